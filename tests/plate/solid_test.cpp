#include "relievo/plate/solid.h"

#include <rapidcheck.h>

#include "support/admesh.h"
#include "support/plate_fronts.h"
#include "support/read_solid.h"
#include "support/triangles.h"

namespace relievo {
namespace {

using test::ellipse, test::fan_front, test::flat_front, test::grid_front, test::plate_of, test::pyramid_front,
    test::used_box;

// Expects that all triangles of the front face upwards. Returns their area as seen from above.
double area_from_above(const Solid& solid) {
  const std::span front = std::span(solid.triangles).first(solid.front_triangles);
  test::expect_counter_clockwise(solid.points, front);
  return test::area_of(solid.points, front);
}

Solid bumpy_plate() {
  const auto bump = [](double x, double y) { return std::sin(x / 5) * std::cos(y / 7) + 1.5; };
  return plate_of(grid_front({60, 40, 30, 20}, bump), {4, 2});
}

// ---------------------------------------------------------------------------------------------- make_plate

TEST(MakePlate, FlatFrontGivesABox) {
  const Solid solid = plate_of(flat_front({60, 40, 6, 4}), {5, 3});
  EXPECT_NEAR(volume_mm3(solid), 70.0 * 50 * 3, 1e-8);
  EXPECT_EQ(used_box(solid).min, Vec3::Zero());
  EXPECT_EQ(used_box(solid).max, Vec3(70, 50, 3));
}

TEST(MakePlate, HasTheCountsItsConstructionImplies) {
  const HeightFieldMesh front = flat_front({60, 40, 6, 4});
  const Solid solid = plate_of(front);
  const std::size_t hull = 20, corners = 4;
  ASSERT_EQ(front.hull.size(), hull);
  EXPECT_EQ(solid.points.size(), front.points.size() + 2 * corners);
  EXPECT_EQ(solid.front_triangles, front.triangles.size() + hull + corners);
  EXPECT_EQ(solid.triangles.size(), solid.front_triangles + 2 * corners + corners - 2);
}

TEST(MakePlate, KeepsTheFrontFirstAndMovesItOnly) {
  HeightFieldMesh front = pyramid_front({{-3, 7}, {9, 7}, {9, 20}}, 4);
  const Solid solid = plate_of(front, {5, 3});
  for (std::size_t t = 0; t < front.triangles.size(); ++t) EXPECT_EQ(solid.triangles[t], front.triangles[t]);
  for (std::size_t i = 0; i < front.points.size(); ++i)
    EXPECT_LT((solid.points[i] - front.points[i] - Vec3(8, -2, 3)).norm(), 1e-12);
}

TEST(MakePlate, GroovesBelowTheGroundKeepTheThickness) {
  const auto wave = [](double x, double y) { return 2 * std::sin(x) * std::sin(y) - 0.3; };
  HeightFieldMesh front = grid_front({30, 30, 90, 90}, wave);
  for (Vec3& p : front.points) p.z() += 17.3;
  front.ground_mm = 17.3;
  const auto [low, high] = std::ranges::minmax(front.points, {}, [](const Vec3& p) { return p.z(); });
  const Solid solid = plate_of(front, {5, 0.7});
  EXPECT_EQ(used_box(solid).max.z(), (high.z() - low.z()) + 0.7);
  double lowest = 1e9;
  for (std::size_t i = 0; i < front.points.size(); ++i) lowest = std::min(lowest, solid.points[i].z());
  EXPECT_EQ(lowest, 0.7);
}

TEST(MakePlate, RingOfAnyConvexFrontCoversTheRectangleOnce) {
  EXPECT_TRUE(rc::check([] {
    // The corners are at random angles on an ellipse.
    auto angles = *rc::gen::suchThat(
        rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 3600)), [](const std::vector<int>& a) {
          return a.size() >= 3 && std::ranges::max(a) - std::ranges::min(a) > 1800;
        });
    std::ranges::sort(angles);
    const auto repeated = std::ranges::unique(angles);
    angles.erase(repeated.begin(), repeated.end());
    RC_PRE(angles.size() >= 3U);
    std::vector<Vec2> polygon;
    for (const int tenths : angles) {
      const double angle = tenths * std::numbers::pi / 1800;
      polygon.emplace_back(30 * std::cos(angle), 20 * std::sin(angle));
    }
    const Solid solid = plate_of(fan_front(polygon), {*rc::gen::element(0.01, 1.0, 50.0), 2});
    RC_ASSERT(check_solid(solid) == "");
    const Vec3 size = used_box(solid).max;
    // All triangles have a positive area, and their areas add up to the area of the rectangle. So the
    // triangles neither overlap nor leave gaps.
    const double area = area_from_above(solid);
    RC_ASSERT(std::abs(area - size.x() * size.y()) < 1e-9 * area);
  }));
}

