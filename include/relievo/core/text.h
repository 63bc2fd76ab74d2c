// Joins texts and parses small inputs, independently of the locale. Tested by tests/core/text_test.cpp.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/types.h"

namespace relievo {

inline void append(std::string& out, std::string_view text) {
  out += text;
}
inline void append(std::string& out, char c) {
  out += c;
}
void append(std::string& out, double number);
template <typename T>
requires std::is_integral_v<T>
void append(std::string& out, T number) {
  char digits[32];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

// Returns the concatenation of texts, characters and numbers. Floating-point numbers get six significant
// digits.
template <typename... Parts>
std::string cat(const Parts&... parts) {
  std::string out;
  (append(out, parts), ...);
  return out;
}

// Returns the text for XML or HTML: special characters are escaped, and control characters, which are not
// allowed there, become blanks.
std::string escaped_markup(std::string_view text);

// Parses finite numbers separated by commas. Returns nothing for any other text.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

// Parses "X,Y,Z" as three finite numbers. Returns nothing for any other text.
std::optional<Vec3> parse_triple(std::string_view text);

}  // namespace relievo
