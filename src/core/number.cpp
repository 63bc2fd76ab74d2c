#include "core/number.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace relievo {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// A decimal number: sign, digits without the decimal point, and a power of ten. It is exact for up to 18
// digits.
struct Decimal {
  bool is_negative = false;
  std::uint64_t digits = 0;
  int significant = 0;  // number of digits without leading zeros
  int exponent = 0;
};

// Reads digits with at most one decimal point. Returns whether there was a digit.
bool take_digits(const char*& at, const char* last, Decimal& number) {
  bool has_digits = false, is_fraction = false;
  for (; at != last && (is_digit(*at) || (*at == '.' && !is_fraction)); ++at) {
    if (*at == '.') {
      is_fraction = true;
      continue;
    }
    has_digits = true;
    if (number.significant > 0 || *at != '0') ++number.significant;
    if (number.significant <= 18) number.digits = number.digits * 10 + static_cast<std::uint64_t>(*at - '0');
    if (is_fraction) --number.exponent;
  }
  return has_digits;
}

// Reads an exponent and adds it to the power of ten. Does not read an "e" without digits after it.
void take_exponent(const char*& at, const char* last, Decimal& number) {
  if (at == last || (*at != 'e' && *at != 'E')) return;
  const char* digit = at + 1;
  const bool is_negative = digit != last && *digit == '-';
  if (digit != last && (*digit == '-' || *digit == '+')) ++digit;
  if (digit == last || !is_digit(*digit)) return;
  int exponent = 0;
  for (; digit != last && is_digit(*digit); ++digit)
    if (exponent < 100'000) exponent = exponent * 10 + (*digit - '0');
  number.exponent += is_negative ? -exponent : exponent;
  at = digit;
}

// Returns whether digits and power of ten are exact as doubles, so that a single operation rounds correctly
// (Clinger, 1990).
bool is_exact(const Decimal& number) {
  return number.significant <= 18 && number.digits <= (std::uint64_t{1} << 53) &&
         std::abs(number.exponent) <= 22;
}

double exact_value(const Decimal& number) {
  constexpr std::array powers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                              1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const auto digits = static_cast<double>(number.digits);
  const double power = powers[static_cast<std::size_t>(std::abs(number.exponent))];
  const double value = number.exponent < 0 ? digits / power : digits * power;
  return number.is_negative ? -value : value;
}

// Reads "inf", "infinity", "nan" and "nan(...)", in upper or lower case, after the sign.
ParsedNumber parse_special(std::string_view text, std::size_t sign) {
  const std::string copy(text.substr(0, 64));
  const char first = copy.size() > sign ? copy[sign] : ' ';
  if (first != 'i' && first != 'I' && first != 'n' && first != 'N')
    return {0, text.data(), std::errc::invalid_argument};
  char* end = nullptr;
  const double value = std::strtod(copy.c_str(), &end);
  if (end == copy.c_str()) return {0, text.data(), std::errc::invalid_argument};
  return {value, text.data() + (end - copy.c_str()), {}};
}

}  // namespace

ParsedNumber detail::parse_double_by_hand(std::string_view text) {
  const char *at = text.data(), *const last = at + text.size();
  Decimal number;
  number.is_negative = at != last && *at == '-';
  if (number.is_negative) ++at;
  if (!take_digits(at, last, number)) return parse_special(text, number.is_negative ? 1 : 0);
  take_exponent(at, last, number);
  if (is_exact(number)) return {exact_value(number), at, {}};
  const std::string copy(text.data(), at);
  const double value = std::strtod(copy.c_str(), nullptr);
  const bool is_out_of_range = std::isinf(value) || (value == 0 && number.digits != 0);
  if (is_out_of_range) return {0, at, std::errc::result_out_of_range};
  return {value, at, {}};
}

ParsedNumber parse_double(std::string_view text) {
#if defined(__cpp_lib_to_chars)
  ParsedNumber number;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
  number.end = end;
  number.error = error;
  return number;
#else
  return detail::parse_double_by_hand(text);
#endif
}

}  // namespace relievo
