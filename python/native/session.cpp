#include "native/session.h"

#include <cmath>
#include <mutex>

#include "native/arrays.h"
#include "native/call.h"
#include "native/errors.h"
#include "native/relief.h"
#include "relievo/core/text.h"
#include "relievo/picture/render.h"
#include "relievo/relief/frame.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"

namespace relievo::python {
namespace {

// A frame with its heights in millimetres.
struct FrameInMm {
  Frame frame;
  double mm_per_unit = 1;
};

struct PreparedModel {
  std::string name;  // of the sources, for errors
  InputFacts facts;
  std::optional<app::Project> project;
  std::vector<SampleNote> notes;
  std::shared_ptr<const ReliefModel> model;
  double longer_side;  // of the surface

  std::mutex mutex = {};  // guards what follows, which is not for concurrent use
  FrameMaker frames{*model};
  FrameRenderer renderer{model};
};

using SharedModel = std::shared_ptr<PreparedModel>;
using SharedFrame = std::shared_ptr<FrameInMm>;

Result<SharedModel> prepare_model(const MakeOrder& order, Progress& progress) {
  RELIEVO_TRY(const Loaded loaded, load(order, progress));
  const ReliefOptions& options = loaded.options;
  RELIEVO_TRY(ViewSample sample,
              sample_for_view(loaded.input.scene, options.view, options.points, &progress));
  RELIEVO_TRY(ReliefModel model, prepare(*sample.cloud, options.view, options.mode, &progress));
  auto shared = std::make_shared<const ReliefModel>(std::move(model));
  const double longer_side = Box::of(shared->surface().points).longer_side();
  progress.finish();
  return SharedModel(new PreparedModel{names_of(order.sources), facts_of(order, loaded), loaded.project,
                                       std::move(sample.notes), std::move(shared), longer_side});
}

SharedModel open(const py::list& sources, const py::dict& keywords, const py::object& callback) {
  const MakeOrder order = order_of(sources, keywords);
  return watched_value(callback, [&](Progress& progress) {
    Result<SharedModel> model = prepare_model(order, progress);
    if (!model && model.error().input.empty()) model.error().input = names_of(order.sources);
    return model;
  });
}

SharedRelief make(const SharedModel& prepared, const py::dict& keywords, const py::object& callback) {
  const MakeOrder order = order_of(py::list(), keywords);
  return watched_value(callback, [&](Progress& progress) -> Result<SharedRelief> {
    RELIEVO_TRY(const ReliefOptions options, options_of(order, prepared->project));
    Result<MadeRelief> made = make_relief(*prepared->model, options, &progress);
    if (!made && made.error().input.empty()) made.error().input = prepared->name;
    if (!made) return std::unexpected(made.error());
    made->report.sample = prepared->notes;
    return finished(*std::move(made), prepared->facts, options, progress);
  });
}

Result<FrameOptions> frame_options(const ReliefOptions& options, double mm_per_unit) {
  if (!has_shape(options.effective_method()))
    return option_error(
        "method", cat("expected layered or paper for frames, found ", name_of(options.effective_method())));
  FrameOptions frame{shape_of(options), std::nullopt, nullptr};
  if (options.height_mm) frame.height = *options.height_mm / mm_per_unit;
  return frame;
}

SharedFrame frame(const SharedModel& prepared, const py::dict& keywords) {
  const MakeOrder order = order_of(py::list(), keywords);
  return value_or_raise(unlocked([&]() -> Result<SharedFrame> {
    RELIEVO_TRY(const ReliefOptions options, options_of(order, prepared->project));
    auto made = std::make_shared<FrameInMm>();
    RELIEVO_TRY(const ReliefOptions sized, with_width(prepared->model->surface(), options));
    made->mm_per_unit = sized.effective_width_mm() / prepared->longer_side;
    RELIEVO_TRY(const FrameOptions wanted, frame_options(options, made->mm_per_unit));
    const std::lock_guard lock(prepared->mutex);
    prepared->frames.make(wanted, made->frame);
    for (float& height : made->frame.heights) height *= static_cast<float>(made->mm_per_unit);
    return made;
  }));
}

struct PictureOrder {
  int width, height;
  double yaw_deg, pitch_deg, zoom;
  std::string material;
  bool is_fine;
};

Result<RenderOptions> render_options(const PictureOrder& order, double mm_per_unit) {
  const auto in_range = [](double x, double min, double max) { return x >= min && x <= max; };
  if (!in_range(order.width, 1, 8192)) return option_error("width", "expected 1 to 8192 pixels");
  if (!in_range(order.height, 1, 8192)) return option_error("height", "expected 1 to 8192 pixels");
  if (!in_range(order.yaw_deg, -360, 360)) return option_error("yaw_deg", "expected -360 to 360");
  if (!in_range(order.pitch_deg, -90, 90)) return option_error("pitch_deg", "expected -90 to 90");
  if (!in_range(order.zoom, .05, 100)) return option_error("zoom", "expected 0.05 to 100");
  RenderOptions options;
  options.width = order.width;
  options.height = order.height;
  options.mm_per_unit = mm_per_unit;
  options.camera = {order.yaw_deg, order.pitch_deg, order.zoom};
  options.is_fine = order.is_fine;
  RELIEVO_TRY(options.material, parse_choice("material", order.material, material_choices));
  return options;
}

py::array picture(const SharedModel& prepared, const SharedFrame& shown, const PictureOrder& order) {
  const std::size_t points = prepared->model->surface().points.size();
  if (shown->frame.heights.size() != points)
    raise_input("frame", "", "expected a frame of this session, found one of another");
  const RenderOptions options = value_or_raise(render_options(order, shown->mm_per_unit));
  Picture picture;
  unlocked([&] {
    std::vector<float> heights = shown->frame.heights;
    for (float& height : heights) height /= static_cast<float>(shown->mm_per_unit);
    const std::lock_guard lock(prepared->mutex);
    prepared->renderer.render({heights, shown->frame.normals}, options, picture);
  });
  return array_of(std::move(picture.image));
}

py::array surface_points(const SharedModel& prepared) {
  const auto& points = prepared->model->surface().points;
  return view_of(points.data()->data(), {std::ssize(points), 3}, prepared);
}

py::array surface_triangles(const SharedModel& prepared) {
  const auto& triangles = prepared->model->surface().triangulation.triangles;
  return view_of(triangles.data()->data(), {std::ssize(triangles), 3}, prepared);
}

py::array inside(const SharedModel& prepared) {
  const auto& is_inside = prepared->model->surface().boundary.is_inside;
  return view_of(reinterpret_cast<const bool*>(is_inside.data()), {std::ssize(is_inside)}, prepared);
}

py::array heights(const SharedFrame& shown) {
  const auto& numbers = shown->frame.heights;
  return view_of(numbers.data(), {std::ssize(numbers)}, shown);
}

py::array normals(const SharedFrame& shown) {
  const auto& numbers = shown->frame.normals;
  return view_of(numbers.data()->data(), {std::ssize(numbers), 3}, shown);
}

}  // namespace

void add_session(py::module_& module) {
  py::class_<PreparedModel, SharedModel>(module, "Session")
      .def("make", &make)
      .def("frame", &frame)
      .def("picture",
           [](const SharedModel& model, const SharedFrame& shown, int width, int height, double yaw_deg,
              double pitch_deg, double zoom, const std::string& material, bool is_fine) {
             return picture(model, shown, {width, height, yaw_deg, pitch_deg, zoom, material, is_fine});
           })
      .def("points", &surface_points)
      .def("triangles", &surface_triangles)
      .def("is_inside", &inside);
  py::class_<FrameInMm, SharedFrame>(module, "Frame")
      .def("heights", &heights)
      .def("normals", &normals)
      .def("height_mm", [](const FrameInMm& f) { return f.frame.height * f.mm_per_unit; })
      .def("is_height_met", [](const FrameInMm& f) { return f.frame.is_height_met; })
      .def("u", [](const FrameInMm& f) { return f.frame.options.shape.compression.u; })
      .def("mm_per_unit", [](const FrameInMm& f) { return f.mm_per_unit; });
  module.def("open", &open);
}

}  // namespace relievo::python
