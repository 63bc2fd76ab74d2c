#include "geometry/predicates.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "support/big_integer.h"
#include "support/planar_points.h"

namespace relievo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Quad = std::array<Vec2, 4>;

int sign(double x) {
  return (x > 0) - (x < 0);
}

template <typename Integer>
Integer orientation(Integer ax, Integer ay, Integer bx, Integer by) {
  return ax * by - ay * bx;
}

// Computes the determinant in the number type to which `integer` converts coordinates.
template <typename F>
auto orient2d_oracle(const Vec2& a, const Vec2& b, const Vec2& c, F integer) {
  const auto cx = integer(c.x()), cy = integer(c.y());
  return orientation(integer(a.x()) - cx, integer(a.y()) - cy, integer(b.x()) - cx, integer(b.y()) - cy);
}

template <typename F>
auto incircle_oracle(const Quad& q, F integer) {
  using Integer = decltype(integer(0.0));
  std::array<Integer, 3> x, y;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = integer(q[i].x()) - integer(q[3].x());
    y[i] = integer(q[i].y()) - integer(q[3].y());
  }
  const auto term = [&](std::size_t i, std::size_t j, std::size_t k) {
    return (x[i] * x[i] + y[i] * y[i]) * orientation(x[j], y[j], x[k], y[k]);
  };
  return term(0, 1, 2) + term(1, 2, 0) + term(2, 0, 1);
}

int incircle(const Quad& q) {
  return relievo::incircle(q[0], q[1], q[2], q[3]);
}
int exact_orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  return orient2d_oracle(a, b, c, BigInteger::scaled).sign();
}
int exact_incircle(const Quad& q) {
  return incircle_oracle(q, BigInteger::scaled).sign();
}

// Returns the sign as computed in plain doubles. If it is sometimes wrong, the test contains hard cases.
int naive_orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  return sign(orient2d_oracle(a, b, c, [](double x) { return x; }));
}
int naive_incircle(const Quad& q) {
  return sign(incircle_oracle(q, [](double x) { return x; }));
}

Vec2 small_integer_point(int limit) {
  const auto coordinate = rc::gen::inRange(-limit, limit + 1);
  return Vec2(*coordinate, *coordinate);
}

TEST(Predicates, AgreeWithIntegerArithmetic) {
  const auto integer = [](double x) { return static_cast<std::int64_t>(x); };
  for (const int limit : {2, 5, 1000}) {
    ASSERT_TRUE(rc::check([&] {
      Quad q;
      for (Vec2& p : q) p = small_integer_point(limit);
      RC_ASSERT(orient2d(q[0], q[1], q[2]) ==
                sign(static_cast<double>(orient2d_oracle(q[0], q[1], q[2], integer))));
      RC_ASSERT(incircle(q) == sign(static_cast<double>(incircle_oracle(q, integer))));
    }));
  }
}

// The examples are from L. Kettner, K. Mehlhorn, S. Pion, S. Schirra, C. Yap, "Classroom Examples of
// Robustness Problems in Geometric Computations", 2008: a point near the line through two other points is
// moved by single bits.
TEST(Orient2d, IsRightOnTheClassroomExamples) {
  struct Line {
    Vec2 p, q, r;
  };
  const double x1 = 0.50000000000002531, y1 = 0.5000000000000171;
  const Line lines[] = {
      {{0.5, 0.5}, {12, 12}, {24, 24}},
      {{x1, y1}, {17.300000000000001, 17.300000000000001}, {24.00000000000005, 24.0000000000000517765}},
      {{0.5, 0.5}, {8.8000000000000007, 8.8000000000000007}, {12.1, 12.1}}};
  for (const auto& [p, q, r] : lines) {
    int naive_errors = 0;
    for (int i = 0; i < 64; ++i) {
      for (int j = 0; j < 64; ++j) {
        const Vec2 moved = p + Vec2(i, j) * 0x1p-53;
        ASSERT_EQ(orient2d(moved, q, r), exact_orient2d(moved, q, r)) << i << " " << j;
        naive_errors += naive_orient2d(moved, q, r) != orient2d(moved, q, r);
      }
    }
    EXPECT_GT(naive_errors, 0);
  }
}

