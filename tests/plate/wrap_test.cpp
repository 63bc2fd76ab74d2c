#include "relievo/plate/wrap.h"

#include "support/admesh.h"
#include "support/plate_fronts.h"

namespace relievo {
namespace {

constexpr double pi = std::numbers::pi;
const std::vector<Vec2> plate_outline = {{0, 0}, {60, 0}, {60, 40}, {0, 40}};

Wrap around(std::string_view text) {
  return value_of(Wrap::around(value_of(parse_wrap(text)), plate_outline));
}

std::string complaint(std::string_view text) {
  const auto options = parse_wrap(text);
  return options ? message_of(Wrap::around(*options, plate_outline)) : options.error().message();
}

constexpr const char* bodies[] = {"cylinder:diameter=60",          "cylinder:turn=270,direction=0",
                                  "cylinder:diameter=50,inside",   "cone:diameter=50,angle=12",
                                  "cone:turn=120,angle=-9,inside", "sphere:diameter=70",
                                  "sphere:turn=100,inside"};

HeightFieldMesh hill() {
  return test::grid_front({56, 36, 56, 36}, [](double x, double y) {
    const double to_middle = std::hypot(x - 28, y - 18);
    return to_middle < 14 ? 1.2 * (1 + std::cos(to_middle * pi / 14)) : 0;
  });
}

PlateOptions plate_around(std::string_view body) {
  PlateOptions options{2, 1.5};
  options.wrap = *parse_wrap(body);
  return options;
}

Solid flat_plate(const PlateOptions& options) {
  return test::plate_of(hill(), options);
}

Solid wrapped(const PlateOptions& options) {
  return value_of(wrap_plate(flat_plate(options), options));
}

// ---------------------------------------------------------------------------------------------------- places

TEST(Wrap, ACylinderKeepsItsRadiusAndLengths) {
  const Wrap wrap = around("cylinder:diameter=60");
  for (const Vec2& p : {Vec2(30, 20), Vec2(3, 7), Vec2(55, 31)}) {
    const Vec3 ground = wrap.at(p, 0), relief = wrap.at(p, 2);
    EXPECT_NEAR(std::hypot(ground.x(), ground.z()), 30, 1e-12);
    EXPECT_NEAR(std::hypot(relief.x(), relief.z()), 32, 1e-12);
    EXPECT_NEAR(std::atan2(ground.x(), ground.z()) * 30, p.x() - 30, 1e-12);
    EXPECT_NEAR(ground.y(), p.y() - 20, 1e-12);
  }
  EXPECT_NEAR(wrap.turn_deg(), 60 / 30. * 180 / pi, 1e-12);
  EXPECT_NEAR(wrap.mm_per_degree(), 60 * pi / 360, 1e-12);
  EXPECT_NEAR(around("cylinder:turn=360").diameter_mm(), 60 / pi, 1e-12);
  EXPECT_TRUE(around("cylinder:turn=360").is_closed());
}

TEST(Wrap, ASphereKeepsWaysFromTheMiddle) {
  const Wrap wrap = around("sphere:diameter=70");
  for (const Vec2& p : {Vec2(30, 20), Vec2(3, 7), Vec2(55, 31)}) {
    const Vec3 ground = wrap.at(p, 0);
    EXPECT_NEAR(ground.norm(), 35, 1e-12);
    EXPECT_NEAR(wrap.at(p, 2).norm(), 37, 1e-12);
    EXPECT_NEAR(std::acos(std::clamp(ground.z() / 35, -1., 1.)) * 35, (p - Vec2(30, 20)).norm(), 1e-6);
  }
}

TEST(Wrap, AConeLeansAsAsked) {
  const Wrap wrap = around("cone:diameter=50,angle=12");
  const Vec3 low = wrap.at({30, 0}, 0), high = wrap.at({30, 40}, 0), out = wrap.at({30, 20}, 3);
  EXPECT_NEAR((high - low).norm(), 40, 1e-12);
  EXPECT_NEAR(std::atan2(low.z() - high.z(), high.y() - low.y()) * 180 / pi, 12, 1e-9);
  EXPECT_NEAR((out - wrap.at({30, 20}, 0)).dot(high - low), 0, 1e-9);
  EXPECT_NEAR(wrap.at({30, 20}, 0).z(), 25, 1e-12);
  EXPECT_LT(wrap.min_radius_mm(), 25);
}

// The map must preserve orientation everywhere. Heights must be perpendicular to the bent ground.
TEST(Wrap, HeightsStandUprightAndNothingIsMirrored) {
  for (const char* body : bodies) {
    const Wrap wrap = around(body);
    for (const Vec2& p : {Vec2(30, 20), Vec2(3, 7), Vec2(55, 31)}) {
      const double step = 1e-6;
      const Vec3 here = wrap.at(p, 0);
      const Vec3 right = (wrap.at(p + Vec2(step, 0), 0) - here) / step,
                 up = (wrap.at(p + Vec2(0, step), 0) - here) / step, out = wrap.at(p, 1) - here;
      EXPECT_NEAR(out.norm(), 1, 1e-9) << body;
      EXPECT_NEAR(out.dot(right), 0, 1e-5) << body;
      EXPECT_NEAR(out.dot(up), 0, 1e-5) << body;
      EXPECT_GT(right.cross(up).dot(out), .1) << body;
    }
    EXPECT_GT((wrap.at({30, 20}, 1) - wrap.at({30, 20}, 0)).z(), .9) << body;
  }
}

TEST(Wrap, RefusesWhatCannotBe) {
  EXPECT_TRUE(complaint("torus").contains("none, cylinder, cone or sphere"));
  for (const char* text :
       {"none:diameter=3", "cylinder:angle=3", "cylinder:diameter=60,turn=90", "cylinder:turn=400",
        "cylinder:diameter=19", "sphere:diameter=20", "cone:angle=85", "cone:diameter=24,angle=45"})
    EXPECT_TRUE(complaint(text).starts_with("wrap: expected ")) << text << ": " << complaint(text);
}

// ---------------------------------------------------------------------------------------------------- bodies

TEST(WrapPlate, IsWatertightForEveryBodyAndOutline) {
  for (const char* body : bodies)
    for (const Outline outline : {Outline::rectangle, Outline::circle, Outline::hexagon, Outline::none}) {
      PlateOptions options = plate_around(body);
      options.outline = outline;
      if (outline == Outline::circle) options.rim = {1.5, .8, .4};
      if (outline == Outline::none) {
        options.wrap.diameter_mm = 70;
        options.wrap.turn_deg.reset();
      }
      if (outline == Outline::circle || outline == Outline::hexagon) {
        options.wrap.diameter_mm = 90;
        options.wrap.turn_deg.reset();
      }
      const Solid solid = wrapped(options);
      EXPECT_EQ(check_solid(solid), "") << body;
      EXPECT_EQ(test::complaint_of_admesh(solid), "") << body;
    }
}

// The front and the back of the shell must have their radii everywhere, even between the corners of triangles.
TEST(WrapPlate, AFlatPlateBecomesAShellOfEvenThickness) {
  const HeightFieldMesh front = test::flat_front({56, 36, 4, 4});
  const PlateOptions options = plate_around("cylinder:diameter=60");
  const Solid plate = *make_plate(front, options), shell = *wrap_plate(plate, options);
  ASSERT_EQ(check_solid(shell), "");
  const double angle = 60. / 30, volume = angle / 2 * (30 * 30 - 28.5 * 28.5) * 40;
  EXPECT_NEAR(volume_mm3(shell), volume, .01 * 2 * angle * 30 * 40);
  const Box box = Box::of(shell.points);
  const Vec2 axis((box.min.x() + box.max.x()) / 2, box.max.z() - 30);
  for (std::size_t t = 0; t < shell.front_triangles; ++t) {
    const auto& [a, b, c] = shell.triangles[t];
    for (const Vec3& p : {shell.points[a], Vec3((shell.points[a] + shell.points[b]) / 2),
                          Vec3((shell.points[a] + shell.points[b] + shell.points[c]) / 3)})
      EXPECT_NEAR(std::hypot(p.x() - axis.x(), p.z() - axis.y()), 30, .0101);
  }
}

TEST(WrapPlate, AFullTurnIsARing) {
  for (const char* body :
       {"cylinder:turn=360", "cylinder:turn=360,direction=0", "cylinder:turn=360,direction=180",
        "cylinder:turn=360,direction=270", "cone:turn=360,angle=5"}) {
    const PlateOptions options = plate_around(body);
    const Solid ring = wrapped(options);
    EXPECT_EQ(check_solid(ring), "") << body;
    EXPECT_EQ(test::complaint_of_admesh(ring), "") << body;
    // A ring has the topology of a torus, so points - edges + triangles = 0.
    const auto points = static_cast<long>(ring.points.size()),
               triangles = static_cast<long>(ring.triangles.size());
    EXPECT_EQ(points - triangles / 2, 0) << body;
    EXPECT_EQ(ring.front_triangles, ring.regions.size());
  }
}

TEST(WrapPlate, AFullTurnWithoutARoundEdgeIsRefused) {
  PlateOptions options = plate_around("cylinder:turn=360");
  options.rim = {1, 1, .3};
  EXPECT_FALSE(wrap_plate(flat_plate(options), options));
  options.rim = {};
  options.outline = Outline::circle;
  EXPECT_FALSE(wrap_plate(flat_plate(options), options));
}

TEST(WrapPlate, RefusesAShellThatReachesTheAxis) {
  PlateOptions options = plate_around("cylinder:diameter=20");
  options.thickness_mm = 10;
  expect_error(wrap_plate(flat_plate(options), options), "as 10 mm reach towards the axis");
  EXPECT_FALSE(wrap_plate(flat_plate({}), {}));
}

TEST(WrapPlate, SimplerOnesHaveFewerTriangles) {
  PlateOptions options = plate_around("cylinder:diameter=60");
  const Solid full = wrapped(options);
  options.tolerance_mm = .0075;
  options.simplify_mm = .03;
  const Solid simple = wrapped(options);
  EXPECT_EQ(check_solid(simple), "");
  EXPECT_LT(simple.front_triangles, full.front_triangles);
  EXPECT_LE(simple.error_mm, .03 + 2 * .0075);
  EXPECT_NEAR(volume_mm3(simple), volume_mm3(full), .04 * 60 * 40);
}

}  // namespace
}  // namespace relievo
