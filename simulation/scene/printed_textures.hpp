#pragma once

#include "simulation/scene/canvas.hpp"
#include "simulation/scene/shapes.hpp"

namespace stdc::simulation {

// Printed matter and other pictures, rich in corners. Same arguments, same bitmap.

/// A bitmap that holds columns x rows pictures of the same kind.
struct PictureSheet {
  cv::Mat image;
  int columns = 1, rows = 1;

  int count() const { return columns * rows; }
  /// The part of the bitmap that holds picture `index` (taken modulo the count).
  PictureArea area(int index) const;
};

PictureSheet book_spines(std::uint64_t seed);   ///< 16 x 4
PictureSheet book_covers(std::uint64_t seed);   ///< 4 x 2
PictureSheet paper_pages(std::uint64_t seed);   ///< 4 x 2: articles, forms, sketches
PictureSheet packages(std::uint64_t seed);      ///< 4 x 2: cartons, tins, bags, wrapped round or flat
PictureSheet screens(std::uint64_t seed);       ///< 2 x 2: editor, plots, browser, terminal
PictureSheet posters(std::uint64_t seed);       ///< 4 x 2: conference posters, landscapes, maps, shapes
PictureSheet small_prints(std::uint64_t seed);  ///< 4 x 4: sticky notes, photographs, cards, badges

cv::Mat keyboard_texture(std::uint64_t seed);
cv::Mat whiteboard_texture(std::uint64_t seed);
cv::Mat outdoor_texture(std::uint64_t seed);  ///< what is seen through the window
cv::Mat calendar_texture(std::uint64_t seed);
cv::Mat clock_texture();

}  // namespace stdc::simulation
