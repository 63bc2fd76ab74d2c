#include "sample_field.h"

#include <Eigen/Geometry>

#include "relievo/parallel.h"

namespace relievo::field {
namespace {

// splitmix64 (Steele, Lea, Flood 2014): a stream per block, so that blocks can run in any order.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream) : state_(seed + 0x9E3779B97F4A7C15U * (stream + 1)) {
    state_ = next();
  }

  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }

  // Uniform in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  // Standard normal (Box and Muller).
  double gaussian() {
    const double u = 1 - uniform(), v = uniform();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
  }

 private:
  std::uint64_t state_;
};

// Cubes of one size that together hold the surface.
struct Cells {
  std::vector<Vec3> centres;
  double side = 0;
};

std::vector<Vec3> near_surface(const Solid& solid, const std::vector<Vec3>& centres, double side) {
  const double reach = side * std::numbers::sqrt3 / 2;
  std::vector<char> is_near(centres.size());
  parallel_for(centres.size(),
               [&](std::size_t i) { is_near[i] = std::abs(solid.value(centres[i])) <= reach; });
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (is_near[i]) kept.push_back(centres[i]);
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
  const int levels = 8;  // 256 cells along the box: finer than any two sheets that must not be taken for one
  Cells cells{{solid.box.centre()}, solid.box.size().maxCoeff()};
  for (int level = 0; level < levels; ++level) {
    cells.centres = near_surface(solid, split(cells.centres, cells.side), cells.side / 2);
    cells.side /= 2;
  }
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

// Regula falsi with the Illinois rule.
double find_root(const Solid& solid, const Line& line, Bracket b) {
  const double tolerance = 1e-5 * (b.t1 - b.t0);
  const int most = 40;
  int last_side = 0;
  double t = b.t0;
  for (int i = 0; i < most; ++i) {
    t = (b.t0 * b.f1 - b.t1 * b.f0) / (b.f1 - b.f0);
    const double f = solid.value(line.at(t));
    if (std::abs(f) < tolerance) break;
    const bool is_left = (f < 0) == (b.f0 < 0);
    (is_left ? b.t0 : b.t1) = t;
    (is_left ? b.f0 : b.f1) = f;
    const int side = is_left ? -1 : 1;
    if (side == last_side) (is_left ? b.f1 : b.f0) /= 2;
    last_side = side;
  }
  return t;
}

struct Block {
  std::vector<Vec3> points, normals;
  std::uint64_t lines = 0;
};

// Lines parallel to the three axes, of equal density, pierce the surface |nx| + |ny| + |nz| times as often as
// its area alone would have it; keeping a hit with the inverse of that makes the density exactly uniform.
void keep_hit(const Solid& solid, const Vec3& p, Random& random, Block& block) {
  const Vec3 n = outward_normal(solid, p);
  if (random.uniform() * n.lpNorm<1>() > 1) return;
  block.points.push_back(p);
  block.normals.push_back(n);
}

void shoot_line(const Solid& solid, const Cells& cells, Random& random, Block& block) {
  const double half = cells.side / 2;
  const double pick = random.uniform() * static_cast<double>(cells.centres.size());
  Line line{cells.centres[static_cast<std::size_t>(pick)], static_cast<int>(random.uniform() * 3)};
  line.origin[(line.axis + 1) % 3] += cells.side * (random.uniform() - 0.5);
  line.origin[(line.axis + 2) % 3] += cells.side * (random.uniform() - 0.5);
  ++block.lines;
  const double middle = solid.value(line.origin);
  if (std::abs(middle) > half) return;
  const Bracket low{-half, solid.value(line.at(-half)), 0, middle};
  const Bracket high{0, middle, half, solid.value(line.at(half))};
  for (const Bracket& b : {low, high}) {
    if (b.holds_root()) keep_hit(solid, line.at(find_root(solid, line, b)), random, block);
  }
}

// Moves a point along its normal, and tilts the normal as fitting a plane to such points would.
void add_noise(const Scatter& how, double spacing, Random& random, Vec3& p, Vec3& n) {
  const double tilt = 0.2 * how.noise;  // radians per axis: a plane through some 30 neighbours
  const Vec3 helper = std::abs(n.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 u = n.cross(helper).normalized(), v = n.cross(u);
  p += how.noise * spacing * random.gaussian() * n;
  const double a = random.gaussian(), b = random.gaussian();
  n = (n + tilt * (a * u + b * v)).normalized();
}

}  // namespace

Vec3 outward_normal(const Solid& solid, const Vec3& p) {
  const double step = 1e-6;
  const double here = solid.value(p);
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) gradient[axis] = solid.value(p + step * Vec3::Unit(axis)) - here;
  return gradient.normalized();
}

Cloud scatter(const Solid& solid, const Scatter& how) {
  const Cells cells = cover(solid);
  const std::size_t grain = default_grain;
  std::vector<Block> blocks((how.points + grain - 1) / grain);
  parallel_ranges(how.points, grain, [&](std::size_t begin, std::size_t end) {
    Block& block = blocks[begin / grain];
    Random random(how.seed, begin / grain);
    while (block.points.size() < end - begin) shoot_line(solid, cells, random, block);
    block.points.resize(end - begin);
    block.normals.resize(end - begin);
  });
  double lines = 0;
  for (const Block& block : blocks) lines += static_cast<double>(block.lines);
  // Per axis a line stands for three times the cells' cross-section shared among all lines; so does a point.
  const double spacing = cells.side * std::sqrt(3 * static_cast<double>(cells.centres.size()) / lines);
  Cloud cloud{std::vector<Vec3>(how.points), std::vector<Vec3f>(how.points)};
  parallel_ranges(how.points, grain, [&](std::size_t begin, std::size_t end) {
    Block& block = blocks[begin / grain];
    Random random(~how.seed, begin / grain);
    for (std::size_t i = begin; i < end; ++i) {
      if (how.noise > 0) add_noise(how, spacing, random, block.points[i - begin], block.normals[i - begin]);
      cloud.points[i] = block.points[i - begin];
      cloud.normals[i] = block.normals[i - begin].cast<float>();
    }
  });
  return cloud;
}

}  // namespace relievo::field
