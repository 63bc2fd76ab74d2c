#include "scan/outlines/inner_lines.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "core/angle.h"
#include "geometry/plane.h"
#include "geometry/point_set.h"

namespace relievo {
namespace {

// Lengths in rho.
constexpr double change_radius = 3.0, stride = .75, line_window = 3, shortest = 8;
// Lines nearer to each other or to outlines would leave too few points between them.
constexpr double apart = 2;
constexpr std::size_t least_points = 4;  // on each side of a line
// A line may begin at an edge if the cosine between the normals at its ends is below this.
constexpr float bent_below = .75F;

// The change of a surface across a line through a position. The normals on each side are fitted by a linear
// function.
struct Change {
  double left_over = 1;  // misfit of both fits, as a share of the misfit of one common fit
  // Scatter around the means of both sides, as a share of the scatter around the common mean.
  double scatter = 1;
  double angle_deg = 0;  // between the fitted normals of both sides
  // Depth of the left side minus depth of the right side, in rho; positive if the left side is in front.
  double step = 0;
};

// Limits that the change of a surface must satisfy, for the begin of a line and for its continuation.
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
  Change across(const Vec2& place, const Vec2& direction, const std::vector<Index>& near) const {
    std::vector<Sample> samples;
    Part left, right;
    for (const Index i : near) {
      const Vec2 to = (plane_.places[i] - place) / radius_;
      const double rest = 1 - to.squaredNorm();
      if (!(rest > 0)) continue;
      const bool is_left = cross(direction, to) > 0;
      samples.push_back(
          {to, rest * rest, surface_.normals[i].cast<double>(), surface_.points[i].z(), is_left});
      (is_left ? left : right).add(samples.back());
    }
    if (std::min(left.count, right.count) < least_points) return {};
    Part whole = left + right;
    for (Part* part : {&left, &right, &whole}) part->fit();
    for (const Sample& s : samples) {
      add_depth(s, s.is_left ? left : right);
      add_depth(s, whole);
    }
    const double cosine = left.normal.dot(right.normal);
    return {(left.misfit() + right.misfit()) / std::max(whole.misfit(), 1e-12),
            (left.scatter() + right.scatter()) / std::max(whole.scatter(), 1e-12),
            to_degrees(std::acos(std::clamp(cosine, -1.0, 1.0))), left.depth() - right.depth()};
  }

 private:
  struct Sample {
    Vec2 to;  // from the position to the sample, as a share of the radius
    double weight;
    Vec3 normal;
    double z;
    bool is_left;
  };

  // Sums over samples, and the results of a linear fit to their normals.
  struct Part {
    std::size_t count = 0;
    Mat3 moments = Mat3::Zero(), products = Mat3::Zero();
    Vec3 normal = Vec3::UnitZ();  // fitted normal at the position of the line
    double of_normals = 0, around_mean = 0;
    double depths = 0, squared_depths = 0;  // in rho

    void add(const Sample& s) {
      const Vec3 powers(1, s.to.x(), s.to.y());
      moments += s.weight * powers * powers.transpose();
      products += s.weight * powers * s.normal.transpose();
      ++count;
    }

    Part operator+(const Part& other) const {
      Part sum;
      sum.moments = moments + other.moments;
      sum.products = products + other.products;
      return sum;
    }

    // Fits the normals. The position lies at the edge of each side's samples, so stiffness keeps the fits
    // from extrapolating too far.
    void fit() {
      constexpr double stiffness = .03;
      // Normals have unit length, so this is also the sum of their squares.
      const double weights = moments(0, 0);
      Mat3 stiff = moments;
      stiff(1, 1) += stiffness * weights, stiff(2, 2) += stiffness * weights;
      const Mat3 field = stiff.inverse() * products;
      normal = field.row(0).transpose().normalized();
      of_normals =
          weights - 2 * field.cwiseProduct(products).sum() + field.cwiseProduct(moments * field).sum();
      around_mean = weights - products.row(0).squaredNorm() / weights;
    }

