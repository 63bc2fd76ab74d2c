// Carved leaves for the samples: lobed blades with mid-rib and veins. Tested by
// tests/samples/sample_test.cpp.
#pragma once

#include "samples/sample_shapes.h"

namespace relievo::field {

struct Leaf {
  double length = 0, half_width = 0;
  double rise = 0, curl = 0;  // height of the mid-rib, in lengths: rise s + curl s^2 at s in [0, 1]
  double lobes = 4;           // on each side
  double thickness = 0.10;
  Vec3 root = Vec3::Zero();
  Mat3 frame = Mat3::Identity();  // rows: along, across, up
  // Computed by placed(): bounds of the leaf, with which distant points are skipped.
  double lowest = 0, highest = 0;  // heights along `up`, from the root
  Vec3 middle = Vec3::Zero();
  double reach = 0;  // radius of a ball about `middle` that contains the leaf
};

struct LeafPose {
  Vec3 root;
  Vec3 towards;  // of any length
  Vec3 facing;   // roughly where the upper side looks; not parallel to `towards`
};

Leaf placed(Leaf shape, const LeafPose& pose);

// Returns the smaller one of the leaf's field at p and `nearest`. Far from the leaf it takes almost no time.
double leaf_value(const Leaf& leaf, const Vec3& p, double nearest);

}  // namespace relievo::field
