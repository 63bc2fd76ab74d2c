// Tests that the preview of a relief shows the relief for all forms and wraps.
#include <gtest/gtest.h>

#include "common/export_file.h"
#include "relievo/make_relief.h"
#include "support/shapes.h"

namespace relievo {
namespace {

using app::preview_of;

constexpr int side_px = 160;

MadeRelief made_of(const char* wrap, Form form = Form::relief, double radius = 1) {
  Cloud cloud = test::joined(test::sheet(20'000, 3, -1), test::sphere(10'000, radius));
  ReliefOptions options{{.width_mm = 100, .height_mm = 3}};
  options.form = form;
  options.wrap = parse_wrap(wrap).value();
  return make_relief(std::move(cloud), options).value();
}

std::vector<std::uint8_t> half_of(const Image8& preview, bool is_right) {
  std::vector<std::uint8_t> half;
  const int width = preview.width / 2;
  for (int y = 0; y < preview.height; ++y)
    for (int x = 0; x < width; ++x)
      for (std::size_t k = 0; k < 3; ++k)
        half.push_back(preview.pixels[preview.index(x + (is_right ? width : 0), y) + k]);
  return half;
}

double difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  std::size_t differ = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) differ += std::abs(a[i] - b[i]) > 12;
  return a.size() == b.size() ? static_cast<double>(differ) / static_cast<double>(a.size()) : 1;
}

TEST(PreviewOfRelief, OfALithophaneIsLitFromBehind) {
  const MadeRelief made = made_of("none", Form::lithophane);
  EXPECT_EQ(preview_of(made, {.longer_side_px = side_px}).pixels,
            render_preview(made.solid, {.longer_side_px = side_px, .material = Material::porcelain}).pixels);
  EXPECT_EQ(preview_of(made, {.longer_side_px = side_px, .material = Material::bronze}).pixels,
            render_preview(made.solid, {.longer_side_px = side_px, .material = Material::bronze}).pixels);
}

TEST(PreviewOfRelief, OfABentLithophaneIsTheFlatOneLitFromBehind) {
  const MadeRelief made = made_of("cylinder:turn=120", Form::lithophane);
  const Image8 flat = render_preview(made.flat, {.longer_side_px = side_px, .material = Material::porcelain});
  EXPECT_EQ(half_of(preview_of(made, {.longer_side_px = side_px}), false), half_of(flat, false));
}

// The front view shows the relief before it is bent. The oblique view must show the bent relief, so a larger
// sphere in the relief must change the oblique view.
TEST(PreviewOfRelief, OfAnInsideWrapShowsTheWork) {
  for (const char* wrap :
       {"cylinder:turn=360,inside", "cylinder:turn=360,inside,direction=0", "cylinder:turn=270,inside",
        "cone:turn=360,inside,angle=8", "sphere:turn=300,inside"}) {
    const MadeRelief made = made_of(wrap), other = made_of(wrap, Form::relief, 1.8);
    const Image8 picture = preview_of(made, {.longer_side_px = side_px}),
                 larger = preview_of(other, {.longer_side_px = side_px});
    EXPECT_EQ(half_of(picture, false), half_of(render_preview(made.flat, {.longer_side_px = side_px}), false))
        << wrap;
    EXPECT_GT(difference(half_of(picture, true), half_of(larger, true)), .01) << wrap;
  }
}

TEST(PreviewOfRelief, OfWhatIsBentOutsideIsItsOwn) {
  const MadeRelief made = made_of("cylinder:turn=180");
  EXPECT_EQ(preview_of(made, {.longer_side_px = side_px}).pixels,
            render_preview(made.solid, {.longer_side_px = side_px}).pixels);
}

}  // namespace
}  // namespace relievo
