#include "common/make_order.h"

#include <utility>

#include "common/files.h"
#include "common/wording.h"
#include "relievo/core/choice.h"
#include "relievo/core/text.h"
#include "relievo/picture/material.h"
#include "relievo/scene.h"

namespace relievo::app {

bool has_image_base(const OptionValues& values) {
  const auto base = values.find("base");
  if (base == values.end()) return false;
  const auto* const text = std::get_if<std::string>(&base->second);
  return text && text->starts_with("image");
}

OptionValues overridden(OptionValues own, const MakeOrder& order) {
  OptionValues values = with_given(std::move(own), order.values);
  if (has_height_map(order) && !order.values.contains("base") && !has_image_base(values))
    values.insert_or_assign("base", std::string("image"));
  return values;
}

Result<ReliefOptions> options_of(const MakeOrder& order, const std::optional<StoredProject>& stored) {
  std::optional<Project> project;
  if (stored) project = stored->project;
  if (project) {
    change_ornament_paths(project->options, [&](const std::string& path) {
      return stored->ornaments.contains(path) ? path : path_in(stored->folder, path);
    });
    RELIEVO_CHECK(take_text_of_file("strokes", stored->folder, project->options));
  }
  OptionValues values = overridden(project ? project->options : OptionValues(), order);
  RELIEVO_CHECK(take_text_of_file("strokes", {}, values));
  RELIEVO_TRY(ReliefOptions options, parse_options(values));
  RELIEVO_TRY(
      std::shared_ptr<const Image<float>> image,
      order.base_image ? order.base_image : base_image_for(options.base, order.base_image_path, project));
  RELIEVO_CHECK(take_base_image(std::move(image), options.base));
  RELIEVO_CHECK(read_ornaments(options, stored ? stored->ornaments : OrnamentFiles()));
  return options;
}

Result<CheckedOrder> check_order(MakeOrder order) {
  const bool are_files = !order.read;
  RELIEVO_CHECK(take_text_of_file("camera", {}, order.values));
  RELIEVO_TRY(auto project,
              find_project(are_files ? order.inputs : std::vector<std::string>(), order.scan_path));
  RELIEVO_TRY(ReliefOptions options, options_of(order, project));
  const OptionValues values = overridden(project ? project->project.options : OptionValues(), order);
  RELIEVO_TRY(order.input_arguments.depth, parse_depth(values));
  RELIEVO_TRY(order.input_arguments.keeps_doubtful, parse_doubtful(values));
  order.input_arguments.is_lithophane = options.form == Form::lithophane;
  if (are_files) order.name = joined(order.inputs);
  return CheckedOrder{std::move(order), std::move(project), std::move(options)};
}

Result<LoadedOrder> load(CheckedOrder order, Progress& progress) {
  LoadedOrder loaded{std::move(order), {}, {}};
  if (loaded.project) {
    RELIEVO_CHECK(progress.stage("read", 0));
    if (loaded.options.points) loaded.input_arguments.depth.points = *loaded.options.points;
    const LoadOptions how{loaded.input_arguments, [&] { return progress.is_cancelled(); }};
    RELIEVO_TRY(loaded.scene, load_project_scan(*loaded.project, how));
    loaded.project->packed = nullptr;  // frees the file's bytes, which may take as much memory as the points
  } else {
    const PointsWanted wanted{loaded.options.view, loaded.options.points.value_or(PointsWanted{}.points)};
    if (!loaded.read && loaded.inputs.empty()) return option_error("inputs", "expected at least one file");
    RELIEVO_TRY(loaded.scene, loaded.read
                                  ? loaded.read(loaded.input_arguments, wanted, &progress)
                                  : read_scene(loaded.inputs, loaded.input_arguments, wanted, &progress));
  }
  if (!loaded.options.view.is_best) return loaded;
  loaded.side = best_side(loaded.scene);
  loaded.options.view = on_side(loaded.options.view, *loaded.side);
  return loaded;
}

InputFacts facts_of(const LoadedOrder& loaded) {
  std::vector<std::string> left_out;
  for (const SceneModel& model : loaded.scene.models)
    for (const std::string& line : remarks_on(*model.file)) left_out.push_back(cat(model.name, ": ", line));
  return {loaded.name, loaded.paths_read, remarks_of(loaded.scene),
          models_report(loaded.scene, loaded.options.view), std::move(left_out)};
}

void FinishedRelief::end(Progress& progress) {
  progress.finish();
  times = progress.times();
}

std::vector<std::string> FinishedRelief::remarks() const {
  std::vector<std::string> lines = inputs.remarks;
  if (!kept_report.is_null()) return lines;  // `inputs` has all remarks of a stored relief
  for (std::string& line : remarks_on(made.report)) lines.push_back(std::move(line));
  return lines;
}

Result<FinishedRelief> make(LoadedOrder loaded, Progress& progress) {
  InputFacts facts = facts_of(loaded);
  Result<MadeRelief> made =
      naming(loaded.name, make_relief(std::move(loaded.scene), loaded.options, &progress));
  if (!made) return std::unexpected(std::move(made).error());
  return FinishedRelief{std::move(*made), std::move(facts), loaded.options.draft_deg};
}

Result<std::shared_ptr<FinishedRelief>> make(MakeOrder order, Progress& progress) {
  RELIEVO_TRY(CheckedOrder known, check_order(std::move(order)));
  RELIEVO_TRY(LoadedOrder loaded, load(std::move(known), progress));
  RELIEVO_TRY(FinishedRelief relief, make(std::move(loaded), progress));
  relief.end(progress);
  return std::make_shared<FinishedRelief>(std::move(relief));
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
