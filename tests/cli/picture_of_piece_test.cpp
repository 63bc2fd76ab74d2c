// Tests that the studio's picture of a finished piece, such as a coin, shows the solid of its file. The
// reference is drawn from the triangles of the exported STL alone.
#include <nlohmann/json.hpp>

#include "common/export_file.h"
#include "common/project.h"
#include "quality/image_measures.h"
#include "relievo/make_relief.h"
#include "relievo/samples/sample.h"
#include "studio/drawing.h"
#include "support/picture_similarity.h"
#include "support/second_renderer.h"

namespace relievo {
namespace {

using app::studio::Drawing;

// Returns the model for the options. All methods except the paper's use the same model.
std::shared_ptr<const ReliefModel> model_for(const ReliefOptions& options) {
  const auto make = [](const View& view) {
    return std::make_shared<const ReliefModel>(*prepare(*make_sample("still_life", {.points = 20000}), view));
  };
  static const auto made = make({});
  return options.effective_view().is_paper ? make(options.effective_view()) : made;
}

// Returns a solid made of the triangles in a file. Triangles that face upwards form its front.
Solid solid_with_front(const test::ReadSolid& file, double ground_mm) {
  Solid solid = test::solid_of(file);
  solid.ground_mm = ground_mm;
  const auto is_up = [&](const Triangle& t) {
    const Vec3 &a = solid.points[t[0]], &b = solid.points[t[1]], &c = solid.points[t[2]];
    return (b - a).cross(c - a).normalized().z() > 1e-3;
  };
  const auto others = std::ranges::stable_partition(solid.triangles, is_up);
  solid.front_triangles = solid.triangles.size() - others.size();
  return solid;
}

std::shared_ptr<const Image<float>> hill_and_hollow() {
  Image<float> image = filled_image(64, 48, 0.F);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = std::sin(static_cast<float>(x) * .1F) * std::sin(static_cast<float>(y) * .065F);
  return std::make_shared<const Image<float>>(std::move(image));
}

// Removes the camera's angles from a piece, because they are not options. Returns the camera.
Camera take_camera(nlohmann::json& piece) {
  Camera camera{.yaw_deg = piece.value("yaw", 0.), .pitch_deg = piece.value("pitch", 0.)};
  piece.erase("yaw");
  piece.erase("pitch");
  return camera;
}

// Removes the base from the piece and returns it. A base of kind image gets its image here, because the
// text of a piece cannot contain an image.
BaseOptions take_base(nlohmann::json& piece) {
  BaseOptions base = *parse_base(piece.value("base", "plane"));
  if (base.kind == BaseKind::image) base.image = hill_and_hollow();
  piece.erase("base");
  return base;
}

// Returns the correlation between the picture's green channel and the cosines, over the pixels of the
// piece. `cosines` are those of the angles between surface and lamp; NaN outside the piece. Expects that
// the picture shows the piece exactly where there are cosines, except at the pixels of its outline.
double agreement(const Image8& picture, const Image<double>& cosines) {
  Image<float> drawn = filled_image(picture.width, picture.height, 0.F), expected = drawn;
  PixelMask both;
  int beside = 0;
  for (std::size_t i = 0; i < cosines.pixels.size(); ++i) {
    const bool is_there = !std::isnan(cosines.pixels[i]), is_drawn = picture.pixels[4 * i + 3] > 250;
    beside += is_there != is_drawn;
    if (!is_there || !is_drawn) continue;
    both.pixels.push_back(static_cast<Index>(i));
    drawn[i] = picture.pixels[4 * i + 1];
    expected[i] = static_cast<float>(cosines.pixels[i]);
  }
  EXPECT_GT(both.pixels.size(), cosines.pixels.size() / 10);
  EXPECT_LT(beside, .01 * static_cast<double>(both.pixels.size()));
  return correlation(drawn, expected, both);
}

// Expects that the brightness of the piece, without shadows, depends on the angles between surface and lamp.
// A second renderer, which shares no code with the library, computes these angles.
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
    // The correlation is below 1, because the library's renderer also adds skylight, and shades large
    // triangles and steep walls smoothly.
    EXPECT_GT(right, request.options.form == Form::lithophane ? .55 : .85);
    EXPECT_LT(wrong, right - .2);
  }
}

class PictureOfPiece : public testing::TestWithParam<std::string> {};

TEST_P(PictureOfPiece, IsThatOfTheFile) {
  nlohmann::json json = nlohmann::json::parse(GetParam());
  json["height"] = json.value("height", 4.0);
  app::studio::PictureRequest request;
  request.render.camera = take_camera(json);
  const BaseOptions base = take_base(json);
  ReliefOptions options = *app::options_from_json(json, "options");
  options.base = base;
  request.options = options;
  request.render.width = 720;
  request.render.height = 600;
  request.render.is_fine = request.is_at_rest = request.is_finished = true;
  const auto model = model_for(options);
  Drawing drawing({model, {}}, 0);
  const auto order = drawing.missing_piece(request);
  ASSERT_TRUE(order && *order);
  drawing.take(std::make_shared<const MadeRelief>(*make_relief(*model, **order)), **order);
  const auto shown = drawing.picture(request);
  ASSERT_TRUE(shown) << shown.error().message();
  EXPECT_TRUE(shown->is_finished);

  const auto made = make_relief(*model, options);
  ASSERT_TRUE(made) << made.error().message();
  const std::string bytes = app::export_file(*made, **app::find_format("stl"), {})->bytes;
  const test::ReadSolid triangles = test::solid_in_stl(bytes);
  expect_lit_piece(triangles, made->solid.ground_mm, drawing, request);
  const auto solid = std::make_shared<const Solid>(solid_with_front(triangles, made->solid.ground_mm));
  Picture file;
  SolidRenderer(solid).render(request.render, file);
  EXPECT_GT(test::structural_similarity(shown->picture.image, file.image), .97);

  // The comparison must detect a different picture, such as one that is 2 % smaller.
  request.render.camera.zoom = .98;
  SolidRenderer(solid).render(request.render, file);
  EXPECT_LT(test::structural_similarity(shown->picture.image, file.image), .85);
}

std::vector<std::string> all_outlines() {
  std::vector<std::string> pieces;
  for (const auto& [name, outline] : outline_choices) pieces.push_back(cat(R"({"outline": ")", name, "\"}"));
  return pieces;
}

INSTANTIATE_TEST_SUITE_P(Outlines, PictureOfPiece, testing::ValuesIn(all_outlines()));

INSTANTIATE_TEST_SUITE_P(
    Pieces, PictureOfPiece,
    testing::Values(
        R"({})", R"({"method": "paper", "margin": 12, "thickness": 8})",
        R"({"outline": "round", "corner": 15})", R"({"outline": "circle", "rim": 4})",
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
