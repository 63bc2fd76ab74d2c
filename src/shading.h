// From light to colour: materials of the live pictures.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "light_map.h"
#include "relievo/render.h"

namespace relievo {

// A place of the plate, lit.
struct Lit {
  Vec3f normal;
  Light light;       // shares that reach the place
  Vec3f place;       // on the plate, mm
  float height = 0;  // share of the relief's height, 0 is its lowest point
};

class Shader {
 public:
  // Both directions are seen from the plate and have length 1.
  Shader(Material material, const Vec3f& to_lamp, const Vec3f& to_viewer);

  // Red, green and blue in [0, 1], linear.
  Vec3f colour(const Lit& lit) const;

 private:
  Vec3f metal(const Lit& lit) const;
  Vec3f wood(const Lit& lit) const;

  Material material_;
  Vec3f to_lamp_, to_sky_, halfway_, to_window_;
};

// Display value of a linear one in [0, 1].
std::uint8_t display_value(float linear);

}  // namespace relievo
