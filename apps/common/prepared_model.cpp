#include "common/prepared_model.h"

#include <utility>

#include "relievo/core/choice.h"
#include "relievo/scan/surface.h"

namespace relievo::app {

PreparedModel::PreparedModel(const LoadedOrder& loaded, LiveModel live)
    : facts_(facts_of(loaded)),
      values_(overridden({}, loaded)),
      base_image_(loaded.options.base.image),
      project_(loaded.project),
      live_(std::move(live)) {
  // The model is prepared for this method, even if a later order replaces the option that implied it.
  values_.try_emplace("method", std::string(name_of(loaded.options.effective_method())));
}

Result<std::shared_ptr<PreparedModel>> PreparedModel::prepare(MakeOrder order, Progress& progress) {
  RELIEVO_TRY(CheckedOrder known, check_order(std::move(order)));
  RELIEVO_TRY(const LoadedOrder loaded, load(std::move(known), progress));
  RELIEVO_TRY(LiveModel live,
              naming(loaded.name, relievo::prepare({loaded.scene, loaded.options}, &progress)));
  progress.finish();
  return std::shared_ptr<PreparedModel>(new PreparedModel(loaded, std::move(live)));
}

MakeOrder PreparedModel::completed(const MakeOrder& order) const {
  MakeOrder complete = order;
  OptionValues own = values_;
  for (const std::string& name : order.unset) own.erase(name);
  complete.values = overridden(std::move(own), order);
  if (!has_height_map(order) && has_image_base(complete.values)) complete.base_image = base_image_;
  return complete;
}

Result<std::shared_ptr<FinishedRelief>> PreparedModel::make(const MakeOrder& order,
                                                            Progress& progress) const {
  RELIEVO_TRY(const ReliefOptions options, options_of(completed(order), project_));
  RELIEVO_TRY(MadeRelief made, naming(facts_.name, live_.relief(options, &progress)));
  InputFacts facts = facts_;
  facts.paths_read.insert(facts.paths_read.end(), order.paths_read.begin(), order.paths_read.end());
  auto relief = std::make_shared<FinishedRelief>(std::move(made), std::move(facts), options.draft_deg);
  relief->end(progress);
  return relief;
}

Result<std::shared_ptr<FrameInMm>> PreparedModel::frame(const MakeOrder& order) {
  RELIEVO_TRY(const ReliefOptions options, options_of(completed(order), project_));
  const Lock lock(mutex_);
  RELIEVO_TRY(const LiveFrame made, live_.frame(options));
  auto shown = std::make_shared<FrameInMm>(*made.frame, made.mm_per_unit);
  for (float& height : shown->frame.heights) height *= static_cast<float>(shown->mm_per_unit);
  return shown;
}

Result<Picture> PreparedModel::picture(const FrameInMm& shown, RenderOptions options,
                                       std::string_view material) {
  if (shown.frame.heights.size() != model().surface().points.size())
    return std::unexpected(
        Error{ErrorKind::input, "frame", {}, "expected a frame of this session, found one of another"});
  RELIEVO_CHECK(check(options));
  RELIEVO_TRY(options.material, parse_choice("material", material, material_choices));
  options.mm_per_unit = shown.mm_per_unit;
  std::vector<float> heights = shown.frame.heights;
  for (float& height : heights) height /= static_cast<float>(shown.mm_per_unit);
  Picture picture;
  const Lock lock(mutex_);
  live_.renderer().render({heights, shown.frame.normals}, options, picture);
  return picture;
}

}  // namespace relievo::app
