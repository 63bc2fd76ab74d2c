// Generates random numbers that are the same on every platform.
#pragma once

#include <cstdint>

namespace relievo {

// SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", 2014).
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += step;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
    z = (z ^ z >> 27) * 0x94D049BB133111EBU;
    return z ^ z >> 31;
  }

  // Returns a uniformly distributed number in [0, 1), with 53 random bits.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  static constexpr std::uint64_t step = 0x9E3779B97F4A7C15U;

 private:
  std::uint64_t state_;
};

}  // namespace relievo
