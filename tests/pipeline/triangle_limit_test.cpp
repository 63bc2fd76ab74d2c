#include "geometry/plane.h"
#include "relievo/make_relief.h"
#include "relievo/relief/relief.h"
#include "support/results.h"
#include "support/shapes.h"

namespace relievo {
namespace {

const ReliefModel& limited_model() {
  static const ReliefModel made =
      *prepare(test::joined(test::torus(12000, 1.5, .4), test::sphere(8000, .8)), View{});
  return made;
}

ReliefOptions options_with(double triangles) {
  return {{.width_mm = 50, .height_mm = 3, .triangles = triangles}};
}

TEST(TriangleLimit, IsNearlyReachedByAllBodies) {
  const double most = 60000;
  for (const Outline outline : {Outline::rectangle, Outline::none})
    for (const BaseKind base : {BaseKind::plane, BaseKind::wave}) {
      if (outline == Outline::none && base != BaseKind::plane) continue;
      ReliefOptions options = options_with(most);
      options.outline = outline;
      options.base.kind = base;
      const auto made = value_of(make_relief(limited_model(), options));
      EXPECT_EQ(check_solid(made.solid), "");
      const auto count = static_cast<double>(made.solid.triangles.size());
      EXPECT_LE(count, most);
      EXPECT_GT(count, .9 * most);
      ASSERT_TRUE(made.report.simplification_error_mm);
      EXPECT_NEAR(made.report.height_mm, 3, 1e-9);
    }
}

// Ground, walls and back of a curved body need triangles, too, but must not take too many from the relief.
TEST(TriangleLimit, CostsLittleMoreOnCurvedBodies) {
  const double most = 40000;
  const double flat =
      *value_of(make_relief(limited_model(), options_with(most))).report.simplification_error_mm;
  for (const char* body : {"wave:height=4,length=20", "cylinder:turn=200", "sphere:turn=150,inside"}) {
    ReliefOptions options = options_with(most);
    if (std::string_view(body).starts_with("wave"))
      options.base = value_of(parse_base(body));
    else
      options.wrap = value_of(parse_wrap(body));
    const auto made = value_of(make_relief(limited_model(), options));
    EXPECT_EQ(check_solid(made.solid), "") << body;
    EXPECT_LE(static_cast<double>(made.solid.triangles.size()), most) << body;
    EXPECT_GT(static_cast<double>(made.solid.triangles.size()), .9 * most) << body;
    EXPECT_LT(*made.report.simplification_error_mm, 2 * flat) << body;
  }
}

TEST(TriangleLimit, CostsLessTheMoreItAllows) {
  double before = 1;
  for (const double most : {15000, 30000, 60000}) {
    const auto made = value_of(make_relief(limited_model(), options_with(most)));
    EXPECT_LT(*made.report.simplification_error_mm, .7 * before);
    before = *made.report.simplification_error_mm;
  }
}

TEST(TriangleLimit, ChangesNothingWhereFewerAreMade) {
  ReliefOptions options = options_with(1e6);
  const auto limited = value_of(make_relief(limited_model(), options));
  options.triangles.reset();
  EXPECT_EQ(limited.solid.triangles, value_of(make_relief(limited_model(), options)).solid.triangles);
}

TEST(TriangleLimit, ActsTogetherWithATolerance) {
  ReliefOptions options = options_with(1e6);
  options.tolerance_mm = .02;
  const auto within = value_of(make_relief(limited_model(), options));
  EXPECT_LE(*within.report.simplification_error_mm, .02);
  options.triangles = std::floor(.7 * static_cast<double>(within.solid.triangles.size()));
  const auto fewer = value_of(make_relief(limited_model(), options));
  EXPECT_LE(static_cast<double>(fewer.solid.triangles.size()), *options.triangles);
  EXPECT_GT(*fewer.report.simplification_error_mm, .02);
}

TEST(TriangleLimit, GivesFewNeedles) {
  const Solid& solid = value_of(make_relief(limited_model(), options_with(20000))).solid;
  std::vector<double> angles;
  for (std::size_t t = 0; t < solid.front_triangles; ++t) {
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = solid.points[solid.triangles[t][i]];
    const bool is_ground = std::ranges::all_of(p, [&](const Vec3& q) { return q.z() == solid.ground_mm; });
    if (is_ground) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 u = (p[(i + 1) % 3] - p[i]).head<2>(), v = (p[(i + 2) % 3] - p[i]).head<2>();
      angles.push_back(std::atan2(cross(u, v), u.dot(v)) * 180 / std::numbers::pi);
    }
  }
  std::ranges::sort(angles);
  EXPECT_GT(angles[angles.size() / 100], 2.5);
}

}  // namespace
}  // namespace relievo
