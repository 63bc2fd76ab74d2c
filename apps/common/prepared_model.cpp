#include "common/prepared_model.h"

#include <utility>

#include "relievo/core/choice.h"
#include "relievo/core/text.h"
#include "relievo/picture/material.h"
#include "relievo/scan/surface.h"

namespace relievo::app {
namespace {

Result<FrameOptions> frame_options(const ReliefOptions& options, double mm_per_unit) {
  if (!has_shape(options.effective_method()))
    return option_error(
        "method", cat("expected layered or paper for frames, found ", name_of(options.effective_method())));
  FrameOptions frame{shape_of(options), std::nullopt, nullptr};
  if (const auto height_mm = options.effective_height_mm()) frame.height = *height_mm / mm_per_unit;
  return frame;
}

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

}  // namespace

PreparedModel::PreparedModel(const LoadedOrder& loaded, std::vector<SampleNote> notes,
                             std::shared_ptr<const ReliefModel> model)
    : facts_(facts_of(loaded)),
      project_(loaded.project),
      notes_(std::move(notes)),
      model_(std::move(model)),
      longer_side_(Box::of(model_->surface().points).longer_side()),
      frames_(*model_),
      renderer_(model_) {}

Result<std::shared_ptr<PreparedModel>> PreparedModel::prepare(MakeOrder order, Progress& progress) {
  RELIEVO_TRY(CheckedOrder known, check_order(std::move(order)));
  RELIEVO_TRY(const LoadedOrder loaded, load(std::move(known), progress));
  const ReliefOptions& options = loaded.options;
  RELIEVO_TRY(ViewSample sample, naming(loaded.name, sample_for_view(loaded.input.scene, options.view,
                                                                     options.points, &progress)));
  RELIEVO_TRY(ReliefModel model,
              naming(loaded.name, relievo::prepare(*sample.cloud, options.view, options.mode, &progress)));
  progress.finish();
  return std::shared_ptr<PreparedModel>(new PreparedModel(
      loaded, std::move(sample.notes), std::make_shared<const ReliefModel>(std::move(model))));
}

Result<std::shared_ptr<FinishedRelief>> PreparedModel::make(const MakeOrder& order,
                                                            Progress& progress) const {
  RELIEVO_TRY(const ReliefOptions options, options_of(order, project_));
  RELIEVO_TRY(MadeRelief made, naming(facts_.name, make_relief(*model_, options, &progress)));
  made.report.sample = notes_;
  auto relief = std::make_shared<FinishedRelief>(std::move(made), facts_, options.draft_deg);
  relief->end(progress);
  return relief;
}

Result<std::shared_ptr<FrameInMm>> PreparedModel::frame(const MakeOrder& order) {
  RELIEVO_TRY(const ReliefOptions options, options_of(order, project_));
  auto made = std::make_shared<FrameInMm>();
  RELIEVO_TRY(const ReliefOptions sized, with_width(model_->surface(), options));
  made->mm_per_unit = sized.effective_width_mm() / longer_side_;
  RELIEVO_TRY(const FrameOptions wanted, frame_options(options, made->mm_per_unit));
  const Lock lock(mutex_);
  frames_.make(wanted, made->frame);
  for (float& height : made->frame.heights) height *= static_cast<float>(made->mm_per_unit);
  return made;
}

Result<Picture> PreparedModel::picture(const FrameInMm& shown, const PictureOrder& order) {
  if (shown.frame.heights.size() != model_->surface().points.size())
    return std::unexpected(
        Error{ErrorKind::input, "frame", {}, "expected a frame of this session, found one of another"});
  RELIEVO_TRY(const RenderOptions options, render_options(order, shown.mm_per_unit));
  std::vector<float> heights = shown.frame.heights;
  for (float& height : heights) height /= static_cast<float>(shown.mm_per_unit);
  Picture picture;
  const Lock lock(mutex_);
  renderer_.render({heights, shown.frame.normals}, options, picture);
  return picture;
}

}  // namespace relievo::app
