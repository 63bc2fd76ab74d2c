// Simplifies a mesh by greedy insertion after Garland and Heckbert, "Fast Polygonal Approximation of Terrains
// and Height Fields", 1995. Each round adds, for every triangle that exceeds its tolerance, the point with
// the largest error. Then only the points and edges in changed triangles are measured again, on all threads.
#include "relievo/plate/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/edges.h"
#include "geometry/predicates.h"
#include "plate/front/approximation.h"
#include "plate/front/silhouette.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

constexpr int most_insertion_rounds = 200;
constexpr std::size_t grain = 8192;  // points or edges that one task measures
// The tolerance of triangles that exceed the slope limit. It is practically zero, less than files can store. So these
// triangles are divided until they follow the original's triangles, which do not exceed the limit.
constexpr double steep_tolerance_mm = 1e-6;

// In each round, a limit for the number of triangles postpones errors below `postponed_share` of the largest error. But so
// that few rounds suffice, a round may use `used_share` of the remaining triangles for the worse half of all errors.
constexpr double postponed_share = .5, used_share = .3;

// A position where a triangle of the approximation exceeds its tolerance. It is a point of the
// original front, or a position on an edge of it, given as a share of the edge.
struct Candidate {
  Index triangle = no_index;
  double error = 0;
  Index point = no_index, edge = no_index;
  double share = 0;
};

// An edge of the original front, and the opposite corners of its one or two triangles (no_index for a missing one).
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

// Lists the triangles of the approximation that an edge of the original enters after the one in which it
// begins. If there are more than three, the last entry is `unknown`.
using Passed = std::array<Index, 3>;
constexpr Index unknown = no_index - 1;

// The results of measuring a block of points or edges.
struct Found {
  std::vector<Candidate> candidates;
  std::vector<Index> beyond_hull;  // points outside all triangles, because the hull is rounded
  double error = 0;                // largest error
  Index last = no_index;           // the triangle that contains the last point
};

