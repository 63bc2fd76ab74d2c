#include "relievo/core/length.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/number.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

void skip_spaces(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
}

// Returns whether the comma is ambiguous. In "1,234" it may be a decimal comma or a thousands separator. In
// "0,125" it can only be a decimal comma.
bool is_ambiguous(std::string_view number) {
  const std::size_t comma = number.find(',');
  if (comma == std::string_view::npos || number.size() - comma != 4) return false;
  const bool has_digits_only = number.find_first_not_of("0123456789", comma + 1) == std::string_view::npos;
  return has_digits_only && number.find_first_of("123456789") < comma;
}

// Removes an unsigned number from the beginning of the text. Returns the number, or nothing if the text does
// not begin with a finite number. Uses parse_double(), which does not depend on the locale, because a locale
// might allow only decimal commas.
std::optional<double> take_number(std::string_view& text) {
  std::string digits(text);
  std::ranges::replace(digits, ',', '.');
  const auto [value, end, error] = parse_double(digits);
  const auto size = static_cast<std::size_t>(end - digits.data());
  if (error != std::errc() || !std::isfinite(value) || text.front() == '-') return std::nullopt;
  if (is_ambiguous(text.substr(0, size))) return std::nullopt;
  text.remove_prefix(size);
  return value;
}

// Removes a number or a fraction of two numbers. Returns its value.
std::optional<double> take_fraction(std::string_view& text) {
  const std::optional<double> value = take_number(text);
  if (!value || !text.starts_with('/')) return value;
  text.remove_prefix(1);
  const std::optional<double> parts = take_number(text);
  return parts && *parts > 0 ? std::optional(*value / *parts) : std::nullopt;
}

// Returns the length of the integer in a text such as "1 1/8", including the spaces after it; 0 if the text
// does not begin with such an integer.
std::size_t whole_part(std::string_view text) {
  constexpr std::string_view digits = "0123456789";
  const std::size_t spaces = std::min(text.find_first_not_of(digits), text.size());
  const std::size_t fraction = std::min(text.find_first_not_of(' ', spaces), text.size());
  const std::size_t slash = text.find_first_not_of(digits, fraction);
  const bool is_mixed =
      spaces > 0 && fraction > spaces && slash > fraction && slash != std::string_view::npos;
  return is_mixed && text[slash] == '/' ? fraction : 0;
}

// Removes a number, a fraction, or an integer with a fraction. Returns its value.
std::optional<double> take_term(std::string_view& text) {
  const std::size_t whole = whole_part(text);
  const std::optional<double> number = whole > 0 ? take_number(text) : std::optional(0.0);
  if (whole > 0) skip_spaces(text);
  const std::optional<double> fraction = take_fraction(text);
  return number && fraction ? std::optional(*number + *fraction) : std::nullopt;
}

// Removes a sum such as "-3 + 1/2 - 0.5". Returns its value.
std::optional<double> take_sum(std::string_view& text) {
  double sum = 0;
  for (bool is_first = true;; is_first = false) {
    const bool is_negative = text.starts_with('-');
    if (is_negative || (!is_first && text.starts_with('+')))
      text.remove_prefix(1);
    else if (!is_first)
      return sum;
    if (!is_first) skip_spaces(text);
    const std::optional<double> term = take_term(text);
    if (!term) return std::nullopt;
    sum += is_negative ? -*term : *term;
    skip_spaces(text);
  }
}

// Returns the length of a unit in millimetres; nothing if the unit is unknown.
std::optional<double> mm_of(std::string_view unit, LengthUnit bare) {
  if (unit.empty()) return mm_per(bare);
  constexpr std::array<std::pair<std::string_view, double>, 4> known{
      {{"mm", 1}, {"cm", 10}, {"in", mm_per_inch}, {"\"", mm_per_inch}}};
  for (const auto& [name, mm] : known)
    if (unit == name) return mm;
  return std::nullopt;
}

}  // namespace

Result<LengthUnit> parse_unit(std::string_view name) {
  if (name == "mm") return LengthUnit::mm;
  if (name == "in") return LengthUnit::inch;
  return option_error("units", cat("expected mm or in, found '", name, "'"));
}

Result<double> parse_length(std::string_view text, LengthUnit bare) {
  std::string_view rest = text.substr(0, text.find_last_not_of(' ') + 1);
  skip_spaces(rest);
  const std::optional<double> value = take_sum(rest), mm = mm_of(rest, bare);
  if (value && mm) return *value * *mm;
  return option_error({}, cat("expected a length such as 12.5mm, 2,5cm, 3/8in or 3+0.5, found '", text, "'"));
}

}  // namespace relievo
