// From light to colour: the lamp, the sky and the materials of all pictures.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "picture/light_map.h"
#include "relievo/picture/material.h"

namespace relievo {

// A place of a body, lit.
struct Lit {
  Vec3f normal;
  Light light;       // shares that reach the place
  Vec3f place;       // on the plate, mm
  float height = 0;  // share of the relief's height, 0 is its lowest point
};

// Returns the direction of that vector; zero for zero.
Vec3f direction_of(const Vec3f& light);

class Shader {
 public:
  // Both directions are seen from the plate and have length 1; no lamp if the first is zero.
  Shader(Material material, const Vec3f& to_lamp, const Vec3f& to_viewer);

  // Red, green and blue in [0, 1], linear.
  Vec3f colour(const Lit& lit) const;

 private:
  Light facing(const Lit& lit) const;
  Vec3f metal(const Lit& lit) const;
  Vec3f wood(const Lit& lit) const;

  Material material_;
  Vec3f to_lamp_, to_sky_, halfway_;
  float exposure_;
  Vec3f to_window_;
};

// Display values of linear ones.
class DisplayTable {
 public:
  DisplayTable();
  std::uint8_t operator()(float linear) const {
    return levels_[static_cast<std::size_t>(std::clamp(linear, 0.F, brightest) * steps + .5F)];
  }

 private:
  static constexpr float brightest = 2, steps = 4096;
  std::vector<std::uint8_t> levels_;
};

const DisplayTable& display_table();

}  // namespace relievo
