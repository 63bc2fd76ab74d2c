// Finds roots of functions of one variable.
#pragma once

#include <cmath>

namespace relievo {

// Returns an x with |f(x)| < tolerance for an increasing function f. The last call of f is f(x); f is called
// at most 100 times. No bracket is needed, but f must change its sign in [-750, 750], the range where exp(x)
// is a finite double. If it does not, the returned x is just outside that range, and f(x) is not near 0.
//
// Increasing steps from 0 bracket the root. Then the Illinois variant of false position narrows the bracket:
// the value of f at an end of the bracket is halved if a step does not move that end. If 8 steps are not
// enough, every other step is a bisection.
template <typename F>
double find_root(F&& f, double tolerance) {
  double a = 0, fa = f(a);
  if (std::abs(fa) < tolerance) return a;
  double step = fa > 0 ? -1 : 1, b = a, fb = fa;
  do {
    a = b, fa = fb;
    b += step;
    fb = f(b);
    if (std::abs(fb) < tolerance || (std::abs(b) > 750 && (fb > 0) == (fa > 0))) return b;
    step *= 1.6;
  } while ((fb > 0) == (fa > 0));
  double x = b;
  for (int call = 0; call < 80; ++call) {
    const bool is_slow = call >= 8 && call % 2 == 0;
    x = is_slow ? (a + b) / 2 : (a * fb - b * fa) / (fb - fa);
    const double fx = f(x);
    if (std::abs(fx) < tolerance) break;
    if ((fx > 0) == (fb > 0)) {
      fa /= 2;
    } else {
      a = b, fa = fb;
    }
    b = x, fb = fx;
  }
  return x;
}

}  // namespace relievo
