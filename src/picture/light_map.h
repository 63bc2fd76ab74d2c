// The share of light that reaches each place of a front: shadows that the relief casts on itself.
#pragma once

#include "plate/height_field.h"

namespace relievo {

// Light that arrives at a place: from the lamp, and from the sky around it.
struct Light {
  float lamp = 0, sky = 0;
};

// Shares of light in [0, 1] over the front's plane; 1 is full light. They depend on the place and not on the
// viewer, so that all views of a plate show the same light.
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

}  // namespace relievo
