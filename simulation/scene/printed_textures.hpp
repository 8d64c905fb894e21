#pragma once

#include "simulation/scene/canvas.hpp"
#include "simulation/scene/shapes.hpp"

namespace stdc {

// Printed matter and other pictures: what gives a room its corners. Same arguments, same bitmap.

/// A bitmap that holds columns x rows pictures of the same kind.
struct Atlas {
  cv::Mat image;
  int columns = 1, rows = 1;

  int count() const { return columns * rows; }
  /// The part of the bitmap that holds picture `index` (taken modulo the count).
  PictureArea area(int index) const;
};

Atlas book_spines(std::uint64_t seed);   ///< 16 x 4
Atlas book_covers(std::uint64_t seed);   ///< 4 x 2
Atlas paper_pages(std::uint64_t seed);   ///< 4 x 2: articles, forms, sketches
Atlas packages(std::uint64_t seed);      ///< 4 x 2: cartons, tins, bags, wrapped round or flat
Atlas screens(std::uint64_t seed);       ///< 2 x 2: editor, plots, browser, terminal
Atlas posters(std::uint64_t seed);       ///< 4 x 2: conference posters, landscapes, maps, shapes
Atlas small_prints(std::uint64_t seed);  ///< 4 x 4: sticky notes, photographs, cards, badges

cv::Mat keyboard_texture(std::uint64_t seed);
cv::Mat whiteboard_texture(std::uint64_t seed);
cv::Mat outdoor_texture(std::uint64_t seed);  ///< what is seen through the window
cv::Mat calendar_texture(std::uint64_t seed);
cv::Mat clock_texture();

}  // namespace stdc
