// Measures scattered points with a k-d tree that the caller already has. Tested by
// tests/scan/spacing_test.cpp, tests/scan/normals_test.cpp and tests/scan/curvature_test.cpp.
#pragma once

#include "geometry/neighbours.h"
#include "relievo/core/progress.h"
#include "relievo/scan/curvature.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Does the same as measure_spacing() in spacing.h, with a `tree` that contains `points`. After cancellation the
// result is meaningless.
Spacing measure_spacing(const KdTree<Vec3>& tree, std::span<const Vec3> points,
                        const Progress* progress = nullptr);

// A cloud, its spacing, and the k-d tree of its points.
struct SearchableCloud {
  const Cloud& cloud;
  const Spacing& spacing;
  const KdTree<Vec3>& tree;
};

// Returns the normals at the given points, in their order. Each is the normal of a plane fitted to the point's
// nearest `neighbours`, at most 64; see estimate_normals() in normals.h.
std::vector<Vec3f> estimated_normals(const SearchableCloud& searchable, std::span<const Index> points,
                                     std::size_t neighbours, const Progress* progress = nullptr);

// Does the same as mean_curvature() in curvature.h.
std::vector<double> mean_curvature(const SearchableCloud& searchable, std::span<const Index> queries,
                                   const CurvatureOptions& options, const Progress* progress);

}  // namespace relievo
