#include "io/las/arithmetic_decoder.h"

namespace relievo::io {
namespace {

constexpr unsigned symbol_bits = 15, bit_bits = 13;  // bits per probability of a symbol, and of a bit

// A model decodes at most this many of the highest bits of a difference; the lower bits have no model.
constexpr std::uint32_t modelled_bits = 8;

}  // namespace

SymbolModel::SymbolModel(std::uint32_t symbols)
    : symbols_(symbols), cycle_(symbols), starts_(symbols), counts_(symbols, 1) {
  const std::uint32_t few = 16;  // up to this many symbols, a search without a table is as fast
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
  const unsigned most = 19;  // largest number of bits per step, so that the interval stays long enough
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

IntegerDecoder::IntegerDecoder(unsigned bits, std::uint32_t contexts)
    : bits_(bits), sizes_(contexts, SymbolModel(bits + 1)), high_bits_(bits + 1) {}

// A difference of size k > 0 is in [-(2^k - 1), -2^(k - 1)] or [2^(k - 1) + 1, 2^k]. A difference of size 0
// is 0 or 1.
std::uint32_t IntegerDecoder::difference(ArithmeticDecoder& decoder) {
  const std::uint32_t size = last_bits_;
  if (size == 0) return decoder.bit(small_);
  if (size == 32) return std::uint32_t{1} << 31;
  std::optional<SymbolModel>& model = high_bits_[size];
  if (!model) model.emplace(1U << std::min(size, modelled_bits));
  std::uint32_t number = decoder.symbol(*model);
  if (size > modelled_bits) {
    const unsigned low = size - modelled_bits;
    number = number << low | decoder.bits(low);
  }
  return number >= 1U << (size - 1) ? number + 1 : number - ((1U << size) - 1);
}

std::int32_t IntegerDecoder::next(ArithmeticDecoder& decoder, std::int32_t prediction,
                                  std::uint32_t context) {
  last_bits_ = decoder.symbol(sizes_[context]);
  const std::uint32_t sum = static_cast<std::uint32_t>(prediction) + difference(decoder);
  const std::uint32_t mask = bits_ == 32 ? ~std::uint32_t{0} : (1U << bits_) - 1;
  return static_cast<std::int32_t>(sum & mask);
}

void RunningMedian::add(std::int32_t value) {
  std::int32_t* const v = values_;
  const bool goes_below = replaces_highest_ && value < v[2], goes_above = !replaces_highest_ && v[2] < value;
  if (goes_below || goes_above) {
    // If the highest value is to be replaced, but the new value is below the median: removes the highest
    // value, moves the median and the value above the median one place up, and inserts the new value below
    // the median. If the lowest value is to be replaced, but the new value is above the median: does the same
    // in the opposite direction. The next new value replaces a value at the same end.
    if (goes_below) std::copy_backward(v + 2, v + 4, v + 5);
    if (goes_above) std::copy(v + 1, v + 3, v);
    if (goes_below) {
      v[2] = value < v[1] ? v[1] : value;
      v[1] = value < v[0] ? v[0] : std::min(value, v[1]);
      v[0] = std::min(value, v[0]);
    } else {
      v[2] = v[3] < value ? v[3] : value;
      v[3] = v[4] < value ? v[4] : std::max(value, v[3]);
      v[4] = std::max(value, v[4]);
    }
    return;
  }
  if (replaces_highest_) {
    v[4] = value < v[3] ? v[3] : value;
    v[3] = std::min(value, v[3]);
  } else {
    v[0] = v[1] < value ? v[1] : value;
    v[1] = std::max(value, v[1]);
  }
  replaces_highest_ = !replaces_highest_;
}

}  // namespace relievo::io
