#include "relievo/solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "relievo/parallel.h"
#include "relievo/text.h"
#include "silhouette.h"

namespace relievo {
namespace {

// Below a micrometre the files' single precision could no longer tell the ring or the walls from a line.
constexpr double least_size_mm = 1e-3;

constexpr Colour plate_colour = {200, 200, 200};  // of the ground, walls and bottom of a coloured relief

std::unexpected<Error> fail(ErrorKind kind, std::string input, std::string expected) {
  return std::unexpected(Error{kind, std::move(input), {}, std::move(expected)});
}

Result<void> check_options(const PlateOptions& options) {
  const auto is_good = [](double mm) { return std::isfinite(mm) && mm >= least_size_mm; };
  const auto wanted = [](double mm) {
    return cat("expected a finite length of at least 0.001 mm, found ", mm);
  };
  if (!is_good(options.margin_mm)) return fail(ErrorKind::option, "margin", wanted(options.margin_mm));
  if (!is_good(options.thickness_mm))
    return fail(ErrorKind::option, "thickness", wanted(options.thickness_mm));
  if (options.outline == Outline::round && !is_good(options.corner_mm))
    return fail(ErrorKind::option, "corner", wanted(options.corner_mm));
  return {};
}

Result<void> check_front(const Front& front, bool has_ground) {
  const auto is_bad = [&](Index i) { return i >= front.points.size() || !front.points[i].allFinite(); };
  const auto has_bad_corner = [&](const Triangle& t) { return std::ranges::any_of(t, is_bad); };
  if (front.triangles.empty() || (has_ground && front.hull.size() < 3))
    return fail(ErrorKind::geometry, "front", "expected triangles and a hull around them, found none");
  if (std::ranges::any_of(front.triangles, has_bad_corner) || std::ranges::any_of(front.hull, is_bad))
    return fail(ErrorKind::geometry, "front", "expected corners that are finite points of the front");
  if (!front.colours.empty() && front.colours.size() != front.points.size())
    return fail(ErrorKind::geometry, "front", "expected a colour for each point of the front, or none");
  if (!front.is_relief.empty() && front.is_relief.size() != front.triangles.size())
    return fail(ErrorKind::geometry, "front",
                "expected to know for each triangle if it is relief, or for none");
  return {};
}

Box used_box(const Front& front) {
  Box box;
  for (const Triangle& t : front.triangles)
    for (const Index i : t) box.extend(front.points[i]);
  return box;
}

// Adds the front's points to an empty solid, the corner of their box at `corner`.
void place_front(const Front& front, const Box& box, const Vec3& corner, Solid& solid) {
  solid.points.reserve(front.points.size() + 8);
  // Subtracting before adding keeps the box exact: the lowest point comes to lie at the thickness, bit for
  // bit.
  for (const Vec3& p : front.points) solid.points.push_back((p - box.min) + corner);
}

// The outline of a plate with ground, from the far, lower left corner of the plate's box; and where that of
// the front's box lies in it.
struct Ground {
  std::vector<Vec2> outline;
  Vec2 corner = Vec2::Zero();
};

Ground ground_around(const Front& front, const Box& box, const PlateOptions& options) {
  if (options.outline == Outline::rectangle) {
    const Vec2 corner = Vec2::Constant(options.margin_mm), size = box.size().head<2>() + corner + corner;
    return {{{0, 0}, {size.x(), 0}, size, {0, size.y()}}, corner};
  }
  std::vector<Vec2> hull;
  for (const Index i : front.hull) hull.push_back((front.points[i] - box.min).head<2>());
  Ground ground{outline_around(hull, {options.outline, options.corner_mm, options.margin_mm})};
  Vec2 min = ground.outline[0];
  for (const Vec2& p : ground.outline) min = min.cwiseMin(p);
  for (Vec2& p : ground.outline) p -= min;
  ground.corner = -min;
  return ground;
}

// A convex polygon of the solid's points, counter-clockwise seen from +Z.
using Rim = std::vector<Index>;

Rim add_outline(Solid& solid, const std::vector<Vec2>& outline, double z) {
  Rim rim;
  for (const Vec2& p : outline) {
    rim.push_back(static_cast<Index>(solid.points.size()));
    solid.points.emplace_back(p.x(), p.y(), z);
  }
  return rim;
}

Vec2 edge(const Solid& solid, const Rim& rim, std::size_t i) {
  return (solid.points[rim[(i + 1) % rim.size()]] - solid.points[rim[i]]).head<2>();
}

// Lets the rim begin at its lowest vertex (of several, the leftmost), so that its edges' angles rise from 0
// to 2 pi.
void begin_at_lowest(const Solid& solid, Rim& rim) {
  const auto is_lower = [&](Index a, Index b) {
    const Vec3 &p = solid.points[a], &q = solid.points[b];
    return p.y() != q.y() ? p.y() < q.y() : p.x() < q.x();
  };
  std::ranges::rotate(rim, std::ranges::min_element(rim, is_lower));
}

// Is the angle of `a`, in [0, 2 pi), smaller than that of `b`?
bool has_smaller_angle(const Vec2& a, const Vec2& b) {
  const auto is_lower_half = [](const Vec2& v) { return v.y() < 0 || (v.y() == 0 && v.x() < 0); };
  if (is_lower_half(a) != is_lower_half(b)) return is_lower_half(b);
  return a.x() * b.y() - a.y() * b.x() > 0;
}

// Fills the ring between two convex polygons, the inner strictly inside the outer. Both are walked in the
// order of their edges' outward normals; each edge is joined to the other polygon's vertex that is farthest
// in its normal's direction. The segments between such pairs sweep the ring once, so no triangles overlap,
// and every one has an area, also where points are collinear or edges are parallel.
void add_ring(Solid& solid, Rim inner, Rim outer) {
  begin_at_lowest(solid, inner);
  begin_at_lowest(solid, outer);
  const std::size_t n = inner.size(), m = outer.size();
  for (std::size_t i = 0, j = 0; i < n || j < m;) {
    const bool is_outer_next =
        i == n || (j < m && has_smaller_angle(edge(solid, outer, j), edge(solid, inner, i)));
    if (is_outer_next) {
      solid.triangles.push_back({outer[j], outer[(j + 1) % m], inner[i % n]});
      ++j;
    } else {
      solid.triangles.push_back({inner[(i + 1) % n], inner[i], outer[j % m]});
      ++i;
    }
  }
}

void add_walls(Solid& solid, const Rim& top, const Rim& bottom) {
  for (std::size_t i = 0; i < top.size(); ++i) {
    const std::size_t next = (i + 1) % top.size();
    solid.triangles.push_back({bottom[i], bottom[next], top[next]});
    solid.triangles.push_back({bottom[i], top[next], top[i]});
  }
}

void add_bottom(Solid& solid, const Rim& rim) {
  for (std::size_t i = 1; i + 1 < rim.size(); ++i) solid.triangles.push_back({rim[0], rim[i + 1], rim[i]});
}

Solid plate_with_ground(const Front& front, const PlateOptions& options) {
  Solid solid;
  const Box box = used_box(front);
  const Ground ground = ground_around(front, box, options);
  place_front(front, box, {ground.corner.x(), ground.corner.y(), options.thickness_mm}, solid);
  solid.triangles = front.triangles;
  const Rim top = add_outline(solid, ground.outline, solid.points[front.hull[0]].z());
  add_ring(solid, front.hull, top);
  solid.front_triangles = solid.triangles.size();
  const Rim bottom = add_outline(solid, ground.outline, 0);
  add_walls(solid, top, bottom);
  add_bottom(solid, bottom);
  return solid;
}

// The relief's triangles, the same below, and walls between the two along its rim.
Solid body_without_ground(const Front& alone, double thickness_mm) {
  Solid solid;
  place_front(alone, used_box(alone), {0, 0, thickness_mm}, solid);
  solid.triangles = alone.triangles;
  solid.front_triangles = alone.triangles.size();
  const auto n = static_cast<Index>(alone.points.size());
  for (Index i = 0; i < n; ++i) solid.points.emplace_back(solid.points[i].x(), solid.points[i].y(), 0);
  for (const auto& [a, b] : rim_of(alone.triangles)) {
    solid.triangles.push_back({a + n, b + n, b});
    solid.triangles.push_back({a + n, b, a});
  }
  for (const auto& [a, b, c] : alone.triangles) solid.triangles.push_back({a + n, c + n, b + n});
  return solid;
}

// A used point as the files hold it.
struct Stored {
  std::array<float, 3> at;
  Index point;
  auto operator<=>(const Stored&) const = default;
};

// Pairs of used points that single precision cannot tell apart; the second has the higher index.
std::vector<std::array<Index, 2>> find_twins(const Solid& solid) {
  std::vector<bool> is_used(solid.points.size());
  for (const Triangle& t : solid.triangles)
    for (const Index i : t) is_used[i] = true;
  std::vector<Stored> stored;
  stored.reserve(solid.points.size());
  for (std::size_t i = 0; i < solid.points.size(); ++i) {
    if (!is_used[i]) continue;
    const Vec3f p = solid.points[i].cast<float>();
    stored.push_back({{p.x(), p.y(), p.z()}, static_cast<Index>(i)});
  }
  std::ranges::sort(stored);
  std::vector<std::array<Index, 2>> twins;
  for (std::size_t i = 1; i < stored.size(); ++i)
    if (stored[i].at == stored[i - 1].at) twins.push_back({stored[i - 1].point, stored[i].point});
  return twins;
}

// Lifts points apart that would become one in a file, by the smallest step of single precision, towards the
// middle height so that the box stays. Dense scans hold such pairs now and then.
void separate_twins(Solid& solid, double middle_z) {
  const int most_passes = 32;  // a pass may push a point onto a third one
  for (int pass = 0; pass < most_passes; ++pass) {
    const auto twins = find_twins(solid);
    if (twins.empty()) return;
    for (const auto& [first, second] : twins) {
      double& z = solid.points[second].z();
      z = std::nextafter(static_cast<float>(z), static_cast<float>(middle_z));
    }
  }
}

std::string name(const char* kind, std::size_t i) {
  return cat(kind, " ", i);
}

std::string wrong_corners(const Solid& solid) {
  if (solid.front_triangles > solid.triangles.size()) return "more front triangles than triangles";
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    const auto& [a, b, c] = solid.triangles[t];
    if (std::max({a, b, c}) >= solid.points.size())
      return name("triangle", t) + " has a corner that does not exist";
    if (a == b || b == c || c == a) return name("triangle", t) + " has two equal corners";
    for (const Index i : {a, b, c})
      if (!solid.points[i].allFinite()) return name("point", i) + " is not finite";
  }
  return {};
}

// Directed edges, those of a vertex together at its lower end: the other end, and the direction in the lowest
// bit.
struct EdgeTable {
  std::vector<std::size_t> begin;  // per point, and one more
  std::vector<std::uint64_t> edges;
};

EdgeTable edge_table(const Solid& solid) {
  EdgeTable table{std::vector<std::size_t>(solid.points.size() + 1), {}};
  const auto each_edge = [&](auto&& f) {
    for (const auto& [a, b, c] : solid.triangles) f(a, b), f(b, c), f(c, a);
  };
  table.edges.resize(3 * solid.triangles.size());
  each_edge([&](Index a, Index b) { ++table.begin[std::min(a, b)]; });
  std::size_t sum = 0;
  for (std::size_t& at : table.begin) at = std::exchange(sum, sum + at);
  std::vector<std::size_t> next(table.begin);
  each_edge([&](Index a, Index b) {
    const std::uint64_t other = std::max(a, b);
    table.edges[next[std::min(a, b)]++] = 2 * other + (a < b ? 0 : 1);
  });
  return table;
}

std::string wrong_edges(const Solid& solid) {
  EdgeTable table = edge_table(solid);
  for (std::size_t p = 0; p < solid.points.size(); ++p) {
    const std::span edges(table.edges.begin() + static_cast<std::ptrdiff_t>(table.begin[p]),
                          table.begin[p + 1] - table.begin[p]);
    std::ranges::sort(edges);
    // In order, good edges are pairs: the same other end, forward, then backward. A third use breaks the
    // pairs.
    for (std::size_t i = 0; i < edges.size(); i += 2) {
      const bool is_pair = i + 1 < edges.size() && edges[i] % 2 == 0 && edges[i + 1] == edges[i] + 1;
      if (!is_pair)
        return cat("edge ", p, "-", edges[i] / 2,
                   " is not shared by exactly two triangles with opposite directions");
    }
  }
  return {};
}

std::string wrong_twins(const Solid& solid) {
  const auto twins = find_twins(solid);
  if (twins.empty()) return {};
  return cat("points ", twins[0][0], " and ", twins[0][1], " are the same in single precision");
}

std::string wrong_volume(const Solid& solid) {
  const double volume = volume_mm3(solid);
  return volume > 0 ? "" : cat("the volume is ", volume, " mm3, not positive");
}

}  // namespace

