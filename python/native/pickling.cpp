// Pickles reliefs. A pickle contains everything from which files, pictures and arrays are made, and the report.
#include "native/pickling.h"

#include <cstring>
#include <utility>
#include <vector>

namespace relievo::python {
namespace {

template <typename T>
py::bytes bytes_of(const std::vector<T>& values) {
  return py::bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

// Raises if `is_right` is false, because this version of the package cannot have written such a pickle.
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

py::tuple state_of(const app::FinishedRelief& relief) {
  const ReliefReport& report = relief.made.report;
  const std::string json = relief.report().dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return py::make_tuple(state_of(relief.made.solid), state_of(relief.made.flat), value_bytes(report.form),
                        report.wrap ? py::object(value_bytes(*report.wrap)) : py::none(),
                        state_of(report.reach), relief.draft_deg, py::bytes(json), relief.remarks(),
                        relief.inputs.paths, relief.inputs.name);
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
  relief->inputs.paths = state[8].cast<std::vector<std::string>>();
  relief->inputs.name = state[9].cast<std::string>();
  return relief;
}

}  // namespace relievo::python
