// Defines tables with the words for an enumeration's values. The same table is used to parse the words, to
// write them, and to list them in errors.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"

namespace relievo {

template <typename E>
struct Choice {
  std::string_view name;  // the word that users type
  E value;
};

// Returns the names joined, such as "a, b or c".
std::string either(const std::vector<std::string_view>& names);

// Returns an error of kind option for a word that is not in `names`: "expected one of a, b or c, found 'x'".
std::unexpected<Error> not_one_of(std::string_view option, const std::vector<std::string_view>& names,
                                  std::string_view found);

// Returns the words of a table, in the table's order. Each entry must have a member `name`.
template <typename Table>
std::vector<std::string_view> names_of(const Table& choices) {
  std::vector<std::string_view> names;
  for (const auto& choice : choices) names.push_back(choice.name);
  return names;
}

// Returns the value for the word `text`. For any other text, returns an error of kind option that names
// `option` and lists all words.
template <typename E, std::size_t n>
Result<E> parse_choice(std::string_view option, std::string_view text,
                       const std::array<Choice<E>, n>& choices) {
  for (const Choice<E>& choice : choices)
    if (choice.name == text) return choice.value;
  return not_one_of(option, names_of(choices), text);
}

// Returns the word for `value`; an empty text if the table does not contain that value.
template <typename E, std::size_t n>
constexpr std::string_view name_in(const std::array<Choice<E>, n>& choices, E value) {
  for (const Choice<E>& choice : choices)
    if (choice.value == value) return choice.name;
  return {};
}

}  // namespace relievo
