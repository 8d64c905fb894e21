#pragma once

#include "simulation/scene/canvas.hpp"

namespace stdc::simulation {

// What walls, floors and furniture are made of. Every bitmap has sides that are powers of two and tiles, and
// is the same for the same arguments.

/// Boards with grain along x; `boards` of them one above the other (1: a plain veneer).
cv::Mat wood_texture(const Paint& colour, int boards, std::uint64_t seed);
/// Strip parquet, square tile.
cv::Mat parquet_texture(const Paint& colour, std::uint64_t seed);
/// Painted plaster with faint stains and scratches.
cv::Mat plaster_texture(const Paint& colour, std::uint64_t seed);
cv::Mat brick_texture(const Paint& colour, std::uint64_t seed);
/// Square tiles, two colours in turn, with joints.
cv::Mat checker_texture(const Paint& a, const Paint& b, std::uint64_t seed);
/// Carpet of a rug: border, medallions, threads.
cv::Mat rug_texture(const Paint& ground, std::uint64_t seed);
/// Woven cloth of chairs and curtains.
cv::Mat fabric_texture(const Paint& colour, std::uint64_t seed);
/// Mineral fibre tiles of an office ceiling, 2 x 2 tiles.
cv::Mat ceiling_texture(std::uint64_t seed);
/// Corrugated board of boxes, with tape and print.
cv::Mat cardboard_texture(std::uint64_t seed);
/// Moulded plastic or painted metal: nearly plain.
cv::Mat plain_texture(const Paint& colour, std::uint64_t seed);
cv::Mat leaf_texture(std::uint64_t seed);
cv::Mat cork_texture(std::uint64_t seed);

}  // namespace stdc::simulation
