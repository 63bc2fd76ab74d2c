// A coarse look at a cloud from +Z: which points are in front, cell by cell. For guesses, not for the relief.
#pragma once

#include "relievo/scan/cloud.h"

namespace relievo {

struct FrontMost {
  double facing_share =
      .5;  // of the front-most points not seen edge on, those that face the viewer; .5 of none
  double normal_variation = 0;  // sum of normal differences between neighbouring cells, depth jumps left out
};

// Looks at a cloud with normals, in view coordinates, through a grid of `cells` cells along the diagonal of
// its box.
FrontMost front_most(const Cloud& viewed, int cells = 160);

}  // namespace relievo
