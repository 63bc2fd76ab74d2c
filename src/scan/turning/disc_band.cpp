#include "scan/turning/disc_band.h"

#include <algorithm>
#include <cmath>

#include "core/simd.h"
#include "scan/scan_limits.h"

namespace relievo {
namespace {

constexpr int lanes = 8;
// Radius, in spacings, of the discs by which normals are averaged. Discs of 1.5 leave a thousandth of the
// places between scattered points uncovered.
constexpr float mean_radius = 1.5F;
constexpr float least_mean_radius = .8F;  // in cells
constexpr float depth_tolerance{ScanLimits::depth_tolerance};
constexpr auto least_facing = static_cast<float>(ScanLimits::least_facing);

// For eight cells of one row: the squared distance of their centres from a disc's centre in the plane, and
// how much higher the disc's plane lies there.
struct Steps {
  Float8 distance_sq, rise;
};

RELIEVO_INLINE Steps steps_from(const FrontDisc& disc, int x, float dy) {
  constexpr Float8 lane{0, 1, 2, 3, 4, 5, 6, 7};
  const Float8 dx = static_cast<float>(x) + lane + .5F - disc.place.x();
  return {dx * dx + dy * dy, disc.slope.x() * dx + disc.slope.y() * dy};
}

// Calls f(x, row, dy) for runs of eight cells of a band, until they contain all cells with centres within the
// radius of the disc's centre in the plane. `dy` is the row's distance from that centre.
template <typename F>
RELIEVO_INLINE void each_run(const DiscBand& band, const FrontDisc& disc, float radius, F&& f) {
  const float y = disc.place.y() - static_cast<float>(band.first_row());
  const int first = std::max(0, static_cast<int>(std::ceil(y - radius - .5F))),
            last = std::min(band.rows(), static_cast<int>(std::floor(y + radius - .5F)) + 1);
  const int left = std::max(0, static_cast<int>(std::ceil(disc.place.x() - radius - .5F))),
            right = std::min(band.columns(), static_cast<int>(std::floor(disc.place.x() + radius - .5F)) + 1);
  for (int row = first; row < last; ++row) {
    const float dy = static_cast<float>(band.first_row() + row) + .5F - disc.place.y();
    for (int x = left; x < right; x += lanes) f(x, row, dy);
  }
}

// Raises the cell in which the disc's centre lies: small discs cover the centre of no cell.
RELIEVO_INLINE void raise_own_cell(DiscBand& band, const FrontDisc& disc) {
  const int x = static_cast<int>(disc.place.x()), y = static_cast<int>(disc.place.y());
  if (y < band.first_row() || y >= band.first_row() + band.rows()) return;
  const float rise =
      disc.slope.dot(Vec2f(static_cast<float>(x) + .5F, static_cast<float>(y) + .5F) - disc.place.head<2>());
  float& depth = band.depths(y - band.first_row())[x];
  depth = std::max(depth, disc.place.z() + std::clamp(rise, -1.F, 1.F));
}

RELIEVO_INLINE void draw(DiscBand& band, std::span<const FrontDisc> discs) {
  for (const FrontDisc& disc : discs) {
    const float radius = FrontDisc::hiding_radius * disc.spacing, radius_sq = radius * radius;
    each_run(band, disc, radius, [&](int x, int row, float dy) {
      const Steps steps = steps_from(disc, x, dy);
      Float8& depth = *reinterpret_cast<Float8*>(band.depths(row) + x);
      const Float8 raised = disc.place.z() + steps.rise;
      const auto is_higher = (steps.distance_sq + steps.rise * steps.rise <= radius_sq) & (raised > depth);
      depth = is_higher ? raised : depth;
    });
    raise_own_cell(band, disc);
  }
}

RELIEVO_INLINE void add(DiscBand& band, std::span<const FrontDisc> discs) {
  for (const FrontDisc& disc : discs) {
    const float radius = std::max(mean_radius * disc.spacing, least_mean_radius), radius_sq = radius * radius;
    const float tolerance =
        depth_tolerance * std::max(disc.spacing, .5F) / std::max(disc.normal.z(), least_facing);
    each_run(band, disc, radius, [&](int x, int row, float dy) {
      const Steps steps = steps_from(disc, x, dy);
      const Float8 rest = 1 - steps.distance_sq / radius_sq;
      const Float8 depth = *reinterpret_cast<const Float8*>(band.depths(row) + x);
      const auto is_in_front =
          (rest > 0.F) & (depth > FrontCells::no_depth) & (disc.place.z() + steps.rise + tolerance >= depth);
      const Float8 weight = is_in_front ? rest * rest : Float8{};
      for (int axis = 0; axis < 3; ++axis)
        *reinterpret_cast<Float8*>(band.normals(axis, row) + x) += weight * disc.normal[axis];
    });
  }
}

}  // namespace

DiscBand::DiscBand(int columns, int first_row, int rows)
    : columns_(columns), first_row_(first_row), rows_(rows), stride_(columns + lanes) {
  const std::size_t cells = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows);
  depth_.assign(cells, FrontCells::no_depth);
  for (std::vector<float>& axis : normal_) axis.assign(cells, 0.F);
}

void DiscBand::draw_depths(std::span<const FrontDisc> discs) {
  RELIEVO_WIDE(draw(*this, discs));
}

void DiscBand::add_normals(std::span<const FrontDisc> discs) {
  RELIEVO_WIDE(add(*this, discs));
}

void DiscBand::write(FrontCells& cells) const {
  for (int row = 0; row < rows_; ++row)
    for (int x = 0; x < columns_; ++x) {
      const auto i = static_cast<std::size_t>(row * stride_ + x);
      const Vec3f n(normal_[0][i], normal_[1][i], normal_[2][i]);
      const float length = n.norm();
      cells.depth.at(x, first_row_ + row) = depth_[i];
      cells.normal.at(x, first_row_ + row) = length > 0 ? Vec3f(n / length) : Vec3f::Zero();
    }
}

}  // namespace relievo
