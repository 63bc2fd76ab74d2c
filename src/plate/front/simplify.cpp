// Simplifies a mesh by greedy insertion after Garland and Heckbert, "Fast Polygonal Approximation of Terrains
// and Height Fields", 1995, but in rounds. Each round adds the point with the largest error of every triangle
// that exceeds its tolerance, and triangulates again. Inserting one point at a time would need a
// triangulation that can be updated and a queue of errors, and could not use threads.
#include "relievo/plate/simplify.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/edges.h"
#include "geometry/predicates.h"
#include "plate/front/silhouette.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/geometry/triangulation.h"

namespace relievo {
namespace {

constexpr int most_insertion_rounds = 200;
constexpr std::size_t edges_per_block = 8192;
// Triangles steeper than allowed get this tolerance. A triangle so close to the original is only as steep as
// the original's triangles, which are within the limit. Files could not store a smaller difference.
constexpr double steep_tolerance_mm = 1e-6;

// A position where a triangle of the approximation exceeds its tolerance.
struct Candidate {
  Index triangle;
  double error;
  Index point;  // index in the original; no_index for a point on one of its edges
  Vec3 place;
  Colour colour = {};
};

// An edge of the original, and the opposite corners of its one or two triangles (no_index for a missing one).
struct Edge {
  Index a, b;
  std::array<Index, 2> facing = {no_index, no_index};
};

std::vector<Edge> edges_of(const HeightFieldMesh& front) {
  std::vector<Edge> edges;
  each_edge(front.triangles, [&](std::span<const TriangleSide> sides) {
    const auto [least, most] = std::ranges::minmax(sides, {}, &TriangleSide::apex);
    edges.push_back({least.low(), least.high(), {least.apex, sides.size() > 1 ? most.apex : no_index}});
  });
  return edges;
}

// The Delaunay triangulation of the points chosen so far, with point location and walks along segments.
class Approximation {
 public:
  explicit Approximation(const std::vector<Vec3>& points) : points_(points) {
    plane_.reserve(points.size());
    for (const Vec3& p : points) plane_.push_back(p.head<2>());
    mesh_ = delaunay(plane_);
  }

  const Triangulation& mesh() const { return mesh_; }

  // Walks from triangle `start` to one that contains the place; returns no_index if the place is outside.
  // Successive points of a scan are close to each other, so that walks are short.
  Index find(const Vec2& place, Index start) const {
    Index t = start, from = no_index;
    for (std::size_t steps = 0; steps <= mesh_.triangles.size(); ++steps) {
      const Index next = towards(place, t, from);
      if (next == t) return t;
      if (next == no_index) return no_index;
      from = std::exchange(t, next);
    }
    return no_index;
  }

  // Returns the other triangle of the edge on which the place lies; no_index if the place is inside t or on
  // the hull.
  Index across(const Vec2& place, Index t) const {
    const Triangle& corners = mesh_.triangles[t];
    for (std::size_t i = 0; i < 3; ++i)
      if (orient2d(plane_[corners[(i + 1) % 3]], plane_[corners[(i + 2) % 3]], place) == 0)
        return mesh_.neighbours[t][i];
    return no_index;
  }

  // Returns the squared slopes of all triangles.
  std::vector<double> slopes_sq() const {
    std::vector<double> slopes(mesh_.triangles.size());
    parallel_for(slopes.size(), [&](std::size_t t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      const Vec3 normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
      slopes[t] = normal.head<2>().squaredNorm() / (normal.z() * normal.z());
    });
    return slopes;
  }

  double height(Index t, const Vec2& place) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const Vec3 p = points_[b] - points_[a], q = points_[c] - points_[a];
    const Vec2 d = place - plane_[a];
    const double area = p.x() * q.y() - p.y() * q.x();
    return points_[a].z() +
           (p.z() * (d.x() * q.y() - d.y() * q.x()) + q.z() * (p.x() * d.y() - p.y() * d.x())) / area;
  }

