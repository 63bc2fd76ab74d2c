#include "relief/sliced_ell_matrix.h"

#include "support/same_bits.h"
#include "support/shapes.h"

namespace relievo {
namespace {

// Random points. Each point has 0 to 9 links to random points, and a slope and a height.
struct Linked {
  Groups<MatrixEntry> links;
  std::vector<Vec2f> slopes;
  std::vector<float> heights;

  explicit Linked(std::size_t n) {
    test::Random random(17);
    const auto number = [&] { return static_cast<float>(random.uniform(-1, 1)); };
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t count = random.bits() % 10; count > 0; --count)
        links.items.push_back({static_cast<Index>(random.bits() % n), {number(), number()}});
      links.begin.push_back(static_cast<Index>(links.items.size()));
      slopes.emplace_back(number(), number());
      heights.push_back(number());
    }
  }

  std::vector<float> divergence() const {
    std::vector<float> sums(heights.size(), -1.F);
    SlicedEllMatrix(links).divergence(slopes, sums);
    return sums;
  }

  std::vector<Vec3f> normals() const {
    std::vector<Vec3f> out(heights.size());
    SlicedEllMatrix(links).normals(heights, out);
    return out;
  }
};

class PointLinksOf : public testing::TestWithParam<std::size_t> {};

template <typename Real>
void expect_divergence(const Linked& linked, Real tolerance) {
  std::vector<Eigen::Vector2<Real>> slopes;
  for (const Vec2f& s : linked.slopes) slopes.push_back(s.cast<Real>());
  std::vector<Real> sums(slopes.size(), Real{-1});
  SlicedEllMatrix(linked.links).divergence(slopes, sums);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    Real expected = 0;
    for (const MatrixEntry& link : linked.links[i])
      expected += (slopes[i] + slopes[link.other]).dot(link.coefficient.cast<Real>());
    ASSERT_NEAR(sums[i], expected, tolerance);
  }
}

TEST_P(PointLinksOf, GiveTheDivergenceInBothPrecisions) {
  expect_divergence<float>(Linked(GetParam()), 1e-5F);
  expect_divergence<double>(Linked(GetParam()), 1e-14);
}

TEST_P(PointLinksOf, GiveNormals) {
  const Linked linked(GetParam());
  const std::vector<Vec3f> normals = linked.normals();
  for (std::size_t i = 0; i < normals.size(); ++i) {
    Vec3f expected = Vec3f::UnitZ();
    for (const MatrixEntry& link : linked.links[i])
      expected.head<2>() += linked.heights[link.other] * link.coefficient;
    ASSERT_LT((normals[i] - expected.normalized()).norm(), 1e-5F);
  }
}

TEST_P(PointLinksOf, GiveTheSameBitsForAnyThreadsAndInstructions) {
  const Linked linked(GetParam());
  const auto all = [&] { return std::pair(linked.divergence(), linked.normals()); };
  test::expect_same_for_any_threads(all);
  test::expect_same_without_avx2(all);
}

INSTANTIATE_TEST_SUITE_P(Sizes, PointLinksOf, testing::Values(0, 1, 7, 8, 9, 257, 5000),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace relievo
