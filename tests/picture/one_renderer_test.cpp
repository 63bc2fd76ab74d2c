// Tests that previews of finished solids and live pictures of frames come from the same renderer. The same
// solid must give the same pixels if view, light and material are the same.
#include <span>
#include <tuple>

#include "picture/body.h"
#include "picture/draw_body.h"
#include "picture/plate_mesh.h"
#include "relievo/picture/preview.h"
#include "relievo/plate/forms.h"
#include "support/surfaces.h"

namespace relievo {
namespace {

constexpr double mm_per_unit = 32;

// A model, a relief of it (heights and normals at its points), and the finished solid. The first points of
// the solid are the points of the relief.
struct Bodies {
  std::shared_ptr<const ReliefModel> model =
      std::make_shared<const ReliefModel>(test::prepared(test::sphere(20000, 1)));
  std::vector<float> heights;
  std::vector<Vec3f> normals;
  Solid solid;

  Bodies() {
    const Surface& surface = model->surface();
    HeightFieldMesh front{{}, surface.triangulation.triangles, surface.triangulation.hull};
    for (const Vec3& p : surface.points) {
      const double r = p.head<2>().norm();
      const double z = std::max(0., .15 * (.8 - r) * (1 + std::sin(11 * p.x()) * std::cos(7 * p.y())));
      heights.push_back(static_cast<float>(z));
      front.points.push_back(mm_per_unit * Vec3(p.x(), p.y(), static_cast<double>(heights.back())));
    }
    solid = *make_plate(front, {});
    normals = relief_normals(solid);
    normals.resize(heights.size());
    std::ranges::replace(normals, Vec3f(Vec3f::Zero()), Vec3f(Vec3f::UnitZ()));  // normals of level parts
  }
  Shown shown() const { return {heights, normals}; }
};

const Bodies& bodies() {
  static const Bodies made;
  return made;
}

RenderOptions options_for(Material material, bool is_fine, double yaw_deg) {
  RenderOptions options{
      .width = 330, .height = 300, .mm_per_unit = mm_per_unit, .material = material, .is_fine = is_fine};
  options.camera.yaw_deg = yaw_deg;
  options.camera.pitch_deg = yaw_deg / 2;
  return options;
}

Image8 live_picture(const RenderOptions& options) {
  Picture picture;
  FrameRenderer(bodies().model).render(bodies().shown(), options, picture);
  return picture.image;
}

// Draws the finished solid at the position of the live picture's plate.
Image8 picture_of_solid(const RenderOptions& options) {
  const SolidBody owner(bodies().solid);
  DrawCache cache;
  Image8 image;
  draw_body(owner.body(), frame_transform(plate_mesh(bodies().model->surface()), options),
            {options.material, options.light, options.has_shadows, options.is_fine}, cache, image);
  return image;
}

// Returns how many values differ by more than `most`.
std::size_t different_values(const Image8& a, const Image8& b, int most = 0) {
  std::size_t count = a.pixels.size() == b.pixels.size() ? 0 : a.pixels.size();
  for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i)
    count += std::abs(a.pixels[i] - b.pixels[i]) > most;
  return count;
}

TEST(OneRenderer, DrawsAFrameAsTheSolidThatIsMadeOfIt) {
  for (const Material material : {Material::plaster, Material::bronze, Material::walnut})
    for (const bool is_fine : {false, true})
      for (const double yaw_deg : {0., 30., -55.}) {
        const RenderOptions options = options_for(material, is_fine, yaw_deg);
        const Image8 live = live_picture(options);
        EXPECT_EQ(different_values(live, picture_of_solid(options)), 0U)
            << "material " << static_cast<int>(material) << ", fine " << is_fine << ", yaw " << yaw_deg;
        EXPECT_GT(std::ranges::count(live.pixels, 255), live.width * live.height / 5);
      }
}

// Returns the plate of a coin whose rim has a bevel.
PlateOptions coin_of(double rim_mm) {
  return {.outline = Outline::circle, .rim = {3, rim_mm, .3 * std::abs(rim_mm)}};
}

struct NamedPlate {
  std::string name;
  PlateOptions options;
};

BaseOptions uneven_base() {
  Image<float> heights = filled_image(4, 3, 0.F);
  heights.pixels = {0, 1, 3, 2, 1, 0, 2, 1, 2, 2, 0, 1};
  return {.kind = BaseKind::image,
          .height_mm = 4,
          .image = std::make_shared<const Image<float>>(std::move(heights))};
}

std::vector<std::pair<std::string, BaseOptions>> raised_and_hollow_bases() {
  std::vector<std::pair<std::string, BaseOptions>> bases{{"plane", {}}, {"image", uneven_base()}};
  for (const std::string text : {"dome", "cylinder:diameter=120", "fold", "wave:height=3,length=40"})
    for (const std::string end : {"", "hollow"})
      bases.emplace_back(text + end, *parse_base(cat(text,
                                                     end.empty()          ? ""
                                                     : text.contains(':') ? ","
                                                                          : ":",
                                                     end)));
  return bases;
}

PlateOptions in_form(PlateOptions plate, Form form) {
  plate.is_mirrored = plate.base.is_mirrored = form != Form::relief;
  plate.is_die = form == Form::die;
  return plate;
}

// Returns plates with each base: plain ones, mirrored ones, and dies. The plates with a dome are coins.
std::vector<NamedPlate> plates_of_all_kinds() {
  std::vector<NamedPlate> plates{{"coin", coin_of(2)}};
  for (const Form form : {Form::relief, Form::mirror, Form::die}) {
    PlateOptions plate{.outline = Outline::none};
    plates.push_back({cat("no ground ", name_in(form_choices, form)), in_form(plate, form)});
    plate.outline = Outline::ellipse;
    plate.size_mm = {90, 120};
    plate.shift_mm = {4, -7};
    plates.push_back({cat("shifted ", name_in(form_choices, form)), in_form(plate, form)});
  }
  for (const auto& [name, base] : raised_and_hollow_bases())
    for (const Form form : {Form::relief, Form::mirror, Form::die}) {
      PlateOptions plate = base.kind == BaseKind::dome ? coin_of(form == Form::die ? -2 : 2) : PlateOptions{};
      plate.base = base;
      plates.push_back({cat(name, " ", name_in(form_choices, form)), in_form(plate, form)});
    }
  for (const std::string wrap : {"cylinder:diameter=70", "cylinder:diameter=70,inside", "cylinder:turn=360",
                                 "cone:turn=150", "sphere:turn=100", "sphere:turn=100,inside"})
    for (const Form form : {Form::relief, Form::mirror, Form::die}) {
      PlateOptions plate = wrap.starts_with("cone") ? coin_of(form == Form::die ? -2 : 2) : PlateOptions{};
      plate.wrap = *parse_wrap(wrap);
      plates.push_back({cat(wrap, " ", name_in(form_choices, form)), in_form(plate, form)});
    }
  return plates;
}

Result<Solid> solid_on(const PlateOptions& plate) {
  const Surface& surface = bodies().model->surface();
  HeightFieldMesh front{{}, surface.triangulation.triangles, surface.triangulation.hull};
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Vec3& p = surface.points[i];
    front.points.push_back(mm_per_unit * Vec3(p.x(), p.y(), static_cast<double>(bodies().heights[i])));
  }
  if (plate.outline == Outline::none) front.is_relief = surface.boundary.is_inside;
  RELIEVO_TRY(Solid solid, make_plate(plate.is_die        ? as_die(front)
                                      : plate.is_mirrored ? mirrored(front)
                                                          : front,
                                      plate));
  return plate.wrap.kind == WrapKind::none ? std::move(solid) : wrap_plate(solid, plate);
}

