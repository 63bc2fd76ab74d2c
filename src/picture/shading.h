// From light to colour: the lamp, the sky and the materials of all pictures.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "picture/light_map.h"
#include "relievo/picture/material.h"

namespace relievo {

// A place of a body with the light on it.
struct Lit {
  Vec3f normal;
  Light light;                        // shares that reach the place
  Vec3f place;                        // on the plate, mm
  float height = 0;                   // share of the relief's height, 0 is its lowest point
  Vec2f from_middle = Vec2f::Zero();  // of the body, over half of its longer side: in [-1, 1]
};

// Returns the direction of that vector; zero for zero.
Vec3f direction_of(const Vec3f& light);

// The light of the room around a body, by its direction. It is a table, as each pixel looks it up.
class Room {
 public:
  // Dark everywhere.
  Room() = default;

  explicit Room(const Vec3f& to_lamp);

  // Takes x and y of a unit vector that points to the viewer's side; others count as the nearest one that does.
  float operator()(const Vec2f& direction) const;

 private:
  static constexpr int cells = 48;  // of a side, over [-1, 1]
  std::vector<float> light_;
};

class Shader {
 public:
  // Both directions are seen from the plate and have length 1; no lamp if the first is zero.
  Shader(Material material, const Vec3f& to_lamp, const Vec3f& to_viewer);

  // Red, green and blue in [0, 1], linear.
  Vec3f colour(const Lit& lit) const;

 private:
  Light facing(const Lit& lit) const;
  float mirrored_light(const Lit& lit) const;
  Vec3f metal(const Lit& lit) const;
  Vec3f wood(const Lit& lit) const;
  Vec3f porcelain(const Lit& lit) const;

  Material material_;
  Vec3f to_lamp_, to_viewer_, to_sky_;
  float exposure_;
  Room room_;
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
