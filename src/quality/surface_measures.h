// Measures the relief's surface, including silhouettes and depth jumps, because a milling cutter follows the whole
// surface.
#pragma once

#include <span>
#include <vector>

#include "relievo/scan/surface.h"

namespace relievo {

// Measures how regular the triangles of a relief are. Const calls may run concurrently.
class SurfaceMeasures {
 public:
  // Keeps a reference to the surface, which must outlive the object.
  explicit SurfaceMeasures(const Surface& surface);

  struct Fray {
    double silhouette_deg = 0, jump_deg = 0;  // 0 if no outline of that kind has 25 triangles
  };

  // Returns how much the tilt of the triangles beside an outline varies along it: the standard deviation of their
  // angles, across and along the outline, from the moving means over 25 triangles. `heights` has one height per
  // point.
  Fray fray(std::span<const double> heights) const;

  // Returns the 99th percentile of the angles between neighbouring triangles, in degrees. Ignores edges across walls,
  // and edges at whose two ends the model's normals differ by more than 10 degrees.
  double facet_angle_deg(std::span<const double> heights) const;

  // Returns the longest triangle side of the relief in the view plane, in sampling distances.
  double longest_side() const;

 private:
  // A triangle beside an outline, and the ends of its side on the outline. The triangle is on the left of the side.
  struct Rim {
    Index from, to, triangle;
  };
  using Chain = std::vector<Rim>;  // each rim begins at the end of the previous one

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
