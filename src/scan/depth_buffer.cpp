#include "scan/depth_buffer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr double least_normal_z = 0.05;  // a slope of 20; steeper discs are drawn with this slope
constexpr long band_rows = 64;           // rows of pixels that one task draws

// Returns half the width of the disc's projection (axis 0), or half its height (axis 1).
double half_extent(const Disc& disc, int axis) {
  const double n = static_cast<double>(disc.normal[axis]);
  return disc.radius * std::sqrt(std::max(0.0, 1 - n * n));
}

}  // namespace

double depth_along_plane(const Vec3f& normal, double dx, double dy) {
  const double nz = std::max(std::abs(static_cast<double>(normal.z())), least_normal_z);
  const double sign = normal.z() < 0 ? -1 : 1;
  return -sign * (static_cast<double>(normal.x()) * dx + static_cast<double>(normal.y()) * dy) / nz;
}

DepthBuffer::DepthBuffer(const Box& box, double pixel) : origin_(box.min.head<2>()) {
  const Vec3 size = box.size();
  pixel_ =
      std::max({pixel, std::sqrt(size.x() * size.y() / most_pixels), (size.x() + size.y()) / most_pixels});
  columns_ = 1 + static_cast<long>(size.x() / pixel_);
  rows_ = 1 + static_cast<long>(size.y() / pixel_);
  squares_ = columns_ / square_side + 1;
  depth_.assign(static_cast<std::size_t>(columns_ * rows_), -std::numeric_limits<float>::infinity());
}

long DepthBuffer::column(double x) const {
  return static_cast<long>(std::floor((x - origin_.x()) / pixel_));
}
long DepthBuffer::row(double y) const {
  return static_cast<long>(std::floor((y - origin_.y()) / pixel_));
}

Vec2 DepthBuffer::pixel_centre(double x, double y) const {
  return origin_ + pixel_ * Vec2(static_cast<double>(column(x)) + .5, static_cast<double>(row(y)) + .5);
}

float DepthBuffer::depth(double x, double y) const {
  const long c = column(x), r = row(y);
  const bool is_inside = c >= 0 && c < columns_ && r >= 0 && r < rows_;
  return is_inside ? depth_[static_cast<std::size_t>(r * columns_ + c)]
                   : -std::numeric_limits<float>::infinity();
}

// Bands of rows are drawn concurrently. Each band draws the discs that touch it, in their order.
void DepthBuffer::splat(const std::vector<Disc>& discs) {
  const auto bands = static_cast<std::size_t>((rows_ + band_rows - 1) / band_rows);
  const auto band_of = [&](double y) { return std::clamp(row(y), 0L, rows_ - 1) / band_rows; };
  std::vector<std::vector<Index>> members(bands);
  for (Index i = 0; i < discs.size(); ++i) {
    const double y = discs[i].centre.y(), half = half_extent(discs[i], 1);
    for (long b = band_of(y - half); b <= band_of(y + half); ++b)
      members[static_cast<std::size_t>(b)].push_back(i);
  }
  parallel_for(
      bands,
      [&](std::size_t b) {
        const long first = static_cast<long>(b) * band_rows;
        for (const Index i : members[b])
          splat_into_rows(discs[i], first, std::min(first + band_rows, rows_) - 1);
      },
      1);
}

// Returns the pixels in the box of a disc.
DepthBuffer::Pixels DepthBuffer::pixels_of(const Disc& disc) const {
  const double half_x = half_extent(disc, 0), half_y = half_extent(disc, 1);
  return {std::max(0L, column(disc.centre.x() - half_x)),
          std::min(columns_ - 1, column(disc.centre.x() + half_x)),
          std::max(0L, row(disc.centre.y() - half_y)), std::min(rows_ - 1, row(disc.centre.y() + half_y))};
}

void DepthBuffer::take_away(const std::vector<Disc>& gone, const std::vector<Disc>& rest) {
  is_redrawn_.assign(static_cast<std::size_t>((rows_ / square_side + 1) * squares_), 0);
  const auto any_square = [&](const Disc& disc, auto&& is_one) {
    const auto [c0, c1, r0, r1] = pixels_of(disc);
    for (long r = r0 / square_side; r <= r1 / square_side; ++r)
      for (long c = c0 / square_side; c <= c1 / square_side; ++c)
        if (is_one(is_redrawn_[static_cast<std::size_t>(r * squares_ + c)])) return true;
    return false;
  };
  for (const Disc& disc : gone) any_square(disc, [](std::uint8_t& mark) { return mark = 1, false; });
  for (long r = 0; r < rows_; ++r)
    for (long c = 0; c < columns_; ++c)
      if (is_redrawn_[square(c, r)])
        depth_[static_cast<std::size_t>(r * columns_ + c)] = -std::numeric_limits<float>::infinity();
  std::vector<Disc> again;
  for (const Disc& disc : rest)
    if (any_square(disc, [](std::uint8_t mark) { return mark != 0; })) again.push_back(disc);
  splat(again);
}

void DepthBuffer::splat_into_rows(const Disc& disc, long first_row, long last_row) {
  const double radius_sq = disc.radius * disc.radius;
  const auto [c0, c1, top, bottom] = pixels_of(disc);
  const long r0 = std::max(first_row, top), r1 = std::min(last_row, bottom);
  const double slope_x = depth_along_plane(disc.normal, 1, 0), slope_y = depth_along_plane(disc.normal, 0, 1);
  for (long r = r0; r <= r1; ++r) {
    const double dy = origin_.y() + pixel_ * (static_cast<double>(r) + .5) - disc.centre.y();
    float* const line = depth_.data() + r * columns_;
    for (long c = c0; c <= c1; ++c) {
      const double dx = origin_.x() + pixel_ * (static_cast<double>(c) + .5) - disc.centre.x();
      const double dz = slope_x * dx + slope_y * dy;
      if (dx * dx + dy * dy + dz * dz > radius_sq) continue;
      line[c] = std::max(line[c], static_cast<float>(disc.centre.z() + dz));
    }
  }
}

}  // namespace relievo
