// Implements the brushes that move parts as a whole: Brush::protect and Brush::in_front.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// The points of a surface under a stroke, and the share of the stroke's change that each point gets.
struct StrokeMask {
  std::vector<Index> points;
  std::vector<float> weights;  // (0, 1], one per point
};

// The heights of a relief whose height is `height`, before and after the height correction.
template <typename Real>
struct CorrectedHeights {
  const Surface& surface;
  double height;
  std::span<const Real> uncorrected;
  std::span<Real> z;
};

// Moves the heights under a stroke towards the uncorrected heights plus the plane that fits the height correction best.
// Each height moves by its weight times `amount`. If the result would exceed the height of the relief anywhere, the
// plane is lowered. The mask must not be empty. Instantiated for float and double.
template <typename Real>
void protect(const CorrectedHeights<Real>& heights, const StrokeMask& mask, double amount);

// An edge that leads from a point of a mask across a depth jump.
struct Crossing {
  Index from;    // index in the points of the mask
  Index behind;  // index of the surface point at the deeper end
};

// Returns edges across depth jumps. Each begins at a point of the mask with a weight of at least 1/2, and
// ends at a deeper point outside of the mask.
std::vector<Crossing> crossings_of(const Surface& surface, const StrokeMask& mask);

// The rise that a stroke should have above the surface behind it.
template <typename Real>
struct InFront {
  std::span<const Crossing> crossings;
  Real step;    // least rise of each crossing
  Real height;  // the height of the relief
};

// Raises the heights z under a stroke by their weights times r (1 - z / height). So nothing exceeds the height, and
// higher points stay higher. r is the least value with which all crossings have their step. It is at most the height,
// so points near the top may get less than their step. Instantiated for float and double.
template <typename Real>
void bring_forward(const InFront<Real>& wanted, const StrokeMask& mask, std::span<Real> z);

}  // namespace relievo
