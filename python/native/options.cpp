#include "native/options.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/files.h"
#include "common/option_list.h"
#include "common/output_files.h"
#include "common/wording.h"
#include "native/arrays.h"
#include "native/errors.h"
#include "relievo/core/text.h"
#include "relievo/io/write.h"
#include "relievo/samples/sample.h"

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

// The content of a file called `name`. An immutable Python object owns the bytes.
struct FileBytes {
  py::bytes object;
  std::string name;
  std::span<const std::byte> bytes;
};

// A model made from arrays of points and triangles, or from a depth image.
struct ArrayModel {
  std::string name;
  std::shared_ptr<const CloudFile> file;  // null for a depth image
  std::shared_ptr<const DepthImage> depths;
};

// One input: the path of a model, a scene or a project; the content of a file; or a model made from arrays.
using Source = std::variant<std::string, FileBytes, ArrayModel>;

// Returns the model with these points, and with normals, colours and triangles if they are not None.
// `missing` is the number of rows that the caller has left out.
ArrayModel array_model(const py::array& points, const std::optional<py::array>& normals,
                       const std::optional<py::array>& colours, const std::optional<py::array>& faces,
                       std::size_t missing) {
  auto file = std::make_shared<CloudFile>();
  Cloud& cloud = file->cloud;
  cloud.points = points_of({"points", points});
  if (normals) cloud.normals = normals_of({"normals", *normals}, cloud.size());
  if (colours) cloud.colours = colours_of({"colours", *colours}, cloud.size());
  file->format = "array";
  if (missing > 0) file->remarks.push_back(cat("left out ", missing, " rows that are not finite"));
  if (!faces) return {"points", std::move(file), nullptr};
  Mesh mesh{cloud.points, triangles_of({"faces", *faces}, cloud.size()), {}, cloud.colours};
  for (const auto& [a, b, c] : mesh.triangles)
    if (cloud.has_normals())
      mesh.corner_normals.push_back({cloud.normals[a], cloud.normals[b], cloud.normals[c]});
  file->mesh = std::move(mesh);
  return {"vertices", std::move(file), nullptr};
}

ArrayModel depth_model(const py::array& depths) {
  return {"depths", nullptr, std::make_shared<const DepthImage>(depth_image_of({"source", depths}))};
}

struct NameOf {
  std::string operator()(const std::string& path) const { return path; }
  std::string operator()(const FileBytes& file) const { return file.name; }
  std::string operator()(const ArrayModel& model) const { return model.name; }
};

SceneModel scene_model(const ArrayModel& model) {
  SceneModel made{model.name, model.file};
  for (const std::string& remark : model.file->remarks) made.remarks.push_back(cat(model.name, ": ", remark));
  return made;
}

struct SourceReader {
  const app::InputArguments& arguments;
  const app::PointsWanted& wanted;
  Progress* progress;
  bool is_alone;

  Result<Scene> operator()(const std::string& path) const {
    if (app::is_scene_file(path) && !is_alone)
      return option_error(path, "expected a scene file alone, or models without one");
    return app::read_scene({path}, arguments, wanted, progress);
  }
  Result<Scene> operator()(const FileBytes& file) const {
    RELIEVO_CHECK(begin_stage(progress, "read", 0));
    RELIEVO_TRY(SceneModel model,
                app::parse_input(file.bytes, file.name, arguments, wanted.points, progress));
    return Scene{{std::move(model)}};
  }
  Result<Scene> operator()(const ArrayModel& model) const {
    if (model.file) return Scene{{scene_model(model)}};
    RELIEVO_TRY(SceneModel read,
                app::take_depths(*model.depths, model.name, arguments, wanted.points, progress));
    return Scene{{std::move(read)}};
  }
};

py::tuple sample(const std::string& name, std::size_t points, double noise) {
  Cloud cloud = value_or_raise(make_sample(name, {points, noise}));
  const auto owner = std::make_shared<const Cloud>(std::move(cloud));
  const auto array_or_none = [&](const auto& rows) {
    return rows.empty() ? py::object(py::none()) : view_of(rows, owner);
  };
  return py::make_tuple(view_of(owner->points, owner), array_or_none(owner->normals),
                        array_or_none(owner->colours));
}

void write_cloud(const ArrayModel& model, const py::str& to, const std::string& comment) {
  const std::string path = path_of(to);
  value_or_raise(app::check_output(path, {".ply"}));
  const app::OutputFile file{path, write_ply(model.file->cloud, comment)};
  value_or_raise(app::write_files({&file, 1}));
}

// Returns the sources in a list of texts, (bytes, name) tuples, and models made by array_model() and
// depth_model().
std::vector<Source> sources_of(const py::list& list) {
  std::vector<Source> sources;
  for (const py::handle item : list) {
    if (py::isinstance<py::str>(item)) {
      sources.emplace_back(path_of(item));
    } else if (py::isinstance<ArrayModel>(item)) {
      sources.emplace_back(item.cast<ArrayModel>());
    } else {
      const auto [bytes, name] = item.cast<std::pair<py::bytes, std::string>>();
      const std::string_view text(bytes);
      sources.emplace_back(FileBytes{bytes, name, std::as_bytes(std::span(text))});
    }
  }
  return sources;
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

std::vector<std::string> unset_options(const py::dict& given) {
  std::vector<std::string> names;
  for (const OptionRow& option : option_table()) {
    const std::string keyword = app::keyword_of(option);
    if (given.contains(keyword.c_str()) && given[keyword.c_str()].is_none()) names.emplace_back(option.name);
  }
  return names;
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

void take_sources(const py::list& list, app::MakeOrder& order) {
  // The sources are shared and not copied, because copies would change Python's reference counts in a thread
  // without Python's lock.
  const auto sources = std::make_shared<const std::vector<Source>>(sources_of(list));
  std::vector<std::string> names;
  for (const Source& source : *sources) {
    names.push_back(std::visit(NameOf(), source));
    if (std::holds_alternative<std::string>(source)) order.inputs.push_back(names.back());
  }
  if (order.inputs.size() == sources->size()) return;
  order.name = app::joined(names);
  order.read = [sources](const app::InputArguments& arguments, const app::PointsWanted& wanted,
                         Progress* progress) -> Result<Scene> {
    Scene all;
    for (const Source& source : *sources) {
      RELIEVO_TRY(Scene one,
                  std::visit(SourceReader{arguments, wanted, progress, sources->size() == 1}, source));
      std::ranges::move(one.models, std::back_inserter(all.models));
    }
    return all;
  };
}

void add_inputs(py::module_& module) {
  py::class_<ArrayModel>(module, "Model");
  module.def("array_model", &array_model, py::arg("points"), py::arg("normals"), py::arg("colours"),
             py::arg("faces"), py::arg("missing") = 0);
  module.def("depth_model", &depth_model);
  module.def("sample", &sample);
  module.def("write_cloud", &write_cloud);
}

}  // namespace relievo::python
