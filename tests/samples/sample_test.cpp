#include "relievo/samples/sample.h"

#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "samples/sample_shapes.h"
#include "support/results.h"
#include "support/same_bits.h"
#include "support/shapes.h"

namespace relievo {
namespace {

field::Solid solid_of(std::string_view name) {
  if (name == "shell") return field::shell();
  if (name == "still_life") return field::still_life();
  return field::green_man();
}

// Returns the sample without noise. Each sample is made only once.
const Cloud& exact(std::string_view name) {
  static std::map<std::string_view, Cloud> made;
  const auto [it, is_new] = made.try_emplace(name);
  if (is_new) it->second = *make_sample(name, {100000, 0});
  return it->second;
}

class Sample : public testing::TestWithParam<std::string_view> {};

TEST_P(Sample, HasThePointsAskedForAllFiniteWithUnitNormals) {
  for (const std::size_t n : {1000, 4097}) {
    const Cloud cloud = *make_sample(GetParam(), {n, 0.5});
    ASSERT_EQ(cloud.points.size(), n);
    ASSERT_EQ(cloud.normals.size(), n);
    for (const Vec3& p : cloud.points) ASSERT_TRUE(p.allFinite());
    for (const Vec3f& normal : cloud.normals) ASSERT_NEAR(normal.norm(), 1, 1e-6);
  }
}

TEST_P(Sample, HasTheSameBitsForAnyNumberOfThreads) {
  test::expect_same_for_any_threads([] {
    const Cloud cloud = *make_sample(GetParam(), {9000, 0.15});
    return std::pair(cloud.points, cloud.normals);
  });
}

TEST_P(Sample, LiesOnItsSurfaceWithOutwardNormals) {
  const field::Solid solid = solid_of(GetParam());
  const Cloud& cloud = exact(GetParam());
  const double step = 1e-5;
  int off_normals = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3& p = cloud.points[i];
    ASSERT_LT(std::abs(solid.value(p)), 1e-6);
    Vec3 gradient;  // by central differences, independently of the normals
    for (int axis = 0; axis < 3; ++axis)
      gradient[axis] = solid.value(p + step * Vec3::Unit(axis)) - solid.value(p - step * Vec3::Unit(axis));
    if (gradient.normalized().dot(cloud.normals[i].cast<double>()) < 0.9998) ++off_normals;  // over 1 degree
  }
  EXPECT_LT(off_normals, 300) << "only a point on a crease may have another normal";
}

TEST_P(Sample, StaysClearOfItsBox) {
  const Box box = solid_of(GetParam()).box, used = bounds(exact(GetParam()));
  EXPECT_GT((used.min - box.min).minCoeff(), 0.005);
  EXPECT_GT((box.max - used.max).minCoeff(), 0.005);
}

TEST_P(Sample, HasAFieldThatIsAtMostTheDistance) {
  const field::Solid solid = solid_of(GetParam());
  const Cloud& cloud = exact(GetParam());
  test::Random random(1);
  const auto unit = [&] { return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
  int too_high = 0;
  for (const Vec3& p : cloud.points) {
    const Vec3 q = p + std::pow(10, -3 * random.uniform()) * unit();
    if (std::abs(solid.value(q)) > 1.02 * (q - p).norm()) ++too_high;
  }
  EXPECT_LT(too_high, 500);
}

// A grid of side x side cells over the bounding box, as seen along z.
struct Plane {
  Box box;
  int side = 0;
  std::size_t cells() const { return static_cast<std::size_t>(side * side); }
  std::size_t cell(const Vec3& p) const {
    const Vec3 t = (p - box.min).cwiseQuotient(box.size()) * side;
    return static_cast<std::size_t>(static_cast<int>(t.y()) * side + static_cast<int>(t.x()));
  }
};

// Returns how often a ray along z enters or leaves the solid. The steps along the ray are so small that few
// crossings are missed.
int crossings(const field::Solid& solid, Vec3 p) {
  const double step = 0.002;
  int count = 0;
  bool was_inside = false;
  p.z() = solid.box.min.z();
  while (p.z() < solid.box.max.z()) {
    const double value = solid.value(p);
    count += (value < 0) != was_inside ? 1 : 0;
    was_inside = value < 0;
    p.z() += std::max(step, 0.7 * std::abs(value));
  }
  return count;
}

// Casts rays through the solid. Returns, for each cell, the number of crossings in it as a fraction of all crossings.
std::vector<double> shares_by_rays(const field::Solid& solid, const Plane& plane) {
  const std::size_t side = 120;
  std::vector<int> counts(side * side);
  const auto start = [&](std::size_t i) {
    const Vec3 t((static_cast<double>(i % side) + 0.5) / side, (static_cast<double>(i / side) + 0.5) / side,
                 0);
    return Vec3(solid.box.min + t.cwiseProduct(solid.box.size()));
  };
  parallel_for(
      counts.size(), [&](std::size_t i) { counts[i] = crossings(solid, start(i)); }, side);
  std::vector<double> shares(plane.cells(), 0);
  const int all = std::accumulate(counts.begin(), counts.end(), 0);
  for (std::size_t i = 0; i < counts.size(); ++i) shares[plane.cell(start(i))] += 1.0 * counts[i] / all;
  return shares;
}

// Computes the fractions of shares_by_rays() from a cloud. Each point represents an equal area of the
// surface. In the view plane this area is smaller by the factor |nz|.
std::vector<double> shares_by_points(const Cloud& cloud, const Plane& plane) {
  std::vector<double> shares(plane.cells(), 0);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    shares[plane.cell(cloud.points[i])] += std::abs(static_cast<double>(cloud.normals[i].z()));
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= all;
  return shares;
}

TEST_P(Sample, HasAsManyPointsAsRaysMeetSurface) {
  const field::Solid solid = solid_of(GetParam());
  const Plane plane{solid.box, 5};
  const std::vector<double> rays = shares_by_rays(solid, plane);
  const Cloud& cloud = exact(GetParam());
  const std::vector<double> points = shares_by_points(cloud, plane);
  for (std::size_t c = 0; c < plane.cells(); ++c) {
    const double chance = 4 * std::sqrt(points[c] / (0.4 * static_cast<double>(cloud.size())));
    EXPECT_NEAR(rays[c], points[c], 0.03 * points[c] + chance + 0.001) << "cell " << c;
  }
}

// Returns, for each pixel, the depths of the points in it that face the viewer.
std::map<std::pair<int, int>, std::vector<double>> facing_depths(const Cloud& cloud) {
  const double pixel = 0.04;
  std::map<std::pair<int, int>, std::vector<double>> depths;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.normals[i].z() < 0.3) continue;
    const Vec3& p = cloud.points[i];
    const std::pair at(static_cast<int>(std::floor(p.x() / pixel)),
                       static_cast<int>(std::floor(p.y() / pixel)));
    depths[at].push_back(p.z());
  }
  return depths;
}

