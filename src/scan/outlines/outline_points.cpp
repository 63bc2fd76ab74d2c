#include "scan/outlines/outline_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/lists.h"
#include "geometry/hilbert.h"
#include "geometry/plane.h"
#include "relievo/core/parallel.h"
#include "scan/jumps.h"
#include "scan/outlines/outlines.h"
#include "scan/outlines/row_points.h"

namespace relievo {
namespace {

// Lengths in rho, the sampling distance.
constexpr double rows_end = 3.2;         // only points nearer than this to an outline are replaced
constexpr double replaced_within = .65;  // least distance between kept points and points of rows
constexpr double widest_gap = 1.6;       // radius; points are added where an empty circle is larger
constexpr double sliver_width = .02;
constexpr double widest_sample = 1.9;  // radius of the largest gap that a single point at its centre fills
// Cell size of the set of new points; also the least distance between points in gaps.
constexpr double cell_size = .7;

// Adds the points of a hexagonal lattice inside a counter-clockwise triangle.
void add_lattice_points(const std::array<Vec2, 3>& triangle, double spacing, std::vector<Vec2>& places) {
  const double row_height = spacing * std::sqrt(.75);
  const auto& [a, b, c] = triangle;
  const Vec2 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  for (double row = std::ceil(low.y() / row_height); row * row_height <= high.y(); ++row) {
    const double shift = std::fmod(row, 2) == 0 ? 0 : .5;
    for (double k = std::ceil(low.x() / spacing - shift); (k + shift) * spacing <= high.x(); ++k) {
      const Vec2 p((k + shift) * spacing, row * row_height);
      if (is_within(p, triangle)) places.push_back(p);
    }
  }
}

// Returns positions for new points in gaps inside the surface: in triangles whose empty circles are larger
// than sampling explains. The centres of these circles come first, then, for large gaps, points of a
// hexagonal lattice with a spacing of one rho.
std::vector<Vec2> places_in_gaps(const Surface& surface) {
  std::vector<Vec2> centres, lattice;
  for (const Triangle corners : triangles_inside(surface)) {
    const auto at = [&](int i) -> Vec2 { return surface.points[corners[i]].head<2>(); };
    if (!(cross(at(1) - at(0), at(2) - at(0)) > 0)) continue;
    const Vec2 centre = circle_through(at(0), at(1), at(2)).centre;
    if ((centre - at(0)).norm() <= widest_gap * surface.rho) continue;
    centres.push_back(centre);
    if ((centre - at(0)).norm() > widest_sample * surface.rho)
      add_lattice_points({at(0), at(1), at(2)}, surface.rho, lattice);
  }
  append(centres, lattice);
  return centres;
}

// The new points of a surface, collected before they replace the old ones.
class NewSurface {
 public:
  NewSurface(const Surface& surface, const PlanePoints& plane, const PointMeasures& measures,
             const std::vector<OutlineCurve>& outlines)
      : surface_(surface),
        plane_(plane),
        measures_(measures),
        outlines_(outlines),
        grid_(segments_of(outlines), 1.5 * surface.rho),
        silhouettes_(silhouette_segments(outlines), 1.5 * surface.rho) {}

  void gather() {
    PointSet taken(cell_size * surface_.rho);
    std::vector<RowPoint> rows = row_points(outlines_, grid_, surface_.rho, taken);
    const std::vector<std::uint8_t> is_kept = kept(taken);
    add_gap_points(is_kept, taken, rows);
    for (Index i = 0; i < is_kept.size(); ++i)
      if (is_kept[i]) add_old(i);
    add_new(rows);
  }

  // Replaces the points by the new ones, in the order of a space-filling curve, and triangulates them.
  void replace(Surface& surface, PointMeasures& measures) {
    const std::vector<Index> order = hilbert_order(in_plane(points_));
    const auto ordered = [&](auto& list) { return pick(std::exchange(list, {}), order); };
    surface.points = ordered(points_);
    surface.normals = ordered(normals_);
    surface.colours = ordered(colours_);
    surface.own_heights = ordered(own_heights_);
    measures = {ordered(k_), ordered(spacing_)};
    const std::vector<Vec2> plane = in_plane(surface.points);
    surface.triangulation = delaunay(plane);
    set_boundary(surface, plane, pick(places_, order));
  }

 private:
  static std::vector<Segment> silhouette_segments(const std::vector<OutlineCurve>& outlines) {
    std::vector<Segment> segments = segments_of(outlines);
    std::erase_if(segments, [&](const Segment& s) { return outlines[s.curve].is_jump; });
    return segments;
  }

