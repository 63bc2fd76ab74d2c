#include "relievo/plate/outline.h"

#include "relievo/make_relief.h"
#include "relievo/plate/forms.h"
#include "relievo/plate/simplify.h"
#include "support/plate_fronts.h"
#include "support/surfaces.h"
#include "support/triangles.h"

namespace relievo {
namespace {

// Returns the smallest signed distance of the points from the lines through the polygon's edges. It is
// negative if a point is outside the polygon.
double least_ground(const std::vector<Vec2>& polygon, const std::vector<Vec2>& points) {
  double least = 1e300;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], edge = polygon[(i + 1) % polygon.size()] - a;
    for (const Vec2& p : points) least = std::min(least, cross(edge, p - a) / edge.norm());
  }
  return least;
}

Vec2 size_of(const std::vector<Vec2>& polygon) {
  return Box::of(polygon).size().head<2>();
}
Vec2 middle_of(const std::vector<Vec2>& polygon) {
  const Box box = Box::of(polygon);
  return ((box.min + box.max) / 2).head<2>();
}

// Returns an asymmetric shape: a part of an ellipse, far from the origin.
std::vector<Vec2> lump() {
  std::vector<Vec2> points = test::ellipse(41, 30, 20, .3);
  std::erase_if(points, [](const Vec2& p) { return p.x() + p.y() < -12; });
  for (Vec2& p : points) p += Vec2(700, -300);
  return points;
}

TEST(OutlineAround, IsConvexAndKeepsTheMarginButNoMore) {
  for (const auto& [name, outline] : outline_choices) {
    if (outline == Outline::none) continue;
    const std::vector<Vec2> polygon = outline_around(lump(), {outline, 12, 3});
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_GT(cross(polygon[(i + 1) % n] - polygon[i], polygon[(i + 2) % n] - polygon[(i + 1) % n]), 0)
          << name;
    EXPECT_NEAR(least_ground(polygon, lump()), 3, 1e-3) << name;
  }
}

TEST(OutlineAround, ASquareHasAKnownCircleEllipseAndHexagon) {
  const std::vector<Vec2> square = {{-10, -10}, {10, -10}, {10, 10}, {-10, 10}};
  const double radius = 10 * std::numbers::sqrt2 + 2;
  EXPECT_NEAR(size_of(outline_around(square, {Outline::circle, 5, 2})).x(), 2 * radius, .02);
  EXPECT_NEAR(size_of(outline_around(square, {Outline::ellipse, 5, 2})).y(), 2 * radius, .02);
  // Towards the midpoint of a slanted side of the hexagon, the square extends to 10 sqrt(3)/2 + 10/2, and
  // the margin adds 2.
  const double width = size_of(outline_around(square, {Outline::hexagon, 5, 2})).minCoeff();
  EXPECT_NEAR(width, 2 * (10 * std::sqrt(.75) + 5 + 2), .05);
}

// The smallest circle around this triangle has its centre at (6.3, -2), which is not midway between left
// and right. The outline must be centred midway.
TEST(OutlineAround, ACircleIsInTheMiddleBetweenLeftAndRight) {
  const std::vector<Vec2> triangle = {{-10, 0}, {10, -18}, {10, 14}};
  const std::vector<Vec2> circle = outline_around(triangle, {Outline::circle, 5, 2});
  const Vec2 centre = (circle[0] + circle[circle.size() / 2]) / 2;
  EXPECT_LT((centre - Vec2(0, -2)).norm(), 1e-6);
  EXPECT_NEAR(size_of(circle).x() / 2, std::hypot(10, 16) + 2, .01);
}

// Returns the largest distance from a curve, over the polygon's corners and the midpoints of its sides.
// `off` returns the signed distance of a point from the curve.
template <typename Off>
double worst_of(const std::vector<Vec2>& polygon, Off off) {
  double worst = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    for (const Vec2& place : {p, Vec2((p + q) / 2)}) worst = std::max(worst, std::abs(off(place)));
  }
  return worst;
}

// An earlier version made polygons that were too coarse: that of a coin of 30 mm had 88 sides and was 30.019 mm wide.
TEST(OutlineAround, ACirclesPolygonLiesWithinAMicrometreOfIt) {
  for (const double diameter : {1., 30., 80., 900.}) {
    const std::vector<Vec2> point = {{70, -3}};
    const std::vector<Vec2> circle =
        outline_around(point, {Outline::circle, 5, .1, Vec2::Constant(diameter)});
    EXPECT_NEAR(size_of(circle).x(), diameter, 1e-9);
    EXPECT_NEAR(size_of(circle).y(), diameter, 1e-9);
    const auto off = [&](const Vec2& p) { return (p - point[0]).norm() - diameter / 2; };
    EXPECT_LE(worst_of(circle, off), 1e-3) << diameter;
    EXPECT_LT(circle.size(), 60 * std::sqrt(diameter)) << "more sides than that takes";
  }
}