// Returns the triangles with at least one corner off the height of the ground.
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
      : front_(front),
        options_(options),
        edges_(edges_of(front)),
        passed_(edges_.size()),
        is_chosen_(front.points.size(), 0),
        containing_(front.points.size(), no_index) {
    choose_corners();
  }

  Result<SimplifiedMesh> run(Progress* progress) {
    const auto fault = geometry_error("front", "expected triangles that cover their hull, found others");
    if (!now_.start()) return fault;
    for (int round = 0; round < most_insertion_rounds; ++round) {
      RELIEVO_CHECK(begin_stage(progress, "simplify", .95));
      // The approximation becomes as large as the front if it needs almost all points, and points on edges in
      // addition. Then the front itself is the result.
      if (triangle_count() >= front_.triangles.size()) return SimplifiedMesh{front_, 0};
      std::vector<Candidate> worst = find_worst();
      if (worst.empty()) worst = find_worst_of_all();
      if (worst.empty()) return finished();
      limit(worst);
      if (worst.empty()) break;
      const std::size_t before = original_.size();
      for (const Candidate& c : worst) choose(c);
      if (original_.size() == before) return fault;
    }
    if (!is_limited()) return SimplifiedMesh{front_, 0};
    find_worst_of_all();
    return finished();
  }

 private:
  void choose(Index i, Index near = no_index) {
    if (std::exchange(is_chosen_[i], 1)) return;
    add(i, front_.points[i], near);
    if (!front_.colours.empty()) colours_.push_back(front_.colours[i]);
  }

  void choose(const Candidate& c) {
    if (c.point != no_index) return choose(c.point, c.triangle);
    const Edge& edge = edges_[c.edge];
    const Vec3 &a = front_.points[edge.a], &b = front_.points[edge.b];
    add(no_index, a + c.share * (b - a), c.triangle);
    if (!front_.colours.empty())
      colours_.push_back(mixed(front_.colours[edge.a], front_.colours[edge.b], c.share));
  }

  void add(Index original, const Vec3& place, Index near) {
    original_.push_back(original);
    now_.add(place, near, [&](Index t) {
      is_changed_.resize(now_.mesh().size(), 0);
      is_changed_[t] = 1;
    });
  }

  bool is_limited() const { return options_.most_triangles != std::numeric_limits<std::size_t>::max(); }

  std::size_t triangle_count() const {
    std::size_t count = 0;
    for (Index t = 0; t < now_.mesh().size(); ++t) count += !now_.mesh().is_outside(t);
    return count;
  }

  // Removes candidates with which the number of triangles would exceed its limit. If there is a limit, candidates with
  // small errors are postponed, too. Then errors are similar everywhere when the limit is reached. A point adds two
  // triangles; a point on the hull adds one.
  void limit(std::vector<Candidate>& worst) const {
    if (!is_limited()) return;
    const std::size_t triangles = triangle_count(), left = options_.most_triangles > triangles
                                                               ? (options_.most_triangles - triangles) / 2
                                                               : 0;
    std::ranges::stable_sort(worst, std::ranges::greater(), &Candidate::error);
    const auto is_large = [&](const Candidate& c) { return c.error >= postponed_share * worst[0].error; };
    const auto large = static_cast<std::size_t>(std::ranges::count_if(worst, is_large));
    const auto few = static_cast<std::size_t>(used_share * static_cast<double>(left));
    worst.resize(std::min(left, std::max(large, std::min(few, (worst.size() + 1) / 2))));
  }

  // Chooses the first points: the corners of the hull, the boundaries of the relief and of flat ground, and the extreme
  // heights. Errors are largest at extremes, and the plate's thickness and height must not change. If all points of the
  // ground's boundary are chosen, the triangulation contains its edges, so flat ground stays flat.
  void choose_corners() {
    const auto& hull = front_.hull;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec3 &before = front_.points[hull[(i + hull.size() - 1) % hull.size()]],
                 &here = front_.points[hull[i]], &after = front_.points[hull[(i + 1) % hull.size()]];
      if (orient2d(before.head<2>(), here.head<2>(), after.head<2>()) == 0) continue;
      choose(hull[i]);
    }
    if (!front_.is_relief.empty())
      for (const auto& [a, b] : boundary_edges(relief_triangles(front_))) choose(a);
    for (const auto& [a, b] : boundary_edges(triangles_above_ground(front_))) choose(a);
    const auto [lowest, highest] =
        std::ranges::minmax_element(front_.points, {}, [](const Vec3& p) { return p.z(); });
    const double ground = front_.points[hull[0]].z();
    for (const auto extreme : {lowest, highest})
      if (extreme->z() != ground) choose(static_cast<Index>(extreme - front_.points.begin()));
  }

  // Returns, for each triangle that exceeds its tolerance, the position with the largest error. Measures only
  // triangles that changed since the last call.
  std::vector<Candidate> find_worst() {
    while (choose_beyond_hull(measure())) continue;
    std::ranges::fill(is_changed_, 0);
    std::vector<Candidate> worst;
    for (const Candidate& c : worst_)
      if (c.error > 0) worst.push_back(with_point(c));
    return worst;
  }

  // Measures all triangles, and sets error_ to the largest error.
  std::vector<Candidate> find_worst_of_all() {
    std::ranges::fill(is_changed_, 1);
    return find_worst();
  }

  // Chooses the points `points`, which lie outside all triangles. Returns false if there are none.
  bool choose_beyond_hull(const std::vector<Index>& points) {
    for (const Index i : points) choose(i);
    return !points.empty();
  }

  // Measures the changed triangles. Returns the points that lie outside all triangles, because the hull is rounded.
  std::vector<Index> measure() {
    is_changed_.resize(now_.mesh().size(), 1);
    worst_.resize(is_changed_.size());
    slopes_sq_.resize(is_changed_.size());
    parallel_for(is_changed_.size(), [&](std::size_t t) {
      if (!is_changed_[t]) return;
      worst_[t] = {};
      if (!now_.mesh().is_outside(static_cast<Index>(t)))
        slopes_sq_[t] = now_.slope_sq(static_cast<Index>(t));
    });
    error_ = 0;
    std::vector<Index> beyond_hull;
    for (const Found& part : in_blocks(front_.points.size(), &Simplifier::measure_point))
      beyond_hull.insert(beyond_hull.end(), part.beyond_hull.begin(), part.beyond_hull.end());
    if (beyond_hull.empty()) in_blocks(edges_.size(), &Simplifier::measure_edge);
    return beyond_hull;
  }

  // Calls measure(i, found) for all points or edges, in blocks, and collects the results.
  std::vector<Found> in_blocks(std::size_t n, void (Simplifier::*measure)(Index, Found&)) {
    std::vector<Found> found((n + grain - 1) / grain);
    parallel_ranges(n, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) (this->*measure)(static_cast<Index>(i), found[begin / grain]);
    });
    for (const Found& part : found) {
      error_ = std::max(error_, part.error);
      for (const Candidate& c : part.candidates)
        if (c.error > worst_[c.triangle].error) worst_[c.triangle] = c;
    }
    return found;
  }

  // Returns the smallest tolerance of any triangle.
  double least_allowed() const {
    const bool has_limit = options_.max_slope < std::numeric_limits<double>::infinity();
    return has_limit ? std::min(steep_tolerance_mm, options_.tolerance_mm) : options_.tolerance_mm;
  }

  // Returns the first of `sides` whose tolerance is smaller than the error; no_index if there is none.
  // `sides` are the one or two triangles at a position with this error.
  Index triangle_beyond(const std::array<Index, 2>& sides, double error) const {
    for (const Index t : sides) {
      if (t == no_index) continue;
      const bool is_steep = slopes_sq_[t] > options_.max_slope * options_.max_slope;
      if (error > (is_steep ? least_allowed() : options_.tolerance_mm)) return t;
    }
    return no_index;
  }

  void measure_point(Index i, Found& found) {
    const Index before = containing_[i];
    if (before != no_index && !is_changed_[before]) return;
    const Vec3& p = front_.points[i];
    const bool is_lost = before == no_index || now_.mesh().is_outside(before);
    const Index t = now_.find(p.head<2>(), is_lost ? found.last : before);
    if (t == no_index) return found.beyond_hull.push_back(i);
    containing_[i] = found.last = t;
    const double error = std::abs(now_.height(t, p.head<2>()) - p.z());
    found.error = std::max(found.error, error);
    const Index off =
        triangle_beyond({t, error > least_allowed() ? now_.across(p.head<2>(), t) : no_index}, error);
    if (off != no_index) found.candidates.push_back({off, error, i});
  }

  // Measures the errors on an edge of the original. The error is the difference of two piecewise flat
  // surfaces. Its extremes are at points of the original, which has all points of the approximation, and at
  // crossings of edges of both surfaces. An edge within one triangle crosses no edge of the approximation. If
  // the triangles along an edge are unchanged, its errors are unchanged, too.
  void measure_edge(Index e, Found& found) {
    const Edge& edge = edges_[e];
    const Index begin = containing_[edge.a], end = containing_[edge.b];
    Passed& passed = passed_[e];
    const auto is_changed = [&](Index t) { return t == unknown || (t != no_index && is_changed_[t]); };
    if (begin == end || (!is_changed(begin) && !is_changed(end) && std::ranges::none_of(passed, is_changed)))
      return;
    const Vec3 &a = front_.points[edge.a], &b = front_.points[edge.b];
    std::size_t count = 0;
    passed.fill(no_index);
    now_.walk(a.head<2>(), b.head<2>(), begin, [&](std::array<Index, 2> sides, double share, double height) {
      passed[std::min(count, passed.size() - 1)] = count < passed.size() ? sides[1] : unknown;
      ++count;
      if (!(share > 1e-6 && share < 1 - 1e-6)) return;  // an end, which measure_point() measures
      const double error = std::abs(height - (a + share * (b - a)).z());
      found.error = std::max(found.error, error);
      if (const Index t = triangle_beyond(sides, error); t != no_index)
        found.candidates.push_back({t, error, no_index, e, share});
    });
  }

  // Chooses the point that is added for an error on an edge of the original. It is the first one of the
  // following points that is not chosen yet: the nearer end, the farther end, the two opposite corners. Once
  // all four are chosen, the edge is in the Delaunay triangulation, unless the four lie on one circle. In
  // that case the crossing becomes a new point.
  Candidate with_point(Candidate c) const {
    if (c.point != no_index) return c;
    const Edge& edge = edges_[c.edge];
    const bool is_near_a = c.share < .5;
    for (const Index i :
         {is_near_a ? edge.a : edge.b, is_near_a ? edge.b : edge.a, edge.facing[0], edge.facing[1]})
      if (c.point == no_index && i != no_index && !is_chosen_[i]) c.point = i;
    return c;
  }

  SimplifiedMesh finished() {
    Triangulation mesh = now_.mesh().result();
    SimplifiedMesh out{
        {now_.points(), std::move(mesh.triangles), std::move(mesh.hull), front_.ground_mm, colours_}, error_};
    if (!front_.is_relief.empty()) out.front.is_relief = relief_within(front_, out.front, original_);
    return out;
  }

  const HeightFieldMesh& front_;
  SimplifyOptions options_;
  std::vector<Edge> edges_;
  std::vector<Passed> passed_;           // per edge
  std::vector<std::uint8_t> is_chosen_;  // per point of the original
  std::vector<Index> containing_;        // per point of the original: the triangle that contains it
  Approximation now_;
  std::vector<Index> original_;  // per chosen point: index in the original; no_index for points on edges
  std::vector<Colour> colours_;
  // Per triangle of the approximation: whether it has changed since it was measured, its squared slope, and
  // the position with its largest error if that exceeds the tolerance.
  std::vector<std::uint8_t> is_changed_;
  std::vector<double> slopes_sq_;
  std::vector<Candidate> worst_;
  double error_ = 0;
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
