// Measurements of scattered points that use an existing k-d tree. Tested by tests/scan/spacing_test.cpp and
// tests/scan/curvature_test.cpp.
#pragma once

#include "geometry/neighbours.h"
#include "relievo/core/progress.h"
#include "relievo/scan/curvature.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Like measure_spacing() in spacing.h. `tree` contains `points`. After cancellation the result is
// meaningless.
Spacing measure_spacing(const KdTree<Vec3>& tree, std::span<const Vec3> points,
                        const Progress* progress = nullptr);

// A cloud, its spacing, and the k-d tree of its points.
struct SearchableCloud {
  const Cloud& cloud;
  const Spacing& spacing;
  const KdTree<Vec3>& tree;
};

// Like mean_curvature() in curvature.h.
std::vector<double> mean_curvature(const SearchableCloud& searchable, std::span<const Index> queries,
                                   const CurvatureOptions& options, const Progress* progress);

}  // namespace relievo
