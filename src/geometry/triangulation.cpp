// Builds a Delaunay triangulation incrementally. Points are inserted one by one, coarse samples first, and within
// each round along a Hilbert curve. So the triangle that contains a point is only a few steps from the previous one.
// After each insertion edges are flipped until all circumcircles are empty again (C. L. Lawson, "Software for C1
// Surface Interpolation", 1977).
//
// Outside the hull there are ghost triangles, one on each hull edge, with a common vertex at infinity. The circle of
// a ghost is the open half-plane outside its edge, plus the edge itself. Triangles and ghosts together form a closed
// surface, so that the hull needs no special cases: a point outside or on a hull edge is inserted like any other.
#include "relievo/geometry/triangulation.h"

#include <algorithm>

#include "geometry/delaunay_builder.h"
#include "geometry/hilbert.h"
#include "geometry/predicates.h"

namespace relievo {
namespace {

constexpr Index infinity = no_index;
// n points give 2 n triangles with 4 slots each. With this limit, 32 bits can number all slots.
constexpr std::size_t most_points = (std::size_t{1} << 29) - 2;

constexpr Index next(Index e) {
  return (e & 3) == 2 ? e - 2 : e + 1;
}
constexpr Index previous(Index e) {
  return (e & 3) == 0 ? e + 2 : e - 1;
}

}  // namespace

void DelaunayBuilder::add_triangle(Index a, Index b, Index c) {
  for (const Index corner : {a, b, c, infinity}) edges_.push_back({corner, no_index});
}

bool DelaunayBuilder::start() {
  const Index n = static_cast<Index>(points_.size());
  Index b = 1, c = 2;
  while (b < n && points_[b] == points_[0]) ++b;
  for (c = b + 1; c < n && orient2d(points_[0], points_[b], points_[c]) == 0;) ++c;
  if (c >= n) return false;
  if (orient2d(points_[0], points_[b], points_[c]) < 0) std::swap(b, c);

  edges_.reserve(8 * points_.size());  // about 2 n triangles, ghosts included, of 4 half-edges
  add_triangle(0, b, c);
  add_triangle(b, 0, infinity);
  add_triangle(c, b, infinity);
  add_triangle(0, c, infinity);
  for (Index i = 0; i < 3; ++i) {
    link(i, 4 * (i + 1));
    link(4 * (i + 1) + 2, 4 * ((i + 1) % 3 + 1) + 1);
  }
  return true;
}

// Returns a half-edge of a triangle that contains p inside or on its border or, if p is outside the hull, of
// a ghost whose hull edge has p strictly on its outer side. In a Delaunay triangulation the walk never
// returns to a triangle, for two reasons. With each step to another circle, the power of p with respect to
// the circle decreases. Triangles with a common circle are linked as a tree.
Index DelaunayBuilder::locate(const Vec2& p) const {
  const auto is_right_of = [&](Index e) {
    return orient2d(points_[edges_[e].origin], points_[edges_[next(e)].origin], p) < 0;
  };
  Index e = near_;
  if (is_right_of(e)) e = edges_[e].twin;
  while (!is_ghost(e)) {
    if (is_right_of(next(e))) {
      e = edges_[next(e)].twin;
    } else if (is_right_of(previous(e))) {
      e = edges_[previous(e)].twin;
    } else {
      break;
    }
  }
  return e;
}

// Returns the corner of e's triangle that lies at p, or no_index.
Index DelaunayBuilder::vertex_at(const Vec2& p, Index e) const {
  for (const Index corner : {edges_[e].origin, edges_[next(e)].origin, edges_[previous(e)].origin})
    if (corner != infinity && points_[corner] == p) return corner;
  return no_index;
}

// Returns whether p is strictly inside the circle of e's triangle. For a ghost, returns whether p is in the
// open half-plane or in the interior of the edge.
bool DelaunayBuilder::circle_contains(Index e, const Vec2& p) const {
  const Index a = edges_[e].origin, b = edges_[next(e)].origin, c = edges_[previous(e)].origin;
  if (a != infinity && b != infinity && c != infinity)
    return incircle(points_[a], points_[b], points_[c], p) > 0;
  const Vec2& from = points_[a == infinity ? b : b == infinity ? c : a];
  const Vec2& to = points_[a == infinity ? c : b == infinity ? a : b];
  const int side = orient2d(from, to, p);
  return side > 0 || (side == 0 && (p - from).dot(p - to) < 0);
}

// Splits e's triangle into three triangles with the common corner p. Returns slot 0 of one of them. If p is
// on a side, one of the three is flat. Flips remove it, because p is inside the circle of the triangle beyond
// that side.
Index DelaunayBuilder::split(Index e, Index p) {
  const Index t = e & ~Index{3}, u = static_cast<Index>(edges_.size()), v = u + 4;
  const Index a = edges_[t].origin, b = edges_[t + 1].origin, c = edges_[t + 2].origin;
  const Index bc = edges_[t + 1].twin, ca = edges_[t + 2].twin;
  edges_[t + 2].origin = p;  // t becomes (a, b, p)
  add_triangle(b, c, p);
  add_triangle(c, a, p);
  link(u, bc);
  link(v, ca);
  link(t + 1, u + 2);
  link(u + 1, v + 2);
  link(v + 1, t + 2);
  return t;
}

// Replaces the side e = (a, b) of the triangle (a, b, p) by (p, d), where d is the opposite corner in the
// neighbour. The new triangles are (a, d, p) and (d, b, p).
void DelaunayBuilder::flip(Index e) {
  const Index t = e, f = edges_[e].twin, u = f & ~Index{3};
  const Index b = edges_[f].origin, d = edges_[previous(f)].origin, p = edges_[t + 2].origin;
  const Index ad = edges_[next(f)].twin, db = edges_[previous(f)].twin, bp = edges_[t + 1].twin;
  edges_[t + 1].origin = d;
  edges_[u].origin = d;
  edges_[u + 1].origin = b;
  edges_[u + 2].origin = p;
  link(t, ad);
  link(u, db);
  link(u + 1, bp);
  link(t + 1, u + 2);
}

bool DelaunayBuilder::insert_added(Index p, Index triangle) {
  names_.push_back(p);
  if (!is_outside(triangle)) near_ = 4 * triangle;
  return insert(p);
}

bool DelaunayBuilder::insert(Index p) {
  const Vec2 position = points_[p];
  Index e = locate(position);
  if (const Index same = vertex_at(position, e); same != no_index) {
    names_[same] = std::min(names_[same], names_[p]);
    return false;
  }
  e = split(e, p);
  const Index first = edges_[e].origin;  // remains a neighbour of p, so the loop ends
  do {
    while (circle_contains(edges_[e].twin, position)) flip(e);
    e = next_around(e);
  } while (edges_[e].origin != first);
  while (is_ghost(e)) e = next_around(e);
  near_ = e;
  return true;
}

// Returns each triangle's index in the result; no_index for ghosts.
std::vector<Index> DelaunayBuilder::number_triangles() const {
  std::vector<Index> numbers(edges_.size() / 4);
  Index count = 0;
  for (Index t = 0; t < numbers.size(); ++t) numbers[t] = is_ghost(4 * t) ? no_index : count++;
  return numbers;
}

void DelaunayBuilder::append_triangle(Index t, const std::vector<Index>& numbers, Triangulation& to) const {
  Triangle corners, neighbours;
  for (Index i = 0; i < 3; ++i) {
    corners[i] = names_[edges_[4 * t + i].origin];
    neighbours[i] = numbers[edges_[4 * t + (i + 1) % 3].twin / 4];
  }
  to.triangles.push_back(corners);
  to.neighbours.push_back(neighbours);
}

// Returns the corners of the hull, by visiting the ghosts around the vertex at infinity.
std::vector<Index> DelaunayBuilder::hull() const {
  std::vector<Index> vertices;
  Index e = 0;
  while (edges_[e].origin != infinity || (e & 3) == 3) ++e;
  const Index first = e;
  do {
    vertices.push_back(names_[edges_[previous(e)].origin]);
    e = next(edges_[e].twin);
  } while (e != first);
  return vertices;
}

Triangulation DelaunayBuilder::result() const {
  const std::vector<Index> numbers = number_triangles();
  Triangulation triangulation;
  triangulation.hull = hull();
  const std::size_t count = numbers.size() - triangulation.hull.size();
  triangulation.triangles.reserve(count);
  triangulation.neighbours.reserve(count);
  for (Index t = 0; t < numbers.size(); ++t)
    if (numbers[t] != no_index) append_triangle(t, numbers, triangulation);
  return triangulation;
}

Triangulation delaunay(std::span<const Vec2> points) {
  if (points.size() > most_points || !std::all_of(points.begin(), points.end(), is_exact_point)) return {};

  const std::vector<Index> order = hilbert_order(points);
  std::vector<Vec2> sorted(points.size());
  std::transform(order.begin(), order.end(), sorted.begin(), [&](Index i) { return points[i]; });
  DelaunayBuilder builder(sorted, order);
  if (!builder.start()) return {};

  // Inserts every 4^k-th point of the curve, then every 4^(k - 1)-th, and so on. Each round refines an even
  // sample. The order of the curve alone would create long slivers first, which cost many flips if the points
  // lie on few lines.
  std::size_t step = 1, coarser = points.size();
  while (step * 4 < points.size()) step *= 4;
  for (; step > 0; coarser = step, step /= 4)
    for (std::size_t i = 0; i < points.size(); i += step)
      if (coarser == points.size() || i % coarser != 0) builder.insert(static_cast<Index>(i));
  return builder.result();
}

}  // namespace relievo
