#include "native/errors.h"

#include <new>

#include "common/memory_reserve.h"
#include "native/options.h"
#include "relievo/core/within_memory.h"

namespace relievo::python {

std::string path_of(py::handle path) {
  const auto bytes = py::reinterpret_steal<py::bytes>(PyUnicode_EncodeFSDefault(path.ptr()));
  if (!bytes) throw py::error_already_set();
  return bytes;
}

py::str text_of(std::string_view text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape"));
}

void raise(const Error& error) {
  const std::string input = error.kind == ErrorKind::option ? keyword_of(error.input) : error.input;
  const py::object type =
      py::module_::import("relievo._errors").attr(error.kind == ErrorKind::memory ? "OutOfMemory" : "Error");
  PyErr_SetObject(type.ptr(), type(text_of(name_of(error.kind)), text_of(input), text_of(error.place),
                                   text_of(error.expected))
                                  .ptr());
  throw py::error_already_set();
}

void raise_input(std::string name, std::string place, std::string expected) {
  raise({ErrorKind::input, std::move(name), std::move(place), std::move(expected)});
}

void add_errors() {
  app::keep_memory_in_reserve();
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
      try {
        raise(memory_error());
      } catch (py::error_already_set& error) {
        error.restore();
      }
    }
  });
}

}  // namespace relievo::python
