// Defines errors, which functions return as values. The library throws nothing and prints nothing.
#pragma once

#include <version>
#ifndef __cpp_lib_expected
#error "Relievo's headers need C++23 with std::expected: g++ 12, or clang++ 19 with libstdc++, and -std=c++23"
#endif

#include <expected>
#include <string>
#include <string_view>
#include <utility>

namespace relievo {

enum class ErrorKind {
  input,      // a file's bytes contradict their format
  option,     // a parameter is out of range, or two parameters contradict each other
  geometry,   // the points do not determine a relief
  cancelled,  // Progress::cancel() was called
  output,     // a file could not be written
  memory,     // an allocation failed; see within_memory.h
};

// Returns the kind's name in files and messages: "input", "option" and so on.
constexpr std::string_view name_of(ErrorKind kind) {
  constexpr std::string_view names[] = {"input", "option", "geometry", "cancelled", "output", "memory"};
  return names[static_cast<int>(kind)];
}

// Describes an error: the input, the position in it, and what was expected and found there.
struct Error {
  ErrorKind kind = ErrorKind::input;
  // The caller's name for the input or option, such as "scan.ply" or "height"; may be empty.
  std::string input;
  std::string place;     // "line 12", "byte 340", "vertex 7"; empty if the error concerns the whole input
  std::string expected;  // one clause that says what was expected and what was found instead

  // Returns the error as one line of text: "scan.ply, line 12: expected 3 numbers, found 'abc'". Empty
  // members are left out.
  std::string message() const {
    std::string head = input;
    if (!place.empty()) head += (head.empty() ? "" : ", ") + place;
    return head.empty() ? expected : head + ": " + expected;
  }
};

template <typename T>
using Result = std::expected<T, Error>;

// Return errors of kind input, option, geometry and cancelled, for functions that return a Result.
inline std::unexpected<Error> input_error(std::string input, std::string place, std::string expected) {
  return std::unexpected(Error{ErrorKind::input, std::move(input), std::move(place), std::move(expected)});
}
inline std::unexpected<Error> option_error(std::string option, std::string expected) {
  return std::unexpected(Error{ErrorKind::option, std::move(option), {}, std::move(expected)});
}
inline std::unexpected<Error> geometry_error(std::string input, std::string expected) {
  return std::unexpected(Error{ErrorKind::geometry, std::move(input), {}, std::move(expected)});
}
inline std::unexpected<Error> geometry_error(std::string expected) {
  return geometry_error({}, std::move(expected));
}
inline std::unexpected<Error> cancelled_error() {
  return std::unexpected(Error{ErrorKind::cancelled, {}, {}, "cancelled"});
}

// These are macros, because a function cannot make its caller return.
#define RELIEVO_JOIN_(a, b) a##b
#define RELIEVO_JOIN(a, b) RELIEVO_JOIN_(a, b)

// Returns from the calling function with the error of a Result, if the Result is an error.
#define RELIEVO_CHECK(...) \
  if (auto checked = (__VA_ARGS__); !checked) return std::unexpected(std::move(checked).error())

// Declares a variable with the value of a Result, or returns the Result's error from the calling function:
// RELIEVO_TRY(const Surface surface, find_surface(cloud, view));
#define RELIEVO_TRY(declaration, ...) RELIEVO_TRY_(RELIEVO_JOIN(tried_, __LINE__), declaration, __VA_ARGS__)
#define RELIEVO_TRY_(result, declaration, ...)                    \
  auto result = (__VA_ARGS__);                                    \
  if (!result) return std::unexpected(std::move(result).error()); \
  declaration = *std::move(result)

}  // namespace relievo
