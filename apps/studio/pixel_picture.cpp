#include "studio/pixel_picture.h"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "relievo/core/text.h"

namespace relievo::app::studio {
namespace {

struct UseInfo {
  PixelUse use;
  std::string_view name;
  Colour colour;
};

// People with any kind of colour blindness can distinguish these colours from each other and from greys.
constexpr std::array<UseInfo, 3> left_out{{{PixelUse::missing, "missing", {136, 34, 85}},
                                           {PixelUse::background, "background", {51, 122, 183}},
                                           {PixelUse::blur, "blur", {230, 150, 0}}}};

Colour colour_of(PixelUse use) {
  return std::ranges::find(left_out, use, &UseInfo::use)->colour;
}

// Maps depths of points to greys: the nearest point is white, and the farthest point is dark.
class GreyOfDepth {
 public:
  explicit GreyOfDepth(const Cloud& cloud) : cloud_(cloud) {
    for (const Vec3& p : cloud.points) low_ = std::min(low_, p.z()), high_ = std::max(high_, p.z());
  }

  Colour operator()(std::size_t point) const {
    constexpr double dark = 60, white = 255;
    const double share = high_ > low_ ? (cloud_.points[point].z() - low_) / (high_ - low_) : 1;
    const auto grey = static_cast<std::uint8_t>(dark + share * (white - dark));
    return {grey, grey, grey};
  }

 private:
  const Cloud& cloud_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

std::string in_hexadecimal(const Colour& colour) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t part : colour) text += {digits[part / 16], digits[part % 16]};
  return text;
}

}  // namespace

Picture picture_of_uses(const SceneModel& image) {
  const Image<PixelUse>& uses = image.pixels->uses;
  const Cloud& cloud = image.file->cloud;
  const GreyOfDepth grey(cloud);
  const bool is_photo = cloud.has_colours();  // a photo has a point for every pixel, even for missing ones
  Picture picture;
  picture.image.resize(uses.width, uses.height, 4);
  std::size_t point = 0;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const bool is_kept = uses[i] == PixelUse::kept;
    const Colour colour = !is_kept ? colour_of(uses[i]) : is_photo ? cloud.colours[i] : grey(point);
    point += is_kept;
    std::ranges::copy(colour, &picture.image[4 * i]);
    picture.image[4 * i + 3] = 255;
  }
  return picture;
}

nlohmann::json uses_json(const SceneModel& image) {
  const PixelUses& pixels = *image.pixels;
  const std::size_t block =
      static_cast<std::size_t>(pixels.reduction) * static_cast<std::size_t>(pixels.reduction);
  nlohmann::json uses = nlohmann::json::array();
  for (const UseInfo& info : left_out)
    uses.push_back(
        {{"use", info.name},
         {"colour", in_hexadecimal(info.colour)},
         {"pixels", block * static_cast<std::size_t>(std::ranges::count(pixels.uses.pixels, info.use))}});
  return {
      {"values", name_in(depth_value_choices, pixels.values)},
      {"is_surface", !image.file->cloud.has_colours()},
      {"is_scaled", image.file->cloud.units_per_value.value_or(0) != 0},
      {"aspect", pixels.uses.width * pixels.pixel_shape.x() / (pixels.uses.height * pixels.pixel_shape.y())},
      {"pixels", block * pixels.uses.size()},
      {"uses", std::move(uses)}};
}

}  // namespace relievo::app::studio