TEST(OutlineAround, ACirclesPolygonWithoutASizeLiesWithinAMicrometreOfIt) {
  const std::vector<Vec2> square = {{-10, -10}, {10, -10}, {10, 10}, {-10, 10}};
  const std::vector<Vec2> circle = outline_around(square, {Outline::circle, 5, 2});
  const double radius = size_of(circle).x() / 2;
  EXPECT_LE(worst_of(circle, [&](const Vec2& p) { return p.norm() - radius; }), 1e-3);
  EXPECT_NEAR(radius, 10 * std::numbers::sqrt2 + 2, 1e-9);
  EXPECT_LT(circle.size(), 60 * std::sqrt(2 * radius));
}

TEST(OutlineAround, RoundCornersThatMeetLeaveNoSideWithoutALength) {
  const std::vector<Vec2> round = outline_around(lump(), {Outline::round, 500, .1, {60, 40}});
  for (std::size_t i = 0; i < round.size(); ++i)
    EXPECT_GT((round[(i + 1) % round.size()] - round[i]).norm(), 1e-3) << i;
}

TEST(OutlineAround, RoundCornersAndEllipsesLieWithinAMicrometreOfTheirCurves) {
  const std::vector<Vec2> point = {{0, 0}};
  const std::vector<Vec2> round = outline_around(point, {Outline::round, 8, .1, {60, 40}});
  const auto off_round = [](const Vec2& p) {
    const Vec2 beyond = (p.cwiseAbs() - Vec2(22, 12)).cwiseMax(0);
    return beyond.norm() - 8;
  };
  EXPECT_LE(worst_of(round, off_round), 1e-3);
  EXPECT_LT((size_of(round) - Vec2(60, 40)).norm(), 1e-9);
  const std::vector<Vec2> ellipse = outline_around(point, {Outline::ellipse, 5, .1, {60, 40}});
  // Returns the distance of a point from the ellipse, to first order: the value of the ellipse's function
  // divided by the length of the function's gradient.
  const auto off_ellipse = [](const Vec2& p) {
    const Vec2 shares = p.cwiseQuotient(Vec2(30, 20));
    return (shares.squaredNorm() - 1) / (2 * shares.cwiseQuotient(Vec2(30, 20)).norm());
  };
  EXPECT_LE(worst_of(ellipse, off_ellipse), 1e-3);
  EXPECT_LT((size_of(ellipse) - Vec2(60, 40)).norm(), 1e-9);
}

TEST(OutlineAround, HasTheSizeAskedForAndItsCentre) {
  for (const auto& [name, outline] : outline_choices) {
    if (!has_free_size(outline) && outline != Outline::circle) continue;
    const Vec2 size = outline == Outline::circle ? Vec2(90, 90) : Vec2(120, 90);
    const std::vector<Vec2> small = outline_around(lump(), {outline, 12, 3}),
                            sized = outline_around(lump(), {outline, 12, 3, size});
    EXPECT_LT((size_of(sized) - size).norm(), 1e-9) << name;
    const Vec2 shift = middle_of(sized) - middle_of(small);
    EXPECT_LT(shift.norm(), outline == Outline::ellipse ? .5 : 1e-9)
        << name;  // the small ellipse has another ratio of axes
  }
}

TEST(PlateSize, IsTwoLengthsOfAnyUnit) {
  for (const char* const text :
       {"200x150", "20cm x 15cm", "20x15cm", "200\u00d7150", "200 mmx150mm", "100+100x150,0"})
    EXPECT_EQ(parse_plate_size(text).value_or(Vec2::Zero()), Vec2(200, 150)) << text;
  for (const LengthUnit bare : {LengthUnit::inch, LengthUnit::mm})
    EXPECT_EQ(parse_plate_size("8x6in", bare).value_or(Vec2::Zero()), 25.4 * Vec2(8, 6));
  EXPECT_EQ(parse_plate_size("8in x 150").value_or(Vec2::Zero()), Vec2(25.4 * 8, 150));
  EXPECT_EQ(parse_shift("1,-2in").value_or(Vec2::Zero()), 25.4 * Vec2(1, -2));
  for (const char* const text : {"", "x", "200", "200x", "x150", "200x150x3", "-200x150", "0x150", "200*150"})
    EXPECT_FALSE(parse_plate_size(text)) << text;
}

