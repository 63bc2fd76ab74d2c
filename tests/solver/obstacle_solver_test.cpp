#include "solver/obstacle_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace relievo::solver {
namespace {

constexpr std::size_t width = 40, height = 30;
constexpr float far = 1e6F;

bool is_rim(std::size_t n) {
  const std::size_t x = n % width, y = n / width;
  return x == 0 || y == 0 || x == width - 1 || y == height - 1;
}

// Returns a stiffness with tension 1 at all nodes, and with the bending stiffness `bending` except at the
// edge of the lattice. There the bending stiffness is 0, which fixes the nodes.
Stiffness even(float bending) {
  Stiffness all{std::vector<float>(width * height, bending), std::vector<float>(width * height, 1)};
  for (std::size_t n = 0; n < all.bending.size(); ++n)
    if (is_rim(n)) all.bending[n] = 0;
  return all;
}

// Returns the stiffness of even(), but with other values in two adjacent columns of nodes.
Stiffness yielding(float bending, std::size_t column, float hinge, float tension) {
  Stiffness all = even(bending);
  for (std::size_t n = 0; n < all.bending.size(); ++n)
    if (n % width / 2 == column / 2 && !is_rim(n)) all.bending[n] = hinge, all.tension[n] = tension;
  return all;
}

// Returns the load at node n. It pulls the left half up and the right half down, and has ripples.
float load(std::size_t n) {
  const double x = static_cast<double>(n % width) / width, y = static_cast<double>(n / width) / height;
  return static_cast<float>(.02 * std::sin(6.283 * x) * std::sin(3.1416 * y) + .004 * std::sin(40 * x * y));
}

// The parameters of a problem. `hold` is the stiffness of the springs at all nodes.
struct Pulls {
  float hold = 0, tie_stiffness = 1, least_at_ties = -std::numeric_limits<float>::infinity(),
        stop_stiffness = 10;

  Springs springs() const { return {tie_stiffness, least_at_ties, stop_stiffness}; }
};

struct Problem {
  Springs springs;
  ObstacleSolver sheet;
  ObstacleSolver::Workspace workspace = sheet.make_workspace();

  Problem(Stiffness stiffness, const Pulls& t, float lowest, float highest, std::span<const Tie> ties = {})
      : springs(t.springs()), sheet(width, std::move(stiffness), ties) {
    ObstacleSolver::Fields& f = workspace[0];
    std::ranges::fill(f.lowest, lowest), std::ranges::fill(f.highest, highest);
    std::ranges::fill(f.hold, t.hold);
    for (std::size_t n = 0; n < f.load.size(); ++n) f.load[n] = load(n);
  }
  const std::vector<float>& solved() {
    sheet.solve(springs, workspace);
    return workspace[0].b;
  }
};

// Returns the matrix of the energy: L' C L + tension + springs. L is the Laplacian, C the bending
// stiffness. The rows of fixed nodes are rows of the identity.
Eigen::MatrixXd matrix(const Stiffness& stiffness, const Pulls& springs) {
  const auto& [bending, tensions] = stiffness;
  const auto n = static_cast<Eigen::Index>(bending.size());
  Eigen::MatrixXd lap = Eigen::MatrixXd::Zero(n, n), a = lap;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!(bending[static_cast<std::size_t>(i)] > 0)) continue;
    lap(i, i) = -4, a(i, i) = static_cast<double>(springs.hold);
    for (const Eigen::Index side :
         {Eigen::Index{-1}, Eigen::Index{1}, -Eigen::Index{width}, Eigen::Index{width}}) {
      const bool is_fixed = !(bending[static_cast<std::size_t>(i + side)] > 0);
      const auto tension = static_cast<double>(
          (tensions[static_cast<std::size_t>(i)] + tensions[static_cast<std::size_t>(i + side)]) / 2);
      a(i, i) += tension;
      if (is_fixed) continue;
      lap(i, i + side) = 1, a(i, i + side) = -tension;
    }
  }
  const Eigen::VectorXd c = Eigen::Map<const Eigen::VectorXf>(bending.data(), n).cast<double>();
  a += lap.transpose() * c.asDiagonal() * lap;
  for (Eigen::Index i = 0; i < n; ++i)
    if (!(c[i] > 0)) a(i, i) = 1;
  return a;
}