TEST(MakePlate, EdgesAlongTheRectangleGiveNoTriangleWithoutArea) {
  const Solid solid = plate_of(flat_front({60, 40, 60, 40}), {0.001, 1});
  EXPECT_NEAR(area_from_above(solid), 60.002 * 40.002, 1e-8);
}

TEST(MakePlate, PointsThatTheFrontDoesNotUseCountForNothing) {
  HeightFieldMesh front = flat_front({10, 10, 2, 2});
  front.points.emplace_back(500, -500, -40);
  const Solid solid = plate_of(front, {5, 3});
  EXPECT_EQ(used_box(solid).max, Vec3(20, 20, 3));
}

TEST(MakePlate, SeparatesPointsThatSinglePrecisionWouldMerge) {
  // Two inner points are 1e-9 mm apart, in a plate of 100 mm.
  HeightFieldMesh front = fan_front({{0, 0}, {100, 0}, {100, 100}, {0, 100}});
  front.points.emplace_back(50, 50, 2);
  front.points.emplace_back(50 + 1e-9, 50, 2);
  front.triangles = {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 4, 5}, {2, 3, 4}, {3, 0, 4}};
  const Solid solid = plate_of(front);
  EXPECT_NEAR(solid.points[5].z(), solid.points[4].z(), 1e-6);
  EXPECT_EQ(used_box(solid).max.z(), 5);
}

TEST(MakePlate, RejectsBadOptionsAndFronts) {
  const HeightFieldMesh good = flat_front({10, 10, 2, 2});
  const auto kind = [](const HeightFieldMesh& front, const PlateOptions& options) {
    const auto solid = make_plate(front, options);
    EXPECT_FALSE(solid.has_value());
    return solid ? ErrorKind::cancelled : solid.error().kind;
  };
  for (const double bad : {0.0, -1.0, 1e-4, std::nan(""), static_cast<double>(INFINITY)}) {
    EXPECT_EQ(kind(good, {bad, 3}), ErrorKind::option) << bad;
    EXPECT_EQ(kind(good, {5, bad}), ErrorKind::option) << bad;
  }
  EXPECT_EQ(kind({}, {}), ErrorKind::geometry);
  HeightFieldMesh hullless = good, dangling = good, infinite = good;
  hullless.hull.clear();
  dangling.triangles[0][1] = 9;
  infinite.points[4].z() = INFINITY;
  for (const HeightFieldMesh& bad : {hullless, dangling, infinite})
    EXPECT_EQ(kind(bad, {}), ErrorKind::geometry);
  EXPECT_EQ(make_plate(good, {-1, 3}).error().message(),
            "margin: expected a finite length of at least 0.001 mm, found -1");
}

// --------------------------------------------------------------------------------------------- check_solid

