#include "geometry/plane.h"
#include "plate/plate_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/lists.h"
#include "geometry/held_edges.h"
#include "geometry/slope_limit.h"
#include "geometry/weld.h"
#include "plate/front/silhouette.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

constexpr double rounding = 1.002;  // rounding may make slopes exceed those of the walls by this factor
constexpr double clear_mm = .02;    // least distance of shapes from relief, rim and each other

struct LevelGround {
  std::vector<std::uint8_t> is_ground;  // per triangle
  std::vector<BoundaryEdge> boundary;
  std::vector<Index> inner_points;
};

LevelGround find_ground(const Solid& surface, std::span<const Vec2> inner) {
  LevelGround ground;
  std::vector<Triangle> triangles;
  const auto is_level = [&](Index i) { return surface.points[i].z() == surface.ground_mm; };
  for (const Triangle& t : surface.triangles) {
    const Vec3 sum = surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]];
    ground.is_ground.push_back(std::ranges::all_of(t, is_level) && is_within(sum.head<2>() / 3, inner));
    if (ground.is_ground.back()) triangles.push_back(t);
  }
  ground.boundary = boundary_edges(triangles);
  std::vector<std::uint8_t> is_inner = used_points(surface.points.size(), triangles);
  for (const auto& [a, b] : ground.boundary) is_inner[a] = is_inner[b] = 0;
  ground.inner_points = indices_where(is_inner.size(), [&](Index i) { return is_inner[i] != 0; });
  return ground;
}

std::unexpected<Error> touching(const RaisedShape& shape, std::string_view what) {
  const bool is_text = shape.name.starts_with("the text");
  return option_error(is_text ? "text" : "ornaments",
                      cat("expected room for ", shape.name, ", found ", what,
                          " in its place: a smaller text-size, a wider margin or another text-inset (in "
                          "ornaments, inset) gives room"));
}

// Checks that shapes lie on level ground and keep clear of everything else.
class Surroundings {
 public:
  Surroundings(const Solid& surface, const LevelGround& ground, std::span<const Vec2> inner)
      : inner_(inner), edges_(segments_of(surface, ground), 1) {
    for (const auto& [a, b] : ground.boundary) corners_.push_back(surface.points[a].head<2>());
  }

  Result<void> check(const RaisedShape& shape, const ShapePoints& points) const {
    for (const auto& [a, b] : points.edges) {
      const Vec2 from = points.points[a].head<2>(), to = points.points[b].head<2>();
      if (!is_within(from, inner_, clear_mm)) return touching(shape, "the rim and the outline");
      const bool is_near = edges_.nearest(from, clear_mm).segment != no_index;
      if (is_near || edges_.is_crossed(from, to)) return touching(shape, "the relief");
    }
    const Box box = Box::of(points.points);
    for (const Vec2& p : corners_)
      if (box.min.x() < p.x() && p.x() < box.max.x() && box.min.y() < p.y() && p.y() < box.max.y() &&
          winding_number(shape.outlines, p) != 0)
        return touching(shape, "the relief");
    return {};
  }

 private:
  static std::vector<Segment> segments_of(const Solid& surface, const LevelGround& ground) {
    std::vector<Segment> segments;
    for (const auto& [a, b] : ground.boundary)
      segments.push_back({surface.points[a].head<2>(), surface.points[b].head<2>()});
    return segments;
  }

  std::span<const Vec2> inner_;
  SegmentGrid edges_;
  std::vector<Vec2> corners_;
};

// The points and edges of new ground. The kept points of the surface come first, in the order of `old`.
struct NewGround {
  std::vector<Index> old;  // indices of the surface's points that are kept
  std::vector<Vec2> plane;
  std::vector<double> heights;  // heights of the added points
  std::vector<EdgeEnds> edges;  // the edges of the ground's boundary come first
  std::size_t border_edges = 0;
};

class GroundMaker {
 public:
  GroundMaker(Solid& surface, std::span<const Vec2> inner)
      : surface_(surface), inner_(inner), ground_(find_ground(surface, inner)) {}

  Result<void> add(std::span<const RaisedShape> shapes) {
    RELIEVO_CHECK(make_points(shapes));
    keep_points(shapes);
    add_border();
    add_points();
    return triangulate();
  }

