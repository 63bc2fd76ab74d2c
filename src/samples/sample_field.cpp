#include "samples/sample_shapes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

#include "core/random.h"
#include "relievo/core/parallel.h"

namespace relievo::field {
namespace {

// A stream of random numbers. Each block has its own stream, so blocks can run in any order.
class Random : public SplitMix64 {
 public:
  Random(std::uint64_t seed, std::uint64_t stream) : SplitMix64(first_state(seed, stream)) {}

  // Returns a random number with the standard normal distribution (Box and Muller 1958).
  double gaussian() {
    const double u = 1 - uniform(), v = uniform();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
  }

 private:
  // Returns a hash of both numbers, so that similar numbers give unrelated streams.
  static std::uint64_t first_state(std::uint64_t seed, std::uint64_t stream) {
    return SplitMix64(seed + step * (stream + 1)).bits();
  }
};

// Cubes of equal size that together contain the surface, and the field at their centres.
struct Cells {
  std::vector<Vec3> centres;
  std::vector<double> values;
  double side = 0;
};

Cells near_surface(const Solid& solid, const std::vector<Vec3>& centres, double side) {
  const double reach = side * std::numbers::sqrt3 / 2;
  std::vector<double> values(centres.size());
  parallel_for(centres.size(), [&](std::size_t i) { values[i] = solid.value(centres[i]); });
  Cells kept{{}, {}, side};
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (std::abs(values[i]) > reach) continue;
    kept.centres.push_back(centres[i]);
    kept.values.push_back(values[i]);
  }
  return kept;
}

std::vector<Vec3> split(const std::vector<Vec3>& centres, double side) {
  std::vector<Vec3> parts;
  parts.reserve(8 * centres.size());
  for (const Vec3& c : centres) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 towards(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      parts.push_back(c + side / 4 * towards);
    }
  }
  return parts;
}

Cells cover(const Solid& solid) {
  // Cells of 1/256 of the longest side are smaller than the distance between any two sheets of a sample.
  const int levels = 8;
  Cells cells{{solid.box.centre()}, {0}, solid.box.size().maxCoeff()};
  for (int level = 0; level < levels; ++level)
    cells = near_surface(solid, split(cells.centres, cells.side), cells.side / 2);
  return cells;
}

struct Line {
  Vec3 origin;
  int axis = 0;
  Vec3 at(double t) const {
    Vec3 p = origin;
    p[axis] += t;
    return p;
  }
};

struct Bracket {
  double t0, f0, t1, f1;
  bool holds_root() const { return (f0 < 0) != (f1 < 0); }
};

struct Root {
  double t, f;  // position on the line, and value of the field there
};

// Finds a root between two positions by false position with the Illinois rule.
Root find_root(const Solid& solid, const Line& line, Bracket b) {
  const double tolerance = 1e-5 * (b.t1 - b.t0);
  const int most = 40;
  int last_side = 0;
  Root root{b.t0, b.f0};
  for (int i = 0; i < most; ++i) {
    root.t = (b.t0 * b.f1 - b.t1 * b.f0) / (b.f1 - b.f0);
    root.f = solid.value(line.at(root.t));
    if (std::abs(root.f) < tolerance) break;
    const bool is_left = (root.f < 0) == (b.f0 < 0);
    (is_left ? b.t0 : b.t1) = root.t;
    (is_left ? b.f0 : b.f1) = root.f;
    const int side = is_left ? -1 : 1;
    if (side == last_side) (is_left ? b.f1 : b.f0) /= 2;
    last_side = side;
  }
  return root;
}

Vec3 unit_gradient(const Solid& solid, const Vec3& p, double here) {
  const double step = 1e-6;
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) gradient[axis] = solid.value(p + step * Vec3::Unit(axis)) - here;
  return gradient.normalized();
}

// A part of the cloud that one stream of random numbers generates.
struct Block {
  std::span<Vec3> points;
  std::span<Vec3f> normals;
  std::size_t filled = 0;
  std::uint64_t lines = 0;  // number of lines used so far

  bool is_full() const { return filled == points.size(); }
  void add(const Vec3& p, const Vec3& n) {
    if (is_full()) return;
    points[filled] = p;
    normals[filled++] = n.cast<float>();
  }
};