// On a curved base, a solid has the normals of its triangles, but a frame has the normals of relief and base
// together. Pictures of solid and frame must look alike.
TEST(OneRenderer, DrawsAFrameOnEachPlateAsTheSolidThatIsMadeOfIt) {
  FrameRenderer renderer(bodies().model);
  for (const auto& [name, plate] : plates_of_all_kinds()) {
    const Result<Solid> solid = solid_on(plate);
    ASSERT_TRUE(solid) << name << ": " << solid.error().expected;
    const bool is_wrapped = plate.wrap.kind != WrapKind::none;
    SolidRenderer of_solid(std::make_shared<const Solid>(*solid));
    for (const double yaw_deg : {0., -55.}) {
      const RenderOptions options = options_for(Material::plaster, false, yaw_deg);
      Picture live, finished;
      const auto placed = value_of(renderer.render_on(plate, bodies().shown(), options, live));
      const Box box = Box::of(solid->points);
      EXPECT_LT((placed.size_mm - box.size()).norm(), is_wrapped ? 1e-2 : 1e-4) << name;
      if (!is_wrapped && plate.outline != Outline::none) {
        const Box relief = Box::of(std::span(solid->points).first(bodies().heights.size()));
        const Vec2 middle = (relief.centre() - box.centre()).head<2>();
        EXPECT_LT((placed.middle_mm - middle).norm(), 1e-6) << name;
      }
      of_solid.render(options, finished);
      EXPECT_NEAR(live.pixels_per_mm, finished.pixels_per_mm, is_wrapped ? 1e-3 : 1e-5) << name;
      const std::size_t count = live.image.pixels.size();
      const bool is_plane = plate.base.kind == BaseKind::plane && !is_wrapped;
      EXPECT_LT(different_values(live.image, finished.image, is_plane ? 0 : 2), is_plane ? 4 : count / 50)
          << name << ", yaw " << yaw_deg;
      EXPECT_LT(different_values(live.image, finished.image, 32), count / 2000)
          << name << ", yaw " << yaw_deg;
    }
  }
}