  // Returns for each old point whether it is kept: it is inside the surface, and no point of a row replaces it.
  std::vector<std::uint8_t> kept(const PointSet& rows) {
    outline_distance_.assign(surface_.points.size(), std::numeric_limits<float>::infinity());
    std::vector<std::uint8_t> is_kept(surface_.points.size(), 0);
    for (const Triangle corners : triangles_inside(surface_))
      for (const Index i : corners) is_kept[i] = 1;
    const double rho = surface_.rho;
    parallel_for(is_kept.size(), [&](std::size_t i) {
      const Vec2 p = surface_.points[i].head<2>();
      const NearestSegment silhouette = silhouettes_.nearest(p, rows_end * rho);
      if (silhouette.segment != no_index && !silhouette.is_left) is_kept[i] = 0;
      if (!is_kept[i]) return;
      const NearestSegment outline = grid_.nearest(p, rows_end * rho);
      if (outline.segment == no_index) return;
      outline_distance_[i] = static_cast<float>(outline.distance);
      if (outline.distance < half_wall * rho || rows.is_near(p, replaced_within * rho)) is_kept[i] = 0;
    });
    return is_kept;
  }

  void add_gap_points(const std::vector<std::uint8_t>& is_kept, PointSet& taken,
                      std::vector<RowPoint>& rows) const {
    const double rho = surface_.rho;
    std::vector<KdTree<Vec2>::Match> near_points;
    const auto is_near_kept = [&](const Vec2& place) {
      plane_.tree.within(place, .81 * rho, near_points);
      return std::ranges::any_of(
          near_points, [&](const auto& m) { return is_kept[m.first] && m.second < .64 * rho * rho; });
    };
    for (const Vec2& place : places_in_gaps(surface_)) {
      const NearestSegment near = silhouettes_.nearest(place, rows_end * rho);
      if (near.segment != no_index && (!near.is_left || near.distance < .6 * rho)) continue;
      if (grid_.nearest(place, .6 * rho).segment != no_index) continue;
      if (is_near_kept(place)) continue;
      if (taken.add(place, cell_size * rho)) rows.push_back({place, place, Place::row});
    }
  }

  void add_old(Index i) {
    points_.push_back(surface_.points[i]);
    normals_.push_back(surface_.normals[i]);
    if (!surface_.colours.empty()) colours_.push_back(surface_.colours[i]);
    if (!surface_.own_heights.empty()) own_heights_.push_back(surface_.own_heights[i]);
    k_.push_back(measures_.k[i]);
    if (!measures_.spacing.empty()) spacing_.push_back(measures_.spacing[i]);
    places_.push_back(Place::scan);
  }

  void add_new(const std::vector<RowPoint>& rows) {
    const SideInterpolation interpolation({surface_, plane_, measures_, grid_, outline_distance_});
    const std::vector<SideInterpolation::Value> values =
        smoothed_along_rows(rows, interpolation.at(rows), surface_.rho);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const SideInterpolation::Value& value = values[r];
      if (!value.is_known) continue;
      points_.push_back(value.point);
      normals_.push_back(value.normal);
      if (!surface_.colours.empty()) colours_.push_back(value.colour);
      if (!surface_.own_heights.empty()) own_heights_.push_back(value.own_height);
      k_.push_back(value.k);
      if (!measures_.spacing.empty()) spacing_.push_back(value.spacing);
      places_.push_back(rows[r].place);
    }
  }

  // Sets which triangles are inside. A triangle with a corner on the silhouette or with a long edge is inside if its
  // centre is inside the silhouette. All others are inside, apart from crumbs.
  void set_boundary(Surface& surface, const std::vector<Vec2>& plane,
                    const std::vector<Place>& places) const {
    Boundary& boundary = surface.boundary;
    const auto& triangles = surface.triangulation.triangles;
    boundary.is_inside.assign(triangles.size(), 1);
    parallel_for(triangles.size(), [&](std::size_t t) {
      const auto& [a, b, c] = triangles[t];
      const auto is_on = [&](Index i) { return places[i] == Place::silhouette; };
      const double longest = std::max(
          {(plane[a] - plane[b]).norm(), (plane[b] - plane[c]).norm(), (plane[c] - plane[a]).norm()});
      if (!is_on(a) && !is_on(b) && !is_on(c) && longest < 3 * surface.rho) return;
      const Vec2 centre = (plane[a] + plane[b] + plane[c]) / 3;
      const NearestSegment near = silhouettes_.nearest(centre, std::max(3 * surface.rho, longest));
      // A thin triangle whose corners all lie on a nearly straight part of the silhouette is outside. Its
      // empty circle is larger than those inside the surface.
      const bool is_sliver = is_on(a) && is_on(b) && is_on(c) && near.distance < sliver_width * surface.rho;
      boundary.is_inside[t] = near.segment == no_index || (near.is_left && !is_sliver);
    });
    drop_crumbs(surface);
    boundary.is_boundary = boundary_points(plane.size(), surface.triangulation, boundary.is_inside);
    for (Index i = 0; i < plane.size(); ++i) boundary.is_boundary[i] |= places[i] == Place::silhouette;
    boundary.wall_side.assign(plane.size(), WallSide::none);
    for (Index i = 0; i < plane.size(); ++i) {
      if (places[i] == Place::front) boundary.wall_side[i] = WallSide::front;
      if (places[i] == Place::back) boundary.wall_side[i] = WallSide::back;
    }
    set_distances(surface, plane);
  }

