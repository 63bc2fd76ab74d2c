#include "solver/order_pull.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace relievo::solver {
namespace {

constexpr std::size_t columns = 23, rows = 17, nodes = columns * rows;

std::vector<float> random_field(unsigned seed, float scale) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> any(-scale, scale);
  std::vector<float> field(nodes);
  for (float& value : field) value = any(random);
  return field;
}

// Returns random depths with a step in the middle.
std::vector<float> depths() {
  std::vector<float> depth = random_field(1, .3F);
  for (std::size_t n = 0; n < nodes; ++n)
    if (n % columns > columns / 2) depth[n] += 2;
  return depth;
}

// Returns, for each node, the share of the pull that acts on it. The shares increase to the right,
// and are 0 in one corner.
std::vector<float> shares() {
  std::vector<float> share(nodes);
  for (std::size_t n = 0; n < nodes; ++n)
    share[n] = n % columns < 3 && n / columns < 4 ? 0 : .3F + .03F * static_cast<float>(n % columns);
  return share;
}

constexpr std::array<float, 2> distances{2, 4.6F};
constexpr float saturation = .7F;
constexpr OrderLimits limits{.4F, .3F};

// Computes the energy of the pull by its definition. The energy is a sum over all pairs of nodes at one of
// the given distances, along a row, a column or a diagonal; positions are rounded to nodes.
double energy(const std::vector<float>& depth, const std::vector<float>& heights) {
  const std::vector<float> share_of = shares();
  double sum = 0;
  for (const double distance : distances)
    for (const auto& [x, y] :
         {std::pair(1., 0.), {0., 1.}, {std::sqrt(.5), std::sqrt(.5)}, {std::sqrt(.5), -std::sqrt(.5)}})
      for (int i = 0; i < static_cast<int>(nodes); ++i) {
        const int at_x = i % int{columns} + static_cast<int>(std::lround(distance * x)),
                  at_y = i / int{columns} + static_cast<int>(std::lround(distance * y));
        if (at_x < 0 || at_y < 0 || at_x >= int{columns} || at_y >= int{rows}) continue;
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(at_x + at_y * int{columns});
        const double nearer = static_cast<double>(depth[a]) - static_cast<double>(depth[b]),
                     share = static_cast<double>(share_of[a] * share_of[b]);
        if (share == 0) continue;
        const double wanted = share * static_cast<double>(limits.height) *
                              std::tanh(std::abs(nearer) / double{saturation}),
                     rise = (static_cast<double>(heights[a]) - static_cast<double>(heights[b])) *
                            (nearer > 0 ? 1 : -1);
        sum += std::pow(std::max(wanted - rise, 0.), 2);
      }
  return double{limits.stiffness} / 2 * sum;
}

std::vector<float> sum_of(const std::vector<float>& a, const std::vector<float>& b) {
  std::vector<float> sum = a;
  for (std::size_t n = 0; n < nodes; ++n) sum[n] += b[n];
  return sum;
}

struct Bound {
  std::vector<float> load = std::vector<float>(nodes), hold = load, lack = load;

  double at(const std::vector<float>& b) const {
    double sum = 0;
    for (std::size_t n = 0; n < nodes; ++n) {
      const auto x = static_cast<double>(b[n]);
      sum += static_cast<double>(hold[n]) * x * x / 2 - static_cast<double>(load[n]) * x;
    }
    return sum;
  }
};

class OrderPullOfAField : public testing::TestWithParam<unsigned> {
 protected:
  const std::vector<float> depth = depths(), share = shares(), b = random_field(GetParam(), .2F),
                           z = random_field(9, .3F);
  const OrderPull pull{columns, {depth, share, saturation, {distances.begin(), distances.end()}}};
  Bound bound;

  void SetUp() override { pull.write_bound(b, z, limits, {bound.load, bound.hold, bound.lack}); }
};

// The bound and the energy must have the same slope at b. Their values at b may differ by a constant.
TEST_P(OrderPullOfAField, HasABoundThatTouchesItsEnergy) {
  constexpr float step = 1e-2F;
  for (const std::size_t n : {5UL, 60UL, 150UL, 151UL, 200UL, 333UL, nodes - 1}) {
    std::vector<float> more = b, less = b;
    more[n] += step, less[n] -= step;
    const double slope =
        (energy(depth, sum_of(more, z)) - energy(depth, sum_of(less, z))) / (2 * double{step});
    EXPECT_NEAR(static_cast<double>(bound.hold[n] * b[n] - bound.load[n]), slope, 2e-3) << n;
  }
}

TEST_P(OrderPullOfAField, IsNowhereAboveItsBound) {
  const double here = energy(depth, sum_of(b, z)) - bound.at(b);
  for (unsigned seed = 20; seed < 40; ++seed) {
    const std::vector<float> other = random_field(seed, seed % 2 ? .05F : .5F);
    EXPECT_LE(energy(depth, sum_of(other, z)) - bound.at(other), here + 1e-4) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Fields, OrderPullOfAField, testing::Values(2U, 3U, 4U));

// The pull must not change pairs that have the right order and are far enough apart in height.
TEST(OrderPull, LeavesRightOrderAlone) {
  std::vector<float> depth(nodes), z(nodes);
  for (std::size_t n = 0; n < nodes; ++n) depth[n] = static_cast<float>(n % columns), z[n] = 10 * depth[n];
  const OrderPull pull(columns, {depth, std::vector<float>(nodes, 1), saturation, {2, 4}});
  Bound bound;
  pull.write_bound(std::vector<float>(nodes), z, limits, {bound.load, bound.hold, bound.lack});
  EXPECT_EQ(bound.load, std::vector<float>(nodes));
  EXPECT_EQ(bound.hold, std::vector<float>(nodes));
  for (float& height_here : z) height_here = -height_here;
  pull.write_bound(std::vector<float>(nodes), z, limits, {bound.load, bound.hold, bound.lack});
  EXPECT_NE(bound.load, std::vector<float>(nodes));
}

TEST(OrderPull, HasNoPairsThatReachBeyondTheLattice) {
  const std::vector<float> depth = depths(), share = shares();
  const OrderPull pull(columns, {depth, share, saturation, {2, 21, 400}});
  Bound bound;
  const std::vector<float> b = random_field(2, .2F), z = random_field(9, .3F);
  pull.write_bound(b, z, limits, {bound.load, bound.hold, bound.lack});
  Bound near;
  OrderPull(columns, {depth, share, saturation, {2}})
      .write_bound(b, z, limits, {near.load, near.hold, near.lack});
  for (std::size_t n = 0; n < nodes; ++n)
    if (n % columns == columns / 2) EXPECT_EQ(bound.load[n], near.load[n]) << n;
}

TEST(OrderPull, HasNoPairsWithinACell) {
  const std::vector<float> depth = depths(), share = shares();
  EXPECT_TRUE(OrderPull(columns, {depth, share, saturation, {.3F}}).empty());
  EXPECT_FALSE(OrderPull(columns, {depth, share, saturation, {.8F}}).empty());
  EXPECT_TRUE(OrderPull().empty());
}

}  // namespace
}  // namespace relievo::solver