TEST(StillLife, HasObjectsBehindOthers) {
  int hidden = 0, all = 0;
  for (auto& [at, z] : facing_depths(exact("still_life"))) {
    std::ranges::sort(z);
    int layers = 1;
    for (std::size_t i = 1; i < z.size(); ++i) layers += z[i] - z[i - 1] > 0.15 ? 1 : 0;
    hidden += layers > 1 ? 1 : 0;
    ++all;
  }
  EXPECT_GT(hidden, all / 10);
}

TEST(StillLife, StandsOnItsPlinth) {
  const Cloud& cloud = exact("still_life");
  const Box box = bounds(cloud);
  Box low, high;
  for (const Vec3& p : cloud.points) (p.y() < box.min.y() + 0.2 ? low : high).extend(p);
  EXPECT_EQ(low.size().x(), box.size().x());
  EXPECT_LT(high.size().x(), box.size().x());
}

TEST(GreenMan, LooksAtTheViewer) {
  const Cloud& cloud = exact("green_man");
  const auto by_depth = [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); };
  const Vec3 nose = *std::ranges::max_element(cloud.points, by_depth);
  EXPECT_LT(std::abs(nose.x()), 0.1);
  EXPECT_NEAR(nose.y(), -0.13, 0.1);
  const auto back = std::ranges::min_element(cloud.points, by_depth) - cloud.points.begin();
  EXPECT_LT(cloud.normals[static_cast<std::size_t>(back)].z(), -0.9F);
}

TEST(Shell, ShowsItsCoilToTheViewer) {
  const Vec3 size = bounds(exact("shell")).size();
  EXPECT_LT(size.z(), 0.6 * std::min(size.x(), size.y()));
}

TEST(MakeSample, NamesTheSamplesItKnows) {
  const Result<Cloud> cloud = make_sample("teapot");
  expect_error(cloud, ErrorKind::option);
  EXPECT_TRUE(cloud.error().message().contains("'teapot'"));
  for (const SampleInfo& info : samples()) {
    EXPECT_TRUE(cloud.error().expected.contains(info.name));
    EXPECT_FALSE(info.description.empty());
  }
}

TEST(MakeSample, RefusesOptionsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto error_of = [](const SampleOptions& options) {
    const auto sample = make_sample("shell", options);
    return sample ? Error{} : sample.error();
  };
  for (const std::size_t points : {std::size_t{0}, std::size_t{999}, std::size_t{100000001}}) {
    EXPECT_EQ(error_of({points, 0.15}).input, "points");
    EXPECT_EQ(error_of({points, 0.15}).kind, ErrorKind::option);
  }
  for (const double noise : {-0.01, 5.01, nan}) EXPECT_EQ(error_of({1000, noise}).input, "noise");
  EXPECT_EQ(error_of({12, 0.15}).message(), "points: expected 1000 to 100000000, found 12");
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> all;
  for (const SampleInfo& info : samples()) all.push_back(info.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Each, Sample, testing::ValuesIn(names()),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace relievo
