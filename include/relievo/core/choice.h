// Words that stand for the values of an enumeration: one table reads them, writes them and names them in errors.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "relievo/core/error.h"

namespace relievo {

template <typename E>
struct Choice {
  std::string_view name;  // as typed
  E value;
};

// Returns "a, b or c".
std::string either(const std::vector<std::string_view>& names);

// Returns the error for a word that is none of those: "expected one of a, b or c, found 'x'", of kind option.
std::unexpected<Error> not_one_of(std::string_view option, const std::vector<std::string_view>& names,
                                  std::string_view found);

// Returns the words in the table's order.
template <typename E, std::size_t n>
std::vector<std::string_view> names_of(const std::array<Choice<E>, n>& choices) {
  std::vector<std::string_view> names;
  for (const Choice<E>& choice : choices) names.push_back(choice.name);
  return names;
}

// Returns the value of that word. Errors: kind option, naming `option` and all words, for any other.
template <typename E, std::size_t n>
Result<E> parse_choice(std::string_view option, std::string_view text,
                       const std::array<Choice<E>, n>& choices) {
  for (const Choice<E>& choice : choices)
    if (choice.name == text) return choice.value;
  return not_one_of(option, names_of(choices), text);
}

// Returns the word of a value that the table has; empty for others.
template <typename E, std::size_t n>
constexpr std::string_view name_in(const std::array<Choice<E>, n>& choices, E value) {
  for (const Choice<E>& choice : choices)
    if (choice.value == value) return choice.name;
  return {};
}

}  // namespace relievo
