// A root of an increasing function of one variable, without an interval given.
#pragma once

#include <cmath>

namespace relievo {

// Calls f until |f(x)| < tolerance, and returns that x; the last call of f is f(x). f must increase from
// below 0 to above 0 somewhere within 750 of 0, where exp(x) is a finite double; if it does not, the last
// call is beyond that. Brackets by growing steps from 0, then false position with the Illinois rule (the end
// that stays is weighed half), which never leaves the bracket; where that is slow, every other step halves
// it. At most 100 calls.
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
