#include "relievo/sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "relievo/parallel.h"
#include "sample_shapes.h"

namespace relievo {
namespace {

field::Solid solid_of(std::string_view name) {
  if (name == "shell") return field::shell();
  if (name == "still_life") return field::still_life();
  return field::green_man();
}

Cloud exact(std::string_view name, std::size_t points) {
  return *make_sample(name, {points, 0});
}

// A small random stream, the same everywhere.
class Dice {
 public:
  double uniform() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }
  Vec3 in(const Box& box) {
    const Vec3 t(uniform(), uniform(), uniform());
    return box.min + t.cwiseProduct(box.size());
  }

 private:
  std::uint64_t state_ = 1;
};

class Sample : public testing::TestWithParam<std::string_view> {
 protected:
  void TearDown() override { set_thread_count(0); }
};

TEST_P(Sample, HasThePointsAskedForAllFiniteWithUnitNormals) {
  for (const std::size_t n : {1000, 4097, 30000}) {
    const Cloud cloud = *make_sample(GetParam(), {n, 0.5});
    ASSERT_EQ(cloud.points.size(), n);
    ASSERT_EQ(cloud.normals.size(), n);
    for (const Vec3& p : cloud.points) ASSERT_TRUE(p.allFinite());
    for (const Vec3f& normal : cloud.normals) ASSERT_NEAR(normal.norm(), 1, 1e-6);
  }
}

TEST_P(Sample, HasTheSameBitsForAnyNumberOfThreads) {
  set_thread_count(1);
  const Cloud alone = *make_sample(GetParam(), {20000, 0.15});
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    const Cloud cloud = *make_sample(GetParam(), {20000, 0.15});
    EXPECT_EQ(cloud.points, alone.points);
    EXPECT_EQ(cloud.normals, alone.normals);
  }
}

TEST_P(Sample, LiesOnItsSurfaceWithOutwardNormals) {
  const field::Solid solid = solid_of(GetParam());
  const Cloud cloud = exact(GetParam(), 20000);
  const double step = 1e-5;
  int off_normals = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3& p = cloud.points[i];
    ASSERT_LT(std::abs(solid.value(p)), 1e-6);
    Vec3 gradient;  // by central differences: not as the cloud's own
    for (int axis = 0; axis < 3; ++axis) {
      gradient[axis] = solid.value(p + step * Vec3::Unit(axis)) - solid.value(p - step * Vec3::Unit(axis));
    }
    if (gradient.normalized().dot(cloud.normals[i].cast<double>()) < 0.9998) ++off_normals;  // 1 degree
  }
  EXPECT_LT(off_normals, 60) << "only a point on a crease may have another normal";
}

TEST_P(Sample, StaysClearOfItsBox) {
  const Box box = solid_of(GetParam()).box, used = bounds(exact(GetParam(), 50000));
  EXPECT_GT((used.min - box.min).minCoeff(), 0.005);
  EXPECT_GT((box.max - used.max).minCoeff(), 0.005);
}

TEST_P(Sample, HasAFieldThatIsAtMostTheDistance) {
  const field::Solid solid = solid_of(GetParam());
  const Cloud cloud = exact(GetParam(), 20000);
  Dice dice;
  int too_high = 0;
  for (const Vec3& p : cloud.points) {
    const Vec3 q = p + std::pow(10, -3 * dice.uniform()) * (dice.in({-Vec3::Ones(), Vec3::Ones()}));
    if (std::abs(solid.value(q)) > 1.02 * (q - p).norm()) ++too_high;
  }
  EXPECT_LT(too_high, 100);
}

