// Texts that name a shape and its numbers: "wave:height=3,length=40,hollow".
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "relievo/core/error.h"

namespace relievo {

struct ShapeNumber {
  std::string_view name;
  std::optional<double>* value;
};

struct ShapeWord {
  std::string_view name;
  bool* value;
};

// The part before the colon, all of the text if it has none.
std::string_view shape_kind(std::string_view text);

// Sets what the text tells after its kind; a number that it does not tell stays as it is. Errors: kind
// option, naming `option`, for names that are neither numbers nor words of the shape, and for values that are
// no finite numbers.
Result<void> read_shape(std::string_view text, std::string_view option, std::span<const ShapeNumber> numbers,
                        std::span<const ShapeWord> words);

// The error of an option.
std::unexpected<Error> wrong_shape(std::string_view option, std::string expected);

}  // namespace relievo