Eigen::VectorXd loads(const Stiffness& stiffness) {
  const std::vector<float>& bending = stiffness.bending;
  Eigen::VectorXd f(static_cast<Eigen::Index>(bending.size()));
  for (std::size_t n = 0; n < bending.size(); ++n)
    f[static_cast<Eigen::Index>(n)] = bending[n] > 0 ? static_cast<double>(load(n)) : 0;
  return f;
}

double energy(const Eigen::MatrixXd& a, const Eigen::VectorXd& f, const std::vector<float>& b) {
  const Eigen::VectorXd x =
      Eigen::Map<const Eigen::VectorXf>(b.data(), static_cast<Eigen::Index>(b.size())).cast<double>();
  return .5 * x.dot(a * x) - f.dot(x);
}

// Adds the energy of ties to the matrix.
void add_ties(Eigen::MatrixXd& a, std::span<const Tie> ties, const Pulls& springs) {
  for (const auto& [cell, at, own] : ties) {
    Eigen::VectorXd w = Eigen::VectorXd::Zero(a.rows());
    const auto x = static_cast<double>(at.x()), y = static_cast<double>(at.y());
    const auto n = static_cast<Eigen::Index>(cell), above = n + static_cast<Eigen::Index>(width);
    w[n] = (1 - x) * (1 - y), w[n + 1] = x * (1 - y), w[above] = (1 - x) * y, w[above + 1] = x * y;
    a += static_cast<double>(own * springs.tie_stiffness) * w * w.transpose();
  }
}

// Returns ties along the line x + slope y = start, which crosses the cells diagonally.
std::vector<Tie> slanting_ties(double start, double slope) {
  std::vector<Tie> ties;
  for (double y = 3; y < height - 3; ++y) {
    const double x = start - slope * (y + .5), left = std::floor(x);
    ties.push_back({static_cast<std::size_t>(left) + width * static_cast<std::size_t>(y),
                    Vec2f(static_cast<float>(x - left), .5F), 2});
  }
  return ties;
}

// Without limits, the field with the least energy solves a linear system; this energy is negative. The solver must
// reach at least the fraction `share` of it. Three quarters of the sweeps would not be enough in any of these cases.
TEST(ObstacleSolver, ComesNearTheLeastEnergy) {
  struct Case {
    Stiffness stiffness;
    Pulls springs;
    double share;
    std::vector<Tie> ties = {};
  };
  const std::vector<Tie> line = slanting_ties(20.3, .37),
                         one = {{line[line.size() / 2].cell, {.3F, .6F}, 20}};
  for (const auto& [stiffness, springs, share, ties] :
       {Case{even(1), {.1F}, .9975}, Case{even(10), {.02F}, .94}, Case{even(10), {}, .91},
        Case{yielding(10, width / 3, .1F, 1), {.02F}, .94},
        Case{yielding(10, width / 3, .1F, .2F), {.02F}, .945},
        Case{yielding(10, width - 3, 10, .2F), {.02F}, .93}, Case{even(4), {.02F, 1}, .945, line},
        Case{even(4), {.02F, 1}, .96, one}}) {
    Eigen::MatrixXd a = matrix(stiffness, springs);
    add_ties(a, ties, springs);
    const Eigen::VectorXd f = loads(stiffness), exact = a.llt().solve(f);
    Problem problem(stiffness, springs, -far, far, ties);
    const double least = -.5 * f.dot(exact);
    EXPECT_GT(energy(a, f, problem.solved()) / least, share);
    EXPECT_LE(energy(a, f, problem.solved()) / least, 1 + 1e-4);
  }
}

TEST(ObstacleSolver, StaysWithinItsLimits) {
  Problem problem(even(4), {.02F}, -.1F, .2F);
  const std::vector<float>& b = problem.solved();
  EXPECT_EQ(*std::ranges::min_element(b), -.1F);
  EXPECT_EQ(*std::ranges::max_element(b), .2F);
  for (std::size_t n = 0; n < b.size(); ++n)
    if (is_rim(n)) ASSERT_EQ(b[n], 0);
}

// Limits increase the least energy. The solution must still have less energy than a cut-off solution: one
// that is computed without limits and then cut off at them.
TEST(ObstacleSolver, BendsInsteadOfBeingCutOff) {
  constexpr Pulls springs{.02F};
  const Stiffness stiffness = even(4);
  const Eigen::MatrixXd a = matrix(stiffness, springs);
  const Eigen::VectorXd f = loads(stiffness);
  Problem unlimited(stiffness, springs, -far, far), limited(stiffness, springs, -.1F, .2F);
  std::vector<float> cut = unlimited.solved();
  const double least = energy(a, f, cut);
  for (float& b : cut) b = std::clamp(b, -.1F, .2F);
  const double held = energy(a, f, limited.solved());
  EXPECT_GT(held, least);
  EXPECT_LT(held, energy(a, f, cut) - .05 * std::abs(least));
}

