#include "geometry/predicates.h"

#include "geometry/expansion.h"

namespace relievo::detail {
namespace {

// Three error bounds from section 4.4 of Shewchuk's paper: for the determinant of the rounded differences, for the
// determinant with a first-order correction, and for rounding an exact value to an estimate.
constexpr double incircle_bound_b = (4 + 48 * epsilon) * epsilon;
constexpr double incircle_bound_c = (44 + 576 * epsilon) * epsilon * epsilon;
constexpr double estimate_bound = (3 + 8 * epsilon) * epsilon;

TwoDoubles difference(double a, double b) {
  return two_sum(a, -b);
}

// A point relative to an origin: rounded differences (high) and their rounding errors (low).
struct Offset {
  TwoDoubles x, y;

  Offset(const Vec2& p, const Vec2& origin)
      : x(difference(p.x(), origin.x())), y(difference(p.y(), origin.y())) {}
  bool is_rounded() const { return x.low != 0 || y.low != 0; }
};

// Returns a difference as an expansion with one component (rounded) or two components (exact).
template <std::size_t n>
Expansion<n> number(const TwoDoubles& difference) {
  if constexpr (n == 1) return Expansion<1>(difference.high);
  if constexpr (n == 2) return Expansion<2>(difference);
}

template <std::size_t n>
auto cross(const Offset& a, const Offset& b) {
  return number<n>(a.x) * number<n>(b.y) - number<n>(a.y) * number<n>(b.x);
}

template <std::size_t n>
auto lift(const Offset& a) {
  const Expansion<n> x = number<n>(a.x), y = number<n>(a.y);
  return x * x + y * y;
}

template <std::size_t n>
auto incircle_determinant(const Offset& a, const Offset& b, const Offset& c) {
  return lift<n>(a) * cross<n>(b, c) + lift<n>(b) * cross<n>(c, a) + lift<n>(c) * cross<n>(a, b);
}

// Returns the sum of the absolute values of the determinant's terms. All error bounds are proportional to it.
double incircle_permanent(const Offset& a, const Offset& b, const Offset& c) {
  const auto term = [](const Offset& p, const Offset& q, const Offset& r) {
    const double lifted = p.x.high * p.x.high + p.y.high * p.y.high;
    return lifted * (std::abs(q.x.high * r.y.high) + std::abs(q.y.high * r.x.high));
  };
  return term(a, b, c) + term(b, c, a) + term(c, a, b);
}

// Returns how much the rounding errors of the differences change a's term of the determinant, to first order.
double incircle_correction(const Offset& a, const Offset& b, const Offset& c) {
  const double cofactor = b.x.high * c.y.high - b.y.high * c.x.high;
  const double cofactor_error =
      (b.x.high * c.y.low + c.y.high * b.x.low) - (b.y.high * c.x.low + c.x.high * b.y.low);
  const double lifted = a.x.high * a.x.high + a.y.high * a.y.high;
  const double lifted_error = 2 * (a.x.high * a.x.low + a.y.high * a.y.low);
  return lifted * cofactor_error + lifted_error * cofactor;
}

// Returns whether the four points are the corners of an upright rectangle, as in a grid: each has the same x as one
// of the others and the same y as another one. These points are on one circle.
bool is_upright_rectangle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto are_sides = [](const Vec2& p, const Vec2& q, const Vec2& r, const Vec2& s) {
    return p.x() == q.x() && r.x() == s.x() &&
           ((p.y() == r.y() && q.y() == s.y()) || (p.y() == s.y() && q.y() == r.y()));
  };
  return are_sides(a, b, c, d) || are_sides(a, c, b, d) || are_sides(a, d, b, c);
}

int sign_beyond(double value, double bound) {
  return value > bound ? 1 : -value > bound ? -1 : 0;
}

}  // namespace

int orient2d_exact(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross<2>(Offset(a, c), Offset(b, c)).sign();
}

int incircle_exact(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  if (is_upright_rectangle(a, b, c, d)) return 0;
  // This is Shewchuk's incircle() in three stages. The first computes exactly with the rounded differences; its sign
  // is final if no difference was rounded. The second adds a first-order correction. The third is fully exact.
  const Offset ad(a, d), bd(b, d), cd(c, d);
  const auto determinant = incircle_determinant<1>(ad, bd, cd);
  if (!ad.is_rounded() && !bd.is_rounded() && !cd.is_rounded()) return determinant.sign();

  const double value = determinant.estimate(), permanent = incircle_permanent(ad, bd, cd);
  if (const int sign = sign_beyond(value, incircle_bound_b * permanent)) return sign;

  const double correction =
      incircle_correction(ad, bd, cd) + incircle_correction(bd, cd, ad) + incircle_correction(cd, ad, bd);
  const double bound = incircle_bound_c * permanent + estimate_bound * std::abs(value);
  if (const int sign = sign_beyond(value + correction, bound)) return sign;

  return incircle_determinant<2>(ad, bd, cd).sign();
}

}  // namespace relievo::detail
