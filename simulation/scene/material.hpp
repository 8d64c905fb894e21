#pragma once

#include <cstdint>

#include "simulation/scene/colour.hpp"

namespace stdc::simulation {

/// How a surface looks to the colour camera and to the depth sensor.
struct Material {
  int texture = 0;               ///< index of a Texture
  float tile = 1;                ///< side of one tile of the texture where it is tiled [m]
  Rgb tint = Rgb::Ones();        ///< multiplies the texture
  float gloss = 0;               ///< strength of the highlights, 0 (matt) to about 0.5 (screen, glaze)
  float shininess = 40;          ///< exponent of the highlights (Blinn 1977)
  float emission = 0;            ///< emitted light, as a multiple of the texture's colour
  float infrared_return = 0.8F;  ///< share of the depth sensor's pattern that comes back at normal incidence
};

}  // namespace stdc::simulation
