// Raises the library's errors as Python exceptions.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <utility>

#include "relievo/core/error.h"

namespace relievo::python {

namespace py = pybind11;

// Convert paths, and texts that contain paths. Bytes that are not UTF-8 become surrogates in Python, as in
// Python's os module.
std::string path_of(py::handle path);
py::str text_of(std::string_view text);

// Raises OutOfMemory for an error of kind memory, and relievo.Error for other errors. If the error names an
// option, the exception names its keyword.
[[noreturn]] void raise(const Error& error);

// Raises relievo.Error of kind input for the array called `name`. `place` is the position of the fault in the
// array.
[[noreturn]] void raise_input(std::string name, std::string place, std::string expected);

// Makes all calls from Python raise OutOfMemory for std::bad_alloc, and reserves the memory for this exception.
void add_errors();

// Returns the value of a result, or raises its error.
template <typename T>
T value_or_raise(Result<T> result) {
  if (!result) raise(result.error());
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

}  // namespace relievo::python
