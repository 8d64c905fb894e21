#pragma once

#include <cstdint>

#include "segmentation/srm/refinement_task.hpp"

namespace stdc {

/// Copies a row of a mask with 255 for what is not zero, and notes the columns where that is so (or was
/// before).
/// @returns whether there is any in the row
bool copy_mask_row(const std::uint8_t* mask, int width, std::uint8_t* result, std::uint8_t* columns);

/// The loop of the SRM (Alg. 1): adds the pixels within `tau` [units] of depth (Eq. 1). Depths: 16-bit, 0 =
/// missing.
void refine_task(const RefinementTask& task, std::uint16_t tau);
/// The same with depths in metres; missing: not above 0 or not finite.
void refine_task(const RefinementTask& task, float tau);

}  // namespace stdc
