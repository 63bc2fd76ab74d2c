// Tests which points of a scene are visible, and the relief that is made from these points.
#include "relievo/io/write.h"
#include "relievo/make_relief.h"

#include <rapidcheck.h>

#include "relievo/scan/spacing.h"
#include "relievo/scan/surface.h"
#include "support/plate_fronts.h"
#include "support/same_bits.h"
#include "support/scene_parts.h"
#include "support/triangles.h"

namespace relievo {
namespace {

using namespace test;

Surface surface_of(const Scene& scene, double points = 30000) {
  return value_of(find_surface(*seen(scene, points).cloud, front));
}

double inner_area(const Surface& surface) {
  return inside_area(surface.points, surface.triangulation, surface.boundary);
}

TEST(SeenScene, OfOneModelUnplacedIsThatModel) {
  const SceneModel cloud = model_of(test::torus(20000, 1, .4)), mesh = model_of(wedge());
  ReliefOptions options{{.points = 5000}};
  for (const SceneModel& model : {cloud, mesh}) {
    const auto alone = value_of(make_relief(*model.file, options)),
               scene = value_of(make_relief(Scene{{model}}, options));
    EXPECT_EQ(write_stl(alone.solid), write_stl(scene.solid));
    EXPECT_EQ(alone.report.sample, scene.report.sample);
  }
}

// Returns a level square of 2 x side x side triangles.
Mesh sheet(int side) {
  const HeightFieldMesh front = flat_front({1. * side, 1. * side, side, side});
  return {front.points, front.triangles};
}

TEST(SeenScene, TakesFewerPointsOfMeshesOfFewTriangles) {
  const View front;
  for (const auto& [side, usual] : {std::pair{1, 1e5}, {80, 15.0 * 2 * 80 * 80}, {110, 3e5}}) {
    const Scene scene{{model_of(sheet(side))}};
    EXPECT_EQ(usual_points(scene), usual) << side;
    const auto sample = value_of(sample_for_view(scene, front, {}));
    EXPECT_NEAR(static_cast<double>(sample.cloud->size()), usual, .02 * usual) << side;
    const auto asked = value_of(sample_for_view(scene, front, 2e4));
    EXPECT_NEAR(static_cast<double>(asked.cloud->size()), 2e4, .05 * 2e4) << side;
  }
  const SceneModel mesh = model_of(sheet(1)), cloud = model_of(test::sphere(1000, 1));
  EXPECT_EQ(usual_points(Scene{{mesh, mesh}}), 1e5);
  EXPECT_EQ(usual_points(Scene{{mesh, cloud}}), 3e5);
}

// Returns the file with its points, mesh and normals transformed to the scene's coordinates.
CloudFile baked(const CloudFile& file, const PlacedModel& place, bool is_mirrored) {
  CloudFile made = file;
  for (Vec3& p : made.cloud.points) p = place(p);
  for (Vec3& p : made.mesh.points) p = place(p);
  for (Vec3f& n : made.cloud.normals) n = place.turn.cast<float>() * n;
  if (is_mirrored)
    for (Triangle& t : made.mesh.triangles) std::swap(t[1], t[2]);
  return made;
}

TEST(SeenScene, PlacingThenSeeingIsSeeingWhatWasPlaced) {
  const Scene scene{{model_of(test::torus(20000, 1, .4), at(0, 0, 0, {40, 0, 10})),
                     model_of(wedge(), {{10, 20, 30}, Vec3(1, .5, -1), .4, true}),
                     model_of(test::sphere(1500, .5), at(-1, 1, .5))}};
  const std::vector<PlacedModel> places = placed(scene);
  Scene ready;
  for (std::size_t i = 0; i < places.size(); ++i) {
    CloudFile file = baked(*scene.models[i].file, places[i], scene.models[i].pose.is_mirrored);
    ready.models.push_back({"baked", std::make_shared<const CloudFile>(std::move(file)), at(0, 0, 0)});
  }
  const ViewSample a = seen(scene), b = seen(ready);
  ASSERT_EQ(a.cloud->size(), b.cloud->size());
  for (std::size_t i = 0; i < a.cloud->size(); ++i) {
    ASSERT_TRUE(a.cloud->points[i].isApprox(b.cloud->points[i], 1e-6)) << i;
    ASSERT_LT((a.cloud->normals[i] - b.cloud->normals[i]).norm(), 1e-4F) << i;
  }
}

TEST(SeenScene, OrderOfModelsDoesNotMatter) {
  std::vector<SceneModel> models{model_of(test::torus(20000, 1, .4), at(0, 0, 0)),
                                 model_of(test::sphere(16000, .7), at(.8, .2, -.5)),
                                 model_of(test::cylinder(9000, .3, 2), at(-.6, 0, .9))};
  const Surface one = surface_of({models});
  std::ranges::rotate(models, models.begin() + 1);
  const Surface other = surface_of({models});
  EXPECT_EQ(one.points, other.points);
  EXPECT_EQ(one.normals, other.normals);
  EXPECT_EQ(one.curvature.k, other.curvature.k);
}

TEST(SeenScene, WhatIsBehindAnotherModelDoesNotShow) {
  const SceneModel ball = model_of(test::sphere(40000, 1), at(0, 0, 0));
  const Surface alone = surface_of({{ball}});
  const Surface both = surface_of({{ball, model_of(test::sphere(8000, .45), at(.2, -.1, -4))}});
  EXPECT_TRUE(std::ranges::all_of(both.points, [&](const Vec3& p) { return (p + both.centre).z() > -1; }));
  EXPECT_NEAR(static_cast<double>(both.visible_points), static_cast<double>(alone.visible_points),
              .005 * static_cast<double>(alone.visible_points));
  EXPECT_NEAR(inner_area(both), inner_area(alone), .002 * inner_area(alone));
}

TEST(SeenScene, MeshesHideEachOther) {
  Mesh wall{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const ViewSample both = seen({{model_of(wall, at(0, 0, 1)), model_of(wall, at(.5, 0, -1))}}, 5000);
  for (std::size_t i = 0; i < both.cloud->size(); ++i) {
    const Vec3& p = both.cloud->points[i];
    EXPECT_EQ(p.z() > 0, p.x() < 1.001) << p.transpose();
  }
}

// The spacing of the points of a ball, and the mean error of their normals: the angle between a
// normal and the direction from the ball's centre.
struct Look {
  double spacing = 0, angle_deg = 0;
};

Look look_at_ball(const Cloud& cloud, const Vec3& centre, double radius) {
  Cloud own;
  double sum = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3 radial = cloud.points[i] - centre;
    if (radial.norm() > 1.2 * radius || radial.z() < .5 * radius) continue;
    own.points.push_back(cloud.points[i]);
    const double cosine = radial.normalized().dot(cloud.normals[i].cast<double>());
    sum += std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
  }
  return {measure_spacing(own).rho, sum / static_cast<double>(std::max<std::size_t>(1, own.size()))};
}

TEST(SeenScene, CoarseAndFineCloudsGetOneSpacing) {
  const Scene scene{{model_of(test::sphere(150000, 1), at(0, 0, 0)),
                     model_of(test::sphere(30000, 1), at(3, 0, 0)),
                     model_of(test::sphere(3000, 1), at(6, 0, 0))}};
  const ViewSample together = seen(scene, 20000);
  std::vector<Look> looks;
  for (const double x : {0, 3, 6}) looks.push_back(look_at_ball(*together.cloud, {x, 0, 0}, 1));
  for (const Look& look : looks) {
    EXPECT_NEAR(look.spacing, looks[1].spacing, .25 * looks[1].spacing);
    EXPECT_LT(look.angle_deg, 1);
  }
  EXPECT_EQ(together.notes.size(), 2U);
  const Surface surface = surface_of(scene, 20000);
  EXPECT_NEAR(inner_area(surface), 3 * std::numbers::pi, .03 * 3 * std::numbers::pi);
}

TEST(SeenScene, CloudsAreAsFineAsTheFinestUnlessThatIsTooMany) {
  const Scene scene{
      {model_of(test::sphere(30000, 1), at(0, 0, 0)), model_of(test::sphere(3000, 1), at(3, 0, 0))}};
  const double own = measure_spacing(scene.models[0].file->cloud).rho;
  for (const double x : {0, 3})
    EXPECT_NEAR(look_at_ball(*seen(scene, 1e6).cloud, {x, 0, 0}, 1).spacing, own, .2 * own);
  const Cloud fewer = *seen(scene, 1500).cloud;
  for (const double x : {0, 3})
    EXPECT_NEAR(look_at_ball(fewer, {x, 0, 0}, 1).spacing, std::sqrt(2 * std::numbers::pi / 1500), .01);
}

TEST(SeenScene, NormalsAreSettledModelByModel) {
  const Cloud ball = test::sphere(20000, 1);
  const Scene scene{{model_of(inside_out(ball), at(0, 0, 0)), model_of(without_normals(ball), at(3, 0, 0)),
                     model_of(ball, at(6, 0, 0))}};
  const ViewSample together = seen(scene);
  for (const double x : {0, 3, 6}) EXPECT_LT(look_at_ball(*together.cloud, {x, 0, 0}, 1).angle_deg, 1);
  ASSERT_EQ(together.notes.size(), 2U);
  EXPECT_EQ(together.notes[0].kind, SampleNote::Kind::turned_normals);
  EXPECT_EQ(together.notes[1].kind, SampleNote::Kind::estimated_normals);
}

TEST(SeenScene, ModelsWithoutColoursAreWhiteBesideOthers) {
  Cloud red = test::sphere(5000, 1);
  red.colours.assign(red.size(), {200, 0, 0});
  Mesh blue = wedge();
  blue.colours.assign(blue.points.size(), {0, 0, 200});
  const ViewSample together = seen({{model_of(test::sphere(5000, 1), at(0, 0, 0)), model_of(red, at(3, 0, 0)),
                                     model_of(wedge(), at(6, 0, 0)), model_of(blue, at(12, 0, 0))}});
  ASSERT_EQ(together.cloud->colours.size(), together.cloud->size());
  for (std::size_t i = 0; i < together.cloud->size(); ++i) {
    const double x = together.cloud->points[i].x();
    const Colour expected = x < 1.5   ? Colour{255, 255, 255}
                            : x < 4.5 ? Colour{200, 0, 0}
                            : x < 10  ? Colour{255, 255, 255}
                                      : Colour{0, 0, 200};
    ASSERT_EQ(together.cloud->colours[i], expected) << x;
  }
  EXPECT_FALSE(seen({{model_of(wedge()), model_of(wedge())}}).cloud->has_colours());
}

TEST(SeenScene, StraysGoModelByModel) {
  Cloud cloud = test::sphere(5000, 1);
  test::add(cloud, {60, 0, 0}, {1, 0, 0});
  const ViewSample together =
      seen({{model_of(cloud, at(0, 0, 0)), model_of(test::sphere(5000, 1), at(60, 0, 0))}});
  EXPECT_EQ(together.left_out, 1U);
  EXPECT_EQ(together.cloud->size(), 10000U);
}

TEST(SeenScene, SaysWhichModelIsNoSurface) {
  Cloud dot;
  for (int i = 0; i < 20; ++i) test::add(dot, {1, 1, 1}, Vec3::UnitZ());
  SceneModel model = model_of(dot);
  model.name = "dot.ply";
  expect_error(sample_for_view(Scene{{model_of(test::sphere(5000, 1), at(0, 0, 0)), model}}, front, 1000),
               "dot.ply: expected ");
}

TEST(SeenScene, RefusesTooFewPoints) {
  const Scene scene{{model_of(test::sphere(5000, 1)), model_of(test::sphere(3, 1))}};
  EXPECT_EQ(message_of(sample_for_view(scene, front, 1000)), "cloud: expected at least 4 points, found 3");
  expect_error(sample_for_view(scene, front, 0), ErrorKind::option);
}

TEST(SeenScene, CanBeCancelled) {
  Cancelled progress;
  const Scene scene{{model_of(wedge()), model_of(wedge())}};
  expect_error(sample_for_view(scene, front, 1000, &progress), ErrorKind::cancelled);
}

TEST(SceneRelief, IsTheSameForAnyNumberOfThreads) {
  const Scene scene{{model_of(test::torus(20000, 1, .4), at(0, 0, 0, {30, 0, 0})),
                     model_of(wedge(), at(0, 0, 0)), model_of(test::sphere(2000, 1), at(1, 1, 0))}};
  ReliefOptions options{{.points = 10000}};
  expect_same_for_any_threads([&] { return write_stl(value_of(make_relief(scene, options)).solid); });
}

// One ball is in front of another one. The relief must have no wall at the depth jump between them.
TEST(SceneRelief, NoWallStandsBetweenModels) {
  const Scene scene{
      {model_of(test::sphere(60000, 1), at(0, 0, 0)), model_of(test::sphere(60000, 1), at(.9, 0, -8))}};
  ReliefOptions options{{.width_mm = 100, .height_mm = 4}};
  const auto made = value_of(make_relief(scene, options));
  EXPECT_EQ(check_solid(made.solid), "");
  double steepest = 0;
  for (std::size_t t = 0; t < made.solid.front_triangles; ++t) {
    const auto& [a, b, c] = made.solid.triangles[t];
    const Vec3 p = made.solid.points[b] - made.solid.points[a],
               q = made.solid.points[c] - made.solid.points[a];
    for (const Vec3& edge : {p, q}) steepest = std::max(steepest, std::abs(edge.z()));
  }
  // `steepest` is the largest height difference, in mm, between the two ends of an edge; two edges of each
  // triangle are measured. Edges on the balls are only a fraction of a millimetre long, so their ends differ
  // little in height. The depths of the balls differ by more than the width of the relief. So a wall between
  // the balls would be almost as high as the whole relief, 4 mm.
  EXPECT_LT(steepest, 1.0);
}

}  // namespace
}  // namespace relievo
