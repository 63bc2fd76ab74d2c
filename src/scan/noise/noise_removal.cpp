// Removes the noise of a scan, eight neighbours at a time in single precision. Declared in noise.h. Tested by
// tests/scan/noise_test.cpp.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "core/angle.h"
#include "core/lists.h"
#include "core/simd.h"
#include "geometry/near_search.h"
#include "relievo/core/parallel.h"
#include "scan/noise/noise.h"

namespace relievo {
namespace {

constexpr int fits = 3;  // number of fits; each is weighted by the deviations from the previous one
constexpr double least_radius = 2, more_radius = 3;  // radius = spacing (2 + 3 noise)
constexpr double least_deviation = to_radians(8),
                 more_deviation = to_radians(30);  // normals: the greater of 8 degrees and 30 degrees * noise
constexpr float facing = .2F;  // least cosine between the normals of neighbours on the same side of a wall
constexpr double stiffness = .01;  // keeps the fit regular if the neighbours are collinear
constexpr std::size_t lanes = 8;

// Eight vectors: positions in units of the radius, or unit normals.
struct Eight {
  Float8 x = {}, y = {}, z = {};
};

// Eight neighbours of a point. Unused lanes are outside the radius, where the weight is 0.
struct Neighbours {
  Eight place{Float8{} + 2, {}, {}}, normal;
  Float8 deviation_sq = {};  // squared distance of each normal from the last fit's normal
};

struct Frame {
  Vec3f axis, t1, t2;

  explicit Frame(const Vec3f& normal) : axis(normal), t1(normal.unitOrthogonal()), t2(normal.cross(t1)) {}

  RELIEVO_INLINE Eight turned(const Eight& v) const {
    return {v.x * t1.x() + v.y * t1.y() + v.z * t1.z(), v.x * t2.x() + v.y * t2.y() + v.z * t2.z(),
            v.x * axis.x() + v.y * axis.y() + v.z * axis.z()};
  }
};

// Weighted sums over the neighbours. u and v are their coordinates in the tangent plane, p and q the slopes of their
// normals. The names list the factors that are summed; `height` sums the predicted heights of the surface.
struct Sums {
  Float8 w = {}, wu = {}, wv = {}, wuu = {}, wuv = {}, wvv = {};
  Float8 p = {}, pu = {}, pv = {}, q = {}, qu = {}, qv = {};
  Float8 height = {};
};

// The fitted surface in a frame. The slopes p and q are linear functions of u and v, given by their coefficients of
// 1, u and v. The height is in units of the radius.
struct LocalSurface {
  Vec3f p = Vec3f::Zero(), q = Vec3f::Zero();
  float height = 0;

