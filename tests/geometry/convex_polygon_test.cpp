#include <rapidcheck.h>

#include "geometry/plane.h"
#include "relievo/plate/outline.h"
#include "support/plate_fronts.h"

namespace relievo {
namespace {

using test::depth_in;
using test::polygon_area;

const std::vector<Vec2> box = {{0, 0}, {60, 0}, {60, 40}, {0, 40}};

TEST(Inset, OfARectangleIsARectangle) {
  const std::vector<Vec2> inner = inset(box, 5), outer = inset(box, -2);
  ASSERT_EQ(inner.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 inwards(box[i].x() > 0 ? -1 : 1, box[i].y() > 0 ? -1 : 1);
    EXPECT_LT((inner[i] - box[i] - 5 * inwards).norm(), 1e-12);
    EXPECT_LT((outer[i] - box[i] + 2 * inwards).norm(), 1e-12);
  }
  EXPECT_EQ(inset(box, 0), box);
}

TEST(Inset, LeavesOutSidesThatVanish) {
  const std::vector<Vec2> cut = {{1, 0}, {60, 0}, {60, 40}, {0, 40}, {0, 1}};
  EXPECT_EQ(inset(cut, .5).size(), 5U);
  EXPECT_EQ(inset(cut, 30.0 * (2 - std::sqrt(2.0))).size(), 4U);
}

// The result is the rectangle only to a micrometre, because polygons inside the arcs stand for the round
// corners, before and after the inset.
TEST(Inset, RoundCornersOfThatRadiusBecomeSharp) {
  const std::vector<Vec2> corners = {{0, 0}, {60, 40}};
  const std::vector<Vec2> rounded = outline_around(corners, {Outline::round, 5, 5});
  const std::vector<Vec2> inner = inset(rounded, 5);
  for (const Vec2& p : inner) EXPECT_NEAR(depth_in(box, p), 0, .001) << p.transpose();
  EXPECT_NEAR(polygon_area(inner), 60 * 40, .02);
}

TEST(Inset, EveryCornerIsAsFarInsideAsAsked) {
  EXPECT_TRUE(rc::check([] {
    const Outline outline = (*rc::gen::elementOf(outline_choices)).value;
    RC_PRE(outline != Outline::none);
    const std::vector<Vec2> points = test::ellipse(*rc::gen::inRange(3, 40), 30, *rc::gen::element(5., 29.));
    const std::vector<Vec2> polygon = outline_around(points, {outline, 4, 10});
    const double mm = *rc::gen::inRange(-200, 100) / 10.0;
    const std::vector<Vec2> moved = inset(polygon, mm);
    for (const Vec2& p : moved) RC_ASSERT(std::abs(depth_in(polygon, p) - mm) < 2e-4);
    if (mm <= 0) RC_ASSERT(moved.size() == polygon.size());
    // The inset removes no more than it should: the points are at least 10 inside the given polygon, so they
    // are at least 10 - mm inside the resulting polygon.
    for (const Vec2& p : points) RC_ASSERT(depth_in(moved, p) >= 10 - mm - 1e-3);
  }));
}

}  // namespace
}  // namespace relievo