  // Calls f(triangles left and entered, share of the way, height of the approximation) wherever the segment
  // from a to b, which begins in triangle t, crosses an edge.
  template <typename F>
  void walk(const Vec2& a, const Vec2& b, Index t, F&& f) const {
    Index from = no_index;
    for (std::size_t steps = 0; steps <= mesh_.triangles.size(); ++steps) {
      const auto exit = exit_of(a, b, t, from);
      if (!exit) return;
      const Vec3 &p = points_[mesh_.triangles[t][(*exit + 1) % 3]],
                 &q = points_[mesh_.triangles[t][(*exit + 2) % 3]];
      const auto side = [&](const Vec3& x) {
        return (b.x() - a.x()) * (x.y() - a.y()) - (b.y() - a.y()) * (x.x() - a.x());
      };
      const double left = side(p), right = side(q), along_edge = left / (left - right);
      const Vec3 crossing = p + along_edge * (q - p);
      const double share = (crossing.head<2>() - a).dot(b - a) / (b - a).squaredNorm();
      from = std::exchange(t, mesh_.neighbours[t][*exit]);
      f(std::array{from, t}, share, crossing.z());
      if (t == no_index) return;
    }
  }

 private:
  // Returns the neighbour across an edge that separates t from the place; t itself if t contains the place.
  Index towards(const Vec2& place, Index t, Index from) const {
    const Triangle& corners = mesh_.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const Index across = mesh_.neighbours[t][i];
      if (across == from && from != no_index) continue;
      if (orient2d(plane_[corners[(i + 1) % 3]], plane_[corners[(i + 2) % 3]], place) < 0) return across;
    }
    return t;
  }

  // Returns the edge by which the segment from a to b leaves the triangle; nothing if b lies in it.
  std::optional<std::size_t> exit_of(const Vec2& a, const Vec2& b, Index t, Index from) const {
    const Triangle& corners = mesh_.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      if (mesh_.neighbours[t][i] == from && from != no_index) continue;
      const Vec2 &p = plane_[corners[(i + 1) % 3]], &q = plane_[corners[(i + 2) % 3]];
      if (orient2d(p, q, b) >= 0) continue;
      if (orient2d(a, b, p) <= 0 && orient2d(a, b, q) >= 0) return i;
    }
    return std::nullopt;
  }

  const std::vector<Vec3>& points_;
  std::vector<Vec2> plane_;
  Triangulation mesh_;
};

// Returns the triangles that are not level at the height of the ground.
std::vector<Triangle> triangles_above_ground(const HeightFieldMesh& front) {
  const double ground = front.points[front.hull[0]].z();
  std::vector<Triangle> above;
  for (const Triangle& t : front.triangles)
    if (std::ranges::any_of(t, [&](Index i) { return front.points[i].z() != ground; })) above.push_back(t);
  return above;
}

class Simplifier {
 public:
  Simplifier(const HeightFieldMesh& front, const SimplifyOptions& options)
      : front_(front), options_(options), edges_(edges_of(front)), is_chosen_(front.points.size(), 0) {
    choose_corners();
  }

  Result<SimplifiedMesh> run(Progress* progress) {
    for (int round = 0;; ++round) {
      RELIEVO_CHECK(begin_stage(progress, "simplify", .95));
      const Approximation now(chosen_);
      if (now.mesh().triangles.empty()) break;
      // If almost all points are needed, and points on edges in addition, the front itself has fewer
      // triangles.
      if (now.mesh().triangles.size() >= front_.triangles.size()) return SimplifiedMesh{front_, 0};
      const std::size_t before = chosen_.size();
      std::vector<Candidate> worst = find_worst(now);
      if (worst.empty()) return finished(now);
      limit(worst, now);
      if (worst.empty()) return finished(now);
      if (round == most_insertion_rounds) return is_limited() ? finished(now) : SimplifiedMesh{front_, 0};
      for (const Candidate& c : worst) choose(c);
      if (chosen_.size() == before) break;
    }
    return geometry_error("front", "expected triangles that cover their hull, found others");
  }

 private:
  void choose(const Candidate& candidate) {
    if (candidate.point != no_index && std::exchange(is_chosen_[candidate.point], 1)) return;
    chosen_.push_back(candidate.place);
    original_.push_back(candidate.point);
    if (!front_.colours.empty()) colours_.push_back(candidate.colour);
  }

  bool is_limited() const { return options_.most_triangles != std::numeric_limits<std::size_t>::max(); }

  // Keeps the candidates that the limit of triangles allows. With a limit, the half with the smaller errors
  // is postponed, so that errors are alike everywhere when the limit is reached. A point adds two triangles,
  // a point on the hull one.
  void limit(std::vector<Candidate>& worst, const Approximation& now) const {
    const bool is_beyond_hull = worst[0].error == 0;
    if (!is_limited() || is_beyond_hull) return;
    const std::size_t triangles = now.mesh().triangles.size(),
                      left =
                          options_.most_triangles > triangles ? (options_.most_triangles - triangles) / 2 : 0;
    const std::size_t count = std::min(left, (worst.size() + 1) / 2);
    std::ranges::stable_sort(worst, std::ranges::greater(), &Candidate::error);
    worst.resize(count);
  }

