#include "relievo/plate/base.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/angle.h"
#include "plate/shape_text.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

using Weights = std::array<double, 4>;

// Returns the weights of four consecutive values in a cubic B-spline, for a position between the second
// value (t = 0) and the third (t = 1).
Weights weights_at(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6,
          t * t * t / 6};
}

constexpr double steepest = 5.671;  // tan 80 degrees; a relief on a steeper base would face sideways
constexpr double least_mm = 1e-3, most_mm = 1e6;
constexpr double default_angle_deg = 15;

// Checks that each number is in its range, and that no two numbers contradict each other.
Result<void> check_numbers(const BaseOptions& options) {
  for (const auto& [name, mm] : {std::pair{"height", options.height_mm},
                                 {"diameter", options.diameter_mm},
                                 {"length", options.length_mm}})
    if (mm && !(*mm >= least_mm && *mm <= most_mm))
      return option_error("base",
                          cat("expected a ", name, " of ", least_mm, " to ", most_mm, " mm, found ", *mm));
  if (options.angle_deg && !(*options.angle_deg > 0 && *options.angle_deg <= 80))
    return option_error("base", cat("expected an angle of 0 to 80 degrees, found ", *options.angle_deg));
  if (!std::isfinite(options.direction_deg))
    return option_error("base", cat("expected a direction in degrees, found ", options.direction_deg));
  if (options.height_mm && (options.angle_deg || options.diameter_mm))
    return option_error("base", cat("expected either a height or ",
                                    options.angle_deg ? "an angle" : "a diameter", ", found both"));
  return {};
}

// Returns the unit vector perpendicular to the base's straight lines. It is exact for 90 and 180 degrees.
Vec2 across(double direction_deg) {
  const double turn = std::remainder(direction_deg - 90, 360);
  if (turn == 0) return Vec2::UnitX();
  if (turn == 90) return Vec2::UnitY();
  return {std::cos(to_radians(turn)), std::sin(to_radians(turn))};
}

std::vector<ShapeNumber> numbers_of(BaseOptions& base, std::optional<double>& direction) {
  const ShapeNumber height{"height", &base.height_mm}, along{"direction", &direction, ShapeUnit::degrees};
  switch (base.kind) {
    case BaseKind::plane:
      return {};
    case BaseKind::fold:
      return {height, {"angle", &base.angle_deg, ShapeUnit::degrees}, along};
    case BaseKind::wave:
      return {height, {"length", &base.length_mm}, along};
    case BaseKind::cylinder:
      return {height, {"diameter", &base.diameter_mm}, along};
    case BaseKind::dome:
      return {height, {"diameter", &base.diameter_mm}};
    case BaseKind::image:
      return {height};
  }
  return {};
}

}  // namespace

// A cubic B-spline surface whose control points are the map's values. It is smooth, so it hides the steps
// between rounded values. It stays within the range of neighbouring values. Beyond the border the outermost
// values are repeated.
class Base::ImageSurface {
 public:
  // Centres the map on a plate of the given size and scales it until it covers the plate. Scales the values
  // so that the difference between the lowest and the highest is `height_mm`.
  ImageSurface(std::shared_ptr<const Image<float>> grid, const Vec2& plate_mm, double height_mm)
      : grid_(std::move(grid)) {
    pixel_mm_ = std::max(plate_mm.x() / grid_->width, plate_mm.y() / grid_->height);
    const auto [lowest, highest] = std::ranges::minmax(grid_->pixels);
    const double span = static_cast<double>(highest) - static_cast<double>(lowest);
    mm_per_value_ = span > 0 ? height_mm / span : 0;
    middle_ = value(Vec2::Zero());
  }

  double pixel_mm() const { return pixel_mm_; }
  double height(const Vec2& from_middle) const { return mm_per_value_ * (value(from_middle) - middle_); }