  // Near the silhouette the distance is measured to its segments, elsewhere to its points.
  void set_distances(Surface& surface, const std::vector<Vec2>& plane) const {
    Boundary& boundary = surface.boundary;
    boundary.distance = distances_to(plane, boundary.is_boundary);
    parallel_for(plane.size(), [&](std::size_t i) {
      if (boundary.is_boundary[i] || boundary.distance[i] > 4 * surface.rho) return;
      const NearestSegment near = silhouettes_.nearest(plane[i], 4 * surface.rho);
      if (near.segment != no_index)
        boundary.distance[i] = std::min(boundary.distance[i], static_cast<float>(near.distance));
    });
  }

  const Surface& surface_;
  const PlanePoints& plane_;
  const PointMeasures& measures_;
  const std::vector<OutlineCurve>& outlines_;
  SegmentGrid grid_, silhouettes_;
  std::vector<float> outline_distance_;  // per old point; infinity if no outline is near
  std::vector<Vec3> points_;
  std::vector<Vec3f> normals_;
  std::vector<Colour> colours_;
  std::vector<float> own_heights_;
  std::vector<double> k_;
  std::vector<float> spacing_;
  std::vector<Place> places_;
};

// The least length of (n_x, n_y) of normals where a surface turns away from the viewer. least_lean in outlines.cpp has
// the same value.
constexpr double least_turned = .75;

// Returns whether there is a depth jump between two points at which the surface behind ends. The surface
// behind ends if its normal at `back` leans towards `front`.
bool ends_at_jump(const Surface& surface, Index front, Index back) {
  if (!is_occlusion(surface, front, back)) return false;
  if (surface.points[front].z() < surface.points[back].z()) std::swap(front, back);
  const Vec2 step = (surface.points[front] - surface.points[back]).head<2>();
  return surface.normals[back].head<2>().cast<double>().dot(step) > least_turned * step.norm();
}

// Returns whether both surfaces end between two points: their normals lean towards each other.
bool ends_on_both_sides(const Surface& surface, Index a, Index b) {
  const Vec2 step = (surface.points[b] - surface.points[a]).head<2>();
  const auto lean = [&](Index i) { return surface.normals[i].head<2>().cast<double>().dot(step); };
  return lean(a) > least_turned * step.norm() && lean(b) < -least_turned * step.norm();
}

std::vector<std::uint8_t> gap_triangles(const Surface& surface) {
  const std::vector<Triangle>& triangles = surface.triangulation.triangles;
  std::vector<std::uint8_t> is_gap(triangles.size(), 0);
  parallel_for(triangles.size(), [&](std::size_t t) {
    if (!surface.boundary.is_inside[t]) return;
    const auto [a, b, c] = triangles[t];
    const auto at = [&](Index i) -> Vec2 { return surface.points[i].head<2>(); };
    const auto ends_between = [&](Index p, Index q) {
      return ends_at_jump(surface, p, q) || ends_on_both_sides(surface, p, q);
    };
    is_gap[t] = circumradius(at(a), at(b), at(c)) > surface.view.gap / 2 * surface.rho &&
                (ends_between(a, b) || ends_between(b, c) || ends_between(c, a));
  });
  return is_gap;
}

// Does the work of put_points_on_outlines(), and returns true. If there are no outlines, returns false and
// changes only boundary.is_inside and crumbs.
bool outlines_replace_points(Surface& surface, PointMeasures& measures,
                             std::span<const OutlineSegment> known_outlines) {
  const ExactOutlines exact(known_outlines, surface.rho);
  if (exact.empty())
    open_notches(surface);
  else
    exact.open_gaps(surface);
  if (!drop_crumbs(surface)) return false;
  const PlanePoints plane(surface);
  std::vector<OutlineCurve> outlines = find_outlines(surface, plane, exact);
  if (outlines.empty() || outlines.front().is_jump) return false;
  add_inner_lines(surface, plane, outlines);
  join_jumps(outlines, surface.rho);
  NewSurface now(surface, plane, measures, outlines);
  now.gather();
  now.replace(surface, measures);
  return true;
}

}  // namespace

void put_points_on_outlines(Surface& surface, PointMeasures& measures,
                            std::span<const OutlineSegment> known_outlines) {
  // If there are no outlines, the flags that the search for outlines has changed are restored.
  std::vector<std::uint8_t> is_inside = surface.boundary.is_inside;
  if (!outlines_replace_points(surface, measures, known_outlines))
    surface.boundary.is_inside = std::move(is_inside);
}

void open_notches(Surface& surface) {
  std::vector<std::uint8_t>& is_inside = surface.boundary.is_inside;
  const std::vector<std::uint8_t> is_gap = gap_triangles(surface);
  std::vector<Index> open = indices_where(is_inside.size(), [&](Index t) { return !is_inside[t]; });
  while (!open.empty()) {
    const Index t = open.back();
    open.pop_back();
    for (const Index other : surface.triangulation.neighbours[t])
      if (other != no_index && is_inside[other] && is_gap[other]) is_inside[other] = 0, open.push_back(other);
  }
}

}  // namespace relievo
