#include "common/make_order.h"

#include <utility>

#include "common/make_report.h"
#include "common/wording.h"
#include "relievo/core/choice.h"
#include "relievo/core/text.h"
#include "relievo/picture/material.h"
#include "relievo/scene.h"

namespace relievo::app {

Result<ReliefOptions> options_of(const MakeOrder& order, const std::optional<Project>& project) {
  OptionTexts texts = order.texts;
  const auto is_given = [&](std::string_view name) { return order.given.contains(std::string(name)); };
  if (project) texts = with_given(project->options, order.texts, is_given);
  const bool has_image = order.base_image || !order.base_image_path.empty();
  if (has_image && texts.base == OptionTexts{}.base && !is_given("base")) texts.base = "image";
  RELIEVO_TRY(ReliefOptions options, parse_options(texts));
  RELIEVO_TRY(
      std::shared_ptr<const Image<float>> image,
      order.base_image ? order.base_image : base_image_for(options.base, order.base_image_path, project));
  RELIEVO_CHECK(take_base_image(std::move(image), options.base));
  return options;
}

Result<LoadedOrder> load_order(const MakeOrder& order, const std::optional<StoredProject>& stored,
                               const std::function<Result<SceneInput>(const ReliefOptions&)>& read,
                               Progress& progress) {
  std::optional<Project> project;
  if (stored) project = stored->project;
  RELIEVO_TRY(ReliefOptions options, options_of(order, project));
  if (!stored) {
    RELIEVO_TRY(SceneInput input, read(options));
    options.view = chosen_view(input.scene, options.view);
    return LoadedOrder{std::move(input), std::move(options)};
  }
  RELIEVO_CHECK(progress.stage("read", 0));
  RELIEVO_TRY(Scene scene, load_project_scan(*stored, [&] { return progress.is_cancelled(); }));
  options.view = chosen_view(scene, options.view);
  return LoadedOrder{with_remarks(std::move(scene)), std::move(options), std::move(project)};
}

InputFacts facts_of(const MakeOrder& order, std::vector<std::string> paths, const LoadedOrder& loaded) {
  InputFacts facts{std::move(paths), loaded.input.remarks,
                   models_report(loaded.input.scene, loaded.options.view)};
  facts.paths.insert(facts.paths.end(), {order.base_image_path, order.scan_path});
  return facts;
}

FinishedRelief finished(MadeRelief made, const InputFacts& facts, const ReliefOptions& options,
                        Progress& progress) {
  progress.finish();
  FinishedRelief relief{std::move(made), {}, facts.remarks, facts.paths, options.draft_deg};
  for (std::string& line : remarks_on(relief.made.report)) relief.remarks.push_back(std::move(line));
  relief.report = make_report({relief.made, facts.models, LengthUnit::mm, progress.times()});
  return relief;
}

Result<PreviewOptions> preview_options(int longer_side_px, std::string_view material) {
  PreviewOptions options;
  options.longer_side_px = longer_side_px;
  if (longer_side_px < 1 || longer_side_px > 5461)
    return option_error("size", cat("expected 1 to 5461 pixels, found ", longer_side_px));
  RELIEVO_TRY(options.material, parse_choice("material", material, material_choices));
  return options;
}

}  // namespace relievo::app
