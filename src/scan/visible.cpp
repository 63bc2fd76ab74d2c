#include "relievo/scan/visible.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/lists.h"
#include "geometry/point_set.h"
#include "relievo/core/parallel.h"
#include "scan/depth_buffer.h"
#include "scan/scan_limits.h"

namespace relievo {
namespace {

constexpr double pixel_side = 0.5;  // width of the depth buffer's pixels, in rho; discs are wider
// Points closer together than this in the view plane, in rho, coincide: only the nearest to the viewer is kept.
constexpr double coincidence_distance = .01;
// Connected sets with fewer visible points than this count as floating noise.
constexpr std::size_t smallest_fragment = 32;
// Neighbours farther apart than this, in local spacings, are not connected. A disc of this radius contains 9 pi = 28
// points.
constexpr double connection_length = 3;
// A set is a fragment only if it has fewer points than the number of visible points divided by this.
// Otherwise all of a small cloud would be fragments.
constexpr std::size_t fragment_divisor = 8;
// Lengths in rho. Only densely sampled surfaces, with local spacings below `sparsest_hole_fill`, supply hole-fill
// points. `hole_fill_spacing` is the least distance between these.
constexpr double sparsest_hole_fill = 1.5, hole_fill_spacing = .7;

class Visibility {
 public:
  Visibility(const Cloud& cloud, const Spacing& spacing)
      : cloud_(cloud), spacing_(spacing), is_fragment_(cloud.size(), 0) {}

  VisiblePoints find() {
    Facing facing = all_facing();
    draw(facing);
    std::vector<Index> visible = in_front(facing);
    std::size_t removed = mark_fragments(visible);
    if (removed > 0) {
      // Without the fragments other points become visible. Fragments among these are removed, too, but then the
      // search ends.
      leave_out_fragments(facing);
      visible = in_front(facing);
      removed += mark_fragments(visible);
    }
    std::erase_if(visible, [&](Index i) { return is_fragment_[i]; });
    return {without_coincident(std::move(visible)), removed};
  }

 private:
  // The points that face the viewer, their discs, and which of them are in front.
  struct Facing {
    std::vector<Index> points;
    std::vector<Disc> discs;
    Box box;
    std::optional<DepthBuffer> buffer = {};
    std::vector<std::uint8_t> is_front = {};
  };

  double local_spacing(Index i) const {
    return std::clamp(static_cast<double>(spacing_.local[i]), ScanLimits::least_spacing * spacing_.rho,
                      ScanLimits::largest_spacing * spacing_.rho);
  }

  Facing all_facing() const {
    Facing facing;
    const auto faces_viewer = [](const Vec3f& n) { return n.z() > 0; };
    const auto count = static_cast<std::size_t>(std::ranges::count_if(cloud_.normals, faces_viewer));
    facing.points.reserve(count), facing.discs.reserve(count);
    for (Index i = 0; i < cloud_.size(); ++i) {
      if (!faces_viewer(cloud_.normals[i])) continue;
      facing.points.push_back(i);
      facing.box.extend(cloud_.points[i]);
      facing.discs.push_back(
          {cloud_.points[i], cloud_.normals[i], ScanLimits::disc_radius * local_spacing(i)});
    }
    return facing;
  }

  // Finds which points are in front; in a height field, all are.
  void draw(Facing& facing) const {
    facing.is_front.assign(facing.points.size(), 1);
    if (cloud_.is_height_field) return;
    facing.buffer.emplace(facing.box, pixel_side * spacing_.rho);
    facing.buffer->splat(facing.discs);
    parallel_for(facing.points.size(),
                 [&](std::size_t k) { facing.is_front[k] = is_in_front(facing.points[k], *facing.buffer); });
  }

  std::vector<Index> in_front(const Facing& facing) const {
    std::vector<Index> points = facing.points;
    keep_where(points, [&](std::size_t k) { return facing.is_front[k] != 0; });
    return points;
  }

  // Removes the fragments from the points and the buffer. If the box of the points shrinks, the buffer's pixels move,
  // and all points are drawn again. Otherwise only the places where fragments were drawn are drawn again.
  void leave_out_fragments(Facing& facing) const {
    std::vector<Disc> gone;
    Box box;
    for (std::size_t k = 0; k < facing.points.size(); ++k)
      if (is_fragment_[facing.points[k]])
        gone.push_back(facing.discs[k]);
      else
        box.extend(facing.discs[k].centre);
    const auto stays = [&](std::size_t k) { return !is_fragment_[facing.points[k]]; };
    keep_where(facing.discs, stays);
    keep_where(facing.is_front, stays);
    std::erase_if(facing.points, [&](Index i) { return is_fragment_[i] != 0; });
    const bool is_same_box = box.min == facing.box.min && box.max == facing.box.max;
    facing.box = box;
    if (!is_same_box || !facing.buffer) return draw(facing);
    facing.buffer->take_away(gone, facing.discs);
    parallel_for(facing.points.size(), [&](std::size_t k) {
      const Vec3& p = facing.discs[k].centre;
      if (facing.buffer->is_redrawn(p.x(), p.y()))
        facing.is_front[k] = is_in_front(facing.points[k], *facing.buffer);
    });
  }