    double depth() const { return depths / moments(0, 0); }  // at the position of the line
    double of_depths() const {
      constexpr double share = .1;  // factor of the squared scatter of depths relative to that of normals
      return share * std::max(0.0, squared_depths - depths * depth());
    }
    // Sums of squared deviations of normals and depths: from the fit, and from the mean.
    double misfit() const { return of_normals + of_depths(); }
    double scatter() const { return around_mean + of_depths(); }
  };

  // Adds the depth of a sample, extrapolated to the line's position along a chord. The chord is perpendicular
  // to the mean of the normals at its ends.
  void add_depth(const Sample& s, Part& part) const {
    const Vec3 mean = part.normal + s.normal;
    const double depth = (s.z + radius_ * mean.head<2>().dot(s.to) / std::max(mean.z(), .2)) / surface_.rho;
    part.depths += s.weight * depth;
    part.squared_depths += s.weight * depth * depth;
  }

  const Surface& surface_;
  const PlanePoints& plane_;
  double radius_;
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

  // Continues jumps. Starts a little before their ends, because these are inaccurate.
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

  // Adds lines. Begins with the edges whose normals differ most.
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
      add(line.places);
    }
  }

 private:
  // Returns the edges inside the surface that may cross a line, ordered by the angle between their normals,
  // largest first.
  std::vector<std::pair<Index, Index>> bent_edges() const {
    std::vector<std::tuple<float, Index, Index>> found;
    for (std::size_t t = 0; t < surface_.triangulation.triangles.size(); ++t)
      for (int i = 0; surface_.boundary.is_inside[t] && i < 3; ++i) {
        const Triangle& corners = surface_.triangulation.triangles[t];
        const Index a = corners[i], b = corners[(i + 1) % 3];
        const float likeness = surface_.normals[a].dot(surface_.normals[b]);
        if (likeness < bent_below) found.emplace_back(likeness, std::min(a, b), std::max(a, b));
      }
    std::ranges::sort(found);
    std::vector<std::pair<Index, Index>> edges;
    for (const auto& [likeness, a, b] : found)
      if (edges.empty() || edges.back() != std::pair(a, b)) edges.emplace_back(a, b);
    return edges;
  }

  // Returns the direction of the line across which the surface changes most; zero if no line begins here.
  Vec2 direction_at(const Vec2& place) const {
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

  Line line_through(const Vec2& place, const Vec2& direction) const {
    Line back{{place}}, line;
    follow(back, -direction, no_index);
    std::ranges::reverse(back.places);
    line.places = std::move(back.places);
    line.steps = -back.steps;
    follow(line, direction, no_index);
    return line;
  }

  // Adds positions to a line, each at the largest change of the surface, until the change is too small or
  // another line is too near. `own` is the outline to be continued, if any.
  void follow(Line& line, Vec2 direction, Index own) const {
    constexpr double turn_deg = 12;
    constexpr double least_gain = .03;  // least improvement of left_over for which the direction changes
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
    constexpr std::size_t latest = 8;  // number of latest positions that may be near
    for (std::size_t k = 0; k + latest < places.size(); ++k)
      if ((places[k] - to).norm() < apart * rho_) return true;
    return false;
  }

  void add(const std::vector<Vec2>& places) {
    std::vector<CurveNode> nodes;
    for (const Vec2& place : places) nodes.push_back({place, 1}), lines_.add(place, 0);
    OutlineCurve outline{fair_curve(nodes, false, {stride * rho_, line_window * rho_}), false, true};
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
    curve.points.insert(curve.points.end(), places.begin(), places.end());
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
  PointSet lines_, starts_;  // positions of new lines; positions where lines were sought
};

}  // namespace

void add_inner_lines(const Surface& surface, const PlanePoints& plane, std::vector<OutlineCurve>& outlines) {
  LineFinder finder(surface, plane, outlines);
  finder.continue_jumps();
  finder.add_lines();
}

}  // namespace relievo
