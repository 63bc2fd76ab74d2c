#include "point_links.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "relievo/parallel.h"
#include "simd.h"

namespace relievo {
namespace {

constexpr std::size_t lanes = PointLinks::lanes;
constexpr std::size_t window = 256;  // points
constexpr std::size_t grain = default_grain / lanes;

// x and y of eight points, one after the other.
struct Pairs {
  Float8 low, high;
};

RELIEVO_INLINE Float8 four_pairs(const Vec2f* from, const Index* at) {
  Double4 bits;
  for (int lane = 0; lane < 4; ++lane) {
    double pair;
    std::memcpy(&pair, from + at[lane], sizeof pair);
    bits[lane] = pair;
  }
  return reinterpret_cast<const Float8&>(bits);
}

RELIEVO_INLINE Pairs eight_pairs(const Vec2f* from, const Index* at) {
  return {four_pairs(from, at), four_pairs(from, at + 4)};
}

RELIEVO_INLINE Pairs pairs(const std::array<float, 2 * lanes>& values) {
  const auto* const v = reinterpret_cast<const Float8*>(values.data());
  return {v[0], v[1]};
}

RELIEVO_INLINE Float8 firsts(const Pairs& p) {
  return __builtin_shufflevector(p.low, p.high, 0, 2, 4, 6, 8, 10, 12, 14);
}
RELIEVO_INLINE Float8 seconds(const Pairs& p) {
  return __builtin_shufflevector(p.low, p.high, 1, 3, 5, 7, 9, 11, 13, 15);
}

struct Slice {
  const Index* points;
  std::span<const PointLinks::Slot> slots;
};

RELIEVO_INLINE void divergence_of(const Slice& slice, const Vec2f* slopes, float* sums) {
  const Pairs own = eight_pairs(slopes, slice.points);
  Pairs sum{};
  for (const PointLinks::Slot& slot : slice.slots) {
    const Pairs other = eight_pairs(slopes, slot.other.data()), pull = pairs(slot.pull);
    sum.low += (own.low + other.low) * pull.low;
    sum.high += (own.high + other.high) * pull.high;
  }
  const Float8 result = firsts(sum) + seconds(sum);
  for (std::size_t lane = 0; lane < lanes; ++lane) sums[slice.points[lane]] = result[lane];
}

RELIEVO_INLINE void normals_of(const Slice& slice, const float* z, const Vec3f& light,
                               const PointLinks::Shaded& out) {
  Pairs sum{};
  for (const PointLinks::Slot& slot : slice.slots) {
    const Index* const at = slot.other.data();
    const Float8 h{z[at[0]], z[at[1]], z[at[2]], z[at[3]], z[at[4]], z[at[5]], z[at[6]], z[at[7]]};
    const Pairs pull = pairs(slot.pull);
    sum.low += __builtin_shufflevector(h, h, 0, 0, 1, 1, 2, 2, 3, 3) * pull.low;
    sum.high += __builtin_shufflevector(h, h, 4, 4, 5, 5, 6, 6, 7, 7) * pull.high;
  }
  const Float8 x = firsts(sum), y = seconds(sum), length_sq = x * x + y * y + 1;
  Float8 length;
  for (std::size_t lane = 0; lane < lanes; ++lane) length[lane] = std::sqrt(length_sq[lane]);
  const Float8 nz = 1 / length, nx = x * nz, ny = y * nz;
  const Float8 cosine = nx * light.x() + ny * light.y() + nz * light.z();
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    out.normals[slice.points[lane]] = {nx[lane], ny[lane], nz[lane]};
    out.shading[slice.points[lane]] = std::max(0.F, cosine[lane]);
  }
}

// A run of slices.
struct Slices {
  const Index *points, *begin;
  const PointLinks::Slot* slots;
  std::size_t count;