TEST(CheckSolid, NamesWhatIsBroken) {
  const Solid good = bumpy_plate();
  ASSERT_EQ(check_solid(good), "");
  const auto wrong = [&](auto&& breaks) {
    Solid solid = good;
    breaks(solid);
    return check_solid(solid);
  };
  const auto has = [](const std::string& text, std::string_view part) { return text.contains(part); };
  EXPECT_PRED2(has, wrong([](Solid& s) { std::swap(s.triangles[70][0], s.triangles[70][1]); }),
               "opposite directions");
  EXPECT_PRED2(has, wrong([](Solid& s) { s.triangles.pop_back(); }), "opposite directions");
  EXPECT_PRED2(has, wrong([](Solid& s) { s.triangles.push_back(s.triangles[3]); }), "opposite directions");
  EXPECT_PRED2(has, wrong([](Solid& s) { s.triangles[5][1] = s.triangles[5][2]; }),
               "triangle 5 has two equal corners");
  EXPECT_PRED2(has, wrong([](Solid& s) { s.triangles[5][1] = 1 << 30; }),
               "triangle 5 has a corner that does not exist");
  EXPECT_PRED2(has, wrong([](Solid& s) { s.points[40].y() = std::nan(""); }), "point 40 is not finite");
  EXPECT_PRED2(has, wrong([](Solid& s) { s.points[40] = s.points[41] * (1 + 1e-12); }), "points 40 and 41");
  EXPECT_PRED2(has, wrong([](Solid& s) { s.front_triangles = s.triangles.size() + 1; }), "front triangles");
  EXPECT_PRED2(has, wrong([](Solid& s) {
                 for (Triangle& t : s.triangles) std::swap(t[0], t[1]);
               }),
               "volume");
  EXPECT_PRED2(has, check_solid({}), "volume");
}

TEST(CheckSolid, RejectsTwoSolidsThatShareAnEdgeFourTimes) {
  // The solid consists of a closed body and of the same body inside out. So each edge belongs to four
  // triangles.
  Solid solid = bumpy_plate();
  const std::vector<Triangle> once = solid.triangles;
  for (const Triangle& t : once) solid.triangles.push_back({t[1], t[0], t[2]});
  EXPECT_TRUE(check_solid(solid).contains("not shared by exactly two"));
}

TEST(Volume, DoesNotDependOnThePlace) {
  Solid solid = bumpy_plate();
  const double here = volume_mm3(solid);
  for (Vec3& p : solid.points) p += Vec3(1e7, -2e7, 3e7);
  EXPECT_NEAR(volume_mm3(solid), here, 1e-5 * here);
  for (Triangle& t : solid.triangles) std::swap(t[1], t[2]);
  EXPECT_NEAR(volume_mm3(solid), -here, 1e-5 * here);
}

// ------------------------------------------------------------------------------------------------- writers

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Expects that a file has the triangles of the solid, in single precision.
void expect_triangles(const test::ReadSolid& file, const Solid& solid) {
  ASSERT_EQ(file.triangles.size(), solid.triangles.size());
  for (std::size_t t = 0; t < solid.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(file.triangles[t][i], solid.points[solid.triangles[t][i]].cast<float>());
}

TEST(WriteStl, HoldsEveryTriangleWithItsNormal) {
  const Solid solid = bumpy_plate();
  const std::vector<std::byte> bytes = write_stl(solid);
  const std::string_view text = as_text(bytes);
  EXPECT_TRUE(text.starts_with("relievo "));
  EXPECT_TRUE(text.substr(0, 80).contains(" mm"));
  const test::ReadSolid file = test::solid_in_stl(text);
  expect_triangles(file, solid);
  for (std::size_t t = 0; t < file.triangles.size(); ++t) {
    const auto& [a, b, c] = file.triangles[t];
    const Vec3 edges_cross = (b - a).cast<double>().cross((c - a).cast<double>());
    const Vec3f normal = test::point_at(text, 84 + 50 * t);
    EXPECT_LT((normal.cast<double>() - edges_cross.normalized()).norm(), 1e-6);
    EXPECT_EQ(test::value_at<std::uint16_t>(text, 84 + 50 * t + 48), 0);
  }
}

TEST(WriteStl, ATriangleWithoutAreaHasNoNormal) {
  const Solid line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, 0};
  const std::vector<std::byte> bytes = write_stl(line);
  ASSERT_EQ(bytes.size(), 84U + 50);
  EXPECT_EQ(test::point_at(as_text(bytes), 84), Vec3f::Zero());
}

