#include "geometry/expansion.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "support/big_integer.h"

namespace relievo {
namespace {

// Doubles of many magnitudes, with few or many bits, all multiples of 2^-60 and below 2^63.
rc::Gen<double> number() {
  const auto parts =
      rc::gen::tuple(rc::gen::arbitrary<std::int64_t>(), rc::gen::inRange(0, 63), rc::gen::inRange(-60, 1));
  return rc::gen::map(parts, [](const std::tuple<std::int64_t, int, int>& it) {
    const auto& [bits, dropped_bits, exponent] = it;
    return std::ldexp(static_cast<double>(bits >> dropped_bits), exponent);
  });
}

template <std::size_t n>
BigInteger value(const Expansion<n>& e) {
  BigInteger sum;
  for (std::size_t i = 0; i < e.size(); ++i) sum = sum + BigInteger::scaled(e[i]);
  return sum;
}

// No zeros, and each component is below the lowest bit of the next one.
template <std::size_t n>
bool is_proper(const Expansion<n>& e) {
  for (std::size_t i = 0; i < e.size(); ++i) {
    if (e[i] == 0) return false;
    if (i == 0) continue;
    int exponent = 0;
    double mantissa = std::frexp(e[i], &exponent);
    while (mantissa != std::floor(mantissa)) mantissa *= 2, --exponent;
    if (std::abs(e[i - 1]) >= std::ldexp(1, exponent)) return false;
  }
  return true;
}

TEST(Expansion, SumsAreExact) {
  ASSERT_TRUE(rc::check([] {
    const double a = *number(), b = *number(), c = *number(), d = *number();
    const auto sum = (Expansion<1>(a) + Expansion<1>(b)) - (Expansion<1>(c) + Expansion<1>(d));
    RC_ASSERT(is_proper(sum));
    RC_ASSERT(value(sum) ==
              BigInteger::scaled(a) + BigInteger::scaled(b) - BigInteger::scaled(c) - BigInteger::scaled(d));
    RC_ASSERT(sum.sign() == value(sum).sign());
  }));
}

TEST(Expansion, ProductsAreExact) {
  ASSERT_TRUE(rc::check([] {
    const double a = *number(), b = *number(), c = *number(), d = *number();
    const Expansion<2> e(two_sum(a, b)), f(two_sum(c, d));
    const auto product = (e * f) * (e - f);
    const BigInteger ab = BigInteger::scaled(a) + BigInteger::scaled(b);
    const BigInteger cd = BigInteger::scaled(c) + BigInteger::scaled(d);
    RC_ASSERT(is_proper(product));
    // Each factor of the oracle carries 2^252.
    const BigInteger unit = BigInteger::scaled(1);
    RC_ASSERT(value(product) * unit * unit == ab * cd * (ab - cd));
    RC_ASSERT(product.sign() == value(product).sign());
  }));
}

TEST(Expansion, CancelsToNothing) {
  const Expansion<2> third(two_sum(1.0 / 3, 0x1p-80));
  const auto zero = third * third - third * third;
  EXPECT_EQ(zero.size(), 0U);
  EXPECT_EQ(zero.sign(), 0);
  EXPECT_EQ(zero.estimate(), 0);
}

TEST(Expansion, EstimateIsCloseToTheValue) {
  const Expansion<2> e(two_sum(1, -0x1p-70));
  EXPECT_EQ((e * e).estimate(), 1);
  EXPECT_EQ((e * e - Expansion<1>(1)).estimate(), -0x1p-69);
}

}  // namespace
}  // namespace relievo
