// Converts a depth image into points. Tested by tests/scan/depth_image_test.cpp.
#include <algorithm>
#include <cmath>

#include "relievo/core/text.h"
#include "relievo/scan/depth_image.h"
#include "scan/depth/depth_grid.h"

namespace relievo {
namespace {

// Returns the mean height difference to the connected neighbours on both sides; 0 if there are none.
float slope_between(float before, float here, float after, bool joins_before, bool joins_after) {
  const float sum = (joins_before ? here - before : 0) + (joins_after ? after - here : 0);
  return joins_before && joins_after ? sum / 2 : sum;
}

Vec3f normal_at(const BoundedGrid& b, const std::vector<float>& z, int c, int r) {
  const std::size_t i = b.at(c, r), w = static_cast<std::size_t>(b.width);
  const bool left = c > 0 && b.joins_right[i - 1], up = r > 0 && b.joins_down[i - w];
  const bool right = b.joins_right[i], down = b.joins_down[i];
  const float dx = slope_between(left ? z[i - 1] : 0, z[i], right ? z[i + 1] : 0, left, right);
  const float dy = slope_between(up ? z[i - w] : 0, z[i], down ? z[i + w] : 0, up, down);
  return Vec3f(-dx, dy, 1).normalized();  // rows go down, y goes up
}

// Changes the width and the height of the cloud's pixels from 1 to those in `shape`.
void scale_pixels(Cloud& cloud, const Vec2& shape) {
  if (shape == Vec2::Ones()) return;
  for (Vec3& p : cloud.points) p.head<2>() = p.head<2>().cwiseProduct(shape);
  for (Vec3f& n : cloud.normals) {
    n.head<2>() = n.head<2>().cwiseQuotient(shape.cast<float>());
    n.normalize();
  }
}

Cloud points_of(const DepthGrid& grid, const std::vector<float>& z) {
  const BoundedGrid& b = grid.bounds;
  Cloud cloud;
  for (int r = 0; r < b.height; ++r)
    for (int c = 0; c < b.width; ++c) {
      const std::size_t i = b.at(c, r);
      if (!b.is_known[i]) continue;
      const double x = c - (b.width - 1) / 2.0, y = (b.height - 1) / 2.0 - r;
      cloud.points.emplace_back(x, y, double{z[i]});
      cloud.normals.push_back(normal_at(b, z, c, r));
    }
  return cloud;
}

// Counts the values that are not depths as `missing`. Numbers among these values that are possible as depths
// are also counted as `marked`; `marker` is the largest of these numbers.
void count_missing(const DepthImage& image, const ValueRange& valid, DepthValues kind, DepthCloud& out) {
  for (const float v : image.values.pixels) {
    if (valid.contains(v)) continue;
    ++out.missing;
    const bool could_be = kind == DepthValues::depth ? v > 0 : kind != DepthValues::inverse || v >= 0;
    if (!std::isfinite(v) || !could_be) continue;
    if (out.marked == 0 || double{v} > out.marker) out.marker = double{v};
    ++out.marked;
  }
}

bool is_background_sought(const DepthOptions& options) {
  if (options.background != Removal::automatic) return options.background == Removal::drop;
  return !options.camera && options.values != DepthValues::height;
}

// Returns the limits of the search for blur; nothing if blur is kept.
std::optional<BlurLimits> blur_limits(const DepthGrid& grid, const DepthOptions& options) {
  // The walls of shallow letters look like narrow blur. So `narrow` requires a height difference of at least a tenth
  // of the range of depths.
  constexpr BlurLimits narrow{3, .1F}, wide{12, 0};
  const bool is_kept = options.blur == Removal::automatic ? grid.is_terrain : options.blur == Removal::keep;
  if (is_kept) return std::nullopt;
  return options.blur == Removal::drop || grid.is_sensor ? wide : narrow;
}

// Stores the reason for which the points of the mask are removed, unless an earlier reason is stored.
void note(const GridMask& is_left_out, PixelUse reason, Image<PixelUse>& uses) {
  for (std::size_t i = 0; i < is_left_out.size(); ++i)
    if (is_left_out[i] && uses[i] == PixelUse::kept) uses[i] = reason;
}

Image<PixelUse> uses_of(const BoundedGrid& grid) {
  Image<PixelUse> uses = filled_image(grid.width, grid.height, PixelUse::kept);
  for (std::size_t i = 0; i < uses.size(); ++i)
    if (!grid.is_known[i]) uses[i] = PixelUse::missing;
  return uses;
}

// Returns the grid without background and blur. Its range of depths is computed from the remaining values.
DepthGrid kept_grid(const GridMaker& maker, const DepthOptions& options, DepthCloud& out) {
  DepthGrid grid = maker.make({});
  out.uses = uses_of(grid.bounds);
  GridMask is_left_out(grid.height.size(), 0);
  if (is_background_sought(options)) is_left_out = find_background(grid, options.background == Removal::drop);
  out.background = static_cast<std::size_t>(std::ranges::count(is_left_out, 1));
  note(is_left_out, PixelUse::background, out.uses);
  if (out.background > 0) grid = maker.make(is_left_out);
  // Removing blur reduces the range of depths, which reveals weaker blur, so the search is repeated.
  const std::optional<BlurLimits> limits = blur_limits(grid, options);
  while (const std::size_t added = limits ? add_blur(grid, *limits, is_left_out) : 0) {
    out.blur += added;
    grid = maker.make(is_left_out);
  }
  for (std::size_t i = 0; i < is_left_out.size(); ++i)
    if (is_left_out[i]) grid.bounds.is_known[i] = 0;
  if (limits && grid.is_sensor) out.blur += drop_teeth(grid.bounds);
  for (std::size_t i = 0; i < out.uses.size(); ++i)
    if (out.uses[i] == PixelUse::kept && !grid.bounds.is_known[i]) out.uses[i] = PixelUse::blur;
  return grid;
}

}  // namespace

Result<DepthCloud> depth_cloud(const DepthImage& image, const DepthOptions& asked, Progress* progress) {
  RELIEVO_CHECK(check(asked));
  DepthOptions options = asked;
  if (options.values == DepthValues::automatic) options.values = DepthValues::depth;
  RELIEVO_CHECK(begin_stage(progress, "depths", 0));
  const GridMaker maker(image, options);
  DepthCloud out;
  count_missing(image, maker.valid(), options.values, out);
  DepthGrid grid = kept_grid(maker, options, out);
  out.reduction = maker.reduction();
  out.noise = grid.noise;
  join(grid);
  const auto known = std::ranges::count(grid.bounds.is_known, 1);
  if (known < 16) return geometry_error(cat("expected at least 16 pixels with a depth, found ", known));
  RELIEVO_CHECK(begin_stage(progress, "smooth depths", 0));
  out.cloud = points_of(grid, smoothest(grid.bounds));
  scale_pixels(out.cloud, image.pixel_shape());
  out.cloud.is_height_field = true;
  out.cloud.units_per_value = grid.units_per_value;
  return out;
}

Result<void> check(const DepthOptions& options) {
  if (!(options.range >= .01 && options.range <= 10))
    return option_error("depth-range", cat("expected a number from 0.01 to 10, found ", options.range));
  if (options.channel < 0 || options.channel > 64)
    return option_error("channel", cat("expected a number from 0 to 64, found ", options.channel));
  if (!(options.points >= 1000 && options.points <= 1e7))
    return option_error("points", cat("expected a number from 1000 to 1e+07, found ", options.points));
  return {};
}

}  // namespace relievo
