// Implements the adaptive arithmetic decoder of LAZ files (A. Said, "Introduction to Arithmetic Coding",
// HPL-2004-76). It has 32-bit intervals, and periodically updates its models of symbol frequencies.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace relievo::io {

// The frequencies of `symbols` different symbols, 2 to 2048. They are equal at first.
class SymbolModel {
 public:
  explicit SymbolModel(std::uint32_t symbols);

 private:
  friend class ArithmeticDecoder;
  void update();

  std::uint32_t symbols_, table_shift_ = 0;
  std::uint32_t total_ = 0, cycle_ = 0, until_update_ = 0;
  std::vector<std::uint32_t> starts_;  // start of each symbol's part of the interval, in units of 2^-15
  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t>
      table_;  // the first symbol to try, by the highest bits of a number; empty if there are few symbols
};

// The frequencies of 0 and 1.
class BitModel {
 private:
  friend class ArithmeticDecoder;
  void update();

  std::uint32_t zeros_ = 1, total_ = 2, start_of_one_ = 1 << 12, cycle_ = 4, until_update_ = 4;
};

class ArithmeticDecoder {
 public:
  explicit ArithmeticDecoder(std::string_view bytes = {}) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) value_ = value_ << 8 | next_byte();
  }

  std::uint32_t symbol(SymbolModel& model);
  std::uint32_t bit(BitModel& model);
  std::uint32_t bits(unsigned count);  // returns a number of 1 to 32 bits that has no model

  // Returns whether decoding went beyond the end of the bytes. Missing bytes are read as zeros.
  bool is_beyond_end() const { return at_ > bytes_.size() + 4; }

 private:
  std::uint32_t next_byte() {
    const std::size_t at = at_++;
    return at < bytes_.size() ? static_cast<unsigned char>(bytes_[at]) : 0;
  }
  void renormalise() {
    while (length_ < 1 << 24) {
      value_ = value_ << 8 | next_byte();
      length_ <<= 8;
    }
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint32_t value_ = 0, length_ = ~std::uint32_t{0};
};

inline std::uint32_t ArithmeticDecoder::symbol(SymbolModel& model) {
  const std::uint32_t whole = length_, part = length_ >> 15, number = value_ / part;
  std::uint32_t low = 0, high = model.symbols_;
  if (!model.table_.empty()) {
    const std::size_t entry = std::min<std::size_t>(number >> model.table_shift_, model.table_.size() - 2);
    low = model.table_[entry];
    high = model.table_[entry + 1] + 1;
  }
  while (high > low + 1) {
    const std::uint32_t middle = (low + high) / 2;
    (model.starts_[middle] > number ? high : low) = middle;
  }
  const std::uint32_t start = model.starts_[low] * part,
                      end = low + 1 == model.symbols_ ? whole : model.starts_[low + 1] * part;
  value_ -= start;
  length_ = end - start;
  renormalise();
  ++model.counts_[low];
  if (--model.until_update_ == 0) model.update();
  return low;
}

// Decodes integers of `bits` bits, 2 to 32. The caller provides the context of a number. Each context has its
// own model for the sizes of differences.
class IntegerDecoder {
 public:
  IntegerDecoder(unsigned bits, std::uint32_t contexts);

  std::int32_t next(ArithmeticDecoder& decoder, std::int32_t prediction, std::uint32_t context = 0);

  // Returns the size of the last difference in bits.
  std::uint32_t last_bits() const { return last_bits_; }

 private:
  std::uint32_t difference(ArithmeticDecoder& decoder);

  unsigned bits_;
  std::uint32_t last_bits_ = 0;
  std::vector<SymbolModel> sizes_;  // by context: model of the sizes
  BitModel small_;                  // model of the differences of size 0
  // The models of the other differences by size. Each is made on first use.
  std::vector<std::optional<SymbolModel>> high_bits_;
};

// Returns a + b modulo 2^32.
inline std::int32_t wrapping_sum(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}

// Returns the context of a difference, given the size in bits of the previous difference along another axis.
// Two consecutive sizes share a context; all sizes from `most` on share one context.
inline std::uint32_t size_context(std::uint32_t bits, std::uint32_t most) {
  return bits < most ? bits & ~1U : most;
}

// An approximate median of recent numbers, as LASzip computes it: the middle one of five sorted values. A new
// number replaces the highest or the lowest value.
class RunningMedian {
 public:
  std::int32_t get() const { return values_[2]; }
  void add(std::int32_t value);

 private:
  std::int32_t values_[5] = {};  // ascending
  bool replaces_highest_ = true;
};

}  // namespace relievo::io
