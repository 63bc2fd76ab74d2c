// Vertex normals of a height field (stage 13), prepared for fixed x and y.
#pragma once

#include <span>
#include <vector>

#include "relievo/boundary.h"
#include "relievo/triangulation.h"

namespace relievo {

// The sum of the cross products of the triangles around a point is linear in the heights where x and y are
// fixed: a stencil over the point's neighbours, gathered per frame. Only triangles inside the relief count.
class VertexNormals {
 public:
  VertexNormals(std::span<const Vec2> points, const Triangulation& triangulation, const Boundary& boundary);

  // Writes the unit normal of each point, (0, 0, 1) at points in no triangle, and its cosine to `light`, a
  // unit vector, 0 where turned away.
  void compute(std::span<const float> heights, const Vec3f& light, std::span<Vec3f> normals,
               std::span<float> shading) const;

  std::size_t memory() const { return begin_.size() * sizeof(Index) + links_.size() * sizeof(Link); }

 private:
  struct Link {
    Index other;
    Vec2f pull;  // change of the normal's x / z and y / z with the height of the other point
  };

  std::vector<Index> begin_;  // links of point i: links_[begin_[i]] up to links_[begin_[i + 1]]
  std::vector<Link> links_;
};

}  // namespace relievo
