#include "relievo/visible.h"

#include <algorithm>
#include <utility>

#include "core/disjoint_sets.h"
#include "geometry/neighbours.h"
#include "relievo/core/parallel.h"
#include "scan/depth_buffer.h"

namespace relievo {
namespace {

constexpr double pixel_side = 0.5;  // of the depth buffer, in rho
constexpr double widest_disc = 8;   // in rho: a lone point far from all others hides little
constexpr double connection_length =
    3;  // neighbours further apart than this, in local spacings, are not connected

class Visibility {
 public:
  Visibility(const Cloud& cloud, const Spacing& spacing, const VisibleOptions& options)
      : cloud_(cloud), spacing_(spacing), options_(options), is_stray_(cloud.size(), 0) {}

  std::vector<Index> find() {
    std::vector<Index> visible = in_front();
    if (mark_strays(visible)) {
      // What the strays hid comes to light; what it may leave as new fragments goes for good.
      visible = in_front();
      mark_strays(visible);
    }
    std::erase_if(visible, [&](Index i) { return is_stray_[i]; });
    return without_twins(std::move(visible));
  }

 private:
  bool faces_viewer(Index i) const { return cloud_.normals[i].z() > 0 && !is_stray_[i]; }
  double local_spacing(Index i) const {
    return std::clamp(static_cast<double>(spacing_.local[i]), .25 * spacing_.rho,
                      .5 * widest_disc * spacing_.rho);
  }

  std::vector<Index> in_front() const {
    std::vector<Disc> discs;
    Box box;
    std::vector<Index> facing;
    for (Index i = 0; i < cloud_.size(); ++i) {
      if (!faces_viewer(i)) continue;
      facing.push_back(i);
      box.extend(cloud_.points[i]);
      discs.push_back({cloud_.points[i], cloud_.normals[i], options_.disc_radius * local_spacing(i)});
    }
    DepthBuffer buffer(box, pixel_side * spacing_.rho);
    buffer.splat(discs);
    std::vector<std::uint8_t> is_front(facing.size());
    parallel_for(facing.size(), [&](std::size_t j) { is_front[j] = is_in_front(facing[j], buffer); });
    std::size_t kept = 0;
    for (std::size_t j = 0; j < facing.size(); ++j)
      if (is_front[j]) facing[kept++] = facing[j];
    facing.resize(kept);
    return facing;
  }

  // Compares depths at the pixel's centre, where the buffer's was taken: on a slope the two places differ.
  bool is_in_front(Index i, const DepthBuffer& buffer) const {
    const Vec3& p = cloud_.points[i];
    const Vec2 step = buffer.pixel_centre(p.x(), p.y()) - p.head<2>();
    const double depth = p.z() + depth_along_plane(cloud_.normals[i], step.x(), step.y());
    const double nz = std::max(static_cast<double>(cloud_.normals[i].z()), .1);
    const double tolerance = options_.depth_tolerance * local_spacing(i) / nz;
    return depth + tolerance >= static_cast<double>(buffer.depth(p.x(), p.y()));
  }

  // Marks the visible points of small connected sets; returns whether there were any.
  bool mark_strays(const std::vector<Index>& visible) {
    std::vector<std::uint8_t> is_visible(cloud_.size(), 0);
    for (const Index i : visible) is_visible[i] = 1;
    DisjointSets sets(cloud_.size());
    for (const Index i : visible) {
      const double reach = connection_length * local_spacing(i);
      for (const Index j : spacing_.nearest[i])
        if (j != no_index && is_visible[j] && (cloud_.points[i] - cloud_.points[j]).norm() < reach)
          sets.join(i, j);
    }
    const std::size_t least = std::min(options_.smallest_fragment, visible.size() / 8);
    bool found = false;
    for (const Index i : visible)
      if (sets.size_of(i) < least) is_stray_[i] = found = true;
    return found;
  }

  // Of points that all but coincide in the view plane the one nearest to the viewer stays: the triangulation
  // in the plane takes one of them, and coordinates of single precision in a file must not fall together.
  std::vector<Index> without_twins(std::vector<Index> visible) const {
    const auto at = [&](Index i) -> const Vec3& { return cloud_.points[i]; };
    // Swept along a slanting unit direction: the points of a column of a range image share their x, not this.
    const auto along = [&](Index i) { return .811 * at(i).x() + .585 * at(i).y(); };
    std::sort(visible.begin(), visible.end(),
              [&](Index a, Index b) { return std::pair(along(a), a) < std::pair(along(b), b); });
    const double reach = options_.twin_distance * spacing_.rho;
    std::vector<std::uint8_t> is_hidden(visible.size(), 0);
    for (std::size_t a = 0; a < visible.size(); ++a)
      for (std::size_t b = a + 1; b < visible.size() && along(visible[b]) - along(visible[a]) <= reach; ++b) {
        if ((at(visible[a]) - at(visible[b])).head<2>().norm() > reach) continue;
        is_hidden[at(visible[a]).z() < at(visible[b]).z() ? a : b] = 1;
      }
    std::size_t kept = 0;
    for (std::size_t a = 0; a < visible.size(); ++a)
      if (!is_hidden[a]) visible[kept++] = visible[a];
    visible.resize(kept);
    std::sort(visible.begin(), visible.end());
    return visible;
  }

  const Cloud& cloud_;
  const Spacing& spacing_;
  const VisibleOptions& options_;
  std::vector<std::uint8_t> is_stray_;
};

// Leaves out points until none is nearer than `distance` to another in the view plane.
std::vector<Index> thinned(const Cloud& cloud, std::vector<Index> points, double distance) {
  const auto at = [&](Index i) -> Vec2 { return cloud.points[i].head<2>(); };
  std::sort(points.begin(), points.end(),
            [&](Index a, Index b) { return std::pair(at(a).x(), a) < std::pair(at(b).x(), b); });
  std::vector<Index> kept;
  for (const Index i : points) {
    bool is_alone = true;
    for (auto k = kept.rbegin(); is_alone && k != kept.rend() && at(i).x() - at(*k).x() < distance; ++k)
      is_alone = (at(i) - at(*k)).norm() >= distance;
    if (is_alone) kept.push_back(i);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace

std::vector<Index> visible_points(const Cloud& viewed, const Spacing& spacing,
                                  const VisibleOptions& options) {
  if (!viewed.has_normals() || !(spacing.rho > 0)) return {};
  return Visibility(viewed, spacing, options).find();
}

std::vector<Index> filler_points(const Cloud& viewed, const Spacing& spacing, std::span<const Index> visible,
                                 const VisibleOptions& options) {
  if (!viewed.has_normals()) return {};
  std::vector<Vec2> seen(visible.size());
  std::transform(visible.begin(), visible.end(), seen.begin(),
                 [&](Index i) { return viewed.points[i].head<2>(); });
  const KdTree<Vec2> tree(seen);
  const double reach = options.filler_distance * spacing.rho;
  std::vector<std::uint8_t> is_far(viewed.size(), 0);
  parallel_for(viewed.size(), [&](std::size_t i) {
    Index nearest;
    double distance_sq;
    if (viewed.normals[i].z() > 0 || !tree.nearest(viewed.points[i].head<2>(), 1, &nearest, &distance_sq))
      return;
    is_far[i] = distance_sq > reach * reach && static_cast<double>(spacing.local[i]) < 1.5 * spacing.rho;
  });
  std::vector<Index> fillers;
  for (Index i = 0; i < viewed.size(); ++i)
    if (is_far[i]) fillers.push_back(i);
  return thinned(viewed, std::move(fillers), .7 * spacing.rho);
}

}  // namespace relievo
