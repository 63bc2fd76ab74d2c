// Lets Python prepare a model once and make many reliefs of it.
#include "common/input_files.h"
#include "common/prepared_model.h"
#include "native/arrays.h"
#include "native/call.h"
#include "native/errors.h"
#include "native/relief.h"
#include "relievo/scan/surface.h"

namespace relievo::python {
namespace {

using app::FrameInMm, app::PreparedModel;
using SharedModel = std::shared_ptr<PreparedModel>;
using SharedFrame = std::shared_ptr<FrameInMm>;

SharedModel open(const py::list& sources, const py::dict& keywords, const py::object& callback) {
  app::MakeOrder order = order_of(sources, keywords);
  return watched_value(callback, [&](Progress& progress) {
    order.paths_read = app::paths_read_by(order);
    return PreparedModel::prepare(order, progress);
  });
}

SharedRelief make(const SharedModel& prepared, const py::dict& keywords, const py::object& callback) {
  app::MakeOrder order = order_of(py::list(), keywords);
  return watched_value(callback, [&](Progress& progress) {
    order.paths_read = app::paths_read_by(order);
    return prepared->make(order, progress);
  });
}

SharedFrame frame(const SharedModel& prepared, const py::dict& keywords) {
  const app::MakeOrder order = order_of(py::list(), keywords);
  return value_or_raise(unlocked([&] { return prepared->frame(order); }));
}

py::array picture(const SharedModel& prepared, const SharedFrame& shown, int width, int height,
                  double yaw_deg, double pitch_deg, double zoom, const std::string& material, bool is_fine) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.camera = {yaw_deg, pitch_deg, zoom};
  options.is_fine = is_fine;
  return array_of(
      value_or_raise(unlocked([&] { return prepared->picture(*shown, options, material); })).image);
}

py::array inside(const SharedModel& prepared) {
  const auto& is_inside = prepared->model().surface().boundary.is_inside;
  return view_of(reinterpret_cast<const bool*>(is_inside.data()), {std::ssize(is_inside)}, prepared);
}

py::array heights(const SharedFrame& shown) {
  const auto& numbers = shown->frame.heights;
  return view_of(numbers.data(), {std::ssize(numbers)}, shown);
}

}  // namespace

void add_session(py::module_& module) {
  py::class_<PreparedModel, SharedModel>(module, "Session")
      .def("make", &make)
      .def("frame", &frame)
      .def("picture", &picture)
      .def("points", [](const SharedModel& m) { return view_of(m->model().surface().points, m); })
      .def("triangles",
           [](const SharedModel& m) { return view_of(m->model().surface().triangulation.triangles, m); })
      .def("is_inside", &inside);
  py::class_<FrameInMm, SharedFrame>(module, "Frame")
      .def("heights", &heights)
      .def("normals", [](const SharedFrame& shown) { return view_of(shown->frame.normals, shown); })
      .def("height_mm", [](const FrameInMm& f) { return f.frame.height * f.mm_per_unit; })
      .def("is_height_met", [](const FrameInMm& f) { return f.frame.is_height_met; })
      .def("u", [](const FrameInMm& f) { return f.frame.options.shape.compression.u; })
      .def("mm_per_unit", [](const FrameInMm& f) { return f.mm_per_unit; });
  module.def("open", &open);
}

}  // namespace relievo::python