TEST(OneRenderer, RefusesAWrapAsTheSolidThatIsMadeOfTheFrame) {
  for (const std::string wrap : {"cylinder:diameter=4", "sphere:diameter=11,inside", "cylinder:turn=360"}) {
    PlateOptions plate = wrap.contains("turn") ? coin_of(2) : PlateOptions{};
    plate.wrap = *parse_wrap(wrap);
    const Result<Solid> solid = solid_on(plate);
    Picture picture;
    const auto placed =
        FrameRenderer(bodies().model)
            .render_on(plate, bodies().shown(), options_for(Material::plaster, false, 0), picture);
    ASSERT_TRUE(!solid && !placed) << wrap;
    EXPECT_EQ(std::tuple(placed.error().input, placed.error().expected.substr(0, 30)),
              std::tuple(solid.error().input, solid.error().expected.substr(0, 30)));
  }
}

// If the height of the rim changes, a quick picture keeps the old bevel; a fine picture gets the new bevel.
TEST(OneRenderer, FollowsTheHeightOfARim) {
  FrameRenderer used(bodies().model), fresh(bodies().model);
  const RenderOptions quick = options_for(Material::plaster, false, 40),
                      fine = options_for(Material::plaster, true, 40);
  Picture first, second, other;
  ASSERT_TRUE(used.render_on(coin_of(1), bodies().shown(), quick, first));
  const auto placed = value_of(used.render_on(coin_of(8), bodies().shown(), quick, second));
  EXPECT_NEAR(placed.size_mm.z(), 3 + 8, 1e-6);
  EXPECT_GT(different_values(first.image, second.image), first.image.pixels.size() / 100);
  ASSERT_TRUE(used.render_on(coin_of(8), bodies().shown(), fine, second));
  ASSERT_TRUE(fresh.render_on(coin_of(8), bodies().shown(), fine, other));
  EXPECT_EQ(different_values(second.image, other.image), 0U);
  PlateOptions broken = coin_of(1);
  broken.rim.bevel_mm = 5;
  const auto refused = used.render_on(broken, bodies().shown(), fine, other);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().input, "rim-bevel");
}

// The renderer's cache must not change pictures. An impossible size must give no picture.
TEST(OneRenderer, DrawsASolidTheSameEachTime) {
  SolidRenderer renderer(std::make_shared<const Solid>(bodies().solid));
  Picture first, other, again;
  renderer.render(options_for(Material::plaster, true, 0), first);
  renderer.render(options_for(Material::bronze, false, 30), other);
  renderer.render(options_for(Material::plaster, true, 0), again);
  EXPECT_EQ(different_values(first.image, again.image), 0U);
  EXPECT_GT(different_values(first.image, other.image), 0U);
  RenderOptions options{.width = 0};
  renderer.render(options, other);
  EXPECT_TRUE(other.image.pixels.empty());
}

// Apart from the background, which is a wall, the front view of a preview equals the studio's picture
// with the same size and zoom.
TEST(OneRenderer, PreviewShowsTheLivePicture) {
  const Image8 preview = render_preview(bodies().solid, {.longer_side_px = 300});
  RenderOptions options = options_for(Material::plaster, true, 0);
  options.width = preview.width / 2;
  options.height = preview.height;
  Picture live;
  FrameRenderer renderer(bodies().model);
  renderer.render(bodies().shown(), options, live);
  const Vec3 size = Box::of(bodies().solid.points).size();
  const double longer_mm = std::max(size.x(), size.y());
  options.camera.zoom = .88 * 300 / longer_mm / live.pixels_per_mm;
  renderer.render(bodies().shown(), options, live);
  std::size_t opaque = 0, different = 0;
  int largest = 0;
  for (int y = 0; y < live.image.height; ++y)
    for (int x = 0; x < live.image.width; ++x) {
      const std::size_t i = live.image.index(x, y);
      if (live.image.pixels[i + 3] < 255) continue;  // the preview shows its wall here
      ++opaque;
      for (std::size_t c = 0; c < 3; ++c)
        if (const int by = std::abs(live.image.pixels[i + c] - preview.pixels[preview.index(x, y) + c]))
          ++different, largest = std::max(largest, by);
    }
  // The zoom differs from the preview's scale in the last digit, so a value between two grey levels
  // may be rounded differently.
  EXPECT_LE(largest, 1);
  EXPECT_LT(different, opaque / 1000);
  EXPECT_GT(opaque, 60000U);
}

}  // namespace
}  // namespace relievo
