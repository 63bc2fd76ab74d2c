#include "relievo/turning.h"

#include "core/quantile.h"
#include "relievo/io/read.h"
#include "relievo/make_relief.h"
#include "relievo/option_table.h"
#include "relievo/scan/scan_file.h"
#include "relievo/scan/surface.h"
#include "scan/measured_cloud.h"
#include "support/picture_similarity.h"
#include "support/results.h"
#include "support/same_bits.h"
#include "support/shapes.h"
#include "support/shared_scans.h"
#include "support/triangles.h"

namespace relievo {
namespace {

constexpr double height_mm = 3;

RenderOptions shown_at(double mm_per_unit) {
  return {.width = 900, .height = 700, .mm_per_unit = mm_per_unit};
}

// Draws a relief as the studio does while a model is turned.
Image8 picture_of(const ShownModel& relief) {
  ReliefOptions options{{.height_mm = height_mm}};
  const double mm = mm_per_unit(relief.model->surface(), options);
  FrameOptions wanted{shape_of(options), height_mm / mm};
  wanted.shape.boundary_width *= relief.spacing_ratio;
  FrameMaker maker(*relief.model);
  Frame frame;
  maker.make(wanted, frame);
  EXPECT_TRUE(frame.is_height_met);
  std::vector<float> gains;
  maker.write_gains(gains);
  FrameRenderer renderer(relief.model);
  Picture picture;
  renderer.render({frame.heights, frame.normals, 1, {}, relief.detail.get(), gains}, shown_at(mm), picture);
  return std::move(picture.image);
}

ShownModel prepared(const MeasuredCloud& measured, const View& view) {
  auto model = ReliefModel::prepare(find_surface(measured, view).value()).value();
  return {std::make_shared<const ReliefModel>(std::move(model))};
}

// Similarities of the picture of a turned relief with the picture of the relief of all points in the same view.
struct Similarities {
  double turned = 0;  // with the height correction of another view
  double first = 0;   // without an earlier model, as after opening a scan
};

Similarities similarities(const Cloud& cloud, const char* from, const char* to) {
  const auto measured = MeasuredCloud::measure(cloud, {}).value();
  const ShownModel before = prepared(*measured, parse_view(from).value());
  const View view = parse_view(to).value();
  const Turntable table(*measured);
  const Image8 whole = picture_of(prepared(*measured, view));
  const auto like = [&](const ReliefModel* model) {
    return test::structural_similarity(picture_of(table.turn(view, model).value()), whole);
  };
  return {like(before.model.get()), like(nullptr)};
}

class TurnedData : public testing::TestWithParam<const char*> {};

TEST_P(TurnedData, LooksLikeTheFullRelief) {
  const std::string name = std::string(GetParam()) + ".ply";
  if (!test::has_shared(name)) GTEST_SKIP() << test::missing_scan(name);
  const Cloud cloud = read_cloud(test::shared_bytes(name), name).value().cloud;
  const Similarities found = similarities(cloud, "0,0,1", "0.5,0.2,1");
  EXPECT_GT(found.turned, .9);
  EXPECT_GT(found.first, .9);
}

INSTANTIATE_TEST_SUITE_P(Scans, TurnedData,
                         testing::Values("armadillo", "dragon", "happy_buddha", "horse", "igea", "nefertiti"),
                         [](const auto& scan) { return std::string(scan.param); });

TEST(Turntable, LooksLikeTheFullRelief) {
  const Similarities found = similarities(test::torus(100'000, 1, .4), "0,0,1", "0.3,1,1");
  EXPECT_GT(found.turned, .9);
  EXPECT_GT(found.first, .9);
}

// Differences of less than half a cell would not be visible. Still, the same call must always give the same relief.
TEST(Turntable, GivesTheSameBitsForAnyNumberOfThreads) {
  const auto measured = MeasuredCloud::measure(test::torus(30'000, 1, .4), {}).value();
  const Turntable table(*measured);
  const View view = parse_view("1,1,1").value();
  test::expect_same_for_any_threads([&] {
    const ShownModel turned = table.turn(view, nullptr).value();
    return std::pair(turned.model->surface().points, picture_of(turned).pixels);
  });
}

TEST(Turntable, HasAboutAsManyPointsAsItSays) {
  for (const std::size_t points : {5'000, 50'000, 400'000}) {
    const auto measured = MeasuredCloud::measure(test::sphere(points, 1), {}).value();
    const ShownModel relief = Turntable(*measured).turn({}, nullptr).value();
    const std::size_t made = relief.model->surface().points.size();
    EXPECT_LT(made, Turntable::points * 7 / 5) << points;
    EXPECT_GT(2 * made, std::min(points / 2, Turntable::points)) << points;
  }
}

// Turns a sphere of radius 1 whose model before the turn has a support plane at `height`. Returns the
// diameter of the part of the sphere in front of the plane.
double diameter_before_plane(const Turntable& table, const MeasuredCloud& measured, double height) {
  Surface surface = find_surface(measured, {}).value();
  surface.plane = SupportPlane{PlaneKind::background, Vec3::UnitZ(), height - surface.centre.z(), .01, .3};
  const ReliefModel before = ReliefModel::prepare(std::move(surface)).value();
  View view{.has_plane = false};
  return Box::of(table.turn(view, &before).value().model->surface().points).size().x();
}

TEST(Turntable, LeavesOutThePlaneOfTheModelBefore) {
  const auto measured = MeasuredCloud::measure(test::sphere(40'000, 1), {}).value();
  const Turntable table(*measured);
  for (const double height : {.4, .4, .8, .4})
    EXPECT_NEAR(diameter_before_plane(table, *measured, height), 2 * std::sqrt(1 - height * height), .05)
        << height;
}

TEST(Turntable, ShowsNothingOfWhatFacesAway) {
  Cloud sheet = test::sheet(20'000, 1, 0, 3);
  const auto measured = MeasuredCloud::measure(sheet, {}).value();
  expect_error(Turntable(*measured).turn(parse_view("back").value(), nullptr), ErrorKind::geometry);
}

// Returns the heights of a relief that is 3 mm high, in mm.
std::vector<double> heights_mm(const ShownModel& relief, double colour_mm) {
  ReliefOptions options{{.height_mm = height_mm}};
  options.colour_mm = colour_mm;
  const double mm = mm_per_unit(relief.model->surface(), options);
  FrameOptions wanted{shape_of(options, mm), height_mm / mm};
  wanted.shape.boundary_width *= relief.spacing_ratio;
  Frame frame;
  FrameMaker(*relief.model).make(wanted, frame);
  EXPECT_TRUE(frame.is_height_met);
  std::vector<double> heights;
  for (const float z : frame.heights) heights.push_back(static_cast<double>(z) * mm);
  return heights;
}

// Returns the model of all points in the view, and the turned model.
std::array<ShownModel, 2> full_and_turned(const Cloud& cloud, const View& view) {
  const auto measured = MeasuredCloud::measure(cloud, {}).value();
  return {prepared(*measured, view), Turntable(*measured).turn(view, nullptr).value()};
}

TEST(Turntable, SinksDarkLinesAsTheReliefOfAllPoints) {
  Cloud dome = test::height_field(
      40'000, 1, [](double x, double) { return .4 * std::cos(2 * x); },
      [](double x, double) { return Vec2(-.8 * std::sin(2 * x), 0); });
  for (const Vec3& p : dome.points)
    dome.colours.push_back(std::abs(p.x() - .3) < .05 ? Colour{20, 20, 20} : Colour{230, 230, 230});
  for (const ShownModel& shown : full_and_turned(dome, {})) {
    const std::vector<double> plain = heights_mm(shown, 0), sunk = heights_mm(shown, .5);
    std::vector<double> deep;
    const std::vector<Vec3>& points = shown.model->surface().points;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (std::abs(points[i].x() - .3) < .01 && std::abs(points[i].y()) < .5)
        deep.push_back(plain[i] - sunk[i]);
    EXPECT_NEAR(quantile(deep, .5), .5, .05);
  }
}

TEST(Turntable, GivesModelsOfASceneTheirOwnHeights) {
  Cloud scene = test::joined(test::sheet(60'000, 2, 0, 5), test::moved(test::sphere(20'000, .6), {-1, 0, 0}));
  scene.own_heights.assign(scene.size(), 0);
  scene = test::joined(std::move(scene), test::moved(test::sphere(20'000, .6), {1, 0, 0}));
  scene.own_heights.resize(scene.size(), .3F);
  for (const ShownModel& shown : full_and_turned(scene, {})) {
    const std::vector<double> heights = heights_mm(shown, 0);
    double lower = 0;
    const std::vector<Vec3>& points = shown.model->surface().points;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].x() > 0) lower = std::max(lower, heights[i]);
    EXPECT_NEAR(lower, .3 * height_mm, .1 * height_mm);  // the sheet behind it is not quite level
  }
  EXPECT_TRUE(full_and_turned(scene, parse_view("0.3,0.2,1").value())[1].model);
}

// Returns values of a view option: the ends of its range, its choices, or the text given here.
std::vector<OptionValue> values_of(const OptionRow& option) {
  const std::map<std::string_view, std::vector<OptionValue>> texts{{"view", {"0.3,0,1"}},
                                                                   {"up", {"1,0,0"}},
                                                                   {"crop", {"0,0,0.4,1"}},
                                                                   {"crumbs", {"keep", "largest", "2"}},
                                                                   {"denoise", {"0"}}};
  if (texts.contains(option.name)) return texts.at(option.name);
  if (option.is_number()) return {option.min, option.max};
  std::vector<OptionValue> values;
  for (const std::string_view choice : option.choices) values.emplace_back(std::string(choice));
  return values;
}

// Returns the area of a model, in the plane of the relief.
double area_of(const ShownModel& shown) {
  const Surface& surface = shown.model->surface();
  return test::inside_area(surface.points, surface.triangulation, surface.boundary);
}

// An option that is forgotten while the model is turned would change the picture when the mouse button is released.
TEST(Turntable, ShowsAsMuchAsTheReliefOfAllPointsWithEachViewOption) {
  const auto ball = [](std::size_t points, double radius, double x) {
    return test::moved(test::sphere(points, radius), {x, 0, 0});
  };
  const Cloud balls =
      test::joined(test::joined(ball(20'000, 1, 0), ball(7'000, .6, 2)), ball(200, .06, -1.5));
  const Cloud wall = test::joined(ball(20'000, 1, 0), test::sheet(30'000, 2, -1, 5));
  for (const OptionRow& option : option_table()) {
    if (option.stage != OptionStage::view) continue;
    const std::vector<OptionValue> values = values_of(option);
    EXPECT_FALSE(values.empty()) << "values_of() has no value of " << option.name;
    for (const OptionValue& value : values)
      for (const Cloud* cloud : {&balls, &wall}) {
        const View view = parse_options({{std::string(option.name), value}}).value().view;
        const ShownModel all = prepared(*MeasuredCloud::measure(*cloud, view).value(), view);
        const auto whole = MeasuredCloud::measure(*cloud, {.denoise = view.denoise}).value();
        const ShownModel turned = Turntable(*whole).turn(view, all.model.get()).value();
        EXPECT_NEAR(area_of(turned), area_of(all), .05 * area_of(all)) << option.name;
        const double diagonal = all.model->surface().diagonal;
        EXPECT_NEAR(turned.model->surface().diagonal, diagonal, .01 * diagonal) << option.name;
      }
  }
}

}  // namespace
}  // namespace relievo
