#include "relievo/relief/subspace.h"

#include "relief/subspace/control_mesh.h"
#include "relievo/io/read.h"
#include "relievo/samples/sample.h"
#include "support/differences.h"
#include "support/same_bits.h"
#include "support/shared_scans.h"
#include "support/surfaces.h"
#include "support/triangles.h"

namespace relievo {
namespace {

using test::bumps_behind_a_ring, test::surface_of;

const Compression keep_all{std::numeric_limits<double>::infinity(), 0};

SubspaceModel subspace_of(const Surface& surface, std::size_t control_points = 2000) {
  SubspaceOptions options;
  options.control.count = control_points;
  return SubspaceModel::prepare(surface, options).value();
}

std::vector<float> heights_of(const Surface& surface, const SubspaceModel& model, const Shape& shape) {
  const std::vector<float> boundary_weight = boundary_weights(surface.boundary.distance, surface.rho);
  SubspaceModel::Workspace workspace = model.make_workspace();
  std::vector<float> heights(model.size());
  model.solve(shape, boundary_weight, workspace);
  model.carry(boundary_weight, workspace, heights);
  return heights;
}

float span_of(const std::vector<float>& heights) {
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  return *high - *low;
}

// Returns the largest root mean square error of several reliefs, each as a fraction of the height of its
// relief. The reliefs range from high to very low, and their compression is even or uneven.
double worst_error(const Surface& surface, const SubspaceModel& subspace,
                   std::initializer_list<double> betas = {0, .01, 1}) {
  const ReliefModel exact = ReliefModel::prepare(surface).value();
  double worst = 0;
  for (const double beta : betas) {
    for (const double u : {1.0, .2, .05}) {
      const Shape shape{{u, beta}};
      const Relief relief = exact.make(shape);
      worst = std::max(worst, test::root_mean_square(heights_of(surface, subspace, shape), relief.heights) /
                                  relief.height);
    }
  }
  return worst;
}

TEST(Subspace, OfAPlaneIsFlat) {
  const Surface surface = surface_of(test::sheet(5000, 1, 2));
  const SubspaceModel model = subspace_of(surface, 300);
  for (const double u : {0.0, .5, keep_all.u}) EXPECT_EQ(span_of(heights_of(surface, model, {{u, 0}})), 0);
}

TEST(Subspace, IsFlatWhereNothingIsKept) {
  const Cloud tilted = test::height_field(
      5000, 1, [](double x, double) { return .5 * x; }, [](double, double) { return Vec2(.5, 0); });
  const Surface surface = surface_of(tilted);
  EXPECT_NEAR(span_of(heights_of(surface, subspace_of(surface, 300), {{0, 0}})), 0, 1e-6);
}

TEST(Subspace, KeptInFullIsTheReference) {
  const Surface surface = surface_of(bumps_behind_a_ring());
  const Relief exact = ReliefModel::prepare(surface)->make({keep_all});
  const std::vector<float> heights = heights_of(surface, subspace_of(surface), {keep_all});
  EXPECT_LE(test::largest_difference(heights, exact.heights), 1e-5 * exact.height);
}

TEST(Subspace, TakesReferenceHeightsThatAreKnown) {
  const Surface surface = surface_of(bumps_behind_a_ring());
  const std::vector<double> z0 = ReliefModel::prepare(surface)->make({keep_all, 0}).heights;
  const Shape shape{{.3, .5}, .02};
  EXPECT_EQ(heights_of(surface, *SubspaceModel::prepare(surface, {}, {z0, {}}), shape),
            heights_of(surface, *SubspaceModel::prepare(surface), shape));
}

TEST(Subspace, StandsOnTheBaseAtItsBoundary) {
  const Surface surface = surface_of(bumps_behind_a_ring());
  const std::vector<float> heights = heights_of(surface, subspace_of(surface), {{.5, 1}});
  for (std::size_t i = 0; i < heights.size(); ++i)
    ASSERT_TRUE(!surface.boundary.is_boundary[i] || heights[i] == 0);
}

// The first error is 1.02 %, because rows of points stand beside the outlines. With scattered points alone,
// it would be below 1 %.
TEST(Subspace, IsCloseToTheExactReliefOfAFigure) {
  const Surface surface = surface_of(bumps_behind_a_ring());
  EXPECT_LT(worst_error(surface, subspace_of(surface, 8000)), .012);
  EXPECT_LT(worst_error(surface, subspace_of(surface, 2000)), .02);
}

TEST(Subspace, IsCloseToTheExactReliefOfASphere) {
  const Surface surface = surface_of(test::sphere(60000, 1));
  EXPECT_LT(worst_error(surface, subspace_of(surface, 1000)), .01);
}

// If every point is a control point and slopes are not averaged, only the spline of the offset is approximate
// (see SubspaceModel). So the relief must be nearly exact.
TEST(Subspace, IsTheExactReliefWhereAllPointsAreControlPoints) {
  const Surface surface = surface_of(test::sphere(10000, 1));
  SubspaceOptions options{.normals_per_point = 1};
  options.control.count = surface.points.size();
  const SubspaceModel model = SubspaceModel::prepare(surface, options).value();
  EXPECT_LT(worst_error(surface, model), .003);
}

class SubspaceSample : public testing::TestWithParam<const char*> {};

TEST_P(SubspaceSample, IsCloseToTheExactRelief) {
  const Surface surface = surface_of(make_sample(GetParam(), {150000}).value());
  const SubspaceModel subspace = subspace_of(surface, 8000);
  EXPECT_LT(worst_error(surface, subspace), .02);
  EXPECT_LT(worst_error(surface, subspace, {5}), .027);  // neighbouring weights differ most at this beta
}

INSTANTIATE_TEST_SUITE_P(All, SubspaceSample, testing::Values("still_life", "green_man", "shell"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Subspace, IsCloseToTheExactReliefOfCleanScans) {
  for (const char* name : {"armadillo", "igea", "horse", "nefertiti", "falcon", "gutenberg"}) {
    const std::string file = std::string(name) + ".ply";
    if (!test::has_shared(file)) GTEST_SKIP() << test::missing_scan(file);
    const Surface surface = surface_of(value_of(read_cloud(test::shared_bytes(file), name)).cloud);
    EXPECT_LT(worst_error(surface, subspace_of(surface, 8000)), .02) << name;
  }
}

TEST(Subspace, ScalesWithTheCloud) {
  Cloud cloud = bumps_behind_a_ring();
  const auto heights = [&cloud] {
    const Surface surface = surface_of(cloud);
    return heights_of(surface, subspace_of(surface), {{.3, .5}});
  };
  const std::vector<float> before = heights();
  for (Vec3& p : cloud.points) p *= 1024;
  const std::vector<float> scaled = heights();
  for (std::size_t i = 0; i < before.size(); ++i)
    ASSERT_NEAR(scaled[i] / 1024, before[i], 1e-5F * span_of(before));
}

TEST(Subspace, RemembersNothingOfTheReliefBefore) {
  const Surface surface = surface_of(bumps_behind_a_ring());
  const SubspaceModel model = subspace_of(surface);
  const std::vector<float> weight = boundary_weights(surface.boundary.distance, surface.rho);
  SubspaceModel::Workspace used = model.make_workspace();
  std::vector<float> z(model.size());
  for (const Shape& shape : {Shape{{3, 0}}, Shape{{.3, 1}}}) {
    model.solve(shape, weight, used);
    model.carry(weight, used, z);
  }
  EXPECT_EQ(z, heights_of(surface, model, {{.3, 1}}));
}

TEST(Subspace, HasTheSameBitsForAnyNumberOfThreads) {
  const Surface surface = surface_of(bumps_behind_a_ring());
  test::expect_same_for_any_threads([&] { return heights_of(surface, subspace_of(surface), {{.3, .01}}); });
}

TEST(Subspace, CanBeCancelled) {
  Cancelled progress;
  expect_error(SubspaceModel::prepare(surface_of(test::sheet(3000, 1, 0)), {}, {}, &progress),
               ErrorKind::cancelled);
}

// Returns about `count` control points of a surface, and their mesh.
std::pair<ControlPoints, ControlMesh> control_mesh(const Surface& surface, std::size_t count) {
  const ControlPoints control =
      grow_control_points(in_plane(surface.points), surface.boundary.distance, {count});
  return {control, mesh_control_points(surface, control)};
}

// The inside triangles must not cover the hole of the torus, but must cover everything else.
TEST(ControlMesh, LeavesHolesOut) {
  const Surface surface = surface_of(test::torus(60000, 1.5, .5));
  const auto [control, mesh] = control_mesh(surface, 1000);
  for (std::size_t t = 0; t < mesh.triangulation.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangulation.triangles[t];
    if (!mesh.boundary.is_inside[t]) continue;
    ASSERT_GT(((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3).norm(), .9);
  }
  const double area = test::inside_area(mesh.points, mesh.triangulation, mesh.boundary);
  EXPECT_NEAR(area, std::numbers::pi * (2 * 2 - 1 * 1), .02 * area);
}

TEST(ControlMesh, HoldsItsPointsOnTheSurfacesBoundary) {
  const Surface surface = surface_of(test::torus(20000, 1.5, .5));
  const auto [control, mesh] = control_mesh(surface, 500);
  for (std::size_t c = 0; c < control.boundary_points; ++c) ASSERT_TRUE(mesh.boundary.is_boundary[c]);
}

// Three of four points are in the left half. Still, the samples must be evenly distributed over the area.
TEST(RegionSamples, StandForEqualAreas) {
  test::Random random(5);
  Cloud crowded;
  while (crowded.size() < 40000) {
    const double x = random.uniform(-1, 1);
    if (x > 0 && random.uniform() < 2 / 3.0) continue;
    test::add(crowded, {x, random.uniform(-1, 1), 0}, {0, 0, 1});
  }
  const Surface surface = surface_of(crowded);
  // There is only one control point, so its region consists of all points.
  const ControlPoints control{{0}, 0, 10};
  const std::vector<Index> samples = sample_regions(surface, control, 1000);
  ASSERT_EQ(samples.size(), 1000U);
  const auto left =
      std::count_if(samples.begin(), samples.end(), [&](Index i) { return surface.points[i].x() < 0; });
  EXPECT_NEAR(static_cast<double>(left), 500, 15);
}

}  // namespace
}  // namespace relievo
