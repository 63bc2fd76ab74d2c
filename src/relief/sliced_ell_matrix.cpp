#include "relief/sliced_ell_matrix.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "core/simd.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr std::size_t lanes = SlicedEllMatrix::lanes;
constexpr std::size_t window = SlicedEllMatrix::window;
constexpr std::size_t grain = default_grain / lanes;

// x and y of eight points: x0 y0 x1 y1 and so on.
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

RELIEVO_INLINE Pairs pairs(const SlicedEllMatrix::Coefficients& values) {
  // With `auto` instead of this type, GCC would ignore that these vectors need no alignment.
  const Float8* const v = reinterpret_cast<const Float8*>(values.data());
  return {v[0], v[1]};
}

RELIEVO_INLINE Float8 firsts(const Pairs& p) {
  return __builtin_shufflevector(p.low, p.high, 0, 2, 4, 6, 8, 10, 12, 14);
}
RELIEVO_INLINE Float8 seconds(const Pairs& p) {
  return __builtin_shufflevector(p.low, p.high, 1, 3, 5, 7, 9, 11, 13, 15);
}

struct Slice {
  SlicedEllMatrix::Others points;
  std::span<const SlicedEllMatrix::Others> others;
  const SlicedEllMatrix::Coefficients* coefficients;
};

RELIEVO_INLINE void divergence_of(const Slice& slice, const Vec2f* slopes, float* sums) {
  const Pairs own = eight_pairs(slopes, slice.points.data());
  Pairs sum{};
  for (std::size_t l = 0; l < slice.others.size(); ++l) {
    const Pairs other = eight_pairs(slopes, slice.others[l].data()),
                coefficient = pairs(slice.coefficients[l]);
    sum.low += (own.low + other.low) * coefficient.low;
    sum.high += (own.high + other.high) * coefficient.high;
  }
  const Float8 result = firsts(sum) + seconds(sum);
  for (std::size_t lane = 0; lane < lanes; ++lane) sums[slice.points[lane]] = result[lane];
}

RELIEVO_INLINE void normals_of(const Slice& slice, const float* z, Vec3f* normals) {
  Pairs sum{};
  for (std::size_t l = 0; l < slice.others.size(); ++l) {
    const SlicedEllMatrix::Others& at = slice.others[l];
    const Float8 h{z[at[0]], z[at[1]], z[at[2]], z[at[3]], z[at[4]], z[at[5]], z[at[6]], z[at[7]]};
    const Pairs coefficient = pairs(slice.coefficients[l]);
    sum.low += __builtin_shufflevector(h, h, 0, 0, 1, 1, 2, 2, 3, 3) * coefficient.low;
    sum.high += __builtin_shufflevector(h, h, 4, 4, 5, 5, 6, 6, 7, 7) * coefficient.high;
  }
  const Float8 x = firsts(sum), y = seconds(sum), length_sq = x * x + y * y + 1;
  Float8 length;
  for (std::size_t lane = 0; lane < lanes; ++lane) length[lane] = std::sqrt(length_sq[lane]);
  const Float8 nz = 1 / length, nx = x * nz, ny = y * nz;
  for (std::size_t lane = 0; lane < lanes; ++lane)
    normals[slice.points[lane]] = {nx[lane], ny[lane], nz[lane]};
}

struct Slices {
  const SlicedEllMatrix::Pattern& pattern;
  const SlicedEllMatrix::Coefficients* coefficients;
  std::size_t first, end;

  RELIEVO_INLINE Slice operator[](std::size_t s) const {
    Slice slice;
    for (std::size_t lane = 0; lane < lanes; ++lane) slice.points[lane] = pattern.point(s * lanes + lane);
    const Index begin = pattern.begin[s];
    slice.others = {pattern.others.data() + begin, pattern.begin[s + 1] - begin};
    slice.coefficients = coefficients + begin;
    return slice;
  }
};

RELIEVO_INLINE void divergence_of(const Slices& slices, const Vec2f* slopes, float* sums) {
  for (std::size_t s = slices.first; s < slices.end; ++s) divergence_of(slices[s], slopes, sums);
}

RELIEVO_INLINE void normals_of(const Slices& slices, const float* heights, Vec3f* normals) {
  for (std::size_t s = slices.first; s < slices.end; ++s) normals_of(slices[s], heights, normals);
}

using Rows = Groups<MatrixEntry>;