Result<Solid> make_plate(const Front& front, const PlateOptions& options) {
  if (auto good = check_options(options); !good) return std::unexpected(good.error());
  const bool has_ground = options.outline != Outline::none;
  if (auto good = check_front(front, has_ground); !good) return std::unexpected(good.error());
  const Front alone = has_ground ? Front{} : relief_alone(front);
  if (!has_ground && alone.triangles.empty())
    return fail(ErrorKind::geometry, "front", "expected triangles of the relief, found ground only");
  const Front& shown = has_ground ? front : alone;
  Solid solid =
      has_ground ? plate_with_ground(front, options) : body_without_ground(alone, options.thickness_mm);
  separate_twins(solid, (options.thickness_mm + used_box(shown).size().z() + options.thickness_mm) / 2);
  solid.colours = shown.colours;
  if (!shown.colours.empty()) solid.colours.resize(solid.points.size(), plate_colour);
  return solid;
}

std::string check_solid(const Solid& solid) {
  for (const auto check : {wrong_corners, wrong_edges, wrong_twins, wrong_volume})
    if (std::string wrong = check(solid); !wrong.empty()) return wrong;
  return {};
}

double volume_mm3(const Solid& solid) {
  if (solid.triangles.empty()) return 0;
  // Cones to a point of the solid: far from the origin, cones to the origin would cancel digits.
  const Vec3 apex = solid.points[solid.triangles[0][0]];
  return parallel_reduce(
      solid.triangles.size(), 0.0,
      [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t t = begin; t < end; ++t) {
          const auto& [a, b, c] = solid.triangles[t];
          const Vec3 p = solid.points[a] - apex, q = solid.points[b] - apex, r = solid.points[c] - apex;
          sum += p.dot(q.cross(r)) / 6;
        }
        return sum;
      },
      std::plus<>());
}

}  // namespace relievo
