// Parses numbers independently of the locale.
#pragma once

#include <charconv>
#include <string_view>

namespace relievo {

struct ParsedNumber {
  double value = 0;
  const char* end = nullptr;  // end of the number in the text
  std::errc error = {};       // as from std::from_chars()
};

// Parses a double like std::from_chars(), which reads only integers in some standard libraries.
ParsedNumber parse_double(std::string_view text);

namespace detail {
// The implementation for those standard libraries. Tests compare it with std::from_chars().
ParsedNumber parse_double_by_hand(std::string_view text);
}  // namespace detail

}  // namespace relievo