  // Compares depths at the centre of the point's pixel, where the buffer's depth was computed. The point's own
  // depth is continued there along its plane.
  bool is_in_front(Index i, const DepthBuffer& buffer) const {
    const Vec3& p = cloud_.points[i];
    const Vec2 step = buffer.pixel_centre(p.x(), p.y()) - p.head<2>();
    const double depth = p.z() + depth_along_plane(cloud_.normals[i], step.x(), step.y());
    const double nz = std::max(static_cast<double>(cloud_.normals[i].z()), ScanLimits::least_facing);
    const double tolerance = ScanLimits::depth_tolerance * local_spacing(i) / nz;
    return depth + tolerance >= static_cast<double>(buffer.depth(p.x(), p.y()));
  }

  // Marks the visible points of small connected sets. Returns the number of these points.
  std::size_t mark_fragments(const std::vector<Index>& visible) {
    std::vector<std::uint8_t> is_visible(cloud_.size(), 0);
    for (const Index i : visible) is_visible[i] = 1;
    DisjointSets sets(cloud_.size());
    for (const Index i : visible) {
      const double radius = connection_length * local_spacing(i);
      for (const Index j : spacing_.nearest[i])
        if (j != no_index && is_visible[j] && (cloud_.points[i] - cloud_.points[j]).norm() < radius)
          sets.join(i, j);
    }
    const std::size_t least = std::min(smallest_fragment, visible.size() / fragment_divisor);
    std::size_t marked = 0;
    for (const Index i : visible)
      if (sets.size_of(i) < least) is_fragment_[i] = 1, ++marked;
    return marked;
  }

  // Of points that nearly coincide in the view plane, keeps only the nearest to the viewer. The triangulation
  // uses only one of coincident points, and coordinates must stay distinct when files round them to single
  // precision.
  std::vector<Index> without_coincident(std::vector<Index> visible) const {
    const auto at = [&](Index i) -> const Vec3& { return cloud_.points[i]; };
    // A sweep along x would compare all points of a column of a range image, which have the same x. This unit
    // direction, 35.8 degrees from the x axis, separates the rows, columns and diagonals of a grid.
    const auto along = [&](Index i) { return .811 * at(i).x() + .585 * at(i).y(); };
    std::sort(visible.begin(), visible.end(),
              [&](Index a, Index b) { return std::pair(along(a), a) < std::pair(along(b), b); });
    const double radius = coincidence_distance * spacing_.rho;
    std::vector<std::uint8_t> is_hidden(visible.size(), 0);
    for (std::size_t a = 0; a < visible.size(); ++a)
      for (std::size_t b = a + 1; b < visible.size() && along(visible[b]) - along(visible[a]) <= radius;
           ++b) {
        if ((at(visible[a]) - at(visible[b])).head<2>().norm() > radius) continue;
        is_hidden[at(visible[a]).z() < at(visible[b]).z() ? a : b] = 1;
      }
    keep_where(visible, [&](std::size_t a) { return !is_hidden[a]; });
    std::sort(visible.begin(), visible.end());
    return visible;
  }

  const Cloud& cloud_;
  const Spacing& spacing_;
  std::vector<std::uint8_t> is_fragment_;
};

// Returns some of the points, no two of which are nearer to each other than `distance` in the view plane.
std::vector<Index> with_least_distance(const Cloud& cloud, std::vector<Index> points, double distance) {
  const auto at = [&](Index i) -> Vec2 { return cloud.points[i].head<2>(); };
  std::ranges::sort(points, {}, [&](Index i) { return std::pair(at(i).x(), i); });
  PointSet kept(distance);
  std::erase_if(points, [&](Index i) { return !kept.add(at(i), distance); });
  std::ranges::sort(points);
  return points;
}

}  // namespace

std::vector<Index> visible_points(const Cloud& viewed, const Spacing& spacing) {
  return find_visible(viewed, spacing).points;
}

VisiblePoints find_visible(const Cloud& viewed, const Spacing& spacing) {
  if (!viewed.has_normals() || !(spacing.rho > 0)) return {};
  return Visibility(viewed, spacing).find();
}

std::vector<Index> hole_fill_points(const Cloud& viewed, const Spacing& spacing,
                                    std::span<const Index> visible) {
  if (!viewed.has_normals()) return {};
  const auto place = [&](std::size_t i) -> Vec2 { return viewed.points[i].head<2>(); };
  const double radius = ScanLimits::hole_fill_distance * spacing.rho;
  PointSet seen(radius);
  for (const Index i : visible) seen.add(place(i), 0);
  std::vector<std::uint8_t> is_far(viewed.size(), 0);
  parallel_for(viewed.size(), [&](std::size_t i) {
    is_far[i] = viewed.normals[i].z() <= 0 && !visible.empty() &&
                static_cast<double>(spacing.local[i]) < sparsest_hole_fill * spacing.rho &&
                !seen.is_near(place(i), radius);
  });
  return with_least_distance(viewed, indices_where(viewed.size(), [&](Index i) { return is_far[i] != 0; }),
                             hole_fill_spacing * spacing.rho);
}

}  // namespace relievo
