// Blurs heights under a stroke. Tested by tests/relief/stroke_fields_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/groups.h"
#include "relievo/scan/surface.h"
#include "relievo/solver/cholesky.h"

namespace relievo {

// The edges and areas of a surface, from which blurs are built.
struct SurfaceLinks {
  struct Link {
    Index to;
    float weight;  // the result of edge_weight()
  };
  Groups<Link> links;        // per point: its edges inside the relief that are no depth jumps
  std::vector<float> areas;  // per point: a third of the area of its triangles, in the view plane
};

// Returns the links and areas of all points of the surface.
SurfaceLinks surface_links(const Surface& surface);

// Computes the difference between heights and their blur at some points. The heights of all other points stay fixed.
// The blur does not cross depth jumps. `Real` is the type of the heights.
template <typename Real>
class StrokeBlur {
 public:
  // `sigma` is the standard deviation of the blur, in the units of the surface.
  StrokeBlur(const Surface& surface, const SurfaceLinks& links, std::span<const Index> points, double sigma);

  // Computes removed() for the heights z of all points of the surface.
  void take(std::span<const Real> z);

  // Returns the height minus the blurred height, one per point; empty before the first take().
  const std::vector<Real>& removed() const { return removed_; }

 private:
  // A link from a point to a point of points_. `to` is an index in points_. If `from` is less than the size
  // of points_, it is also an index in points_. Otherwise `from` minus this size is an index in around_.
  struct Link {
    Index to, from;
    Real pull;
  };

  std::vector<Index> points_, around_;
  std::vector<Link> links_;
  std::vector<Real> areas_;
  std::optional<solver::Cholesky> system_;
  std::optional<solver::Cholesky::Workspace> workspace_;
  std::vector<Real> removed_;
};

}  // namespace relievo
