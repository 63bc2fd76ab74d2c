// Lengths as people write them: in millimetres, centimetres or inches.
#pragma once

#include <string_view>

#include "relievo/core/error.h"

namespace relievo {

enum class LengthUnit { mm, inch };

inline constexpr double mm_per_inch = 25.4;

// Millimetres of one unit.
constexpr double mm_per(LengthUnit unit) {
  return unit == LengthUnit::inch ? mm_per_inch : 1;
}

// "mm" or "in".
constexpr std::string_view name_of(LengthUnit unit) {
  return unit == LengthUnit::inch ? "in" : "mm";
}

// Returns the unit of that name, mm or in. Errors: kind option for any other, naming --units.
Result<LengthUnit> parse_unit(std::string_view name);

// Returns the millimetres of "12.5mm", "1cm", "4in", "4\"" or "3/8in": a number or a fraction of two, and its
// unit, with or without a space between; without a unit it is in `bare`. Finite, of any sign. Errors: kind
// option for any other text; its input is for the caller to name.
Result<double> parse_length(std::string_view text, LengthUnit bare = LengthUnit::mm);

}  // namespace relievo