  Candidate at_point(Index triangle, double error, Index i) const {
    return {triangle, error, i, front_.points[i], front_.colours.empty() ? Colour{} : front_.colours[i]};
  }

  // Chooses the first points: the corners of the hull, the boundary of the relief and of flat ground, and the
  // extreme heights. Errors are largest at extremes, and the plate's thickness and height must not change.
  // With all points of the ground's boundary, the edges of that boundary are in the triangulation, so that
  // flat ground stays flat.
  void choose_corners() {
    const auto& hull = front_.hull;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec3 &before = front_.points[hull[(i + hull.size() - 1) % hull.size()]],
                 &here = front_.points[hull[i]], &after = front_.points[hull[(i + 1) % hull.size()]];
      if (orient2d(before.head<2>(), here.head<2>(), after.head<2>()) == 0) continue;
      choose(at_point(0, 0, hull[i]));
    }
    if (!front_.is_relief.empty())
      for (const auto& [a, b] : boundary_edges(relief_triangles(front_))) choose(at_point(0, 0, a));
    for (const auto& [a, b] : boundary_edges(triangles_above_ground(front_))) choose(at_point(0, 0, a));
    const auto [lowest, highest] =
        std::ranges::minmax_element(front_.points, {}, [](const Vec3& p) { return p.z(); });
    const double ground = front_.points[hull[0]].z();
    for (const auto extreme : {lowest, highest})
      if (extreme->z() != ground) choose(at_point(0, 0, static_cast<Index>(extreme - front_.points.begin())));
  }

  // Returns, for each triangle that exceeds its tolerance, the position with its largest error, and sets
  // error_ to the largest error of all. If points lie outside all triangles, which can happen because the
  // hull is rounded, returns these points instead.
  std::vector<Candidate> find_worst(const Approximation& now) {
    containing_.resize(front_.points.size());
    slopes_sq_ = now.slopes_sq();
    const std::size_t blocks = (front_.points.size() + edges_per_block - 1) / edges_per_block,
                      edge_blocks = (edges_.size() + edges_per_block - 1) / edges_per_block;
    std::vector<std::vector<Candidate>> found(blocks + edge_blocks);
    std::vector<double> errors(blocks + edge_blocks, 0);
    std::vector<std::vector<Candidate>> outside(blocks);
    parallel_ranges(front_.points.size(), edges_per_block, [&](std::size_t begin, std::size_t end) {
      const std::size_t block = begin / edges_per_block;
      outside[block] = measure_points(now, begin, end, found[block], errors[block]);
    });
    std::vector<Candidate> beyond_hull;
    for (const auto& part : outside) beyond_hull.insert(beyond_hull.end(), part.begin(), part.end());
    if (!beyond_hull.empty()) return beyond_hull;
    parallel_ranges(edges_.size(), edges_per_block, [&](std::size_t begin, std::size_t end) {
      const std::size_t block = blocks + begin / edges_per_block;
      measure_edges(now, begin, end, found[block], errors[block]);
    });
    error_ = *std::ranges::max_element(errors);
    return worst_of(found, now.mesh().triangles.size());
  }

  // Returns the smallest tolerance that any triangle has.
  double least_allowed() const {
    const bool is_limited = options_.max_slope < std::numeric_limits<double>::infinity();
    return is_limited ? std::min(steep_tolerance_mm, options_.tolerance_mm) : options_.tolerance_mm;
  }

  // `sides` are the one or two triangles at a position with that error. Returns the first whose tolerance is
  // smaller than the error; no_index if both tolerances are large enough.
  Index triangle_beyond(const std::array<Index, 2>& sides, double error) const {
    for (const Index t : sides) {
      if (t == no_index) continue;
      const bool is_steep = slopes_sq_[t] > options_.max_slope * options_.max_slope;
      if (error > (is_steep ? least_allowed() : options_.tolerance_mm)) return t;
    }
    return no_index;
  }

  static std::vector<Candidate> worst_of(const std::vector<std::vector<Candidate>>& found,
                                         std::size_t triangles) {
    std::vector<const Candidate*> worst(triangles, nullptr);
    for (const auto& part : found)
      for (const Candidate& c : part)
        if (!worst[c.triangle] || c.error > worst[c.triangle]->error) worst[c.triangle] = &c;
    std::vector<Candidate> out;
    for (const Candidate* c : worst)
      if (c) out.push_back(*c);
    return out;
  }

  // Returns the points that lie outside all triangles.
  std::vector<Candidate> measure_points(const Approximation& now, std::size_t begin, std::size_t end,
                                        std::vector<Candidate>& found, double& worst) {
    std::vector<Candidate> outside;
    Index t = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& p = front_.points[i];
      const Index here = now.find(p.head<2>(), t);
      if (here == no_index) {
        outside.push_back(at_point(0, 0, static_cast<Index>(i)));
        continue;
      }
      containing_[i] = t = here;
      const double error = std::abs(now.height(t, p.head<2>()) - p.z());
      worst = std::max(worst, error);
      const Index off =
          triangle_beyond({t, error > least_allowed() ? now.across(p.head<2>(), t) : no_index}, error);
      if (off != no_index) found.push_back(at_point(off, error, static_cast<Index>(i)));
    }
    return outside;
  }

  // The difference of two piecewise flat surfaces is extreme at the corners of their overlay: at the
  // original's points (the approximation's are among them), and where edges of the two cross. An edge within
  // one triangle crosses no other edge.
  void measure_edges(const Approximation& now, std::size_t begin, std::size_t end,
                     std::vector<Candidate>& found, double& worst) const {
    for (std::size_t e = begin; e < end; ++e) {
      const Edge& edge = edges_[e];
      if (containing_[edge.a] == containing_[edge.b]) continue;
      const Vec3 &a = front_.points[edge.a], &b = front_.points[edge.b];
      now.walk(a.head<2>(), b.head<2>(), containing_[edge.a],
               [&](std::array<Index, 2> sides, double share, double height) {
                 if (!(share > 1e-6 && share < 1 - 1e-6)) return;  // an end, measured as a point
                 const double error = std::abs(height - (a + share * (b - a)).z());
                 worst = std::max(worst, error);
                 if (const Index t = triangle_beyond(sides, error); t != no_index)
                   found.push_back(remedy(edge, share, t, error));
               });
    }
  }

  // Returns the point to add for an error on an edge of the original: the nearer end, the other end, or an
  // opposite corner, whichever is the first not yet chosen. Once all four are chosen, the edge is an edge of
  // the Delaunay triangulation, unless the four lie on one circle: then the crossing itself becomes a point.
  Candidate remedy(const Edge& edge, double share, Index t, double error) const {
    const bool is_near_a = share < .5;
    for (const Index i :
         {is_near_a ? edge.a : edge.b, is_near_a ? edge.b : edge.a, edge.facing[0], edge.facing[1]})
      if (i != no_index && !is_chosen_[i]) return at_point(t, error, i);
    const Vec3 &a = front_.points[edge.a], &b = front_.points[edge.b];
    return {t, error, no_index, a + share * (b - a),
            front_.colours.empty() ? Colour{} : mixed(front_.colours[edge.a], front_.colours[edge.b], share)};
  }

  SimplifiedMesh finished(const Approximation& now) {
    SimplifiedMesh out{{chosen_, now.mesh().triangles, now.mesh().hull, front_.ground_mm, colours_}, error_};
    if (!front_.is_relief.empty()) out.front.is_relief = relief_within(front_, out.front, original_);
    return out;
  }

  const HeightFieldMesh& front_;
  SimplifyOptions options_;
  double error_ = 0;
  std::vector<double> slopes_sq_;  // squared slopes of the approximation's triangles
  std::vector<Edge> edges_;
  std::vector<std::uint8_t> is_chosen_;  // whether each point of the original is chosen
  std::vector<Vec3> chosen_;
  std::vector<Index> original_;  // indices of chosen points in the original; no_index for points on edges
  std::vector<Colour> colours_;
  std::vector<Index> containing_;  // the triangle that contains each point of the original
};

}  // namespace

Result<SimplifiedMesh> simplify(const HeightFieldMesh& front, const SimplifyOptions& options,
                                Progress* progress) {
  if (!(options.tolerance_mm > 0))
    return option_error("tolerance", cat("expected a positive length, found ", options.tolerance_mm));
  if (front.triangles.empty() || front.hull.size() < 3)
    return geometry_error("front", "expected triangles and a hull around them, found none");
  return Simplifier(front, options).run(progress);
}

Result<SimplifiedMesh> simplify(const HeightFieldMesh& front, double tolerance_mm, Progress* progress) {
  return simplify(front, SimplifyOptions{tolerance_mm}, progress);
}

}  // namespace relievo
