#pragma once

#include "simulation/scene/canvas.hpp"

namespace stdc::simulation {

// Random pictures that fill a canvas: parts of posters, book covers, pages and photographs.

constexpr Paint kInk{28, 28, 32}, kPaperWhite{240, 240, 236};

Paint strong_colour(Random& random);
/// Curves over axes.
void paint_plot(Canvas& c, Random& random);
void paint_bars(Canvas& c, Random& random);
void paint_landscape(Canvas& c, Random& random);
/// Discs, rings and triangles over a blend of colours, with a title.
void paint_shapes(Canvas& c, Random& random);
/// A poster; `index` selects its kind: conference poster, landscape, map, shapes.
void paint_poster(Canvas& c, Random& random, int index);

}  // namespace stdc::simulation