TEST(OutlineAround, RoundCornersWithinTheMarginKeepTheRectanglesSize) {
  const std::vector<Vec2> box = {{0, 0}, {30, 0}, {30, 20}, {0, 20}};
  EXPECT_LT((size_of(outline_around(box, {Outline::round, 5, 5})) - Vec2(40, 30)).norm(), 1e-9);
  // Inside the margin of 5, the outline's corners have the radius 15 - 5. They would cut off the corners of
  // the box, so the rectangle must be larger.
  const Vec2 grown = size_of(outline_around(box, {Outline::round, 15, 5}));
  const double inner = 10 * (1 - std::sqrt(.5));  // the distance by which each side moves out
  EXPECT_NEAR(grown.x(), 40 + 2 * inner, .02);
  EXPECT_NEAR(grown.y(), 30 + 2 * inner, .02);
}

// ------------------------------------------------------------------------------------------------- the plate

TEST(MakePlate, EveryOutlineIsWatertightWithItsClosedFormVolume) {
  const std::vector<Vec2> polygon = test::ellipse(37, 20, 12);
  const HeightFieldMesh pyramid = test::pyramid_front(polygon, 6);
  const double relief = test::polygon_area(polygon) * 6 / 3;
  for (const auto& [name, outline] : outline_choices) {
    const auto solid = value_of(make_plate(pyramid, {2, 1.5, outline, 8}));
    EXPECT_EQ(check_solid(solid), "") << name;
    const std::vector<Vec2> around = outline_around(polygon, {outline, 8, 2});
    const double ground = test::polygon_area(around.empty() ? polygon : around);
    EXPECT_NEAR(volume_mm3(solid), ground * 1.5 + relief, 1e-6) << name;
    for (const Vec3& p : solid.points) EXPECT_GE(p.minCoeff(), 0) << name;
  }
}

// Returns a grid of squares. The squares that `rows` marks with '#' belong to the relief. The heights do not matter.
HeightFieldMesh patches(const std::vector<std::string>& rows) {
  const int n = static_cast<int>(rows.size());
  HeightFieldMesh front =
      test::grid_front({10.0 * n, 10.0 * n, n, n}, [](double x, double y) { return (x + y) / 50; });
  for (const std::string& row : rows)
    for (const char c : row) front.is_relief.insert(front.is_relief.end(), 2, c == '#');
  return front;
}

std::size_t pieces(const Solid& solid) {
  std::vector<Index> piece(solid.points.size());
  for (Index i = 0; i < piece.size(); ++i) piece[i] = i;
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const Triangle& t : solid.triangles) {
      const Index least = std::min({piece[t[0]], piece[t[1]], piece[t[2]]});
      for (const Index i : t) has_changed |= std::exchange(piece[i], least) != least;
    }
  }
  std::ranges::sort(piece);
  return static_cast<std::size_t>(std::ranges::unique(piece).begin() - piece.begin());
}

double flat_area(const Solid& solid) {
  return test::area_of(solid.points, std::span(solid.triangles).first(solid.front_triangles));
}

TEST(MakePlate, WithoutGroundHolesStayHolesAndPiecesBecomeBodies) {
  const auto solid =
      test::plate_of(patches({"##...", "##...", ".....", "..###", "..#.#"}), {5, 2, Outline::none});
  EXPECT_EQ(pieces(solid), 2U);
  EXPECT_NEAR(flat_area(solid), 9 * 100, 1e-9);
  const auto ring = make_plate(patches({"....", ".###", ".#.#", ".###"}), {5, 2, Outline::none});
  EXPECT_EQ(check_solid(*ring), "");
  EXPECT_EQ(pieces(*ring), 1U);
  EXPECT_NEAR(flat_area(*ring), 8 * 100, 1e-9);
}

TEST(MakePlate, WithoutGroundNothingHangsOnByACorner) {
  // The two blocks touch in one point. The diagonals of cells run through this point, so two triangles of
  // each block meet there. The triangles of one block are removed.
  const auto solid = test::plate_of(patches({"##..", "##..", "..##", "..##"}), {5, 2, Outline::none});
  EXPECT_EQ(pieces(solid), 2U);
  EXPECT_NEAR(flat_area(solid), 8 * 100 - 100, 1e-9);
}

TEST(MakePlate, WithoutGroundAndReliefThereIsNothing) {
  EXPECT_EQ(message_of(make_plate(patches({"..", ".."}), {5, 2, Outline::none})),
            "front: expected triangles of the relief, found ground only");
}

TEST(MakePlate, RefusesACornerWithoutARadius) {
  const HeightFieldMesh front = test::flat_front({10, 10, 2, 2});
  EXPECT_FALSE(make_plate(front, {5, 3, Outline::round, 0}));
  EXPECT_TRUE(make_plate(front, {5, 3, Outline::circle, 0}));
}

// ------------------------------------------------------------------------------------ the whole pipeline

// Returns a torus, which has a hole, and a ball beside it.
Cloud two_pieces() {
  Cloud cloud = test::torus(9000, 1, .35);
  const Cloud ball = test::sphere(4000, .5);
  for (std::size_t i = 0; i < ball.size(); ++i)
    test::add(cloud, ball.points[i] + Vec3(2.6, .4, 0), ball.normals[i].cast<double>());
  return cloud;
}

