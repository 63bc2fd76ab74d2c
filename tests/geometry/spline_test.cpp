#include "relievo/geometry/spline.h"

#include "support/differences.h"
#include "support/same_bits.h"
#include "support/shapes.h"

namespace relievo {
namespace {

using test::largest_difference;

std::vector<Vec2> scattered(std::size_t n, std::uint64_t seed = 1) {
  test::Random random(seed);
  std::vector<Vec2> points;
  while (points.size() < n) points.emplace_back(random.uniform(0, 2), random.uniform(0, 1));
  return points;
}

SplineOptions options(int levels, double damping = 0) {
  return {.max = Vec2(2, 1), .cell = std::ldexp(1, 1 - levels), .levels = levels, .damping = damping};
}

template <typename F>
std::vector<float> values_of(std::span<const Vec2> points, F f) {
  std::vector<float> values;
  for (const Vec2& p : points) values.push_back(static_cast<float>(f(p.x(), p.y())));
  return values;
}

// Fits the spline to values at its sites. Returns its values at other points.
std::vector<float> fitted(const MultilevelSpline& spline, std::span<const float> values,
                          std::span<const Vec2> at) {
  SplineFunction function = spline.make_function();
  MultilevelSpline::Workspace workspace = spline.make_workspace();
  spline.fit(values, function, workspace);
  std::vector<float> out(at.size());
  spline.evaluate(function, spline.pack(at), out);
  return out;
}

std::vector<float> ones(std::size_t n) {
  return std::vector<float>(n, 1.F);
}

double wavy(double x, double y) {
  return std::sin(3 * x) * std::cos(4 * y) + x;
}

// Computes a uniform B-spline by the recursion of Cox and de Boor, with the knots 0, 1, 2, ... The cubic
// B-spline is positive in (0, 4).
double b_spline(int degree, double t) {
  if (degree == 0) return t >= 0 && t < 1 ? 1 : 0;
  return t / degree * b_spline(degree - 1, t) + (degree + 1 - t) / degree * b_spline(degree - 1, t - 1);
}

// The lattice of one level of a multilevel B-spline. The B-spline of node (i, j) covers 4 x 4 cells. The
// first of them is in column i - 3 and row j - 3 of the domain.
struct Lattice {
  std::size_t columns, rows;
  double cell;
  std::vector<double> nodes = std::vector<double>(columns * rows, 0.0);

  double weight(std::size_t i, std::size_t j, const Vec2& p) const {
    return b_spline(3, p.x() / cell - static_cast<double>(i) + 3) *
           b_spline(3, p.y() / cell - static_cast<double>(j) + 3);
  }

