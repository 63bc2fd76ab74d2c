#include "relievo/core/text.h"

#include <cmath>
#include <cstdio>

#include "core/number.h"
#include "relievo/core/choice.h"

namespace relievo {

// std::to_chars() is independent of the locale, but std::snprintf() depends on it. WebAssembly has no locales
// and uses std::snprintf(), because the tables of std::to_chars() would take a tenth of the module's size.
void append(std::string& out, double number) {
  char digits[32];
#if defined(__wasm__)
  out.append(digits, static_cast<std::size_t>(std::snprintf(digits, sizeof digits, "%.6g", number)));
#else
  out.append(digits,
             std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6).ptr);
#endif
}

std::string escaped_markup(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool is_allowed = static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\t';
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += is_allowed ? c : ' ';
  }
  return out;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const auto [number, rest, status] = parse_double(text);
    if (status != std::errc{} || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
    text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
    if (text.empty()) return numbers;
    if (text.front() != ',') return std::nullopt;
    text.remove_prefix(1);
  }
}

std::optional<Vec3> parse_triple(std::string_view text) {
  const auto numbers = parse_numbers(text);
  if (!numbers || numbers->size() != 3) return std::nullopt;
  return Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

std::string either(const std::vector<std::string_view>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += cat(i == 0 ? "" : i + 1 == names.size() ? " or " : ", ", names[i]);
  return text;
}

std::unexpected<Error> not_one_of(std::string_view option, const std::vector<std::string_view>& names,
                                  std::string_view found) {
  return option_error(std::string(option), cat("expected one of ", either(names), ", found '", found, "'"));
}

}  // namespace relievo
