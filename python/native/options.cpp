#include "native/options.h"

#include <pybind11/stl.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "common/option_list.h"
#include "common/wording.h"
#include "native/errors.h"
#include "relievo/core/text.h"

namespace relievo::python {
namespace {

[[noreturn]] void raise_type(const std::string& keyword, std::string_view expected, py::handle value) {
  throw py::type_error(cat(keyword, ": ", expected, ", found ", Py_TYPE(value.ptr())->tp_name));
}

// Returns the value as a number or a text, according to the option's type. A length may be a text with a
// unit, as on the command line.
OptionValue value_of(const OptionRow& option, py::handle given) {
  const bool is_text = py::isinstance<py::str>(given);
  if (is_text && (!option.is_number() || option.is_length())) return given.cast<std::string>();
  const double number = is_text || PyBool_Check(given.ptr()) ? -1 : PyFloat_AsDouble(given.ptr());
  const bool is_number = !is_text && !PyBool_Check(given.ptr()) && !PyErr_Occurred();
  PyErr_Clear();
  if (!is_number || !option.is_number()) raise_type(app::keyword_of(option), expected_type(option), given);
  return number;
}

py::object table() {
  return py::module_::import("json").attr("loads")(app::keyword_list().dump());
}

}  // namespace

std::string keyword_of(std::string_view name) {
  if (name == "base-image") return "base_image";
  const OptionRow* const option = find_option(name);
  return option ? app::keyword_of(*option) : std::string(name);
}

OptionValues values_of(const py::dict& given) {
  OptionValues values;
  for (const OptionRow& option : option_table()) {
    const py::object found = given.attr("get")(app::keyword_of(option));
    if (!found.is_none()) values.emplace(option.name, value_of(option, found));
  }
  return values;
}

app::InputArguments input_arguments(const py::dict& given) {
  app::InputArguments arguments;
  const OptionRow stream{.name = "stream_above_mb", .unit = "MB", .min = 0, .max = 1e9, .help = {}};
  if (const py::object found = given.attr("get")("stream_above_mb"); !found.is_none())
    arguments.stream_above_mb = std::get<double>(value_of(stream, found));
  return arguments;
}

void add_options(py::module_& module) {
  module.def("option_table", &table);
  module.def("nearest_name", &app::nearest_name);
}

}  // namespace relievo::python
