// The studio shows what its files contain: compares its picture of a piece with a picture of the exported STL
// that is drawn from nothing but the triangles.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "common/export_file.h"
#include "common/project.h"
#include "relievo/make_relief.h"
#include "relievo/samples/sample.h"
#include "studio/drawing.h"
#include "support/read_solid.h"
#include "support/second_renderer.h"

namespace relievo {
namespace {

using app::studio::Drawing;

std::shared_ptr<const ReliefModel> model() {
  static const auto made =
      std::make_shared<const ReliefModel>(*prepare(*make_sample("still_life", {.points = 20000}), View{}));
  return made;
}

// Returns a solid of the triangles in a file. Those that face up are the front.
Solid solid_of(const test::ReadSolid& file, double ground_mm) {
  Solid solid;
  solid.ground_mm = ground_mm;
  std::map<std::array<float, 3>, Index> numbers;
  const auto number = [&](const Vec3f& p) {
    const auto [at, is_new] =
        numbers.try_emplace({p.x(), p.y(), p.z()}, static_cast<Index>(solid.points.size()));
    if (is_new) solid.points.push_back(p.cast<double>());
    return at->second;
  };
  std::vector<Triangle> others;
  for (const auto& [a, b, c] : file.triangles) {
    const Triangle t{number(a), number(b), number(c)};
    const bool is_up = (b - a).cross(c - a).normalized().z() > 1e-3F;
    (is_up ? solid.triangles : others).push_back(t);
  }
  solid.front_triangles = solid.triangles.size();
  solid.triangles.insert(solid.triangles.end(), others.begin(), others.end());
  return solid;
}

// The green of a picture on a grey ground.
Image<float> green_of(const Image8& image) {
  Image<float> green = filled_image(image.width, image.height, 0.F);
  for (std::size_t i = 0; i < green.pixels.size(); ++i) {
    const float opacity = image.pixels[4 * i + 3] / 255.F;
    green.pixels[i] = opacity * image.pixels[4 * i + 1] + (1 - opacity) * 200;
  }
  return green;
}

// Returns the mean structural similarity (Wang et al. 2004) of two pictures, in windows of 8 x 8 pixels.
double similarity(const Image8& picture, const Image8& other) {
  constexpr int side = 8;
  constexpr double c1 = .01 * 255 * .01 * 255, c2 = .03 * 255 * .03 * 255;
  const Image<float> a = green_of(picture), b = green_of(other);
  if (a.width != b.width || a.height != b.height) return 0;
  double sum = 0;
  int windows = 0;
  for (int top = 0; top + side <= a.height; top += side / 2)
    for (int left = 0; left + side <= a.width; left += side / 2, ++windows) {
      double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
      for (int y = top; y < top + side; ++y)
        for (int x = left; x < left + side; ++x) {
          const double p = static_cast<double>(a.at(x, y)), q = static_cast<double>(b.at(x, y));
          ma += p, mb += q, aa += p * p, bb += q * q, ab += p * q;
        }
      constexpr double n = side * side;
      ma /= n, mb /= n;
      const double va = aa / n - ma * ma, vb = bb / n - mb * mb, both = ab / n - ma * mb;
      sum += (2 * ma * mb + c1) * (2 * both + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
  return sum / windows;
}

// A height map of a hill beside a hollow.
std::shared_ptr<const Image<float>> hill_and_hollow() {
  Image<float> image = filled_image(64, 48, 0.F);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = std::sin(static_cast<float>(x) * .1F) * std::sin(static_cast<float>(y) * .065F);
  return std::make_shared<const Image<float>>(std::move(image));
}

// Takes the camera out of a piece: its angles are not among the options.
Camera take_camera(nlohmann::json& piece) {
  Camera camera;
  camera.yaw_deg = piece.value("yaw", 0.);
  camera.pitch_deg = piece.value("pitch", 0.);
  piece.erase("yaw");
  piece.erase("pitch");
  return camera;
}

// Takes the base out of a piece. The text of a piece cannot contain the image of a base.
BaseOptions take_base(nlohmann::json& piece) {
  BaseOptions base = *parse_base(piece.value("base", "plane"));
  if (base.kind == BaseKind::image) base.image = hill_and_hollow();
  piece.erase("base");
  return base;
}

// Pearson's correlation.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sa += a[i], sb += b[i], saa += a[i] * a[i], sbb += b[i] * b[i], sab += a[i] * b[i];
  return (n * sab - sa * sb) / std::sqrt((n * saa - sa * sa) * (n * sbb - sb * sb));
}

// Returns the correlation of the picture's green with the cosines where the piece is, and expects that it is drawn there
// and nowhere else, but for pixels of its outline.
double agreement(const Image8& picture, const Image<double>& cosines) {
  std::vector<double> drawn, expected;
  int beside = 0;
  for (std::size_t i = 0; i < cosines.pixels.size(); ++i) {
    const bool is_there = !std::isnan(cosines.pixels[i]), is_drawn = picture.pixels[4 * i + 3] > 250;
    beside += is_there != is_drawn;
    if (!is_there || !is_drawn) continue;
    drawn.push_back(picture.pixels[4 * i + 1]);
    expected.push_back(cosines.pixels[i]);
  }
  EXPECT_GT(drawn.size(), cosines.pixels.size() / 10);
  EXPECT_LT(beside, .01 * static_cast<double>(drawn.size()));
  return correlation(drawn, expected);
}

// Expects that without shadows the piece is as bright as the angle between surface and lamp says, by another renderer,
// which shares no code with the library's.
void expect_lit_piece(const test::ReadSolid& file, double ground_mm, Drawing& drawing,
                      app::studio::PictureRequest request) {
  const Camera& camera = request.render.camera;
  request.render.has_shadows = request.render.is_fine = false;
  for (const Vec3& lamp : {Vec3(-1, 1, .8), Vec3(1.5, .4, 1)}) {
    request.render.light = lamp.cast<float>();
    const auto shown = drawing.picture(request);
    ASSERT_TRUE(shown) << shown.error().message();
    test::RayCamera rays{test::axes_after(camera.yaw_deg, camera.pitch_deg), file.box().centre(),
                         shown->picture.pixels_per_mm, request.render.width, request.render.height};
    rays.middle.z() = ground_mm;
    const double right = agreement(shown->picture.image, test::lamp_cosines(file, rays, lamp));
    const Vec3 other = lamp.cwiseProduct(Vec3(-1, 1, 1));
    const double wrong = agreement(shown->picture.image, test::lamp_cosines(file, rays, other));
    // The sky adds to the lamp, and rounds large triangles and steep walls, which the other renderer does not.
    EXPECT_GT(right, request.options.form == Form::lithophane ? .55 : .85);
    EXPECT_LT(wrong, right - .2);
  }
}

class PictureOfPiece : public testing::TestWithParam<const char*> {};

TEST_P(PictureOfPiece, IsThatOfTheFile) {
  nlohmann::json json = nlohmann::json::parse(GetParam());
  json["height"] = json.value("height", 4.0);
  app::studio::PictureRequest request;
  request.render.camera = take_camera(json);
  const BaseOptions base = take_base(json);
  ReliefOptions options = *app::options_from_json(json, "options");
  options.base = base;
  request.options = options;
  request.key = json.dump();
  request.render.width = 720;
  request.render.height = 600;
  request.render.is_fine = request.is_finished = true;
  Drawing drawing({model(), {}}, 0);
  const auto order = drawing.missing_piece(request);
  ASSERT_TRUE(order && *order);
  drawing.take(std::make_shared<const MadeRelief>(*make_relief(*model(), (*order)->options)), **order);
  const auto shown = drawing.picture(request);
  ASSERT_TRUE(shown) << shown.error().message();
  EXPECT_TRUE(shown->is_finished);

  const auto made = make_relief(*model(), options);
  ASSERT_TRUE(made) << made.error().message();
  const std::string bytes = app::export_file(*made, **app::find_format("stl"), {}).bytes;
  const test::ReadSolid triangles = test::solid_in_stl(bytes);
  expect_lit_piece(triangles, made->solid.ground_mm, drawing, request);
  const auto solid = std::make_shared<const Solid>(solid_of(triangles, made->solid.ground_mm));
  Picture file;
  SolidRenderer(solid).render(request.render, file);
  EXPECT_GT(similarity(shown->picture.image, file.image), .98);

  // The comparison detects another picture: one that is 2 % smaller.
  request.render.camera.zoom = .98;
  SolidRenderer(solid).render(request.render, file);
  EXPECT_LT(similarity(shown->picture.image, file.image), .98);
}

INSTANTIATE_TEST_SUITE_P(
    Pieces, PictureOfPiece,
    testing::Values(
        R"({})", R"({"method": "paper", "margin": 12, "thickness": 8})",
        R"({"outline": "round", "corner": 15})", R"({"outline": "ellipse"})",
        R"({"outline": "circle", "rim": 4})", R"({"outline": "none"})",
        R"({"rim": 3, "rim-height": 2, "rim-bevel": 1})", R"({"plate": "150x140", "rim": 5})",
        R"({"diameter": 80, "outline": "circle", "rim": 2, "height": 3})", R"({"form": "mirror"})",
        R"({"form": "die", "outline": "circle", "rim": 3})", R"({"form": "lithophane", "height": 2.4})",
        R"({"base": "dome:height=8", "outline": "circle"})", R"({"base": "wave:height=4,length=40"})",
        R"({"base": "fold:angle=15"})", R"({"base": "cylinder:diameter=200", "form": "mirror"})",
        R"({"base": "image:height=6", "outline": "round"})", R"({"wrap": "cylinder:turn=120"})",
        R"({"wrap": "cone:turn=90,angle=8"})", R"({"wrap": "sphere:turn=100", "outline": "circle"})",
        R"({"draft": 20, "outline": "ellipse", "rim": 3})", R"({"tolerance": 0.02, "outline": "round"})",
        R"({"triangles": 20000, "outline": "circle"})", R"({"tool": "ball:2", "finish": "reachable"})",
        R"({"yaw": 35, "pitch": 20, "outline": "circle", "rim": 3, "rim-height": 2})",
        R"({"yaw": -50, "pitch": -15, "base": "wave:height=4,length=40"})",
        R"({"yaw": 30, "pitch": 30, "wrap": "cylinder:turn=120"})",
        R"({"yaw": 20, "pitch": -40, "form": "die", "outline": "ellipse"})"));

}  // namespace
}  // namespace relievo
