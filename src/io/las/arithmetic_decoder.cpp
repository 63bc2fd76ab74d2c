#include "io/las/arithmetic_decoder.h"

namespace relievo::io {
namespace {

constexpr unsigned symbol_bits = 15, bit_bits = 13;  // precision of the probabilities

}  // namespace

SymbolModel::SymbolModel(std::uint32_t symbols)
    : symbols_(symbols), cycle_(symbols), starts_(symbols), counts_(symbols, 1) {
  const std::uint32_t few = 16;  // so few symbols are found equally fast without a table
  if (symbols > few) {
    unsigned bits = 3;
    while (symbols > 1U << (bits + 2)) ++bits;
    table_.resize((std::size_t{1} << bits) + 2);
    table_shift_ = symbol_bits - bits;
  }
  update();
  cycle_ = until_update_ = (symbols + 6) / 2;
}

void SymbolModel::update() {
  total_ += cycle_;
  if (total_ > 1U << symbol_bits) {
    total_ = 0;
    for (std::uint32_t& count : counts_) total_ += count = (count + 1) / 2;
  }
  const std::uint32_t scale = (1U << 31) / total_;
  std::uint32_t sum = 0;
  std::size_t entry = 0;
  for (std::uint32_t i = 0; i < symbols_; ++i) {
    starts_[i] = (scale * sum) >> (31 - symbol_bits);
    sum += counts_[i];
    if (table_.empty()) continue;
    for (const std::size_t here = starts_[i] >> table_shift_; entry < here;) table_[++entry] = i - 1;
  }
  while (entry + 1 < table_.size()) table_[++entry] = symbols_ - 1;
  cycle_ = std::min(5 * cycle_ / 4, (symbols_ + 6) * 8);
  until_update_ = cycle_;
}

void BitModel::update() {
  total_ += cycle_;
  if (total_ > 1U << bit_bits) {
    total_ = (total_ + 1) / 2;
    zeros_ = (zeros_ + 1) / 2;
    if (zeros_ == total_) ++total_;
  }
  start_of_one_ = (zeros_ * ((1U << 31) / total_)) >> (31 - bit_bits);
  cycle_ = std::min<std::uint32_t>(5 * cycle_ / 4, 64);
  until_update_ = cycle_;
}

std::uint32_t ArithmeticDecoder::bit(BitModel& model) {
  const std::uint32_t start = model.start_of_one_ * (length_ >> bit_bits);
  const bool is_one = value_ >= start;
  if (is_one) {
    value_ -= start;
    length_ -= start;
  } else {
    length_ = start;
    ++model.zeros_;
  }
  renormalise();
  if (--model.until_update_ == 0) model.update();
  return is_one ? 1 : 0;
}

std::uint32_t ArithmeticDecoder::bits(unsigned count) {
  const unsigned most = 19;  // bits at a time, so that the interval stays long enough
  if (count > most) {
    const std::uint32_t low = bits(16);
    return bits(count - 16) << 16 | low;
  }
  length_ >>= count;
  const std::uint32_t number = value_ / length_;
  value_ -= length_ * number;
  renormalise();
  return number;
}

}  // namespace relievo::io
