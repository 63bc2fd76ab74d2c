// Parses a shape with parameters, such as "wave:height=3,length=40,hollow". Tested by base_test and
// wrap_test.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "relievo/core/error.h"

namespace relievo {

enum class ShapeUnit { mm, degrees };

// A parameter with a number, and the variable for it. A length may have a unit: "diameter=2 1/2in".
struct ShapeNumber {
  std::string_view name;
  std::optional<double>* value;
  ShapeUnit unit = ShapeUnit::mm;
};

// A parameter without a value, and the variable that becomes true if the text contains it.
struct ShapeWord {
  std::string_view name;
  bool* value;
};

// Returns the text before the colon, or all of it if there is no colon.
std::string_view shape_kind(std::string_view text);

// Parses the parameters after the colon into `numbers` and `words`. Variables of parameters that are not in
// the text keep their values. A comma before a digit is a decimal comma; other commas separate parameters.
// Errors: kind option, naming `option`, for unknown parameters and for values that are not lengths or finite
// numbers.
Result<void> read_shape(std::string_view text, std::string_view option, std::span<const ShapeNumber> numbers,
                        std::span<const ShapeWord> words);

}  // namespace relievo
