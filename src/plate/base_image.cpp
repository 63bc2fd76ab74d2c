#include "plate/base_image.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo {
namespace {

using Weights = std::array<double, 4>;

// Returns the cubic B-spline's weights of four values in a row, at the fraction `t` of the way from the
// second to the third.
Weights weights_at(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6,
          t * t * t / 6};
}

}  // namespace

Base::ImageSurface::ImageSurface(std::shared_ptr<const Image<float>> grid, const Vec2& plate_mm,
                                 double height_mm)
    : grid_(std::move(grid)) {
  pixel_mm_ = std::max(plate_mm.x() / grid_->width, plate_mm.y() / grid_->height);
  const auto [lowest, highest] = std::ranges::minmax(grid_->pixels);
  const double span = static_cast<double>(highest) - static_cast<double>(lowest);
  mm_per_value_ = span > 0 ? height_mm / span : 0;
  middle_ = value(Vec2::Zero());
}

double Base::ImageSurface::value(const Vec2& from_middle) const {
  const double x = from_middle.x() / pixel_mm_ + (grid_->width - 1) / 2.0,
               y = (grid_->height - 1) / 2.0 - from_middle.y() / pixel_mm_;
  const int column = static_cast<int>(std::floor(std::clamp(x, -2.0, grid_->width + 2.0))),
            row = static_cast<int>(std::floor(std::clamp(y, -2.0, grid_->height + 2.0)));
  const Weights across = weights_at(std::clamp(x - column, 0.0, 1.0)),
                down = weights_at(std::clamp(y - row, 0.0, 1.0));
  double total = 0;
  for (int j = 0; j < 4; ++j) {
    const int r = std::clamp(row + j - 1, 0, grid_->height - 1);
    double line = 0;
    for (int i = 0; i < 4; ++i) {
      const int c = std::clamp(column + i - 1, 0, grid_->width - 1);
      line += across[i] * static_cast<double>(grid_->at(c, r));
    }
    total += down[j] * line;
  }
  return total;
}

double Base::ImageSurface::height(const Vec2& from_middle) const {
  return mm_per_value_ * (value(from_middle) - middle_);
}

}  // namespace relievo
