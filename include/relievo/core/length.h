// Parses lengths as users write them, in millimetres, centimetres or inches. Tested by
// tests/core/length_test.cpp.
#pragma once

#include <string_view>

#include "relievo/core/error.h"
#include "relievo/core/types.h"

namespace relievo {

inline constexpr double mm_per_inch = 25.4;

// Returns the length of one unit in millimetres.
constexpr double mm_per(LengthUnit unit) {
  return unit == LengthUnit::inch ? mm_per_inch : 1;
}

// Returns "mm" or "in".
constexpr std::string_view name_of(LengthUnit unit) {
  return unit == LengthUnit::inch ? "in" : "mm";
}

// Returns the unit with the name "mm" or "in". Errors: kind option for any other name; the error's input is
// "units".
Result<LengthUnit> parse_unit(std::string_view name);

// Returns the length in millimetres that a text describes, such as "12.5mm", "2,5cm", "4in", "4\"", "1 3/8in"
// or "3+0.5". The text is a number, a fraction, a number with a fraction, or a sum of these. A single unit
// may follow, with or without a space; a text without a unit is in `bare`. Numbers have a decimal point or
// comma. "1,234" is an error, because the comma could separate thousands. The result is finite and may be
// negative. Errors: kind option for any other text; the error's input is empty, for the caller to fill in.
//
// apps/studio/page/lengths.js is the same function in JavaScript; tests/core/lengths.json has test cases for
// both.
Result<double> parse_length(std::string_view text, LengthUnit bare = LengthUnit::mm);

}  // namespace relievo
