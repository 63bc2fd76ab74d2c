#include "relievo/picture/preview.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "picture/draw_body.h"
#include "picture/shading.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

constexpr double preview_padding =
    .06;  // around the plate for its shadow, as a share of the picture's longer side
constexpr int most_pixels = RasterInput::most_pixels / 3 / 2;  // of both pictures, with 3 samples per pixel

// The ground behind the body, linear, from the top to the bottom: bright enough for the plate to stand out,
// and darker below, as a wall that is lit from above.
constexpr float brightest_wall = .90F, darkest_wall = .70F;

// From above right, where the upper left lamp leaves the most to be seen of slopes and of the plate's edge.
constexpr double oblique_yaw_deg = -35, oblique_pitch_deg = 20;

Mat3 oblique_rotation() {
  const double degree = std::numbers::pi / 180;
  return (Eigen::AngleAxisd(oblique_pitch_deg * degree, Vec3::UnitX()) *
          Eigen::AngleAxisd(oblique_yaw_deg * degree, Vec3::UnitY()))
      .matrix();
}

Box rotated_box(const DrawnBody& body, const Mat3& rotation) {
  Box box;
  for (const Triangle& t : body.triangles)
    for (const Index i : t) box.extend(rotation * body.point(i));
  return box;
}

// The front in a picture of that longer side, and the oblique view in a picture of the same size.
std::array<ScreenTransform, 2> preview_transforms(const DrawnBody& body, int longer_side_px) {
  const Mat3 rotation = oblique_rotation();
  const Box front = rotated_box(body, Mat3::Identity()), side = rotated_box(body, rotation);
  const double longer = std::max(front.size().x(), front.size().y());
  const double scale = longer_side_px * (1 - 2 * preview_padding) / longer,
               pad = 2 * preview_padding * longer_side_px;
  const auto pixels = [&](double mm) { return std::max(1, static_cast<int>(std::lround(mm * scale + pad))); };
  const int width = pixels(front.size().x()), height = pixels(front.size().y());
  const double fit = std::min((width - pad) / side.size().x(), (height - pad) / side.size().y());
  const Vec3 middle = rotation.transpose() * side.centre();
  return {ScreenTransform{width, height, scale},
          ScreenTransform{width, height, std::min(scale, fit), rotation, middle, false}};
}

// Lays a picture with opacity over the wall, its left edge at column `left`.
void lay_on_wall(const Image8& picture, int left, Image8& image) {
  const DisplayTable& display = display_table();
  const auto lay_row = [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const float share = static_cast<float>(y) / static_cast<float>(picture.height);
    const int wall = display(brightest_wall + (darkest_wall - brightest_wall) * share);
    const std::uint8_t* from = &picture.at(0, y);
    std::uint8_t* to = &image.at(left, y);
    for (int x = 0; x < picture.width; ++x, from += 4, to += 3)
      for (int i = 0; i < 3; ++i)
        to[i] = static_cast<std::uint8_t>((from[i] * from[3] + wall * (255 - from[3]) + 127) / 255);
  };
  parallel_for(static_cast<std::size_t>(picture.height), lay_row, 16);
}

}  // namespace

Image8 render_preview(const Solid& solid, const PreviewOptions& options) {
  if (solid.triangles.empty() || options.longer_side_px < 1 || options.longer_side_px > most_pixels)
    return {};
  const SolidBody owner(solid);
  const DrawnBody body = owner.body();
  const auto transforms = preview_transforms(body, options.longer_side_px);
  const int width = transforms[0].width;
  Image8 image = filled_image(2 * width, transforms[0].height, std::uint8_t{0}, 3), picture;
  DrawCache cache;
  for (int i = 0; i < 2; ++i) {
    draw_body(body, transforms[i], {options.material, options.light, true, true}, cache, picture);
    lay_on_wall(picture, i * width, image);
  }
  return image;
}

}  // namespace relievo