// Parallel rays in steps too small to miss much: the surface they meet, cell by cell of the view plane, must
// have its share of the points (each point standing for its area, the ray for the projected one).
TEST_P(Sample, HasThePointsWhereRaysMeetTheSurface) {
  const field::Solid solid = solid_of(GetParam());
  const std::size_t side = 5, rays = 10000;
  const double step = 0.004;
  const auto cell_of = [&](const Vec3& p) {
    const Vec3 t = (p - solid.box.min).cwiseQuotient(solid.box.size()) * static_cast<double>(side);
    return static_cast<std::size_t>(t.y()) * side + static_cast<std::size_t>(t.x());
  };
  Dice dice;
  std::vector<Vec3> starts(rays);
  for (Vec3& p : starts) p = dice.in(solid.box);
  std::vector<double> hits(rays, 0);
  parallel_for(
      rays,
      [&](std::size_t i) {
        Vec3 p = starts[i];
        bool was_inside = false;
        for (p.z() = solid.box.min.z(); p.z() < solid.box.max.z(); p.z() += step) {
          const bool is_inside = solid.value(p) < 0;
          hits[i] += is_inside != was_inside ? 1 : 0;
          was_inside = is_inside;
        }
      },
      64);
  std::vector<double> met(side * side, 0), cast(side * side, 0), stood_for(side * side, 0);
  for (std::size_t i = 0; i < rays; ++i) met[cell_of(starts[i])] += hits[i];
  const Cloud cloud = exact(GetParam(), 100000);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    stood_for[cell_of(cloud.points[i])] += std::abs(static_cast<double>(cloud.normals[i].z()));
  }
  double all_met = 0, all_stood = 0;
  for (std::size_t c = 0; c < met.size(); ++c) all_met += met[c], all_stood += stood_for[c];
  for (std::size_t c = 0; c < met.size(); ++c) {
    EXPECT_NEAR(met[c] / all_met, stood_for[c] / all_stood, 0.004) << "cell " << c;
  }
}

// In a pixel, points that face the viewer at clearly different depths: how many such layers there are.
std::map<std::pair<int, int>, std::vector<double>> facing_depths(const Cloud& cloud) {
  const double pixel = 0.03;
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
  for (auto& [at, z] : facing_depths(exact("still_life", 100000))) {
    std::ranges::sort(z);
    int layers = 1;
    for (std::size_t i = 1; i < z.size(); ++i) layers += z[i] - z[i - 1] > 0.15 ? 1 : 0;
    hidden += layers > 1 ? 1 : 0;
    ++all;
  }
  EXPECT_GT(hidden, all / 10);
}

TEST(StillLife, StandsOnItsPlinth) {
  const Cloud cloud = exact("still_life", 20000);
  const Box box = bounds(cloud);
  Box low, high;
  for (const Vec3& p : cloud.points) (p.y() < box.min.y() + 0.2 ? low : high).extend(p);
  EXPECT_EQ(low.size().x(), box.size().x());
  EXPECT_LT(high.size().x(), box.size().x());
}

TEST(GreenMan, LooksAtTheViewer) {
  const Cloud cloud = exact("green_man", 20000);
  const auto by_depth = [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); };
  const Vec3 nose = *std::ranges::max_element(cloud.points, by_depth);
  EXPECT_LT(std::abs(nose.x()), 0.1);
  EXPECT_NEAR(nose.y(), -0.13, 0.1);
  const auto back = std::ranges::min_element(cloud.points, by_depth) - cloud.points.begin();
  EXPECT_LT(cloud.normals[static_cast<std::size_t>(back)].z(), -0.9F);
}

TEST(Shell, ShowsItsCoilToTheViewer) {
  const Vec3 size = bounds(exact("shell", 20000)).size();
  EXPECT_LT(size.z(), 0.6 * std::min(size.x(), size.y()));
}

TEST(MakeSample, NamesTheSamplesItKnows) {
  const Result<Cloud> cloud = make_sample("teapot");
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().kind, ErrorKind::option);
  EXPECT_NE(cloud.error().message().find("'teapot'"), std::string::npos);
  for (const SampleInfo& info : samples()) {
    EXPECT_NE(cloud.error().expected.find(info.name), std::string::npos);
    EXPECT_FALSE(info.description.empty());
  }
}

TEST(MakeSample, RefusesOptionsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto error_of = [](const SampleOptions& options) { return make_sample("shell", options).error(); };
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
