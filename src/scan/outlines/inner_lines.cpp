#include "scan/jumps.h"
#include "scan/outlines/outlines.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/angle.h"
#include "core/lists.h"
#include "core/simd.h"
#include "geometry/plane.h"
#include "geometry/point_set.h"

namespace relievo {
namespace {

// Lengths in rho, the sampling distance.
constexpr double change_radius = 3.0, stride = .75, line_window = 3, shortest = 8;
constexpr double least_step = .3;  // in rho; a line with a smaller mean step in depth is a crease
// The least distance of lines from each other and from outlines. Closer lines would leave too few points between
// them.
constexpr double apart = 2;
constexpr std::size_t least_points = 4;  // least number of points on each side of a line
// A line may begin at an edge of a triangle if the cosine between the normals at the two ends of the edge is
// below this.
constexpr float bent_below = .75F;

// Measures the change of a surface across a line through a position. A linear function is fitted to the normals on each
// side.
struct Change {
  double left_over = 1;  // misfit of the fits of both sides, as a share of the misfit of one common fit
  // Scatter around the means of both sides, as a share of the scatter around the common mean.
  double scatter = 1;
  double angle_deg = 0;  // angle between the fitted normals of both sides
  // Depth of the left side minus depth of the right side, in rho; positive if the left side is in front.
  double step = 0;
};

// The limits that the change of a surface must satisfy at the start of a line, or farther on along it.
struct Limits {
  double left_over, angle_deg, step;

  bool hold(const Change& change) const {
    return change.left_over < left_over && (change.angle_deg > angle_deg || std::abs(change.step) > step);
  }
};
constexpr Limits at_start{.5, 35, .8}, farther_on{.65, 20, .4};

Vec2 turned(const Vec2& direction, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * direction.x() - s * direction.y(), s * direction.x() + c * direction.y()};
}

// Measures the changes of a surface across lines.
class ChangeFinder {
 public:
  ChangeFinder(const Surface& surface, const PlanePoints& plane)
      : surface_(surface), plane_(plane), radius_(change_radius * surface.rho) {}

  std::vector<Index> around(const Vec2& place, double reach) const {
    std::vector<KdTree<Vec2>::Match> matches;
    plane_.tree.within(place, radius_ + reach, matches);
    std::vector<Index> points;
    for (const auto& [i, distance_sq] : matches) points.push_back(i);
    return points;
  }

  // Returns the change across a line through `place`. `near` must include all points within the radius of the
  // fits.
  Change across(const Vec2& place, const Vec2& direction, const std::vector<Index>& near) {
    if (!take_samples(place, direction, near)) return {};
    Part left, right;
    RELIEVO_WIDE(add_samples(samples_, left, right));
    Part whole = left + right;
    for (Part* part : {&left, &right, &whole}) part->fit();
    RELIEVO_WIDE(add_depths(samples_, left, right, whole));
    const double cosine = left.normal.dot(right.normal);
    return {(left.misfit() + right.misfit()) / std::max(whole.misfit(), 1e-12),
            (left.scatter() + right.scatter()) / std::max(whole.scatter(), 1e-12),
            to_degrees(std::acos(std::clamp(cosine, -1.0, 1.0))), left.depth() - right.depth()};
  }

 private:
  // Four points around a place. Unused entries have no weight.
  struct FourSamples {
    Double4 x = {}, y = {};  // position relative to the place, in units of the radius
    Double4 weight = {}, is_left = {};
    Double4 n_x = {}, n_y = {}, n_z = {}, z = {};
  };

  // Takes the samples around a place. Returns whether there are enough on each side of the line.
  bool take_samples(const Vec2& place, const Vec2& direction, const std::vector<Index>& near) {
    samples_.clear();
    std::size_t on_left = 0, on_right = 0;
    for (const Index i : near) {
      const Vec2 to = (plane_.places[i] - place) / radius_;
      const double rest = 1 - to.squaredNorm();
      if (!(rest > 0)) continue;
      const bool is_left = cross(direction, to) > 0;
      const std::size_t lane = (on_left + on_right) % 4;
      if (lane == 0) samples_.emplace_back();
      FourSamples& four = samples_.back();
      const Vec3f& n = surface_.normals[i];
      four.x[lane] = to.x(), four.y[lane] = to.y(), four.weight[lane] = rest * rest,
      four.is_left[lane] = is_left;
      four.n_x[lane] = n.x(), four.n_y[lane] = n.y(), four.n_z[lane] = n.z(),
      four.z[lane] = surface_.points[i].z();
      ++(is_left ? on_left : on_right);
    }
    return std::min(on_left, on_right) >= least_points;
  }