const ReliefModel& model() {
  static const ReliefModel it = *prepare(two_pieces(), View{});
  return it;
}

ReliefOptions options_for(Outline outline, Form form, bool is_simpler) {
  ReliefOptions options{{.height_mm = 3, .corner_mm = 15}};
  options.outline = outline;
  options.form = form;
  if (is_simpler) options.tolerance_mm = .05;
  return options;
}

TEST(Outlines, AreWatertightInEveryFormAndSimplified) {
  for (const auto& [name, outline] : outline_choices)
    for (const auto& [form_name, form] : form_choices)
      for (const bool is_simpler : {false, true}) {
        const auto made = value_of(make_relief(model(), options_for(outline, form, is_simpler)));
        EXPECT_EQ(check_solid(made.solid), "") << name << form_name << is_simpler;
        if (is_simpler)
          EXPECT_LE(*made.report.simplification_error_mm, .05) << name;
        else
          EXPECT_EQ(pieces(made.solid), outline == Outline::none ? 2U : 1U) << name << form_name;
        EXPECT_EQ(made.report.simplification_error_mm.has_value(), is_simpler) << name;
      }
}

TEST(Outlines, SimplifyingKeepsTheSilhouette) {
  const auto full = value_of(make_relief(model(), options_for(Outline::none, Form::relief, false)));
  const auto simpler = value_of(make_relief(model(), options_for(Outline::none, Form::relief, true)));
  EXPECT_LT(simpler.solid.triangles.size(), full.solid.triangles.size() * 3 / 4);
  EXPECT_NEAR(flat_area(simpler.solid), flat_area(full.solid), 1e-6);
}

// At the relief's edge, only half of a cell may belong to the relief. The corners of a cell lie on a circle, so the
// Delaunay triangulation may divide the cell along its other diagonal. That moves the silhouette by half a cell.
TEST(Outlines, SimplifyingAGridKeepsItsSilhouetteToAFewCells) {
  const int n = 24;
  HeightFieldMesh front =
      test::grid_front({24, 24, n, n}, [](double x, double y) { return std::sin(x / 3) * y / 24; });
  for (const Triangle& t : front.triangles) {
    const Vec3 middle = (front.points[t[0]] + front.points[t[1]] + front.points[t[2]]) / 3;
    front.is_relief.push_back((middle.head<2>() - Vec2(12, 12)).norm() < 9);
  }
  const auto simpler = value_of(simplify(front, .05));
  const Solid full = test::plate_of(front, {5, 2, Outline::none}),
              body = test::plate_of(simpler.front, {5, 2, Outline::none});
  EXPECT_EQ(pieces(body), 1U);
  EXPECT_LT(body.triangles.size(), full.triangles.size());
  EXPECT_NEAR(flat_area(body), flat_area(full), 12);  // the whole area is 254
}

// The transform in the report must map each point of the outline to a corner of the solid, and the scan's
// lowest point to the ground. All outlines and forms are tested, with a scan far from the origin.
TEST(Outlines, TheReportTellsWhereTheScanLies) {
  Cloud cloud = two_pieces();
  for (Vec3& p : cloud.points) p = 3 * p + Vec3(4e6, -1e6, 250);
  const auto far = value_of(prepare(cloud, *parse_view("1,.2,2")));
  const Surface& surface = far.surface();
  for (const auto& [name, outline] : outline_choices)
    for (const Form form : {Form::relief, Form::mirror, Form::die}) {
      if (outline == Outline::none) continue;
      const auto made = value_of(make_relief(far, options_for(outline, form, false)));
      const ReliefReport& r = made.report;
      double lowest = 1e9;
      for (std::size_t i = 0; i < surface.points.size(); ++i) {
        const Vec3 p = test::place_of(surface, i);
        const Vec3 mm = r.scale * r.rotation * p + r.offset;
        lowest = std::min(lowest, mm.z());
        const bool is_inside = !surface.boundary.is_boundary[i];
        EXPECT_TRUE(is_inside || test::has_corner_at(made.solid, mm.head<2>(), 1e-6)) << name;
      }
      EXPECT_TRUE(form == Form::die || std::abs(lowest - made.solid.ground_mm) < 1e-6) << name << lowest;
    }
}

TEST(Outlines, OnlyTheRectangleIsTheBoxOfItsPoints) {
  const std::vector<Vec2> points = {{0, 0}, {4, 1}, {3, 3}};
  for (const auto& [name, outline] : outline_choices) {
    const std::vector<Vec2> polygon = outline_around(points, {outline, 1, 2});
    EXPECT_EQ(is_box(outline), polygon.size() == 4) << name;
  }
}

}  // namespace
}  // namespace relievo
