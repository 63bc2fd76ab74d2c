// Numbers from text, independent of the locale. Tested by tests/core/number_test.cpp.
#pragma once

#include <charconv>
#include <string_view>

namespace relievo {

struct ParsedNumber {
  double value = 0;
  const char* end = nullptr;  // end of the number in the text
  std::errc error = {};       // as std::from_chars() reports it
};

// Parses a double as std::from_chars() does, also where the standard library's function reads only integers.
ParsedNumber parse_double(std::string_view text);

namespace detail {
// The implementation for such standard libraries. Tests compare it with std::from_chars().
ParsedNumber parse_double_by_hand(std::string_view text);
}  // namespace detail

}  // namespace relievo
