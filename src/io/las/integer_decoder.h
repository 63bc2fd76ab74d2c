// Decodes integers of LAZ files, which are stored as differences from a prediction.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "io/las/arithmetic_decoder.h"

namespace relievo::io {

// Decodes integers of that many bits, 2 to 32. The caller states the context of a number; the sizes of the
// differences have one model per context.
class IntegerDecoder {
 public:
  IntegerDecoder(unsigned bits, std::uint32_t contexts);

  std::int32_t next(ArithmeticDecoder& decoder, std::int32_t prediction, std::uint32_t context = 0);

  // Returns the number of bits of the last difference.
  std::uint32_t last_bits() const { return last_bits_; }

 private:
  std::uint32_t difference(ArithmeticDecoder& decoder);

  unsigned bits_;
  std::uint32_t last_bits_ = 0;
  std::vector<SymbolModel> sizes_;                     // model of the sizes, by context
  BitModel small_;                                     // model of the differences 0 and 1
  std::vector<std::optional<SymbolModel>> high_bits_;  // models of others, by size; made on first use
};

// Returns a + b modulo 2^32.
inline std::int32_t wrapping_sum(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}

// Returns the context of a difference, given the number of bits of the previous difference along another
// axis. There is one context for every two bits, up to `most`.
inline std::uint32_t size_context(std::uint32_t bits, std::uint32_t most) {
  return bits < most ? bits & ~1U : most;
}

// The median of the last five numbers, approximately: each new number replaces the highest or the lowest in
// turn.
class RunningMedian {
 public:
  std::int32_t get() const { return values_[2]; }
  void add(std::int32_t value);

 private:
  std::int32_t values_[5] = {};  // ascending
  bool replaces_highest_ = true;
};

}  // namespace relievo::io