 private:
  // Returns the spline at a position, in the map's unit.
  double value(const Vec2& from_middle) const {
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

  std::shared_ptr<const Image<float>> grid_;
  double pixel_mm_ = 1, mm_per_value_ = 0;
  double middle_ = 0;  // the value at the plate's middle
};

Result<Base> Base::over(const BaseOptions& options, std::span<const Vec2> outline) {
  RELIEVO_CHECK(check_numbers(options));
  const Box box = Box::of(outline);
  Base base;
  if (options.kind == BaseKind::plane || box.is_empty()) return base;
  base.kind_ = options.kind;
  base.middle_ = box.centre().head<2>();
  base.across_ = across(options.direction_deg);
  base.sign_ = options.is_hollow ? -1 : 1;
  base.mirror_ = options.is_mirrored ? -1 : 1;
  // Half the plate's size across the straight lines of the base, such as those of a cylinder. For a dome, the largest
  // distance of the outline from the middle.
  double half_extent = 0;
  for (const Vec2& p : outline) {
    const Vec2 from_middle = base.from_middle(p);
    half_extent =
        std::max(half_extent, options.kind == BaseKind::dome ? from_middle.norm()
                                                             : std::abs(base.across_.dot(from_middle)));
  }
  Result<void> good;
  switch (options.kind) {
    case BaseKind::plane:
      break;
    case BaseKind::fold:
      good = base.shape_fold(options, half_extent);
      break;
    case BaseKind::wave:
      good = base.shape_wave(options, half_extent);
      break;
    case BaseKind::cylinder:
    case BaseKind::dome:
      good = base.shape_round(options, half_extent);
      break;
    case BaseKind::image:
      good = base.lay_image(options, box.size().head<2>());
      break;
  }
  if (!good) return std::unexpected(good.error());
  return base;
}

Result<void> Base::shape_fold(const BaseOptions& options, double half_extent) {
  size_ = options.height_mm ? *options.height_mm / half_extent
                            : std::tan(to_radians(options.angle_deg.value_or(default_angle_deg)));
  if (size_ > 1.001 * steepest)
    return option_error("base", cat("expected a height of at most ", steepest * half_extent,
                                    " mm on this plate, 80 degrees, found ", *options.height_mm));
  return {};
}

Result<void> Base::shape_wave(const BaseOptions& options, double half_extent) {
  const double length = options.length_mm   ? *options.length_mm
                        : options.height_mm ? std::max(half_extent, 4 * *options.height_mm)
                                            : half_extent;
  size_ = options.height_mm.value_or(length / 8) / 2;
  wave_number_ = 2 * std::numbers::pi / length;
  min_feature_mm_ = length / 4;
  if (size_ * wave_number_ > steepest)
    return option_error("base", cat("expected a length of at least ", 2 * std::numbers::pi * size_ / steepest,
                                    " mm at a height of ", 2 * size_, " mm, 80 degrees, found ", length));
  return {};
}

Result<void> Base::shape_round(const BaseOptions& options, double half_extent) {
  const bool is_dome = kind_ == BaseKind::dome;
  const double height = options.height_mm.value_or(.15 * half_extent),
               of_height = (half_extent * half_extent / height + height) / 2;
  if (options.diameter_mm)
    size_ = *options.diameter_mm / 2;
  else
    size_ = is_dome || options.height_mm ? of_height : 2 * half_extent;
  const double smallest = half_extent * std::sqrt(1 + 1 / (steepest * steepest));
  if (options.diameter_mm && size_ < smallest)
    return option_error("base", cat("expected a diameter of at least ", 2 * smallest,
                                    " mm on this plate, found ", *options.diameter_mm));
  const double highest = smallest - std::sqrt(smallest * smallest - half_extent * half_extent);
  if (options.height_mm && height > highest)
    return option_error("base",
                        cat("expected a height of at most ", highest, " mm on this plate, found ", height));
  return {};
}

Result<void> Base::lay_image(const BaseOptions& options, const Vec2& size) {
  const auto wrong = [](const char* found) {
    return option_error("base",
                        cat("expected a height image of at least 2 x 2 finite values, found ", found));
  };
  if (!options.image) return wrong("none");
  const Image<float>& image = *options.image;
  if (image.width < 2 || image.height < 2 || image.size() != image.index(0, image.height))
    return wrong("a smaller one");
  if (!std::ranges::all_of(image.pixels, [](float z) { return std::isfinite(z); }))
    return wrong("others: fill its holes");
  image_ = std::make_shared<const ImageSurface>(
      options.image, size, options.height_mm.value_or(.1 * std::max(size.x(), size.y())));
  min_feature_mm_ = image_->pixel_mm();
  return {};
}

Vec2 Base::from_middle(const Vec2& place) const {
  const Vec2 p = place - middle_;
  return {mirror_ * p.x(), p.y()};
}

double Base::profile(const Vec2& p) const {
  const double t = across_.dot(p);
  // The square root has a negative argument only outside the plate.
  const auto cap = [&](double square) { return std::sqrt(std::max(0.0, size_ * size_ - square)) - size_; };
  switch (kind_) {
    case BaseKind::plane:
      return 0;
    case BaseKind::fold:
      return -size_ * std::abs(t);
    case BaseKind::wave:
      return size_ * (std::cos(wave_number_ * t) - 1);
    case BaseKind::cylinder:
      return cap(t * t);
    case BaseKind::dome:
      return cap(p.squaredNorm());
    case BaseKind::image:
      return image_->height(p);
  }
  return 0;
}

double Base::height(const Vec2& place) const {
  return sign_ * profile(from_middle(place));
}

std::optional<double> Base::ridge_between(const Vec2& a, const Vec2& b) const {
  if (kind_ != BaseKind::fold) return std::nullopt;
  const double s = across_.dot(from_middle(a)), t = across_.dot(from_middle(b));
  const bool is_crossed = (s < 0 && t > 0) || (s > 0 && t < 0);
  if (!is_crossed) return std::nullopt;
  return s / (s - t);
}

Result<BaseOptions> parse_base(std::string_view text) {
  RELIEVO_TRY(const BaseKind kind, parse_choice("base", shape_kind(text), base_choices));
  BaseOptions base;
  base.kind = kind;
  std::optional<double> direction;
  std::vector<ShapeWord> words;
  if (base.kind != BaseKind::plane) words.push_back({"hollow", &base.is_hollow});
  RELIEVO_CHECK(read_shape(text, "base", numbers_of(base, direction), words));
  base.direction_deg = direction.value_or(base.direction_deg);
  return base;
}

}  // namespace relievo
