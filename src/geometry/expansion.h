// Computes exactly with doubles. A number is represented by a sum of doubles, an expansion. Source: J. R. Shewchuk,
// "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997.
//
// The arithmetic is exact if nothing overflows or underflows, doubles round to nearest even, and the compiler neither
// contracts nor reassociates (-ffp-contract=off, no -ffast-math).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace relievo {

// A rounded result and its rounding error: high + low is the exact value.
struct TwoDoubles {
  double high, low;
};

// Returns a + b exactly. (Knuth; Shewchuk's theorem 7)
inline TwoDoubles two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

// Returns a + b exactly; needs |a| >= |b| or a = 0. (Dekker; theorem 6)
inline TwoDoubles fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// Splits `a` into the sum of two doubles of at most 26 bits each. (Veltkamp; theorem 17)
inline TwoDoubles split(double a) {
  const double c = 0x8000001p0 * a;  // 2^27 + 1
  const double high = c - (c - a);
  return {high, a - high};
}

// Returns a * b exactly. (Dekker and Veltkamp; theorem 18) std::fma is not used, because it is ten times as
// slow where the hardware lacks it, as in WebAssembly.
inline TwoDoubles two_product(double a, double b) {
  const double product = a * b;
  const TwoDoubles x = split(a), y = split(b);
  const double error = ((product - x.high * y.high) - x.low * y.high) - x.high * y.low;
  return {product, x.low * y.low - error};
}

// A number as an exact sum of at most `capacity` doubles, its components. These are strongly nonoverlapping,
// never zero, and of increasing magnitude, so the last one has the sign of the sum.
template <std::size_t capacity>
class Expansion {
 public:
  Expansion() : size_(0) {}  // zero; the components stay uninitialised because most are never used
  explicit Expansion(double a) : Expansion() { append(a); }
  explicit Expansion(TwoDoubles a) : Expansion() { append(a.low), append(a.high); }

  std::size_t size() const { return size_; }
  double operator[](std::size_t i) const { return components_[i]; }

  // Appends a component unless it is zero. Its magnitude must not be smaller than that of earlier components.
  void append(double a) {
    components_[size_] = a;
    size_ += a != 0;
  }

  int sign() const { return size_ == 0 ? 0 : components_[size_ - 1] > 0 ? 1 : -1; }

  // Returns the value with a relative error of at most 2^-52.
  double estimate() const {
    double sum = 0;
    for (std::size_t i = 0; i < size_; ++i) sum += components_[i];
    return sum;
  }

  Expansion operator-() const {
    Expansion result;
    for (std::size_t i = 0; i < size_; ++i) result.append(-components_[i]);
    return result;
  }

 private:
  // The array has one element more than `capacity`, because append() also writes zeros, which do not count.
  std::array<double, capacity + 1> components_;
  std::size_t size_;
};

namespace detail {

// Sets `h` to e + f: merges the components by magnitude and propagates the rounding errors.
// (Fast-Expansion-Sum; theorem 13)
template <typename E, typename F, typename H>
void add(const E& e, const F& f, H& h) {
  h = H();
  std::size_t i = 0, j = 0;
  const auto next = [&] {
    if (j == f.size() || (i < e.size() && std::abs(e[i]) < std::abs(f[j]))) return e[i++];
    return f[j++];
  };
  const std::size_t n = e.size() + f.size();
  if (n == 0) return;
  double carry = next();
  for (std::size_t k = 1; k < n; ++k) {
    const auto [high, low] = k == 1 ? fast_two_sum(next(), carry) : two_sum(carry, next());
    h.append(low);
    carry = high;
  }
  h.append(carry);
}

// Returns e * b. (Scale-Expansion; theorem 19)
template <std::size_t n>
Expansion<2 * n> scale(const Expansion<n>& e, double b) {
  Expansion<2 * n> h;
  if (e.size() == 0) return h;
  auto [carry, first] = two_product(e[0], b);
  h.append(first);
  for (std::size_t i = 1; i < e.size(); ++i) {
    const TwoDoubles product = two_product(e[i], b);
    const TwoDoubles sum = two_sum(carry, product.low);
    h.append(sum.low);
    const TwoDoubles top = fast_two_sum(product.high, sum.high);
    h.append(top.low);
    carry = top.high;
  }
  h.append(carry);
  return h;
}

}  // namespace detail

template <std::size_t n, std::size_t m>
Expansion<n + m> operator+(const Expansion<n>& e, const Expansion<m>& f) {
  Expansion<n + m> h;
  detail::add(e, f, h);
  return h;
}

template <std::size_t n, std::size_t m>
Expansion<n + m> operator-(const Expansion<n>& e, const Expansion<m>& f) {
  return e + -f;
}

template <std::size_t n, std::size_t m>
Expansion<2 * n * m> operator*(const Expansion<n>& e, const Expansion<m>& f) {
  Expansion<2 * n * m> sums[2];  // the last partial sum and the next one; they take turns
  for (std::size_t i = 0; i < f.size(); ++i)
    detail::add(sums[i % 2], detail::scale(e, f[i]), sums[(i + 1) % 2]);
  return sums[f.size() % 2];
}

}  // namespace relievo
