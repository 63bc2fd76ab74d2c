// Computes colours from light: the lamp, the sky, shadows that the relief casts on itself, and the materials
// of all pictures.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "plate/height_field.h"
#include "relievo/picture/material.h"

namespace relievo {

// Light that arrives at a place: from the lamp, and from the sky around it.
struct Light {
  float lamp = 0, sky = 0;
};

// Shares of light in [0, 1] over the front's plane; 1 is full light. They depend on the position and not on
// the viewer, so that all views of a plate show the same light.
class LightMap {
 public:
  // `to_lamp` has length 1. A field without pixels gives a map of ones.
  LightMap(const HeightField& field, const Vec3f& to_lamp);

  // Returns the light at a point of the front, interpolated between pixels.
  Light at(const Vec3f& point) const;

 private:
  Image<Light> light_;
  Vec2f origin_ = Vec2f::Zero();  // pixel at the origin of the front's plane
  float pixels_per_mm_ = 1;
};

// A point of a body with the light on it.
struct Lit {
  Vec3f normal;
  Light light;                        // shares of light that reach the point
  Vec3f place;                        // position on the plate, in mm
  float height = 0;                   // share of the relief's height, 0 is its lowest point
  Vec2f from_middle = Vec2f::Zero();  // offset in units of half the body's longer side, in [-1, 1]
};

// Returns the vector scaled to length 1; a zero vector stays zero.
Vec3f direction_of(const Vec3f& light);

// The light of the room around a body, as a function of direction. It is tabulated, because every pixel uses
// it.
class Room {
 public:
  // Makes a room that is dark everywhere.
  Room() = default;

  explicit Room(const Vec3f& to_lamp);

  // Returns the light from a direction, given as x and y of a unit vector towards the viewer's side. For
  // other vectors it is the light from the nearest such direction.
  float operator()(const Vec2f& direction) const;

 private:
  static constexpr int cells = 48;  // cells per side, over [-1, 1]
  std::vector<float> light_;
};

class Shader {
 public:
  // Both directions are seen from the plate and have length 1. If `to_lamp` is zero, there is no lamp.
  Shader(Material material, const Vec3f& to_lamp, const Vec3f& to_viewer);

  // Returns linear red, green and blue in [0, 1].
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

// Converts linear values to display values.
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