// Random lines parallel to the three axes hit a small part of the surface with a probability proportional to
// its area times |nx| + |ny| + |nz|. Each hit is kept with a probability inversely proportional to that
// factor. So the density of points is exactly uniform over the area.
void keep_hit(const Solid& solid, const Vec3& p, double value, Random& random, Block& block) {
  const Vec3 n = unit_gradient(solid, p, value);
  if (random.uniform() * n.lpNorm<1>() <= 1) block.add(p, n);
}

// A random line through a random cell. The line is parallel to an axis, and its position is uniformly
// distributed over the cell's cross-section.
struct Shot {
  Line line;
  double at_least = 0;  // lower bound of the field's magnitude at the midpoint of the line
};

Shot aim(const Cells& cells, Random& random) {
  const auto cell = static_cast<std::size_t>(random.uniform() * static_cast<double>(cells.centres.size()));
  Line line{cells.centres[cell], static_cast<int>(random.uniform() * 3)};
  const double u = cells.side * (random.uniform() - 0.5), v = cells.side * (random.uniform() - 0.5);
  line.origin[(line.axis + 1) % 3] += u;
  line.origin[(line.axis + 2) % 3] += v;
  return {line, std::abs(cells.values[cell]) - std::hypot(u, v)};
}

void shoot(const Solid& solid, const Cells& cells, Random& random, Block& block) {
  const double half = cells.side / 2;
  const auto [line, at_least] = aim(cells, random);
  ++block.lines;
  if (at_least > half) return;
  const double middle = solid.value(line.origin);
  if (std::abs(middle) > half) return;
  const Bracket low{-half, solid.value(line.at(-half)), 0, middle};
  const Bracket high{0, middle, half, solid.value(line.at(half))};
  for (const Bracket& b : {low, high}) {
    if (!b.holds_root()) continue;
    const Root root = find_root(solid, line, b);
    keep_hit(solid, line.at(root.t), root.f, random, block);
  }
}

// Generates the points and normals of the cloud. Returns the sampling distance.
double fill(const Solid& solid, const Cells& cells, std::uint64_t seed, Cloud& cloud) {
  const auto shots = [&](std::size_t begin, std::size_t end) {
    Block block{std::span(cloud.points).subspan(begin, end - begin),
                std::span(cloud.normals).subspan(begin, end - begin)};
    Random random(seed, begin / default_grain);
    while (!block.is_full()) shoot(solid, cells, random, block);
    return block.lines;
  };
  const std::uint64_t lines = parallel_reduce(cloud.size(), std::uint64_t{0}, shots, std::plus<>());
  // Lines along three axes are distributed over the cross-sections of all cells. The total area of these
  // cross-sections, divided by the number of lines, is the area of the surface per point.
  const double share =
      3 * cells.side * cells.side * static_cast<double>(cells.centres.size()) / static_cast<double>(lines);
  return std::sqrt(share);
}

// Moves a point along its normal by noise, and tilts the normal as much as noise would tilt a normal
// estimated from such points.
void disturb(double noise, double spacing, Random& random, Vec3& p, Vec3f& normal) {
  const double tilt = 0.2 * noise;  // in radians per axis, the error of a plane fitted to about 30 neighbours
  const Vec3 n = normal.cast<double>();
  const Vec3 helper = std::abs(n.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 u = n.cross(helper).normalized(), v = n.cross(u);
  const double along = random.gaussian(), a = random.gaussian(), b = random.gaussian();
  p += noise * spacing * along * n;
  normal = (n + tilt * (a * u + b * v)).normalized().cast<float>();
}

}  // namespace

Cloud scatter(const Solid& solid, const Scatter& how) {
  Cloud cloud{std::vector<Vec3>(how.points), std::vector<Vec3f>(how.points)};
  const double spacing = fill(solid, cover(solid), how.seed, cloud);
  if (how.noise == 0) return cloud;
  parallel_ranges(how.points, default_grain, [&](std::size_t begin, std::size_t end) {
    Random random(~how.seed, begin / default_grain);
    for (std::size_t i = begin; i < end; ++i)
      disturb(how.noise, spacing, random, cloud.points[i], cloud.normals[i]);
  });
  return cloud;
}

}  // namespace relievo::field
