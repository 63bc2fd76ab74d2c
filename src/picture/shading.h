// Computes colours for all pictures. They depend on the lamp, the sky, the relief's shadows on
// itself, and the materials.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "plate/height_field.h"
#include "relievo/core/types.h"
#include "relievo/picture/material.h"
#include "relievo/plate/tool.h"

namespace relievo {

// The light that arrives at a point from the lamp and from the sky.
struct Light {
  float lamp = 0, sky = 0;
};

// The shares of full light, in [0, 1], over the plane of the front. They depend on the position but not on
// the viewer, so all views of a plate have the same shadows.
class LightMap {
 public:
  // `to_lamp` has unit length. If the field has no pixels, all points get full light.
  LightMap(const HeightField& field, const Vec3f& to_lamp);

  // Returns the light at a point of the front, interpolated between pixels.
  Light at(const Vec3f& point) const;

 private:
  Image<Light> light_;
  Vec2f origin_ = Vec2f::Zero();  // the pixel at the origin of the plane of the front
  float pixels_per_mm_ = 1;
};

// A point of a body, and the light on it.
struct Lit {
  Vec3f normal;
  Light light;       // the shares of full light that reach the point
  Vec3f place;       // position on the plate, in mm
  float height = 0;  // as a share of the relief's height; 0 at the relief's lowest point
  // Offset from the middle of the body, in units of half the body's longer side; in [-1, 1].
  Vec2f from_middle = Vec2f::Zero();
};

// Returns the vector scaled to unit length; zero for a zero vector.
Vec3f direction_of(const Vec3f& light);

// The light that a body receives from its environment, as a function of direction. It is tabulated, because every pixel
// needs it.
class EnvironmentLight {
 public:
  // Makes an environment that is dark everywhere.
  EnvironmentLight() = default;

  explicit EnvironmentLight(const Vec3f& to_lamp);

  // Returns the light from a direction, which is given as the x and y of a unit vector with positive z. If
  // the vector (x, y) is longer than 1, returns the light from the nearest valid direction.
  float operator()(const Vec2f& direction) const;

 private:
  static constexpr int cells = 48;  // cells per side of a table over [-1, 1]
  std::vector<float> light_;
};

class Shader {
 public:
  // Both directions are unit vectors in the axes of the plate. If `to_lamp` is zero, there is no lamp.
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
  EnvironmentLight environment_;
};

// Converts linear brightness to display values.
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

class ReachTint {
 public:
  // `front` is the box of the measured front in the body's coordinates. If `reach` is null, colours do not change.
  ReachTint(std::shared_ptr<const ToolReach> reach, const Box& front);

  // Returns the linear colour of a point on the front, given its colour without tint. If more material
  // than the tolerance is left at the point, the result is orange to red.
  Vec3f operator()(const Vec3f& colour, const Vec3f& place) const;

 private:
  std::shared_ptr<const ToolReach> reach_;
  Vec2f corner_ = Vec2f::Zero();  // upper left corner of the samples, mm
};

}  // namespace relievo
