#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "relievo/geometry/triangulation.h"
#include "support/planar_points.h"

namespace relievo {
namespace {

using Points = std::vector<Vec2>;
constexpr Index none = no_index;

// A kite and its two triangulations; only the one with the short diagonal has empty circles.
const Points kite = {{-5, 0}, {0, -1}, {5, 0}, {0, 1}};
const Triangulation good = {{{0, 1, 3}, {1, 2, 3}}, {{1, none, none}, {none, 0, none}}, {0, 1, 2, 3}};
const Triangulation flipped = {{{0, 1, 2}, {0, 2, 3}}, {{none, 1, none}, {none, none, 0}}, {0, 1, 2, 3}};

bool is_rejected(const Points& points, const Triangulation& t, const std::string& complaint) {
  const std::string wrong = check_delaunay(points, t);
  EXPECT_TRUE(wrong.contains(complaint)) << "says: " << wrong;
  return !wrong.empty();
}

// Returns the good kite after an edit.
template <typename F>
Triangulation edited(F&& edit) {
  Triangulation t = good;
  edit(t);
  return t;
}

TEST(CheckDelaunay, AcceptsWhatIsRight) {
  EXPECT_EQ(check_delaunay(kite, good), "");
  EXPECT_EQ(check_delaunay(kite, edited([](auto& t) { t.hull = {2, 3, 0, 1}; })), "");
  EXPECT_EQ(check_delaunay({}, {}), "");
  EXPECT_EQ(check_delaunay(Points{{0, 0}, {1, 1}, {2, 2}}, {}), "");
  const Points square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(check_delaunay(square, good), "");
  EXPECT_EQ(check_delaunay(square, flipped), "");
}

TEST(CheckDelaunay, RejectsAFlippedEdge) {
  EXPECT_TRUE(is_rejected(kite, flipped, "inside its circle"));
}

TEST(CheckDelaunay, RejectsTurnedTriangles) {
  EXPECT_TRUE(is_rejected(kite, edited([](auto& t) { std::swap(t.triangles[1][0], t.triangles[1][1]); }),
                          "triangle 1: not counter-clockwise"));
  EXPECT_TRUE(is_rejected({{-5, 0}, {0, 0}, {5, 0}, {0, 1}}, flipped, "triangle 0: not counter-clockwise"));
}

TEST(CheckDelaunay, RejectsDroppedTriangles) {
  const auto dropped = edited([](auto& t) { t.triangles.pop_back(), t.neighbours.pop_back(); });
  EXPECT_TRUE(is_rejected(kite, dropped, "triangle 0: no such neighbour"));
  Triangulation unlinked = dropped;
  unlinked.neighbours[0][0] = none;
  EXPECT_TRUE(is_rejected(kite, unlinked, "edge 1 to 3 is not on the hull"));
  unlinked.hull = {0, 1, 3};
  EXPECT_TRUE(is_rejected(kite, unlinked, "point 2: in no triangle"));
  EXPECT_TRUE(is_rejected(kite, {}, "points 0, 1, 2 span one"));
  EXPECT_TRUE(is_rejected(kite, edited([](auto& t) { t.triangles.clear(); }), "without triangles"));
}

TEST(CheckDelaunay, RejectsWrongLinks) {
  EXPECT_TRUE(is_rejected(kite, edited([](auto& t) {
                            t.neighbours[0] = {none, 1, none};
                          }),
                          "is no neighbour"));
  EXPECT_TRUE(is_rejected(kite, edited([](auto& t) { t.neighbours[0][0] = 0; }), "is no neighbour"));
  EXPECT_TRUE(is_rejected(kite, edited([](auto& t) { t.neighbours[0][0] = 2; }), "no such neighbour"));
  EXPECT_TRUE(is_rejected(kite, edited([](auto& t) { t.neighbours.pop_back(); }), "as many neighbours"));
  EXPECT_TRUE(is_rejected(kite, edited([](auto& t) { t.triangles[0][0] = 4; }), "triangle 0: no such point"));
}

TEST(CheckDelaunay, RejectsWrongHulls) {
  const auto with_hull = [](std::vector<Index> hull) { return edited([&](auto& t) { t.hull = hull; }); };
  EXPECT_TRUE(is_rejected(kite, with_hull({}), "not on the hull"));
  EXPECT_TRUE(is_rejected(kite, with_hull({0, 1, 2}), "not on the hull"));
  EXPECT_TRUE(is_rejected(kite, with_hull({3, 2, 1, 0}), "not on the hull"));
  EXPECT_TRUE(is_rejected(kite, with_hull({0, 1, 2, 4}), "hull: no such point"));
  EXPECT_TRUE(is_rejected(kite, with_hull({0, 1, 2, 3, 0}), "appears twice"));

  // The border of these triangles has a notch: the triangle (0, 1, 2) is missing.
  const Points notched = {{-5, 0}, {0, 1}, {5, 0}, {0, 9}};
  EXPECT_TRUE(is_rejected(notched, good, "turns right at point 1"));
}

// Five triangles about a centre, each with its corners 144 degrees apart: every link, circle and turn is
// right, and so is Euler's relation, but they go round twice.
TEST(CheckDelaunay, RejectsAPentagram) {
  Points points = circle_points(5);
  points.emplace_back(0, 0);
  Triangulation t;
  for (Index k = 0; k < 5; ++k) {
    t.triangles.push_back({5, 2 * k % 5, 2 * (k + 1) % 5});
    t.neighbours.push_back({none, (k + 1) % 5, (k + 4) % 5});
    t.hull.push_back(2 * k % 5);
  }
  EXPECT_TRUE(is_rejected(points, t, "does not go round once"));
}

TEST(CheckDelaunay, RejectsWrongUseOfPoints) {
  Points points = kite;
  points.push_back(kite[2]);
  EXPECT_EQ(check_delaunay(points, good), "");
  const auto uses_the_twin = edited([](auto& t) { t.triangles[1] = {1, 4, 3}, t.hull = {0, 1, 4, 3}; });
  EXPECT_TRUE(is_rejected(points, uses_the_twin, "point 2: in no triangle"));
  points.back() = Vec2(std::nan(""), 0);
  EXPECT_TRUE(is_rejected(points, good, "point 4: coordinates out of range"));
}

// In general position the triangulation is unique, so any other number anywhere is wrong.
TEST(CheckDelaunay, RejectsAnyChangedNumber) {
  const Points points = random_points(60);
  const Triangulation right = delaunay(points);
  ASSERT_EQ(check_delaunay(points, right), "");
  const int count = static_cast<int>(right.triangles.size());
  ASSERT_TRUE(rc::check([&] {
    Triangulation t = right;
    const int triangle = *rc::gen::inRange(0, count), corner = *rc::gen::inRange(0, 3);
    Index* const targets[] = {&t.triangles[triangle][corner], &t.neighbours[triangle][corner],
                              &t.hull[triangle % t.hull.size()]};
    Index& target = *targets[*rc::gen::inRange(0, 3)];
    const Index value =
        *rc::gen::oneOf(rc::gen::inRange(Index{0}, static_cast<Index>(count)), rc::gen::just(none));
    RC_PRE(value != target);
    target = value;
    RC_ASSERT(check_delaunay(points, t) != "");
  }));
}

}  // namespace
}  // namespace relievo
