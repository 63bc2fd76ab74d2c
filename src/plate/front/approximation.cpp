#include "plate/front/approximation.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/lists.h"
#include "geometry/predicates.h"

namespace relievo {

bool Approximation::start() {
  if (!std::ranges::all_of(plane_, is_exact_point)) return false;
  mesh_.emplace(plane_, all_indices(plane_.size()));
  if (!mesh_->start()) return false;
  for (Index i = 0; i < plane_.size(); ++i) mesh_->insert(i);
  return true;
}

// Walks from triangle to triangle, starting at `start`. The points of a scan that follow each other are
// close together, so walks are short.
Index Approximation::find(const Vec2& place, Index start) const {
  Index t = start == no_index || mesh_->is_outside(start) ? mesh_->newest() : start, from = no_index;
  for (Index steps = 0; steps <= mesh_->size(); ++steps) {
    const Index next = towards(place, t, from);
    if (next == t) return t;
    if (next == no_index) return no_index;
    from = std::exchange(t, next);
  }
  return no_index;
}

Index Approximation::across(const Vec2& place, Index t) const {
  const Triangle corners = mesh_->corners(t);
  for (Index i = 0; i < 3; ++i)
    if (orient2d(plane_[corners[(i + 1) % 3]], plane_[corners[(i + 2) % 3]], place) == 0)
      return mesh_->neighbour(t, i);
  return no_index;
}

double Approximation::slope_sq(Index t) const {
  const auto [a, b, c] = mesh_->corners(t);
  const Vec3 normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
  return normal.head<2>().squaredNorm() / (normal.z() * normal.z());
}

double Approximation::height(Index t, const Vec2& place) const {
  const auto [a, b, c] = mesh_->corners(t);
  const Vec3 p = points_[b] - points_[a], q = points_[c] - points_[a];
  const Vec2 d = place - plane_[a];
  const double area = p.x() * q.y() - p.y() * q.x();
  return points_[a].z() +
         (p.z() * (d.x() * q.y() - d.y() * q.x()) + q.z() * (p.x() * d.y() - p.y() * d.x())) / area;
}

// Returns the neighbour of t across an edge that separates t from `place`; t itself if t contains `place`.
Index Approximation::towards(const Vec2& place, Index t, Index from) const {
  const Triangle corners = mesh_->corners(t);
  for (Index i = 0; i < 3; ++i) {
    if (orient2d(plane_[corners[(i + 1) % 3]], plane_[corners[(i + 2) % 3]], place) >= 0) continue;
    const Index across = mesh_->neighbour(t, i);
    if (across != from || from == no_index) return across;
  }
  return t;
}

// Returns the edge through which the segment from a to b leaves triangle t; nothing if b lies in t.
std::optional<Index> Approximation::exit_of(const Vec2& a, const Vec2& b, Index t, Index from) const {
  const Triangle corners = mesh_->corners(t);
  for (Index i = 0; i < 3; ++i) {
    const Vec2 &p = plane_[corners[(i + 1) % 3]], &q = plane_[corners[(i + 2) % 3]];
    if (orient2d(p, q, b) >= 0) continue;
    if (from != no_index && mesh_->neighbour(t, i) == from) continue;
    if (orient2d(a, b, p) <= 0 && orient2d(a, b, q) >= 0) return i;
  }
  return std::nullopt;
}

}  // namespace relievo