// Four random points of a unit circle are moved by a common offset and rounded. The last one is also moved
// by -2 to 2 times 2^-53.
TEST(Incircle, IsRightNearTheCircle) {
  std::mt19937_64 random(1);
  int naive_errors = 0;
  for (const double offset : {0.0, 0.7, 3.0, 1e6}) {
    for (int repeat = 0; repeat < 2000; ++repeat) {
      Quad q;
      for (Vec2& p : q) {
        const double angle = 2 * M_PI * uniform(random);
        p = Vec2(std::cos(angle) + offset, std::sin(angle) - offset);
      }
      q[3].x() += static_cast<double>(repeat % 5 - 2) * 0x1p-53;
      ASSERT_EQ(incircle(q), exact_incircle(q)) << "offset " << offset << ", repeat " << repeat;
      naive_errors += naive_incircle(q) != incircle(q);
    }
  }
  EXPECT_GT(naive_errors, 0);
}

// The corners of an axis-parallel rectangle lie on a circle, whatever its coordinates are. The predicate must
// find this even if the differences of the coordinates are rounded.
TEST(Incircle, KnowsRectangles) {
  std::mt19937_64 random(2);
  const auto coordinate = [&] {
    return std::ldexp(uniform(random) - 0.5, static_cast<int>(random() % 120) - 60);
  };
  for (int repeat = 0; repeat < 2000; ++repeat) {
    const auto [left, right] = std::minmax({coordinate(), coordinate()});
    const auto [bottom, top] = std::minmax({coordinate(), coordinate()});
    Quad q = {Vec2(left, bottom), Vec2(right, bottom), Vec2(right, top), Vec2(left, top)};
    ASSERT_EQ(incircle(q), 0);
    q[3].x() = std::nextafter(left, infinity);
    ASSERT_EQ(incircle(q), 1);
    q[3].x() = std::nextafter(left, -infinity);
    ASSERT_EQ(incircle(q), -1);
  }
}

// The coordinates in a determinant have any magnitudes in the range that the header allows.
TEST(Predicates, AreExactToTheEndsOfTheRange) {
  std::mt19937_64 random(3);
  const double ends[] = {0, 1e-60, -1e-60, 1e70, -1e70, 1 + 0x1p-52, 1e-20, -0x1.fffffffffffffp-150, 3e40};
  const auto coordinate = [&] { return ends[random() % std::size(ends)]; };
  for (int repeat = 0; repeat < 3000; ++repeat) {
    Quad q;
    for (Vec2& p : q) p = Vec2(coordinate(), coordinate());
    ASSERT_EQ(orient2d(q[0], q[1], q[2]), exact_orient2d(q[0], q[1], q[2]));
    ASSERT_EQ(incircle(q), exact_incircle(q));
  }
}

TEST(Predicates, ChangeSignWithEachSwap) {
  std::mt19937_64 random(4);
  for (int repeat = 0; repeat < 1000; ++repeat) {
    Quad q;
    for (Vec2& p : q) {
      const double angle = 2 * M_PI * uniform(random);
      p = Vec2(std::cos(angle), std::sin(angle)) * (repeat % 2 ? 1 : 1e-30);
    }
    const int turn = orient2d(q[0], q[1], q[2]), circle = incircle(q);
    ASSERT_EQ(orient2d(q[1], q[2], q[0]), turn);
    ASSERT_EQ(orient2d(q[1], q[0], q[2]), -turn);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        Quad swapped = q;
        std::swap(swapped[i], swapped[j]);
        ASSERT_EQ(incircle(swapped), -circle) << i << " " << j;
      }
    }
  }
}

TEST(Predicates, KnowTheRangeInWhichTheyAreExact) {
  for (const double x : {0.0, -0.0, 1e-60, -1e70, 1.0}) EXPECT_TRUE(is_exact_point({x, 1})) << x;
  for (const double x : {1e-61, -2e70, infinity, std::nan("")}) EXPECT_FALSE(is_exact_point({1, x})) << x;
}

}  // namespace
}  // namespace relievo