  // The sums over the samples on one side of the line, and the linear fit to the normals of these samples.
  struct Part {
    Mat3 moments = Mat3::Zero(), products = Mat3::Zero();
    Vec3 normal = Vec3::UnitZ();  // fitted normal at the position of the line
    double of_normals = 0, around_mean = 0;
    double depths = 0, squared_depths = 0;  // weighted sums, in rho

    Part operator+(const Part& other) const {
      Part sum;
      sum.moments = moments + other.moments;
      sum.products = products + other.products;
      return sum;
    }

    // Fits the normals. The position is at the edge of each side's samples, so stiffness keeps the fits from
    // extrapolating too far.
    void fit() {
      constexpr double stiffness = .03;
      // The sum of the weights is also the sum of the weighted squares of the normals, because these have unit
      // length.
      const double weights = moments(0, 0);
      Mat3 stiff = moments;
      stiff(1, 1) += stiffness * weights, stiff(2, 2) += stiffness * weights;
      const Mat3 field = stiff.inverse() * products;
      normal = field.row(0).transpose().normalized();
      of_normals =
          weights - 2 * field.cwiseProduct(products).sum() + field.cwiseProduct(moments * field).sum();
      around_mean = weights - products.row(0).squaredNorm() / weights;
    }

    double depth() const { return depths / moments(0, 0); }  // mean depth, at the position of the line
    double of_depths() const {
      constexpr double share = .1;  // weight of the squared scatter of depths relative to that of normals
      return share * std::max(0.0, squared_depths - depths * depth());
    }
    // misfit() returns the sum of the squared deviations of the normals from their fit and of the depths from their
    // mean. scatter() uses the deviations of the normals from their mean instead.
    double misfit() const { return of_normals + of_depths(); }
    double scatter() const { return around_mean + of_depths(); }
  };

  // Weighted sums over the samples. The names list the factors that are summed: coordinates x and y, and components of
  // the normals. Each of the four entries sums every fourth sample.
  struct FourSums {
    Double4 w = {}, x = {}, y = {}, xx = {}, xy = {}, yy = {};
    Double4 n_x = {}, n_y = {}, n_z = {}, x_n_x = {}, x_n_y = {}, x_n_z = {}, y_n_x = {}, y_n_y = {},
            y_n_z = {};

    RELIEVO_INLINE void add(const FourSamples& s, const Double4& weight) {
      const Double4 wx = weight * s.x, wy = weight * s.y;
      w += weight, x += wx, y += wy, xx += wx * s.x, xy += wx * s.y, yy += wy * s.y;
      n_x += weight * s.n_x, n_y += weight * s.n_y, n_z += weight * s.n_z;
      x_n_x += wx * s.n_x, x_n_y += wx * s.n_y, x_n_z += wx * s.n_z;
      y_n_x += wy * s.n_x, y_n_y += wy * s.n_y, y_n_z += wy * s.n_z;
    }

    void put_into(Part& part) const {
      part.moments << total(w), total(x), total(y), total(x), total(xx), total(xy), total(y), total(xy),
          total(yy);
      part.products << total(n_x), total(n_y), total(n_z), total(x_n_x), total(x_n_y), total(x_n_z),
          total(y_n_x), total(y_n_y), total(y_n_z);
    }
  };

  RELIEVO_INLINE static void add_samples(const std::vector<FourSamples>& fours, Part& left, Part& right) {
    FourSums of_left, of_right;
    for (const FourSamples& s : fours) {
      const Double4 weight = s.weight * s.is_left;
      of_left.add(s, weight);
      of_right.add(s, s.weight - weight);
    }
    of_left.put_into(left);
    of_right.put_into(right);
  }

  // Weighted sums of the depths of one part, in rho, and of their squares. Each of the four entries sums every fourth
  // sample.
  struct FourDepths {
    Double4 sum = {}, squares = {};

    RELIEVO_INLINE void add(const Double4& weight, const Double4& depth) {
      sum += weight * depth, squares += weight * depth * depth;
    }
    void put_into(Part& part) const { part.depths = total(sum), part.squared_depths = total(squares); }
  };

