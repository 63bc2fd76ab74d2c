#include "core/root_finding.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

struct Search {
  double x = 0, last = 0;
  int calls = 0;
};

template <typename F>
Search search(F f) {
  Search s;
  s.x = find_root([&](double x) { return ++s.calls, s.last = f(x); }, 1e-5);
  return s;
}

TEST(FindRoot, FindsRootsNearAndFar) {
  for (const double root : {0.0, .3, -7.0, 120.0, -640.0, 700.0}) {
    const Search s = search([&](double x) { return x - root; });
    EXPECT_NEAR(s.x, root, 1e-5);
    EXPECT_EQ(s.last, s.x - root);  // the last call of the function was at the result
  }
}

// Each function is much steeper in one part of its domain than in another.
TEST(FindRoot, FindsThemOnCurvesOfManyShapes) {
  const auto expect_root = [](auto f) {
    const Search s = search(f);
    EXPECT_LT(std::abs(s.last), 1e-5);
    EXPECT_LE(s.calls, 100);
  };
  for (const double root : {.7, 30.0, -300.0})
    for (const double width : {.1, 1.0, 20.0}) {
      expect_root([&](double x) { return std::atan((x - root) / width); });
      expect_root([&](double x) { return std::cbrt((x - root) / width); });
      expect_root([&](double x) { return std::expm1(std::min((x - root) / width, 50.0)); });
      expect_root([&](double x) { return x > root ? 1e-3 * (x - root) : 100 * (x - root); });
    }
}

TEST(FindRoot, EndsWhereThereIsNone) {
  EXPECT_GT(search([](double) { return -1.0; }).x, 750);
  EXPECT_LT(search([](double) { return 1.0; }).x, -750);
}

}  // namespace
}  // namespace relievo