 private:
  Result<void> make_points(std::span<const RaisedShape> shapes) {
    if (ground_.boundary.empty())
      return option_error("text", "expected level ground around the relief for it, found none");
    const Surroundings around(surface_, ground_, inner_);
    std::vector<Segment> feet;
    OrnamentFacts& facts = surface_.ornaments;
    for (const RaisedShape& shape : shapes) {
      ShapePoints points = points_of(shape);
      RELIEVO_CHECK(around.check(shape, points));
      const SegmentGrid others(feet, 1);
      const auto number = static_cast<Index>(points_.size());
      for (const auto& [a, b] : points.edges) {
        const Vec2 from = points.points[a].head<2>(), to = points.points[b].head<2>();
        if (others.nearest(from, clear_mm).segment != no_index || others.is_crossed(from, to)) {
          const Index other = others.nearest(from, (to - from).norm() + clear_mm).segment;
          return touching(shape, other == no_index ? "another ornament" : shapes[feet[other].curve].name);
        }
        if (a < points.feet && b < points.feet) added_feet_.push_back({from, to, number});
      }
      append(feet, added_feet_);
      added_feet_.clear();
      facts.highest_mm = std::max(facts.highest_mm, points.most_mm);
      facts.thinnest_mm = std::min(facts.thinnest_mm, points.thinnest_mm);
      for (std::size_t k = 1; k < shape.levels.size(); ++k) steepest_ = std::max(steepest_, rise(shape, k));
      points_.push_back(std::move(points));
    }
    feet_ = SegmentGrid(std::move(feet), 1);
    return {};
  }

  // Returns the slope of a shape's wall between the previous level and the level `level`.
  static double rise(const RaisedShape& shape, std::size_t level) {
    const WallLevel &low = shape.levels[level - 1], &high = shape.levels[level];
    return std::abs(high.height_mm - low.height_mm) / (high.distance_mm - low.distance_mm);
  }

  // Keeps the ground's inner points that no shape covers.
  void keep_points(std::span<const RaisedShape> shapes) {
    for (const Index i : ground_.inner_points) {
      const Vec2 p = surface_.points[i].head<2>();
      const bool is_covered = std::ranges::any_of(
          shapes, [&](const RaisedShape& s) { return winding_number(s.outlines, p) != 0; });
      if (!is_covered && feet_.nearest(p, clear_mm).segment == no_index) keep(i);
    }
  }

  Index keep(Index i) {
    new_.old.push_back(i);
    new_.plane.emplace_back(surface_.points[i].head<2>());
    return static_cast<Index>(new_.plane.size() - 1);
  }

  void add_border() {
    std::vector<Index> number(surface_.points.size(), no_index);
    for (const auto& [a, b] : ground_.boundary) {
      for (const Index i : {a, b})
        if (number[i] == no_index) number[i] = keep(i);
      new_.edges.push_back({number[a], number[b]});
    }
    new_.border_edges = new_.edges.size();
  }

  void add_points() {
    for (const ShapePoints& shape : points_) {
      const auto first = static_cast<Index>(new_.plane.size());
      for (const Vec3& p : shape.points) {
        new_.plane.emplace_back(p.head<2>());
        new_.heights.push_back(p.z());
      }
      for (const auto& [a, b] : shape.edges) new_.edges.push_back({first + a, first + b});
    }
  }