  // Returns the depths of samples, extrapolated to the position of the line. Assumes that the chord from a sample to
  // this position is perpendicular to the mean of the normals at its ends.
  RELIEVO_INLINE Double4 depths_at_place(const FourSamples& s, const Vec3& normal) const {
    const Double4 n_z = s.n_z + normal.z(), least = Double4{} + .2;
    const Double4 rise = (s.n_x + normal.x()) * s.x + (s.n_y + normal.y()) * s.y;
    return (s.z + radius_ * rise / (n_z > least ? n_z : least)) / surface_.rho;
  }

  RELIEVO_INLINE void add_depths(const std::vector<FourSamples>& fours, Part& left, Part& right,
                                 Part& whole) const {
    FourDepths of_left, of_right, of_whole;
    for (const FourSamples& s : fours) {
      const Double4 weight = s.weight * s.is_left;
      of_left.add(weight, depths_at_place(s, left.normal));
      of_right.add(s.weight - weight, depths_at_place(s, right.normal));
      of_whole.add(s.weight, depths_at_place(s, whole.normal));
    }
    of_left.put_into(left);
    of_right.put_into(right);
    of_whole.put_into(whole);
  }

  const Surface& surface_;
  const PlanePoints& plane_;
  double radius_;
  std::vector<FourSamples> samples_;  // around the position of the last call
};

// The positions of a line, and the sum of the steps across it.
struct Line {
  std::vector<Vec2> places;
  double steps = 0;
};

class LineFinder {
 public:
  LineFinder(const Surface& surface, const PlanePoints& plane, std::vector<OutlineCurve>& outlines)
      : surface_(surface),
        plane_(plane),
        outlines_(outlines),
        finder_(surface, plane),
        rho_(surface.rho),
        grid_(segments_of(outlines), 1.5 * rho_),
        lines_(2 * rho_),
        starts_(2 * rho_) {}

  // Continues jumps beyond their ends. Starts a few points before the ends, because these are inaccurate.
  void continue_jumps() {
    constexpr std::size_t before_end = 4, least_length = 8;
    for (Index c = 0; c < outlines_.size(); ++c) {
      FairCurve& curve = outlines_[c].curve;
      if (outlines_[c].is_closed || curve.points.size() < least_length) continue;
      for (int end = 0; end < 2; ++end) {
        std::ranges::reverse(curve.points);
        std::ranges::reverse(curve.is_corner);
        const std::size_t last = curve.points.size() - 1 - before_end;
        Line line{{curve.points[last]}};
        follow(line, curve.points[last] - curve.points[last - 2], c);
        if (line.places.size() > before_end) replace_end(line.places, curve, last);
      }
    }
  }

  // Adds new lines. Starts at the edges across which the normals differ most.
  void add_lines() {
    for (const auto& [a, b] : bent_edges()) {
      const Vec2 place = (plane_.places[a] + plane_.places[b]) / 2;
      if (starts_.is_near(place, stride * rho_) || !is_free(place)) continue;
      starts_.add(place, 0);
      const Vec2 direction = direction_at(place);
      if (!(direction.norm() > 0)) continue;
      Line line = line_through(place, direction);
      if (static_cast<double>(line.places.size()) * stride < shortest) continue;
      if (line.steps < 0) std::ranges::reverse(line.places);
      add(line);
    }
  }

 private:
  // Returns the edges inside the surface that may cross a line, ordered by the angle between their normals,
  // largest first.
  std::vector<std::pair<Index, Index>> bent_edges() const {
    std::vector<std::tuple<float, Index, Index>> found;
    each_side_inside(surface_, [&](Index a, Index b) {
      const float likeness = surface_.normals[a].dot(surface_.normals[b]);
      if (likeness < bent_below) found.emplace_back(likeness, std::min(a, b), std::max(a, b));
    });
    std::ranges::sort(found);
    std::vector<std::pair<Index, Index>> edges;
    for (const auto& [likeness, a, b] : found)
      if (edges.empty() || edges.back() != std::pair(a, b)) edges.emplace_back(a, b);
    return edges;
  }

