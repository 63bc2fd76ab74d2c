// Converts a picture into points for a lithophane.
#include <algorithm>
#include <cmath>
#include <limits>

#include "relievo/core/text.h"
#include "relievo/scan/depth_image.h"

namespace relievo {
namespace {

// Returns the image reduced to about `points` pixels by averaging square blocks. Missing values are ignored;
// blocks without any value are NaN.
Image<float> reduced(const Image<float>& values, double points) {
  const double pixels = static_cast<double>(values.width) * values.height;
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(pixels / points))));
  if (side == 1) return values;
  Image<float> means = filled_image(values.width / side, values.height / side, 0.F);
  for (int r = 0; r < means.height; ++r)
    for (int c = 0; c < means.width; ++c) {
      double sum = 0, n = 0;
      for (int y = r * side; y < (r + 1) * side; ++y)
        for (int x = c * side; x < (c + 1) * side; ++x)
          if (const float v = values.at(x, y); std::isfinite(v)) sum += double{v}, n += 1;
      means.at(c, r) = n > 0 ? static_cast<float>(sum / n) : std::numeric_limits<float>::quiet_NaN();
    }
  return means;
}

// Adds points half a pixel outside the outermost pixels, so that the cloud has the full width of the picture. A
// lithophane is dark along its outline; without these points the outermost pixels would be dark.
void add_frame(const Image<float>& values, Cloud& cloud) {
  const double x = values.width / 2.0, y = values.height / 2.0;
  const auto add = [&](double at_x, double at_y) { cloud.points.emplace_back(at_x, at_y, 0); };
  for (int c = 0; c < values.width; ++c) add(c + .5 - x, y), add(c + .5 - x, -y);
  for (int r = 0; r < values.height; ++r) add(-x, r + .5 - y), add(x, r + .5 - y);
  for (const double side : {-x, x}) add(side, -y), add(side, y);
}

}  // namespace

Result<DepthCloud> picture_cloud(const DepthImage& image, const DepthOptions& options) {
  RELIEVO_CHECK(check(options));
  const Image<float> values = reduced(image.values, options.points);
  DepthCloud out;
  out.reduction = image.values.width / std::max(1, values.width);
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const float v : values.pixels)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (!(low < high))
    return geometry_error("expected a picture with bright and dark pixels, found one brightness");
  Cloud& cloud = out.cloud;
  out.uses = filled_image(values.width, values.height, PixelUse::kept);
  for (int r = 0; r < values.height; ++r)
    for (int c = 0; c < values.width; ++c) {
      const float v = values.at(c, r);
      const float share = std::isfinite(v) ? (v - low) / (high - low) : 1;
      if (!std::isfinite(v)) out.uses.at(c, r) = PixelUse::missing;
      const auto grey = static_cast<std::uint8_t>(std::lround(255 * share));
      cloud.points.emplace_back(c + .5 - values.width / 2.0, values.height / 2.0 - r - .5, 0);
      cloud.colours.push_back({grey, grey, grey});
    }
  add_frame(values, cloud);
  cloud.colours.resize(cloud.points.size(), Colour{});
  cloud.normals.assign(cloud.points.size(), Vec3f::UnitZ());
  for (Vec3& p : cloud.points) p.head<2>() = p.head<2>().cwiseProduct(image.pixel_shape());
  cloud.is_height_field = true;
  out.missing = static_cast<std::size_t>(
      std::ranges::count_if(image.values.pixels, [](float v) { return !std::isfinite(v); }));
  return out;
}

}  // namespace relievo
