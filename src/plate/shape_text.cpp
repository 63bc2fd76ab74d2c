#include "plate/shape_text.h"

#include <algorithm>
#include <cctype>

#include "relievo/core/length.h"
#include "relievo/core/text.h"

namespace relievo {
namespace {

std::optional<double> value_of(std::string_view text, ShapeUnit unit) {
  const bool has_unit = text.find_first_not_of("0123456789.,+-/eE ") != std::string_view::npos;
  if (unit == ShapeUnit::degrees && has_unit) return std::nullopt;
  const Result<double> value = parse_length(text);
  return value ? std::optional(*value) : std::nullopt;
}

// Returns the text up to the first comma that is not followed by a digit.
std::string_view first_entry(std::string_view text) {
  std::size_t comma = text.find(',');
  while (comma != std::string_view::npos && comma + 1 < text.size() &&
         std::isdigit(static_cast<unsigned char>(text[comma + 1])))
    comma = text.find(',', comma + 1);
  return text.substr(0, comma);
}

std::string names_of(std::span<const ShapeNumber> numbers, std::span<const ShapeWord> words) {
  std::string names;
  const auto add = [&](std::string_view name, std::string_view value) {
    names += cat(names.empty() ? "" : ", ", name, value);
  };
  for (const ShapeNumber& number : numbers) add(number.name, number.unit == ShapeUnit::mm ? "=MM" : "=DEG");
  for (const ShapeWord& word : words) add(word.name, "");
  return names.empty() ? "nothing" : names;
}

bool read_entry(std::string_view entry, std::span<const ShapeNumber> numbers,
                std::span<const ShapeWord> words) {
  const std::size_t equals = entry.find('=');
  const std::string_view name = entry.substr(0, equals);
  if (equals == std::string_view::npos) {
    const auto word = std::ranges::find(words, name, &ShapeWord::name);
    if (word != words.end()) *word->value = true;
    return word != words.end();
  }
  const auto number = std::ranges::find(numbers, name, &ShapeNumber::name);
  if (number == numbers.end()) return false;
  *number->value = value_of(entry.substr(equals + 1), number->unit);
  return number->value->has_value();
}

}  // namespace

std::string_view shape_kind(std::string_view text) {
  return text.substr(0, text.find(':'));
}

Result<void> read_shape(std::string_view text, std::string_view option, std::span<const ShapeNumber> numbers,
                        std::span<const ShapeWord> words) {
  const std::string_view kind = shape_kind(text);
  if (kind.size() == text.size()) return {};
  std::string_view rest = text.substr(kind.size() + 1);
  while (true) {
    const std::string_view entry = first_entry(rest);
    if (!read_entry(entry, numbers, words))
      return option_error(std::string(option), cat("expected ", names_of(numbers, words), " after '", kind,
                                                   ":', found '", entry, "'"));
    if (entry.size() == rest.size()) return {};
    rest.remove_prefix(entry.size() + 1);
  }
}

}  // namespace relievo