  // Returns the direction of the line across which the surface changes most; zero if no line begins at
  // `place`.
  Vec2 direction_at(const Vec2& place) {
    constexpr int directions = 12;
    const std::vector<Index> near = finder_.around(place, 0);
    double least = 1;
    Vec2 best = Vec2::Zero();
    for (int k = 0; k < directions; ++k) {
      const Vec2 direction = turned(Vec2::UnitX(), to_radians(180.0 * k / directions));
      const Change change = finder_.across(place, direction, near);
      if (at_start.hold(change) && change.scatter < least) least = change.scatter, best = direction;
    }
    return best;
  }

  Line line_through(const Vec2& place, const Vec2& direction) {
    Line back{{place}}, line;
    follow(back, -direction, no_index);
    std::ranges::reverse(back.places);
    line.places = std::move(back.places);
    line.steps = -back.steps;
    follow(line, direction, no_index);
    return line;
  }

  // Adds positions to a line until the change is too small or another line is too near. Each position is where the
  // surface changes most. `own` is the outline that the line continues, if any.
  void follow(Line& line, Vec2 direction, Index own) {
    constexpr double turn_deg = 12;
    constexpr double least_gain = .03;  // least decrease of the scatter for which the direction changes
    direction.normalize();
    while (true) {
      const Vec2 from = line.places.back();
      const std::vector<Index> near = finder_.around(from, stride * rho_);
      Change best;
      Vec2 towards = direction;
      for (const int turn : {0, 1, -1, 2, -2, 3, -3}) {
        const Vec2 along = turned(direction, to_radians(turn_deg * turn));
        const Change change = finder_.across(from + stride * rho_ * along, along, near);
        if (farther_on.hold(change) && change.scatter < best.scatter - least_gain)
          best = change, towards = along;
      }
      const Vec2 to = from + stride * rho_ * towards;
      if (best.scatter == 1 || !is_free(to, own) || returns(line.places, to)) return;
      line.places.push_back(to);
      line.steps += best.step;
      direction = (direction + towards).normalized();
    }
  }

  bool is_free(const Vec2& place, Index own = no_index) const {
    return grid_.nearest(place, apart * rho_, own).segment == no_index &&
           !lines_.is_near(place, apart * rho_);
  }

  // Returns whether a position is near an earlier part of its own line.
  bool returns(const std::vector<Vec2>& places, const Vec2& to) const {
    constexpr std::size_t latest = 8;  // the last positions, which are always near, are not tested
    for (std::size_t k = 0; k + latest < places.size(); ++k)
      if ((places[k] - to).norm() < apart * rho_) return true;
    return false;
  }

  void add(const Line& line) {
    std::vector<CurveNode> nodes;
    for (const Vec2& place : line.places) nodes.push_back({place, 1}), lines_.add(place, 0);
    const bool is_crease = std::abs(line.steps) < least_step * static_cast<double>(line.places.size());
    const FairCurveOptions options{(is_crease ? crease_spacing : stride) * rho_, line_window * rho_};
    OutlineCurve outline{fair_curve(nodes, false, options), false, true, is_crease};
    if (!outline.curve.points.empty()) outlines_.push_back(std::move(outline));
  }

  // Replaces the part of a curve after its point `last` by `places`, after smoothing their zigzag. places[0]
  // is the point `last`.
  void replace_end(std::vector<Vec2>& places, FairCurve& curve, std::size_t last) {
    for (int pass = 0; pass < 4; ++pass) {
      const std::vector<Vec2> before = places;
      for (std::size_t k = 1; k + 1 < places.size(); ++k)
        places[k] = (before[k - 1] + 2 * before[k] + before[k + 1]) / 4;
    }
    curve.points.resize(last);
    append(curve.points, places);
    curve.is_corner.resize(last);
    curve.is_corner.resize(curve.points.size(), 0);
    for (const Vec2& place : places) lines_.add(place, 0);
  }

  const Surface& surface_;
  const PlanePoints& plane_;
  std::vector<OutlineCurve>& outlines_;
  ChangeFinder finder_;
  double rho_;
  SegmentGrid grid_;         // the outlines given to the constructor
  PointSet lines_, starts_;  // lines_: positions of new lines; starts_: positions where lines were sought
};

}  // namespace

void add_inner_lines(const Surface& surface, const PlanePoints& plane, std::vector<OutlineCurve>& outlines) {
  LineFinder finder(surface, plane, outlines);
  finder.continue_jumps();
  finder.add_lines();
}

}  // namespace relievo
