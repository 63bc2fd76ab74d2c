#include "native/options.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "common/option_list.h"
#include "native/errors.h"
#include "relievo/core/text.h"

namespace relievo::python {
namespace {

[[noreturn]] void raise_type(const std::string& keyword, const char* expected, py::handle value) {
  throw py::type_error(cat(keyword, ": expected ", expected, ", found ", Py_TYPE(value.ptr())->tp_name));
}

// Takes the values of the keywords that a table of options names.
struct KeywordReader {
  const py::dict& given;

  void operator()(const OptionField& field, double& value) const {
    if (const std::optional<double> number = take_number(field)) value = *number;
  }
  void operator()(const OptionField& field, std::optional<double>& value) const {
    if (const std::optional<double> number = take_number(field)) value = number;
  }
  void operator()(const OptionField& field, std::string& value) const {
    const py::object found = find(field);
    if (found.is_none()) return;
    if (!py::isinstance<py::str>(found)) raise_type(app::keyword_of(field), "a text", found);
    value = found.cast<std::string>();
  }

  py::object find(const OptionField& field) const { return given.attr("get")(app::keyword_of(field)); }

  // Lengths may be texts with a unit, as on the command line.
  std::optional<double> take_number(const OptionField& field) const {
    const py::object found = find(field);
    if (found.is_none()) return std::nullopt;
    const bool is_length = field.unit == "MM";
    if (is_length && py::isinstance<py::str>(found)) {
      Result<double> length = parse_length(found.cast<std::string>());
      if (!length) length.error().input = field.name;
      return value_or_raise(std::move(length));
    }
    const double number = PyBool_Check(found.ptr()) ? -1 : PyFloat_AsDouble(found.ptr());
    if (PyBool_Check(found.ptr()) || PyErr_Occurred()) {
      PyErr_Clear();
      raise_type(app::keyword_of(field), is_length ? "a number or a length such as '4in'" : "a number",
                 found);
    }
    return number;
  }
};

py::object table() {
  return py::module_::import("json").attr("loads")(app::keyword_list().dump());
}

}  // namespace

std::string keyword_of(std::string_view name) {
  for (const ReliefField& field : option_fields())
    if (field.name == name) return app::keyword_of(field);
  if (name == "base-image") return "base_image";
  DepthTexts depth;
  std::string keyword(name);
  visit(depth, [&](const OptionField& field, const auto&) {
    if (field.name == name) keyword = app::keyword_of(field);
  });
  return keyword;
}

OptionTexts texts_of(const py::dict& given) {
  OptionTexts texts;
  visit(texts, KeywordReader{given});
  return texts;
}

app::InputArguments input_arguments(const py::dict& given) {
  DepthTexts depth;
  const KeywordReader reader{given};
  visit(depth, reader);
  app::InputArguments arguments;
  arguments.depth = value_or_raise(parse_depth(depth));
  reader({"camera", "TEXT", ""}, arguments.camera);
  reader({"stream_above_mb", "MB", ""}, arguments.stream_above_mb);
  return arguments;
}

void add_options(py::module_& module) {
  module.def("option_table", &table);
}

}  // namespace relievo::python