  Vec3f normal(const Frame& frame) const {
    return (frame.axis + p[0] * frame.t1 + q[0] * frame.t2).normalized();
  }
};

// The weight of a neighbour is multiplied by exp(-factor * deviation^2) for each of its two deviations from
// the last fit. A factor is 1 / (2 variance).
struct Tolerances {
  float normals;  // the factor for the deviation of normals
  float heights;  // the factor for the deviation of heights, which is in units of the radius
};

// Returns exp(x) for x <= 0 with seven digits; below -80, returns exp(-80), about 2e-35.
RELIEVO_INLINE Float8 exponential(const Float8& x) {
  constexpr float digits_end = 12582912;  // 1.5 * 2^23; adding it rounds a small number to an integer
  Float8 result;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const float y = std::max(x[lane], -80.F) * 1.44269504F, shifted = y + digits_end;
    const float t = (y - (shifted - digits_end)) * .693147181F;
    const float series = 1 + t * (1 + t * (.5F + t * (.166666667F + t * (.0416666667F + t * .00833333333F))));
    std::uint32_t bits;
    std::memcpy(&bits, &shifted, sizeof bits);
    bits = (bits << 23) + (127U << 23);
    float power;
    std::memcpy(&power, &bits, sizeof power);
    result[lane] = series * power;
  }
  return result;
}

RELIEVO_INLINE Sums sums_of(std::span<const Neighbours> neighbours, const Frame& frame, float height,
                            const Tolerances& tolerances) {
  Sums s;
  for (const Neighbours& each : neighbours) {
    const Eight d = frame.turned(each.place), n = frame.turned(each.normal);
    // The height of the surface at the point, predicted by a neighbour. It is assumed that the chord from the
    // neighbour to the surface at the point is perpendicular to the mean of the normals at both ends. This is
    // exact on spheres, too.
    const Float8 up = (d.x * n.x + d.y * n.y + d.z * (n.z + 1)) * .5F, off = up - height;
    const Float8 inside = 1 - (d.x * d.x + d.y * d.y + d.z * d.z);
    const auto counts = (n.z > facing) & (inside > 0);
    const Float8 likeness =
        exponential(-tolerances.normals * each.deviation_sq - tolerances.heights * off * off);
    const Float8 w = counts ? inside * inside * likeness : Float8{}, tilt = w / (counts ? n.z : Float8{} + 1);
    const Float8 wu = w * d.x, wv = w * d.y, p = tilt * n.x, q = tilt * n.y;
    s.w += w, s.wu += wu, s.wv += wv, s.wuu += wu * d.x, s.wuv += wu * d.y, s.wvv += wv * d.y;
    s.p += p, s.pu += p * d.x, s.pv += p * d.y, s.q += q, s.qu += q * d.x, s.qv += q * d.y;
    s.height += w * up;
  }
  return s;
}

// Computes how much the neighbours' normals deviate from the normals of the surface.
RELIEVO_INLINE void deviate(std::span<Neighbours> neighbours, const Frame& frame, const LocalSurface& fit) {
  for (Neighbours& each : neighbours) {
    const Eight d = frame.turned(each.place), n = frame.turned(each.normal);
    const Float8 p = fit.p[0] + fit.p[1] * d.x + fit.p[2] * d.y,
                 q = fit.q[0] + fit.q[1] * d.x + fit.q[2] * d.y;
    const Float8 length_sq = 1 + p * p + q * q;
    Float8 length;
    for (std::size_t lane = 0; lane < lanes; ++lane) length[lane] = std::sqrt(length_sq[lane]);
    const Float8 dev = 2 - 2 * (n.x * p + n.y * q + n.z) / length;
    each.deviation_sq = dev > 0 ? dev : Float8{};
  }
}

double total(const Float8& eight) {
  double sum = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) sum += static_cast<double>(eight[lane]);
  return sum;
}

// Returns the surface for these sums. The sum of the weights must be positive.
LocalSurface solved(const Sums& sums) {
  const double w = total(sums.w), wu = total(sums.wu), wv = total(sums.wv), wuv = total(sums.wuv);
  const Mat3 moments{
      {w, wu, wv}, {wu, total(sums.wuu) + stiffness * w, wuv}, {wv, wuv, total(sums.wvv) + stiffness * w}};
  const Mat3 inverse = moments.inverse();
  const Vec3 p(total(sums.p), total(sums.pu), total(sums.pv)),
      q(total(sums.q), total(sums.qu), total(sums.qv));
  return {(inverse * p).cast<float>(), (inverse * q).cast<float>(),
          static_cast<float>(total(sums.height) / w)};
}

// Fits the surface around each point.
class NoiseFilter {
 public:
  NoiseFilter(const SearchableCloud& scan, double noise) : scan_(scan), noise_(noise) {}

  double radius(Index i) const { return (least_radius + more_radius * noise_) * unit(i); }