SlicedEllMatrix::Pattern pattern_of(const Rows& rows) {
  SlicedEllMatrix::Pattern pattern;
  pattern.size = rows.size();
  pattern.points.resize((pattern.size + lanes - 1) / lanes * lanes);
  for (std::size_t first = 0; first < pattern.size; first += window) {
    std::vector<std::uint8_t> order(std::min(window, pattern.size - first));
    std::iota(order.begin(), order.end(), std::uint8_t{0});
    const auto count = [&](std::uint8_t i) { return rows[static_cast<Index>(first + i)].size(); };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint8_t a, std::uint8_t b) { return count(a) > count(b); });
    std::copy(order.begin(), order.end(), pattern.points.begin() + static_cast<std::ptrdiff_t>(first));
  }
  if (pattern.size % lanes > 0)
    std::fill(pattern.points.begin() + static_cast<std::ptrdiff_t>(pattern.size), pattern.points.end(),
              pattern.points[pattern.size - 1]);
  for (std::size_t first = 0; first < pattern.points.size(); first += lanes) {
    pattern.begin.push_back(static_cast<Index>(pattern.others.size()));
    const std::size_t most = rows[pattern.point(first)].size();
    for (std::size_t l = 0; l < most; ++l) {
      SlicedEllMatrix::Others& others = pattern.others.emplace_back();
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Index i = pattern.point(first + lane);
        others[lane] = l < rows[i].size() ? rows[i][l].other : i;
      }
    }
  }
  pattern.begin.push_back(static_cast<Index>(pattern.others.size()));
  pattern.others.shrink_to_fit();
  return pattern;
}

// Writes the coefficients of one row into its lane. Returns false if an entry has no slot in the pattern.
bool enter(std::span<const MatrixEntry> entries, std::span<const SlicedEllMatrix::Others> others,
           std::size_t lane, SlicedEllMatrix::Coefficients* coefficients) {
  std::size_t l = 0;
  for (const MatrixEntry& entry : entries) {
    while (l < others.size() && others[l][lane] != entry.other) ++l;
    if (l == others.size()) return false;
    coefficients[l][2 * lane] = entry.coefficient.x();
    coefficients[l][2 * lane + 1] = entry.coefficient.y();
    ++l;
  }
  return true;
}

// Returns the coefficients in the order of the pattern's slots, or an empty list if the pattern lacks an
// entry.
std::vector<SlicedEllMatrix::Coefficients> coefficients_in(const SlicedEllMatrix::Pattern& pattern,
                                                           const Rows& rows) {
  std::vector<SlicedEllMatrix::Coefficients> coefficients(pattern.others.size());
  std::atomic<bool> is_complete = true;
  parallel_for(
      pattern.begin.size() - 1,
      [&](std::size_t slice) {
        const Index begin = pattern.begin[slice];
        const auto others = std::span(pattern.others).subspan(begin, pattern.begin[slice + 1] - begin);
        for (std::size_t lane = 0; lane < lanes; ++lane)
          if (!enter(rows[pattern.point(slice * lanes + lane)], others, lane, coefficients.data() + begin))
            is_complete = false;
      },
      grain);
  if (!is_complete) coefficients.clear();
  return coefficients;
}

}  // namespace

SlicedEllMatrix::SlicedEllMatrix(const Rows& rows)
    : pattern_(std::make_shared<const Pattern>(pattern_of(rows))),
      coefficients_(coefficients_in(*pattern_, rows)) {}

SlicedEllMatrix::SlicedEllMatrix(const Rows& rows, const SlicedEllMatrix& like)
    : pattern_(like.pattern_), coefficients_(coefficients_in(*pattern_, rows)), owns_pattern_(false) {
  if (coefficients_.empty() && !rows.items.empty()) *this = SlicedEllMatrix(rows);
}

std::size_t SlicedEllMatrix::memory() const {
  const std::size_t pattern = pattern_->points.size() + pattern_->begin.size() * sizeof(Index) +
                              pattern_->others.size() * sizeof(Others);
  return coefficients_.size() * sizeof(Coefficients) + (owns_pattern_ ? pattern : 0);
}

template <typename F>
void SlicedEllMatrix::for_runs(F&& f) const {
  parallel_ranges(pattern_->begin.size() - 1, grain, [&](std::size_t first, std::size_t end) {
    f(Slices{*pattern_, coefficients_.data(), first, end});
  });
}

void SlicedEllMatrix::divergence(std::span<const Vec2f> slopes, std::span<float> sums) const {
  for_runs([&](const Slices& slices) { RELIEVO_WIDE(divergence_of(slices, slopes.data(), sums.data())); });
}

void SlicedEllMatrix::divergence(std::span<const Vec2> slopes, std::span<double> sums) const {
  for_runs([&](const Slices& slices) {
    for (std::size_t s = slices.first; s < slices.end; ++s) {
      const Slice slice = slices[s];
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Index i = slice.points[lane];
        Vec2 sum = Vec2::Zero();
        for (std::size_t l = 0; l < slice.others.size(); ++l) {
          const Vec2 coefficient(static_cast<double>(slice.coefficients[l][2 * lane]),
                                 static_cast<double>(slice.coefficients[l][2 * lane + 1]));
          sum += (slopes[i] + slopes[slice.others[l][lane]]).cwiseProduct(coefficient);
        }
        sums[i] = sum.sum();
      }
    }
  });
}

void SlicedEllMatrix::normals(std::span<const float> heights, std::span<Vec3f> normals) const {
  for_runs([&](const Slices& slices) { RELIEVO_WIDE(normals_of(slices, heights.data(), normals.data())); });
}

}  // namespace relievo
