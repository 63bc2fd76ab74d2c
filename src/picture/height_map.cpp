#include <algorithm>
#include <cmath>
#include <vector>

#include "plate/height_field.h"
#include "relievo/core/parallel.h"
#include "relievo/core/types.h"
#include "relievo/picture/height_map.h"

namespace relievo {
namespace {

constexpr float background = 236, darkest = 40, brightest = 225;
const Vec3f mild(255, 170, 60), strong(200, 20, 20);  // colours of small and of large residuals

// The average of the samples within a pixel.
struct Averaged {
  Vec3f colour = Vec3f::Zero();
  int samples = 0;
};

// Returns the brightness of a surface that is lit from the upper left. `right` and `down` are its
// slopes in these directions.
float grey(float right, float down) {
  const Vec3f lamp = Vec3f(-1, 1, 1.2F).normalized();
  const float facing = Vec3f(-right, down, 1).normalized().dot(lamp);
  return darkest + (brightest - darkest) * std::clamp(.15F + .85F * facing, 0.F, 1.F);
}

class ReachPainter {
 public:
  explicit ReachPainter(const ToolReach& reach) : reach_(reach) {}

  Vec3f colour(int x, int y) const {
    const float z = height(x, y);
    if (z != z) return Vec3f::Constant(background);
    const auto step = static_cast<float>(2 * reach_.mm_per_sample);
    const auto slope = [&](float a, float b) { return a == a && b == b ? (b - a) / step : 0; };
    const float light =
        grey(slope(height(x - 1, y), height(x + 1, y)), slope(height(x, y - 1), height(x, y + 1)));
    const float left = reach_.residual_mm.at(x, y);
    if (static_cast<double>(left) <= reach_.tolerance_mm) return Vec3f::Constant(light);
    const float share = left / static_cast<float>(reach_.largest_residual_mm);
    return (.35F + .65F * light / brightest) * (mild + std::sqrt(share) * (strong - mild));
  }

 private:
  float height(int x, int y) const {
    const Image<float>& heights = reach_.heights_mm;
    return heights.at(std::clamp(x, 0, heights.width - 1), std::clamp(y, 0, heights.height - 1));
  }

  const ToolReach& reach_;
};

}  // namespace

Image8 render_reach(const ToolReach& reach, int longer_side_px) {
  const int width = reach.heights_mm.width, height = reach.heights_mm.height;
  if (width < 1 || height < 1 || longer_side_px < 1) return {};
  const int side = std::max(1, (std::max(width, height) + longer_side_px - 1) / longer_side_px);
  Image8 image = filled_image((width + side - 1) / side, (height + side - 1) / side, std::uint8_t{0}, 3);
  const ReachPainter painter(reach);
  parallel_for(
      static_cast<std::size_t>(image.height),
      [&](std::size_t row) {
        std::uint8_t* pixel = &image.at(0, static_cast<int>(row));
        for (int column = 0; column < image.width; ++column) {
          Averaged sum;
          const int top = static_cast<int>(row) * side, left = column * side;
          for (int y = top; y < std::min(top + side, height); ++y)
            for (int x = left; x < std::min(left + side, width); ++x, ++sum.samples)
              sum.colour += painter.colour(x, y);
          for (const float value : sum.colour)
            *pixel++ =
                static_cast<std::uint8_t>(std::clamp(value / static_cast<float>(sum.samples), 0.F, 255.F));
        }
      },
      8);
  return image;
}

HeightsMm make_heights_mm(const Solid& solid, const HeightMapOptions& options) {
  const bool is_relief_alone = options.area == MapArea::relief;
  HeightField field =
      measure_height_field(solid, {options.longer_side_px, options.mm_per_pixel, is_relief_alone});
  const double zero = options.zero == MapZero::ground ? solid.ground_mm - field.box.min.z() : 0;
  const double span_mm = std::max(0., field.box.size().z() - zero);
  for (float& z : field.z.pixels) {
    z -= static_cast<float>(zero);
    if (options.is_inverted) z = static_cast<float>(span_mm) - z;
  }
  return {std::move(field.z), field.mm_per_pixel, options, span_mm, {}};
}

HeightMap grey_levels(const HeightsMm& heights, int bits) {
  const double white = (1 << bits) - 1, span_mm = heights.span_mm;
  HeightMap map{{}, heights.mm_per_pixel, span_mm / white, bits};
  map.image.resize(heights.image.width, heights.image.height);
  const double greys_per_mm = span_mm > 0 ? white / span_mm : 0;
  const auto grey = [&](float z) {
    return static_cast<std::uint16_t>(std::clamp(z * greys_per_mm + .5, 0., white));
  };
  std::ranges::transform(heights.image.pixels, map.image.pixels.begin(), grey);
  return map;
}

Image8 in_8_bits(const HeightMap& map) {
  Image8 image{map.image.width, map.image.height, 1, {}};
  image.pixels.assign(map.image.pixels.begin(), map.image.pixels.end());
  return image;
}

int count_greys(const HeightMap& map) {
  std::vector<bool> is_used(std::size_t{1} << map.bits);
  for (const std::uint16_t grey : map.image.pixels) is_used[grey] = true;
  return static_cast<int>(std::ranges::count(is_used, true));
}

}  // namespace relievo
