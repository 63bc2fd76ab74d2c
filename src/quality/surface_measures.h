// Measures of the surface itself, silhouettes and depth jumps included: a milling cutter follows it there,
// too.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// Measures how even the triangles of a relief are. Const calls may run concurrently.
class SurfaceMeasures {
 public:
  // Keeps a view of the surface, which must outlive it.
  explicit SurfaceMeasures(const Surface& surface);

  struct Fray {
    double silhouette_deg = 0, jump_deg = 0;  // 0 without such an outline
  };

  // Returns how much the tilt of the triangles beside an outline scatters along it. This is the standard
  // deviation of their angles across and along the outline from the means of 25 neighbours. Heights are one
  // per point.
  Fray fray(std::span<const double> heights) const;

  // Returns the 99th percentile of the angles between neighbouring triangles, in degrees. Only pairs count
  // where the model's normals turn by less than 10 degrees from one end of the shared edge to the other.
  double facet_angle_deg(std::span<const double> heights) const;

  // Returns the longest side of the relief's triangles in the view plane, in sampling distances.
  double longest_side() const;

 private:
  // A triangle beside an outline, and the end points of its side on the outline. The triangle lies on the
  // left.
  struct Rim {
    Index from, to, triangle;
  };
  using Chain = std::vector<Rim>;  // each rim begins where the one before ends

  struct Pair {
    Index left, right;  // triangles
  };

  void find_outlines();
  void find_pairs();

  const Surface& surface_;
  std::vector<Chain> silhouettes_, jumps_;
  std::vector<Pair> smooth_pairs_;
};

}  // namespace relievo