TEST(WritePly, HoldsEveryPointAndTriangle) {
  const Solid solid = bumpy_plate();
  const std::vector<std::byte> bytes = write_ply(solid);
  const std::string_view text = as_text(bytes);
  EXPECT_TRUE(text.starts_with("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_EQ(test::number_after(text, "element vertex "), solid.points.size());
  expect_triangles(test::solid_in_ply(text), solid);
}

TEST(WriteObj, HoldsEveryPointAndTriangleToTheLastBit) {
  Solid solid = bumpy_plate();
  solid.points[3] = {-1.17549435e-38, 3.40282347e38, -1.23456789e-7};  // numbers with the longest texts
  const std::vector<std::byte> bytes = write_obj(solid);
  const std::string text(as_text(bytes));
  EXPECT_TRUE(text.starts_with("# relievo"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 1 + std::ssize(solid.points) + std::ssize(solid.triangles));
  expect_triangles(test::solid_in_obj(text), solid);
}

TEST(Writers, AnEmptySolidGivesAnEmptyFileWithItsHeader) {
  EXPECT_EQ(write_stl({}).size(), 84U);
  EXPECT_TRUE(as_text(write_ply(Solid{})).ends_with("end_header\n"));
  EXPECT_TRUE(as_text(write_obj({})).ends_with("mm\n"));
}

// ------------------------------------------------------------------------------------------- outside judge

TEST(WriteStl, AdmeshFindsNothingToRepair) {
  if (!test::has_admesh()) GTEST_SKIP() << "admesh is not installed";
  const HeightFieldMesh pyramid = pyramid_front(ellipse(101, 30, 20, 0.3), 3);
  EXPECT_EQ(test::complaint_of_admesh(bumpy_plate()), "");
  for (const auto& [name, outline] : outline_choices)
    EXPECT_EQ(test::complaint_of_admesh(plate_of(pyramid, {1, 1, outline})), "") << name;
}

TEST(InUnit, ScalesAndSeparates) {
  const Solid mm = plate_of(pyramid_front({{0, 0}, {60, 0}, {60, 40}, {0, 40}}, 7));
  const Solid inches = in_unit(mm, LengthUnit::inch);
  EXPECT_EQ(inches.unit, LengthUnit::inch);
  EXPECT_EQ(inches.triangles, mm.triangles);
  for (std::size_t i = 0; i < mm.points.size(); ++i)
    EXPECT_LT((inches.points[i] * 25.4 - mm.points[i]).norm(), 1e-12);
  EXPECT_EQ(in_unit(mm, LengthUnit::mm).points, mm.points);
}

// Two corners of a thin triangle are different in a file in millimetres. If their coordinates are merely
// divided by 25.4, they may be equal in a file in inches.
TEST(InUnit, KeepsPointsApart) {
  int merged = 0;
  for (int i = 0; i < 20; ++i) {
    const double width = 43 + .01 * i;
    HeightFieldMesh front = pyramid_front({{0, 0}, {width, 0}, {width, 40}, {0, 40}}, 7);
    front.points.push_back({width / 2 + 2e-6, 20, 7});
    front.triangles[1] = {1, 2, 5};
    front.triangles.push_back({1, 5, 4});
    front.triangles.push_back({2, 4, 5});
    const Solid mm = plate_of(front, {10, 3});
    Solid scaled = mm;
    for (Vec3& p : scaled.points) p /= 25.4;
    merged += check_solid(scaled) != "";
    EXPECT_EQ(check_solid(in_unit(mm, LengthUnit::inch)), "");
  }
  EXPECT_GT(merged, 0);
}

}  // namespace
}  // namespace relievo
