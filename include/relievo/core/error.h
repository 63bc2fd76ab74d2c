// Errors as values: the library throws nothing and prints nothing.
#pragma once

#include <expected>
#include <string>

namespace relievo {

enum class ErrorKind {
  input,      // a file's bytes are not what their format promises
  option,     // a parameter is out of its range, or two contradict each other
  geometry,   // the points do not determine a relief
  cancelled,  // Progress::cancel() was called
  output,     // a file could not be written
};

// What went wrong: which input, where in it, and what was expected there.
struct Error {
  ErrorKind kind = ErrorKind::input;
  std::string input;  // the name the caller gave to the input or option, "scan.ply", "--height"; may be empty
  std::string place;  // "line 12", "byte 340", "vertex 7"; empty when the whole input is meant
  std::string expected;  // one clause: what was expected and what was found instead

  // One line for a person: "scan.ply, line 12: expected 3 numbers, found 'abc'". Empty parts are left out.
  std::string message() const {
    std::string head = input;
    if (!place.empty()) head += (head.empty() ? "" : ", ") + place;
    return head.empty() ? expected : head + ": " + expected;
  }
};

template <typename T>
using Result = std::expected<T, Error>;

}  // namespace relievo
