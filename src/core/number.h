// Parses numbers independently of the locale.
#pragma once

#include <charconv>
#include <string_view>

namespace relievo {

struct ParsedNumber {
  double value = 0;
  const char* end = nullptr;  // end of the number in the text
  std::errc error = {};       // see std::from_chars()
};

// Parses a double like std::from_chars(). In some standard libraries std::from_chars() reads only integers.
ParsedNumber parse_double(std::string_view text);

namespace detail {
// The implementation for standard libraries whose std::from_chars() reads only integers. Tests compare it
// with std::from_chars().
ParsedNumber parse_double_by_hand(std::string_view text);
}  // namespace detail

}  // namespace relievo