// If both limits of a node are equal, the node gets this value.
TEST(ObstacleSolver, TakesLimitsThatMeet) {
  Problem problem(even(4), {.02F}, .05F, .05F);
  const std::vector<float>& b = problem.solved();
  for (std::size_t n = 0; n < b.size(); ++n) ASSERT_EQ(b[n], is_rim(n) ? 0 : .05F);
}

// The field must bend at a hinge: its second difference must be larger at the hinge than four nodes away from
// the hinge.
TEST(ObstacleSolver, BendsAtAHinge) {
  constexpr std::size_t middle = width / 2;
  Problem problem(yielding(50, middle, .05F, 1), {}, -far, far);
  for (std::size_t n = 0; n < problem.workspace[0].load.size(); ++n) problem.workspace[0].load[n] = .01F;
  const std::vector<float>& b = problem.solved();
  const std::size_t n = middle + height / 2 * width;
  const auto bend = [&](std::size_t at) { return std::abs(b[at - 1] + b[at + 1] - 2 * b[at]); };
  EXPECT_GT(bend(n), 5 * bend(n - 4));
  EXPECT_GT(bend(n), 5 * bend(n + 4));
}

// A hinge with low tension separates its two sides. If the loads on both sides are opposite, the
// field must have a step there.
TEST(ObstacleSolver, KeepsApartWhatYields) {
  const auto step_at_middle = [](float tension) {
    constexpr std::size_t middle = width / 2;
    Problem problem(yielding(50, middle, .05F, tension), {}, -far, far);
    std::vector<float>& loads = problem.workspace[0].load;
    for (std::size_t n = 0; n < loads.size(); ++n) loads[n] = n % width < middle ? .01F : -.01F;
    const float* b = problem.solved().data() + middle + height / 2 * width;
    return (b[-1] - b[2]) / (b[-6] - b[7]);
  };
  EXPECT_GT(step_at_middle(.01F), .9F);
  EXPECT_LT(step_at_middle(1), .7F);
}

// Returns the mean and the standard deviation of the field at the ties.
std::pair<double, double> at_ties(const std::vector<float>& b, const std::vector<Tie>& ties) {
  double sum = 0, squares = 0;
  for (const auto& [cell, at, stiffness] : ties) {
    const float below = std::lerp(b[cell], b[cell + 1], at.x()),
                above = std::lerp(b[cell + width], b[cell + width + 1], at.x());
    const auto value = static_cast<double>(std::lerp(below, above, at.y()));
    sum += value, squares += value * value;
  }
  const double n = static_cast<double>(ties.size()), mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean))};
}

// A plate that is pushed down must rest evenly on its ties, wherever in the cells they lie.
TEST(ObstacleSolver, RestsEvenlyOnTies) {
  const std::vector<Tie> ties = slanting_ties(20.3, .37);
  const auto resting = [&](std::span<const Tie> held) {
    Problem problem(even(16), {.005F, 0, 0}, -far, far, held);
    std::ranges::fill(problem.workspace[0].load, -.01F);
    return at_ties(problem.solved(), ties);
  };
  const auto [free, free_deviation] = resting({});
  const auto [held, deviation] = resting(ties);
  EXPECT_LT(free, -.1);
  EXPECT_GT(held, .1 * free);
  EXPECT_LT(deviation, .05 * std::abs(free));
}

// Ties with tie_stiffness 0 must have no effect as long as the field is above least_at_ties.
TEST(ObstacleSolver, LeavesTiesUpwards) {
  const std::vector<Tie> ties = slanting_ties(20.3, .37);
  Problem tied(even(4), {.02F, 0, -10}, -far, far, ties), free(even(4), {.02F}, -far, far);
  EXPECT_EQ(tied.solved(), free.solved());
}

TEST(ObstacleSolver, HasNothingToDoWhereAllIsFixed) {
  Problem problem(even(0), {}, -1, 1);
  EXPECT_EQ(problem.solved(), std::vector<float>(width * height));
  int free = 0;
  problem.sheet.each_free_node([&](Index) { ++free; });
  EXPECT_EQ(free, 0);
}

}  // namespace
}  // namespace relievo::solver
