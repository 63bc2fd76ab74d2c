#include "io/las/integer_decoder.h"

namespace relievo::io {
namespace {

constexpr std::uint32_t modelled_bits = 8;  // number of highest bits of a difference that have a model

}  // namespace

IntegerDecoder::IntegerDecoder(unsigned bits, std::uint32_t contexts)
    : bits_(bits), sizes_(contexts, SymbolModel(bits + 1)), high_bits_(bits + 1) {}

// A difference of size k is in [-(2^k - 1), -2^(k - 1)] or [2^(k - 1) + 1, 2^k]; of size 0 it is 0 or 1.
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
    // Shifts the half on the other side of the median by one and inserts the value into its own half. The
    // next value replaces the same end.
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