  double operator()(const Vec2& p) const {
    double sum = 0;
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < columns; ++i) sum += nodes[j * columns + i] * weight(i, j, p);
    return sum;
  }
};

Lattice lattice(int level) {
  const std::size_t cells = std::size_t{1} << level;
  return {2 * cells + 3, cells + 3, std::ldexp(1, -level)};
}

// Computes equations (3) to (5) of Lee, Wolberg and Shin (see spline.h) for sites with weights, directly and
// without optimisation.
Lattice approximated(int level, std::span<const Vec2> sites, std::span<const float> weights,
                     std::span<const double> values) {
  Lattice result = lattice(level);
  for (std::size_t j = 0; j < result.rows; ++j) {
    for (std::size_t i = 0; i < result.columns; ++i) {
      double delta = 0, omega = 0;
      for (std::size_t c = 0; c < sites.size(); ++c) {
        const double w = result.weight(i, j, sites[c]);
        if (w == 0) continue;
        double squares = 0;
        for (std::size_t l = 0; l < result.rows; ++l)
          for (std::size_t k = 0; k < result.columns; ++k)
            squares += std::pow(result.weight(k, l, sites[c]), 2);
        const double phi = w * values[c] / squares;
        delta += static_cast<double>(weights[c]) * w * w * phi;
        omega += static_cast<double>(weights[c]) * w * w;
      }
      result.nodes[j * result.columns + i] = omega > 0 ? delta / omega : 0;
    }
  }
  return result;
}

TEST(Spline, ReproducesConstantsExactly) {
  const std::vector<Vec2> sites = scattered(300), places = scattered(1000, 2);
  const MultilevelSpline spline(sites, ones(300), options(5, .01));
  EXPECT_EQ(fitted(spline, std::vector<float>(300, 1.1F), places), std::vector<float>(1000, 1.1F));
}

TEST(Spline, ReproducesLinearFunctionsClosely) {
  const auto linear = [](double x, double y) { return 2 * x - 3 * y + 1; };
  const std::vector<Vec2> sites = scattered(4000), places = scattered(1000, 2);
  const MultilevelSpline spline(sites, ones(4000), options(6));
  EXPECT_LT(largest_difference(fitted(spline, values_of(sites, linear), places), values_of(places, linear)),
            .07);
}

TEST(Spline, InterpolatesAsLevelsGrow) {
  const std::vector<Vec2> sites = scattered(300);
  const std::vector<float> values = values_of(sites, wavy);
  double last = 3;
  for (int levels = 1; levels <= 9; ++levels) {
    const MultilevelSpline spline(sites, ones(300), options(levels));
    const double error = largest_difference(fitted(spline, values, sites), values);
    EXPECT_LT(error, last) << levels;
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(Spline, IsTheSumOfTheLevelsOfTheTextbook) {
  const std::vector<Vec2> sites = scattered(40), places = scattered(200, 2);
  std::vector<float> weights = values_of(sites, [](double x, double y) { return x + y * y; });
  weights[7] = 0;
  const std::vector<float> values = values_of(sites, wavy);

  double sum = 0, total = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sum += static_cast<double>(weights[i]) * static_cast<double>(values[i]);
    total += static_cast<double>(weights[i]);
  }
  std::vector<double> rest;
  for (const float v : values) rest.push_back(static_cast<double>(v) - sum / total);
  std::vector<float> expected(places.size(), static_cast<float>(sum / total));
  for (int level = 0; level < 4; ++level) {
    const Lattice lattice = approximated(level, sites, weights, rest);
    for (std::size_t i = 0; i < sites.size(); ++i) rest[i] -= lattice(sites[i]);
    for (std::size_t i = 0; i < places.size(); ++i) expected[i] += static_cast<float>(lattice(places[i]));
  }
  const MultilevelSpline spline(sites, weights, options(4));
  EXPECT_LT(largest_difference(fitted(spline, values, places), expected), 3e-4);
}

TEST(Spline, EvaluatesTheSumOfTheTextbook) {
  const MultilevelSpline spline({}, {}, options(4));
  SplineFunction function = spline.make_function();
  Lattice direct = lattice(3);
  ASSERT_EQ(function.nodes.size(), direct.nodes.size());
  test::Random random(3);
  for (std::size_t i = 0; i < direct.nodes.size(); ++i)
    direct.nodes[i] = static_cast<double>(function.nodes[i] = static_cast<float>(random.uniform(-1, 1)));
  function.mean = 2;
  std::vector<Vec2> places = scattered(500);
  places.insert(places.end(), {{0, 0}, {1.999999, .999999}, {.125, .25}});
  std::vector<float> values(places.size());
  spline.evaluate(function, spline.pack(places), values);
  for (std::size_t i = 0; i < places.size(); ++i)
    ASSERT_NEAR(static_cast<double>(values[i]), 2 + direct(places[i]), 3e-5) << places[i].transpose();
}

TEST(Spline, TakesTheEdgesValueOutsideTheDomain) {
  const std::vector<Vec2> sites = scattered(100);
  const MultilevelSpline spline(sites, ones(100), options(5));
  const std::vector<float> out =
      fitted(spline, values_of(sites, wavy), std::vector<Vec2>{{-5, .5}, {0, .5}, {7, 1e9}, {2, 1}});
  EXPECT_EQ(out[0], out[1]);
  EXPECT_EQ(out[2], out[3]);
}

// A site of weight 0 has no effect. If all weights are 0, the spline is 0.
TEST(Spline, FollowsTheWeights) {
  std::vector<Vec2> sites = scattered(200);
  std::vector<float> values = values_of(sites, wavy), weights = ones(200);
  const std::vector<Vec2> places = scattered(300, 2);
  const std::vector<float> before = fitted(MultilevelSpline(sites, weights, options(5)), values, places);
  sites.insert(sites.begin(), Vec2(1, .5));
  values.insert(values.begin(), 1e6F);
  weights.insert(weights.begin(), 0);
  EXPECT_EQ(before, fitted(MultilevelSpline(sites, weights, options(5)), values, places));

  const std::vector<float> none(weights.size(), 0);
  EXPECT_EQ(fitted(MultilevelSpline(sites, none, options(5)), values, places), std::vector<float>(300, 0.F));
}

TEST(Spline, IsDampedTowardsTheMean) {
  const std::vector<Vec2> sites = scattered(200);
  const std::vector<float> values = values_of(sites, wavy);
  double last = 0;
  for (const double damping : {0.0, .01, 1.0, 1e6}) {
    const std::vector<float> out =
        fitted(MultilevelSpline(sites, ones(200), options(4, damping)), values, sites);
    const double error = largest_difference(out, values);
    EXPECT_GT(error, last);
    last = error;
  }
}

TEST(Spline, TellsWhatTheFitLeaves) {
  const std::vector<Vec2> sites = scattered(200);
  const std::vector<float> values = values_of(sites, wavy);
  const MultilevelSpline spline(sites, ones(200), options(4));
  SplineFunction function = spline.make_function();
  MultilevelSpline::Workspace workspace = spline.make_workspace();
  spline.fit(values, function, workspace);
  std::vector<float> sum(sites.size());
  spline.evaluate(function, spline.pack(sites), sum);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += workspace.rest[i];
  EXPECT_LT(largest_difference(sum, values), 3e-4);
}

// A spline on a lattice of six levels, of which only the three coarsest are fitted, is the same function as
// a spline with three levels.
TEST(Spline, IsTheSameOnAFinerLattice) {
  const std::vector<Vec2> sites = scattered(200), places = scattered(300, 2);
  const std::vector<float> values = values_of(sites, wavy);
  SplineOptions fine = options(6);
  fine.last_fitted = 2;
  EXPECT_LT(largest_difference(fitted(MultilevelSpline(sites, ones(200), fine), values, places),
                               fitted(MultilevelSpline(sites, ones(200), options(3)), values, places)),
            1e-4);
}

TEST(Spline, EvaluatesPairsAsOneByOne) {
  const std::vector<Vec2> sites = scattered(200), points = scattered(9000, 2);
  const MultilevelSpline spline(sites, ones(200), options(5));
  SplineFunction f = spline.make_function(), g = spline.make_function();
  MultilevelSpline::Workspace workspace = spline.make_workspace();
  spline.fit(values_of(sites, wavy), f, workspace);
  spline.fit(values_of(sites, [](double x, double y) { return x * y; }), g, workspace);
  const std::vector<SplinePlace> places = spline.pack(points);
  std::vector<float> of_f(9000), of_g(9000), pair_f(9000), pair_g(9000);
  spline.evaluate(f, places, of_f);
  spline.evaluate(g, places, of_g);
  std::vector<float> pair;
  MultilevelSpline::pair_up(f, g, pair);
  test::expect_same_without_avx2([&] {
    spline.evaluate(pair, places, {pair_f, pair_g});
    return std::pair(pair_f, pair_g);
  });
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_NEAR(pair_f[i] + f.mean, of_f[i], 2e-6F);
    ASSERT_NEAR(pair_g[i] + g.mean, of_g[i], 2e-6F);
  }
}

TEST(Spline, HasTheSameBitsForAnyNumberOfThreads) {
  const std::vector<Vec2> sites = scattered(500), places = scattered(20000, 2);
  test::expect_same_for_any_threads(
      [&] { return fitted(MultilevelSpline(sites, ones(500), options(5)), values_of(sites, wavy), places); });
}

}  // namespace
}  // namespace relievo
