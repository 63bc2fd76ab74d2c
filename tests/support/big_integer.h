// Implements integers that are wide enough for all exact determinants in the tests of floating-point expansions.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace relievo {

// A number of 2048 bits in two's complement. It is wide enough for products of four numbers that scaled()
// accepts.
class BigInteger {
 public:
  BigInteger() = default;

  // Returns x * 2^252. The result is exact if x is 0 or its magnitude is at least 1e-60 and below 1e70.
  static BigInteger scaled(double x) {
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    BigInteger result;
    const auto magnitude = static_cast<std::uint64_t>(std::abs(mantissa));
    for (int bit = 0; bit < 53; ++bit) {
      const int place = bit + exponent - 53 + 252;
      if (magnitude >> bit & 1) result.limbs_[place / 32] |= 1U << place % 32;
    }
    return x < 0 ? -result : result;
  }

  int sign() const {
    if (limbs_.back() >> 31) return -1;
    return *this == BigInteger() ? 0 : 1;
  }

  friend bool operator==(const BigInteger&, const BigInteger&) = default;

  friend BigInteger operator+(const BigInteger& a, const BigInteger& b) {
    BigInteger sum;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < limbs; ++i) {
      carry += std::uint64_t{a.limbs_[i]} + b.limbs_[i];
      sum.limbs_[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    return sum;
  }

  friend BigInteger operator-(const BigInteger& a) {
    BigInteger complement, one;
    for (std::size_t i = 0; i < limbs; ++i) complement.limbs_[i] = ~a.limbs_[i];
    one.limbs_[0] = 1;
    return complement + one;
  }

  friend BigInteger operator-(const BigInteger& a, const BigInteger& b) { return a + -b; }

  friend BigInteger operator*(const BigInteger& a, const BigInteger& b) {
    BigInteger product;
    for (std::size_t i = 0; i < limbs; ++i) {
      if (a.limbs_[i] == 0) continue;
      std::uint64_t carry = 0;
      for (std::size_t j = 0; i + j < limbs; ++j) {
        carry += std::uint64_t{a.limbs_[i]} * b.limbs_[j] + product.limbs_[i + j];
        product.limbs_[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
    }
    return product;
  }

 private:
  static constexpr std::size_t limbs = 64;
  std::array<std::uint32_t, limbs> limbs_{};
};

}  // namespace relievo