  RELIEVO_INLINE Slice operator[](std::size_t s) const {
    return {points + s * lanes, {slots + begin[s], slots + begin[s + 1]}};
  }
};

RELIEVO_INLINE void divergence_inline(const Slices& slices, const Vec2f* slopes, float* sums) {
  for (std::size_t s = 0; s < slices.count; ++s) divergence_of(slices[s], slopes, sums);
}
RELIEVO_AVX2 void divergence_avx2(const Slices& slices, const Vec2f* slopes, float* sums) {
  divergence_inline(slices, slopes, sums);
}

RELIEVO_INLINE void normals_inline(const Slices& slices, const float* heights, const Vec3f& light,
                                   const PointLinks::Shaded& out) {
  for (std::size_t s = 0; s < slices.count; ++s) normals_of(slices[s], heights, light, out);
}
RELIEVO_AVX2 void normals_avx2(const Slices& slices, const float* heights, const Vec3f& light,
                               const PointLinks::Shaded& out) {
  normals_inline(slices, heights, light, out);
}

}  // namespace

PointLinks::PointLinks(std::span<const Index> begin, std::span<const PointLink> links)
    : size_(begin.size() - 1) {
  const auto count = [&](Index i) { return begin[i + 1] - begin[i]; };
  points_.resize(size_);
  std::iota(points_.begin(), points_.end(), Index{0});
  for (std::size_t first = 0; first < size_; first += window) {
    const auto from = points_.begin() + static_cast<std::ptrdiff_t>(first);
    std::stable_sort(from, from + static_cast<std::ptrdiff_t>(std::min(window, size_ - first)),
                     [&](Index a, Index b) { return count(a) > count(b); });
  }
  if (size_ > 0) points_.resize((size_ + lanes - 1) / lanes * lanes, points_.back());

  begin_.reserve(points_.size() / lanes + 1);
  for (std::size_t first = 0; first < points_.size(); first += lanes) {
    begin_.push_back(static_cast<Index>(slots_.size()));
    const Index most = count(points_[first]);
    for (Index l = 0; l < most; ++l) {
      Slot& slot = slots_.emplace_back();
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Index i = points_[first + lane];
        const PointLink link = l < count(i) ? links[begin[i] + l] : PointLink{i};
        slot.other[lane] = link.other;
        slot.pull[2 * lane] = link.pull.x(), slot.pull[2 * lane + 1] = link.pull.y();
      }
    }
  }
  begin_.push_back(static_cast<Index>(slots_.size()));
  slots_.shrink_to_fit();
}

template <typename F>
void PointLinks::for_runs(F&& f) const {
  parallel_ranges(begin_.size() - 1, grain, [&](std::size_t first, std::size_t end) {
    f(Slices{points_.data() + first * lanes, begin_.data() + first, slots_.data(), end - first});
  });
}

void PointLinks::divergence(std::span<const Vec2f> slopes, std::span<float> sums) const {
  for_runs([&](const Slices& slices) {
    (uses_avx2() ? divergence_avx2 : divergence_inline)(slices, slopes.data(), sums.data());
  });
}

void PointLinks::divergence(std::span<const Vec2> slopes, std::span<double> sums) const {
  for_runs([&](const Slices& slices) {
    for (std::size_t s = 0; s < slices.count; ++s) {
      const Slice slice = slices[s];
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Index i = slice.points[lane];
        Vec2 sum = Vec2::Zero();
        for (const Slot& slot : slice.slots) {
          const Vec2 pull(static_cast<double>(slot.pull[2 * lane]),
                          static_cast<double>(slot.pull[2 * lane + 1]));
          sum += (slopes[i] + slopes[slot.other[lane]]).cwiseProduct(pull);
        }
        sums[i] = sum.sum();
      }
    }
  });
}

void PointLinks::normals(std::span<const float> heights, const Vec3f& light, const Shaded& out) const {
  for_runs([&](const Slices& slices) {
    (uses_avx2() ? normals_avx2 : normals_inline)(slices, heights.data(), light, out);
  });
}

}  // namespace relievo