  // Returns which triangles are inside the ground's border; nothing if the triangulation lacks an edge of the
  // border.
  static std::vector<std::uint8_t> within_border(const HeldTriangulation& made, const NewGround& wanted) {
    std::vector<EdgeEnds> border(wanted.edges.begin(),
                                 wanted.edges.begin() + static_cast<std::ptrdiff_t>(wanted.border_edges));
    for (std::size_t e = 0; e < border.size(); ++e)
      if (!made.is_held[e]) return {};
    std::ranges::sort(border);
    const auto is_border = [&](Index a, Index b) {
      return std::ranges::binary_search(border, EdgeEnds{a, b});
    };
    const auto& [triangles, neighbours, hull] = made.mesh;
    std::vector<std::uint8_t> is_within(triangles.size(), 0);
    std::vector<Index> waiting;
    const auto visit = [&](Index t) {
      if (t != no_index && !std::exchange(is_within[t], 1)) waiting.push_back(t);
    };
    for (Index t = 0; t < triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        if (is_border(triangles[t][i], triangles[t][(i + 1) % 3])) visit(t);
    while (!waiting.empty()) {
      const Index t = waiting.back();
      waiting.pop_back();
      for (std::size_t i = 0; i < 3; ++i)
        if (!is_border(triangles[t][(i + 1) % 3], triangles[t][(i + 2) % 3])) visit(neighbours[t][i]);
    }
    return is_within;
  }

  // Limits the slopes of triangles where walls meet. An edge between points of two walls can make a triangle steeper
  // than both walls. The heights must also stay within their range, so slopes and heights are limited alternately.
  void limit(std::span<const Triangle> triangles) {
    const std::size_t kept = new_.old.size();
    std::vector<double> heights(kept, 0);
    append(heights, new_.heights);
    std::vector<std::uint8_t> is_fixed(kept, 1);
    for (const double height : new_.heights) is_fixed.push_back(height == 0);
    const PlaneMesh field{new_.plane, triangles, is_fixed};
    constexpr int most_rounds = 30;
    for (int round = 0; round < most_rounds && steepest_of(field, heights) > rounding * steepest_; ++round) {
      if (!limit_slopes(field, (1 + rounding) / 2 * steepest_, Rounding::none, heights)) return;
      std::size_t i = kept;
      for (const ShapePoints& shape : points_)
        for (const Vec3& p : shape.points) {
          heights[i] = std::clamp(heights[i], p.z() < 0 ? -shape.most_mm : 0, p.z() > 0 ? shape.most_mm : 0);
          ++i;
        }
    }
    std::copy(heights.begin() + static_cast<std::ptrdiff_t>(kept), heights.end(), new_.heights.begin());
  }

  Result<void> triangulate() {
    const HeldTriangulation made = delaunay_with(new_.plane, new_.edges);
    const std::vector<std::uint8_t> is_within = within_border(made, new_);
    if (is_within.empty())
      return geometry_error("text", "expected ground whose border crosses nothing, found another");
    std::vector<Triangle> ground = made.mesh.triangles;
    keep_where(ground, [&](std::size_t t) { return is_within[t] != 0; });
    limit(ground);
    replace_ground(ground);
    return {};
  }

  // Replaces the old triangles of the ground by `ground`, whose corners are indices of the new ground's points.
  void replace_ground(std::span<const Triangle> ground) {
    std::vector<Triangle>& triangles = surface_.triangles;
    std::vector<Region>& regions = surface_.regions;
    const auto is_kept = [&](std::size_t t) { return ground_.is_ground[t] == 0; };
    keep_where(triangles, is_kept);
    keep_where(regions, is_kept);
    const std::size_t kept = new_.old.size(), old_points = surface_.points.size();
    for (std::size_t i = 0; i < new_.heights.size(); ++i) {
      const Vec2& p = new_.plane[kept + i];
      surface_.points.emplace_back(p.x(), p.y(), surface_.ground_mm + new_.heights[i]);
    }
    const auto number = [&](Index i) {
      return i < kept ? new_.old[i] : static_cast<Index>(old_points + (i - kept));
    };
    for (const auto& [a, b, c] : ground) {
      triangles.push_back({number(a), number(b), number(c)});
      const auto is_low = [&](Index i) { return surface_.points[i].z() == surface_.ground_mm; };
      regions.push_back(std::ranges::all_of(triangles.back(), is_low) ? Region::ground : Region::bevel);
    }
  }

  Solid& surface_;
  std::span<const Vec2> inner_;
  LevelGround ground_;
  std::vector<ShapePoints> points_;
  std::vector<Segment> added_feet_;
  SegmentGrid feet_{{}, 1};
  double steepest_ = 0;  // largest slope of all walls
  NewGround new_;
};

}  // namespace

OrnamentFrame ornament_frame(const PlateOutline& outline, const PlateOptions& options) {
  OrnamentFrame frame{rim_inner_polygon(outline, options.rim), options.margin_mm};
  frame.border_mm = margin_of_borders(options.ornaments, options.margin_mm);
  if (options.rim.width_mm > 0) frame.rim_mm = std::abs(options.rim.height_mm);
  frame.slope = options.ornament_slope;
  frame.is_mirrored = options.is_mirrored;
  frame.is_die = options.is_die;
  return frame;
}

Result<void> add_shapes(Solid& surface, std::span<const RaisedShape> shapes, std::span<const Vec2> inner) {
  if (shapes.empty()) return {};
  return GroundMaker(surface, inner).add(shapes);
}

}  // namespace relievo