  // Returns the point, moved onto the surface that is fitted to the points `near`, and the surface's normal
  // there.
  std::pair<Vec3, Vec3f> at(Index i, std::span<const Index> near) {
    gather(i, near);
    const double deviation = std::max(least_deviation, more_deviation * noise_),
                 height = noise_ * unit(i) / radius(i);
    const Tolerances tolerances{static_cast<float>(1 / (2 * deviation * deviation)),
                                static_cast<float>(1 / (4 * height * height))};
    Vec3f normal = scan_.cloud.normals[i];
    LocalSurface surface;
    for (int k = 0; k < fits; ++k) {
      const Frame frame(normal);
      if (k == 0) RELIEVO_WIDE(deviate(neighbours_, frame, surface));
      const Sums sums = RELIEVO_WIDE(sums_of(neighbours_, frame, surface.height, tolerances));
      if (!(total(sums.w) > 0)) break;
      surface = solved(sums);
      normal = surface.normal(frame);
      if (k + 1 < fits) RELIEVO_WIDE(deviate(neighbours_, frame, surface));
    }
    const double height_of_surface = radius(i) * static_cast<double>(surface.height);
    return {scan_.cloud.points[i] + height_of_surface * normal.cast<double>(), normal};
  }

 private:
  double unit(Index i) const {
    return std::max(static_cast<double>(scan_.spacing.local[i]), scan_.spacing.rho);
  }

  void gather(Index i, std::span<const Index> near) {
    neighbours_.assign((near.size() + lanes - 1) / lanes, {});
    const double per_radius = 1 / radius(i);
    for (std::size_t k = 0; k < near.size(); ++k) {
      const Vec3f place = (per_radius * (scan_.cloud.points[near[k]] - scan_.cloud.points[i])).cast<float>();
      const Vec3f& normal = scan_.cloud.normals[near[k]];
      Neighbours& eight = neighbours_[k / lanes];
      const std::size_t lane = k % lanes;
      eight.place.x[lane] = place.x(), eight.place.y[lane] = place.y(), eight.place.z[lane] = place.z();
      eight.normal.x[lane] = normal.x(), eight.normal.y[lane] = normal.y(), eight.normal.z[lane] = normal.z();
    }
  }

  const SearchableCloud& scan_;
  double noise_;
  std::vector<Neighbours> neighbours_;
};

}  // namespace

CleanPoints without_noise(const SearchableCloud& scan, const NoiseRemoval& removal,
                          const Progress* progress) {
  const std::span<const Index> points = removal.points;
  CleanPoints clean{std::vector<Vec3>(points.size()), std::vector<Vec3f>(points.size())};
  parallel_ranges(points.size(), 1024, [&](std::size_t begin, std::size_t end) {
    if (progress && progress->is_cancelled()) return;
    NoiseFilter filter(scan, removal.noise);
    NearSearch<Vec3> search(scan.tree, scan.cloud.points);
    const auto ball = [&](std::size_t k) -> NearSearch<Vec3>::Ball {
      return {scan.cloud.points[points[k]], filter.radius(points[k])};
    };
    search.each(begin, end, ball, [&](std::size_t k, std::span<const Index> near) {
      std::tie(clean.points[k], clean.normals[k]) = filter.at(points[k], near);
    });
  });
  return clean;
}

std::vector<Index> points_near_front(std::span<const Vec3f> normals, const Vec3f& towards_viewer,
                                     const Spacing& spacing) {
  constexpr float least_facing =
      -.1F;  // cosine of 96 degrees; few normals with larger angles turn to the viewer when noise is removed
  constexpr std::uint8_t rings = 3;  // rings of neighbours; they reach farther than the fits of curvature do
  std::vector<std::uint8_t> level(normals.size(), 0);
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (normals[i].dot(towards_viewer) > least_facing) level[i] = rings + 1;
  for (std::uint8_t ring = rings; ring > 0; --ring)
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (level[i] != ring + 1) continue;
      for (const Index j : spacing.nearest[i])
        if (j != no_index) level[j] = std::max(level[j], ring);
    }
  return indices_where(level.size(), [&](Index i) { return level[i] > 0; });
}

}  // namespace relievo
