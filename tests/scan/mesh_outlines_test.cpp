// Compares the outlines of meshes with closed forms of the shapes.
#include "scan/outlines/mesh_outlines.h"

#include "relievo/scan/surface.h"
#include "support/mesh_shapes.h"
#include "support/shapes.h"
#include "support/triangles.h"

namespace relievo {
namespace {

constexpr double pi = std::numbers::pi;

// The surface of points that were sampled on a mesh. The points are given relative to `centre`.
struct MeshSurface {
  Surface surface;
  Vec3 centre;  // in view coordinates

  MeshSurface(const Mesh& mesh, const View& view, double points)
      : surface(*find_surface(*sample_mesh(mesh, view, {points}), view)),
        centre(view.R_view_model * surface.centre) {}

  Vec2 place(Index i) const { return (surface.points[i] + centre).head<2>(); }
  double rho() const { return surface.rho; }

  // Calls f(from, to) for each edge that belongs to only one triangle inside the outline.
  template <typename F>
  void each_boundary_edge(F&& f) const {
    std::vector<std::array<Index, 2>> sides;
    for (std::size_t t = 0; t < surface.triangulation.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3 && surface.boundary.is_inside[t]; ++i) {
        const Triangle& c = surface.triangulation.triangles[t];
        sides.push_back({c[i], c[(i + 1) % 3]});
      }
    std::ranges::sort(sides);
    for (const auto& [a, b] : sides)
      if (!std::ranges::binary_search(sides, std::array<Index, 2>{b, a})) f(a, b);
  }

  // Returns the largest |offset(position)|, in rho, at the points of the boundary and the midpoints of the
  // boundary's edges.
  template <typename Offset>
  double farthest(Offset offset) const {
    double most = 0;
    each_boundary_edge([&](Index a, Index b) {
      for (const Vec2& p : {place(a), Vec2((place(a) + place(b)) / 2)})
        most = std::max(most, std::abs(offset(p)) / rho());
    });
    return most;
  }
};

Mesh two_buttons() {
  return test::joined(test::button_mesh(1, .15, 0, 720), test::button_mesh(.5, .075, .6, 720));
}

class MeshOutlines : public testing::TestWithParam<double> {};

TEST_P(MeshOutlines, OfASphereAreItsCircle) {
  const MeshSurface sphere(test::sphere_mesh(1, 720), View{}, GetParam());
  EXPECT_LT(sphere.farthest([](const Vec2& p) { return p.norm() - 1; }), .03);
}

TEST_P(MeshOutlines, OfButtonsAreCirclesWithAnEvenWall) {
  const MeshSurface buttons(two_buttons(), View{}, GetParam());
  EXPECT_LT(buttons.farthest([](const Vec2& p) { return p.norm() - 1.15; }), .03);
  std::array<double, 2> farthest = {0, 0};
  std::array<int, 2> count = {0, 0};
  for (Index i = 0; i < buttons.surface.points.size(); ++i) {
    const WallSide side = buttons.surface.boundary.wall_side[i];
    if (side == WallSide::none) continue;
    const std::size_t back = side == WallSide::back;
    const double off = (buttons.place(i).norm() - .575) / buttons.rho() - (back ? .15 : -.15);
    farthest[back] = std::max(farthest[back], std::abs(off));
    ++count[back];
  }
  EXPECT_LT(farthest[0], .03);
  EXPECT_LT(farthest[1], .03);
  const double all = 2 * pi * .575 / (.75 * buttons.rho());
  EXPECT_GT(count[0], .95 * all);
  EXPECT_GT(count[1], .95 * all);
}

TEST_P(MeshOutlines, OfATorusAreAtTheTubesRadiusFromAnEllipse) {
  const MeshSurface torus(test::torus_mesh(2, .5, 720), *view_towards({0, -1, 1}), GetParam());
  EXPECT_LT(
      torus.farthest([](const Vec2& p) { return test::distance_from_ellipse(p, 2, std::sqrt(2.)) - .5; }),
      .1);
}

constexpr int teeth = 12;
constexpr double root = .8, tip = 1;

double distance_from_gear(const Vec2& p) {
  const double sector = pi / teeth, angle = std::atan2(p.y(), p.x()) + 2 * pi;
  const bool is_tooth = std::fmod(std::floor(angle / sector), 2) == 0;
  double least = std::abs(p.norm() - (is_tooth ? tip : root));
  for (const double k : {std::floor(angle / sector), std::ceil(angle / sector)}) {
    const Vec2 ray(std::cos(k * sector), std::sin(k * sector));
    least = std::min(least, (p - std::clamp(p.dot(ray), root, tip) * ray).norm());
  }
  return least;
}

TEST_P(MeshOutlines, OfAGearKeepItsCorners) {
  const MeshSurface gear(test::gear_mesh(root, tip, teeth), View{}, GetParam());
  EXPECT_LT(gear.farthest(distance_from_gear), .1);
  double farthest = 0;
  for (int k = 0; k < 2 * teeth; ++k)
    for (const double radius : {root, tip}) {
      const Vec2 corner = radius * Vec2(std::cos(k * pi / teeth), std::sin(k * pi / teeth));
      double nearest = 1e9;
      gear.each_boundary_edge(
          [&](Index a, Index) { nearest = std::min(nearest, (gear.place(a) - corner).norm()); });
      farthest = std::max(farthest, nearest / gear.rho());
    }
  EXPECT_LT(farthest, .1);
}

TEST_P(MeshOutlines, LeaveNotchesOpen) {
  // There is a narrow gap between two sheets. In a cloud of points, a gap of this width would be closed.
  const auto sheet = [](double left, double right) {
    return Mesh{{{left, -1, 0}, {right, -1, 0}, {right, 1, 0}, {left, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  };
  const double gap = 3 * std::sqrt(4 / GetParam());
  const Mesh mesh = test::joined(sheet(-1, -.2), sheet(-.2 + gap, 1));
  const MeshSurface sheets(mesh, View{}, GetParam());
  const double area =
      test::inside_area(sheets.surface.points, sheets.surface.triangulation, sheets.surface.boundary);
  EXPECT_NEAR(area, 4 - 2 * gap, .05 * gap);
}

INSTANTIATE_TEST_SUITE_P(Sizes, MeshOutlines, testing::Values(20000, 100000));
// This test takes minutes, so it runs only with --gtest_also_run_disabled_tests.
INSTANTIATE_TEST_SUITE_P(DISABLED_Large, MeshOutlines, testing::Values(1000000));

TEST(SeenOutlines, EndWhereAnotherSurfaceHidesThem) {
  // A square hides the left half of a rectangle that is behind it.
  const auto square = [](double left, double z) {
    return Mesh{{{left, -1, z}, {left + 2, -1, z}, {left + 2, 1, z}, {left, 1, z}}, {{0, 1, 2}, {0, 2, 3}}};
  };
  Mesh behind = square(0, 0);
  behind.points[0].y() = behind.points[1].y() = -.5;
  behind.points[2].y() = behind.points[3].y() = .5;
  const Mesh mesh = test::joined(square(-1, 1), behind);
  double silhouette = 0, jump = 0;
  for (const OutlineSegment& s : seen_outlines(mesh.points, mesh.triangles, .01)) {
    (s.is_jump ? jump : silhouette) += (s.to - s.from).norm();
    if (s.is_jump) EXPECT_EQ(s.from.x(), 1);
  }
  EXPECT_NEAR(silhouette, 3 * 2 + 1 + 2 * 1 + 1, .03);
  EXPECT_NEAR(jump, 1, .02);
}

}  // namespace
}  // namespace relievo
