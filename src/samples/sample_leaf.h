// Carved leaves for the samples: lobed blades with mid-rib and veins. Private to the samples.
#pragma once

#include "samples/sample_shapes.h"

namespace relievo::field {

struct Leaf {
  double length = 0, half_width = 0;
  double rise = 0, curl = 0;  // the mid-rib's height is rise s + curl s^2 at s of its length, in lengths
  double lobes = 4;           // on each side
  double thickness = 0.10;
  Vec3 root = Vec3::Zero();
  Mat3 frame = Mat3::Identity();  // rows: along, across, up
  // Filled by placed(): what holds the leaf, to pass it by at little cost.
  double lowest = 0, highest = 0;  // along up, from the root
  Vec3 middle = Vec3::Zero();
  double reach = 0;  // of a ball about `middle` that holds the leaf
};

struct LeafPose {
  Vec3 root;
  Vec3 towards;  // of any length
  Vec3 facing;   // roughly where the upper side looks; not parallel to `towards`
};

// Returns the leaf of that shape, standing as told.
Leaf placed(Leaf shape, const LeafPose& pose);

// Returns the field of the leaf, or `nearest` where that is lower; far away it costs next to nothing.
double leaf_value(const Leaf& leaf, const Vec3& p, double nearest);

}  // namespace relievo::field
