// Compares triangulations with those of Qhull, which computes in plain doubles. The points are far from
// degenerate, so both must be equal.
#ifdef RELIEVO_HAS_QHULL

#include <gtest/gtest.h>
#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <set>

#include "relievo/geometry/triangulation.h"
#include "support/planar_points.h"

namespace relievo {
namespace {

// Triangles with sorted corners, because Qhull does not orient its facets consistently.
using Corners = std::set<Triangle>;

Corners corners_of(const Triangulation& triangulation) {
  Corners result;
  for (Triangle t : triangulation.triangles) {
    std::sort(t.begin(), t.end());
    result.insert(t);
  }
  return result;
}

Corners qhull_corners(std::vector<Vec2> points) {
  qhT state, *qh = &state;
  qh_zero(qh, stderr);
  char command[] = "qhull d Qbb";
  Corners result;
  const auto n = static_cast<int>(points.size());
  EXPECT_EQ(qh_new_qhull(qh, 2, n, points[0].data(), False, command, nullptr, stderr), 0);
  facetT* facet;
  FORALLfacets {
    if (facet->upperdelaunay) continue;
    Triangle t;
    auto corner = t.begin();
    vertexT *vertex, **vertexp;
    FOREACHvertex_(facet->vertices)* corner++ = static_cast<Index>(qh_pointid(qh, vertex->point));
    std::sort(t.begin(), t.end());
    result.insert(t);
  }
  int blocks = 0, bytes = 0;
  qh_freeqhull(qh, !qh_ALL);
  qh_memfreeshort(qh, &blocks, &bytes);
  return result;
}

TEST(DelaunayAgainstQhull, FindsTheSameTriangles) {
  std::vector<Vec2> stretched = random_points(5000, 7), dense = random_points(5000, 8);
  for (Vec2& p : stretched) p.y() *= 0.01;
  for (Vec2& p : dense) p = p.cwiseProduct(p).cwiseProduct(p);
  for (const std::vector<Vec2>& points : {random_points(20000), stretched, dense})
    EXPECT_EQ(corners_of(delaunay(points)), qhull_corners(points));
}

}  // namespace
}  // namespace relievo

#endif
