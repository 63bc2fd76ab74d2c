#include "native/relief.h"

#include <pybind11/stl.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "common/export_file.h"
#include "common/files.h"
#include "common/input_files.h"
#include "common/relief_files.h"
#include "native/arrays.h"
#include "native/call.h"
#include "native/errors.h"
#include "native/options.h"
#include "relievo/core/text.h"
#include "relievo/io/write.h"
#include "relievo/picture/height_map.h"
#include "relievo/picture/preview.h"

namespace relievo::python {
namespace {

py::object from_json(const nlohmann::json& json) {
  return py::module_::import("json").attr("loads")(
      text_of(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)));
}

py::bytes bytes_of(std::string_view text) {
  return py::bytes(text.data(), text.size());
}

SharedRelief make(const py::list& sources, const py::dict& keywords, const py::object& callback) {
  app::MakeOrder order = order_of(sources, keywords);
  return watched_value(callback, [&](Progress& progress) {
    order.paths_read = app::paths_read_by(order);
    return app::make(order, progress);
  });
}

void check_size(const char* keyword, int px, int most_px) {
  constexpr int least_px = 16;
  if (px < least_px || px > most_px)
    raise(
        {ErrorKind::option, keyword, {}, cat("expected ", least_px, " to ", most_px, " pixels, found ", px)});
}

struct PictureSizes {
  int heightmap_px, preview_px;
};

app::ReliefFiles files_of(const py::dict& paths, const std::string& units, PictureSizes sizes) {
  check_size("heightmap_size", sizes.heightmap_px, 16384);
  check_size("preview_size", sizes.preview_px, 4096);
  app::ReliefFiles files;
  files.heightmap_px = sizes.heightmap_px;
  files.preview_px = sizes.preview_px;
  files.unit = value_or_raise(parse_unit(units));
  for (const auto& [name, path] :
       {std::pair("solid", &files.solid), std::pair("preview", &files.preview),
        std::pair("heightmap", &files.heightmap), std::pair("tool_picture", &files.tool_picture),
        std::pair("report", &files.report)})
    if (paths.contains(name)) *path = path_of(paths[name]);
  for (const app::HeightMapFlag& flag : app::height_map_flags)
    if (paths.contains(flag.name)) files.map.*flag.text = paths[flag.name].cast<std::string>();
  return files;
}

void save(const SharedRelief& relief, const app::ReliefFiles& files) {
  value_or_raise(unlocked([&]() -> Result<void> {
    RELIEVO_CHECK(
        app::check_outputs(files, relief->inputs.paths_read, relief->made.report.reach.has_value()));
    RELIEVO_TRY(app::MadeFiles made, app::relief_files(files, relief->made, relief->draft_deg));
    if (!files.report.empty()) made.files.push_back(app::report_file(files, *relief, made.height_map));
    return app::write_files(made.files);
  }));
}

py::bytes to_bytes(const SharedRelief& relief, const std::string& format, int heightmap_px) {
  const app::FileFormat* const known = value_or_raise(app::find_format(format));
  app::ExportOrder order;
  order.map.longer_side_px = heightmap_px;
  order.map.is_tiff = format == "tiff";
  return bytes_of(
      value_or_raise(unlocked([&] { return app::export_file(relief->made, *known, order); })).bytes);
}

py::array preview(const SharedRelief& relief, int size, const std::string& material) {
  const PreviewOptions options = value_or_raise(app::preview_options(size, material));
  return array_of(unlocked([&] { return app::preview_of(relief->made, options); }));
}

py::array heights(const SharedRelief& relief, int size) {
  if (size < 1 || size > 32768)
    raise({ErrorKind::option, "size", {}, cat("expected 1 to 32768 pixels, found ", size)});
  const MadeRelief& made = relief->made;
  HeightsMm map = unlocked(
      [&] { return make_heights_mm(made.report.wrap ? made.flat : made.solid, {.longer_side_px = size}); });
  return array_of(std::move(map.image));
}

// Returns an 8-bit picture with one, three or four channels as the bytes of a PNG file.
py::bytes png(const py::array& picture) {
  const py::ssize_t dimensions = picture.ndim(), channels = dimensions == 3 ? picture.shape(2) : 1;
  const bool is_picture = (dimensions == 2 || dimensions == 3) &&
                          (channels == 1 || channels == 3 || channels == 4) &&
                          picture.dtype().kind() == 'u' && picture.dtype().itemsize() == 1;
  constexpr py::ssize_t most = 32768;
  if (!is_picture || picture.size() == 0 || picture.shape(0) > most || picture.shape(1) > most)
    raise_input("picture", "shape",
                "expected rows, columns and 1, 3 or 4 channels of uint8, found another array");
  const auto rows = py::array_t<std::uint8_t, py::array::c_style>::ensure(picture);
  Image8 image{
      static_cast<int>(rows.shape(1)), static_cast<int>(rows.shape(0)), static_cast<int>(channels), {}};
  image.pixels.assign(rows.data(), rows.data() + rows.size());
  const auto bytes = unlocked([&] { return write_png(image); });
  return bytes_of(app::text_in(bytes));
}

py::object colours(const SharedRelief& relief) {
  const std::vector<Colour>& colours = relief->made.solid.colours;
  return colours.empty() ? py::object(py::none()) : view_of(colours, relief);
}

// Returns the path that the caller gives for the scan of a project; an empty path if none is given.
std::string scan_path_of(const py::dict& keywords) {
  const py::object scan = keywords.attr("get")("scan");
  if (scan.is_none()) return {};
  if (!py::isinstance<py::str>(scan))
    throw py::type_error(cat("scan: expected a path, found ", Py_TYPE(scan.ptr())->tp_name));
  return path_of(scan);
}

template <typename T>
py::bytes bytes_of(const std::vector<T>& values) {
  return py::bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

// Raises ValueError if `is_right` is false: then this version of the package cannot have written the pickle.
void check(bool is_right) {
  if (!is_right) throw py::value_error("expected a pickle of a relief by this version of relievo");
}

template <typename T>
std::vector<T> values_in(const py::handle& given) {
  const auto bytes = given.cast<std::string_view>();
  check(bytes.size() % sizeof(T) == 0);
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(static_cast<void*>(values.data()), bytes.data(), bytes.size());
  return values;
}

template <typename T>
void take(const py::handle& given, T& value) {
  const std::vector<T> read = values_in<T>(given);
  check(read.size() == 1);
  value = read[0];
}

template <typename T>
py::bytes value_bytes(const T& value) {
  return bytes_of(std::vector<T>{value});
}

py::tuple state_of(const Solid& solid) {
  return py::make_tuple(bytes_of(solid.points), bytes_of(solid.triangles), solid.front_triangles,
                        bytes_of(solid.colours), bytes_of(solid.regions), value_bytes(solid.shift),
                        solid.ground_mm, solid.error_mm, value_bytes(solid.unit));
}

Solid solid_in(const py::tuple& state) {
  check(state.size() == 9);
  Solid solid{values_in<Vec3>(state[0]), values_in<Triangle>(state[1]), state[2].cast<std::size_t>(),
              values_in<Colour>(state[3]), values_in<Region>(state[4])};
  take(state[5], solid.shift);
  solid.ground_mm = state[6].cast<double>();
  solid.error_mm = state[7].cast<double>();
  take(state[8], solid.unit);
  for (const Triangle& triangle : solid.triangles)
    for (const Index corner : triangle) check(corner < solid.points.size());
  check(solid.front_triangles <= solid.triangles.size());
  check(solid.colours.empty() || solid.colours.size() == solid.points.size());
  check(solid.regions.empty() || solid.regions.size() >= solid.front_triangles);
  return solid;
}

py::tuple state_of(const Image<float>& image) {
  return py::make_tuple(image.width, image.height, bytes_of(image.pixels));
}

Image<float> image_in(const py::tuple& state) {
  check(state.size() == 3);
  Image<float> image{state[0].cast<int>(), state[1].cast<int>(), 1, values_in<float>(state[2])};
  check(image.width >= 0 && image.height >= 0 && image.size() == image.index(0, image.height));
  return image;
}

py::object state_of(const std::optional<ToolReach>& reach) {
  if (!reach) return py::none();
  return py::make_tuple(state_of(reach->heights_mm), state_of(reach->residual_mm), reach->tolerance_mm,
                        reach->mm_per_sample, reach->reached_share, reach->largest_residual_mm);
}

std::optional<ToolReach> reach_in(const py::object& state) {
  if (state.is_none()) return std::nullopt;
  const auto parts = state.cast<py::tuple>();
  check(parts.size() == 6);
  ToolReach reach;
  reach.heights_mm = image_in(parts[0]);
  reach.residual_mm = image_in(parts[1]);
  reach.tolerance_mm = parts[2].cast<double>();
  reach.mm_per_sample = parts[3].cast<double>();
  reach.reached_share = parts[4].cast<double>();
  reach.largest_residual_mm = parts[5].cast<double>();
  return reach;
}

}  // namespace

app::MakeOrder order_of(const py::list& sources, const py::dict& keywords) {
  app::MakeOrder order{values_of(keywords), input_arguments(keywords)};
  take_sources(sources, order);
  order.scan_path = scan_path_of(keywords);
  order.unset = unset_options(keywords);
  const py::object image = keywords.attr("get")("base_image");
  if (image.is_none()) return order;
  if (py::isinstance<py::str>(image))
    order.base_image_path = path_of(image);
  else
    order.base_image =
        std::make_shared<const Image<float>>(depth_image_of({"base_image", image.cast<py::array>()}).values);
  return order;
}

void add_relief(py::module_& module) {
  py::class_<app::FinishedRelief, SharedRelief>(module, "Relief")
      .def(py::pickle([](const app::FinishedRelief& relief) { return state_of(relief); }, &relief_in))
      .def("save",
           [](const SharedRelief& relief, const py::dict& paths, const std::string& units, int heightmap_px,
              int preview_px) {
             save(relief, files_of(paths, units, {heightmap_px, preview_px}));
           })
      .def("to_bytes", &to_bytes)
      .def("preview", &preview)
      .def("heights", &heights)
      .def("vertices", [](const SharedRelief& relief) { return view_of(relief->made.solid.points, relief); })
      .def("faces", [](const SharedRelief& relief) { return view_of(relief->made.solid.triangles, relief); })
      .def("colours", &colours)
      .def("report", [](const SharedRelief& relief) { return from_json(relief->report()); })
      .def("left_out", [](const SharedRelief& relief) { return relief->inputs.left_out; })
      .def("remarks", [](const SharedRelief& relief) { return from_json(relief->remarks()); });
  module.def("make", &make);
  module.def("png", &png);
}

py::tuple state_of(const app::FinishedRelief& relief) {
  const ReliefReport& report = relief.made.report;
  const std::string json = relief.report().dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return py::make_tuple(state_of(relief.made.solid), state_of(relief.made.flat), value_bytes(report.form),
                        report.wrap ? py::object(value_bytes(*report.wrap)) : py::none(),
                        state_of(report.reach), relief.draft_deg, py::bytes(json), relief.remarks(),
                        relief.inputs.paths_read, relief.inputs.name);
}

std::shared_ptr<app::FinishedRelief> relief_in(const py::tuple& state) {
  check(state.size() == 10);
  auto relief = std::make_shared<app::FinishedRelief>();
  relief->made.solid = solid_in(state[0]);
  relief->made.flat = solid_in(state[1]);
  take(state[2], relief->made.report.form);
  if (!state[3].is_none()) take(state[3], relief->made.report.wrap.emplace());
  relief->made.report.reach = reach_in(state[4]);
  relief->draft_deg = state[5].cast<std::optional<double>>();
  relief->kept_report = nlohmann::json::parse(state[6].cast<std::string_view>(), nullptr, false);
  check(relief->kept_report.is_object());
  relief->inputs.remarks = state[7].cast<std::vector<std::string>>();
  relief->inputs.paths_read = state[8].cast<std::vector<std::string>>();
  relief->inputs.name = state[9].cast<std::string>();
  return relief;
}

}  // namespace relievo::python
