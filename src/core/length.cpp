#include "relievo/core/length.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "relievo/core/text.h"

namespace relievo {
namespace {

// Removes a number from the beginning of the text and returns it; nothing if there is no finite number.
std::optional<double> take_number(std::string_view& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

// Returns the millimetres of a unit, or nothing if the unit is unknown.
std::optional<double> mm_of(std::string_view unit, LengthUnit bare) {
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
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
  return std::unexpected(Error{ErrorKind::option, "units", {}, cat("expected mm or in, found '", name, "'")});
}

Result<double> parse_length(std::string_view text, LengthUnit bare) {
  // std::from_chars does not depend on the locale, in which a comma might be the decimal point.
  std::string_view rest = text;
  std::optional<double> value = take_number(rest);
  if (value && rest.starts_with('/')) {
    rest.remove_prefix(1);
    const std::optional<double> parts = take_number(rest);
    value = parts && *parts > 0 ? std::optional(*value / *parts) : std::nullopt;
  }
  const std::optional<double> mm = mm_of(rest, bare);
  if (value && mm) return *value * *mm;
  return std::unexpected(Error{
      ErrorKind::option, {}, {}, cat("expected a length such as 12.5mm, 1cm or 3/8in, found '", text, "'")});
}

}  // namespace relievo
