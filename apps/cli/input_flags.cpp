#include "cli/input_flags.h"

#include "cli/flags.h"

namespace relievo::app::cli {

void add_input_flags(CLI::App& command, InputTexts& texts) {
  add_flags(command, texts.depth, [](const OptionRow& option) { return !option.is_of_relief(); });
  command
      .add_option("--stream-above", texts.stream_above_mb,
                  "size from which binary PLY, PCD and LAS are read piece by piece")
      ->type_name("MB")
      ->capture_default_str();
}

Result<InputArguments> parse_input_texts(const InputTexts& texts) {
  OptionValues values = texts.depth;
  RELIEVO_CHECK(take_text_of_file("camera", {}, values));
  RELIEVO_TRY(const DepthOptions depth, parse_depth(values));
  RELIEVO_TRY(const bool keeps_doubtful, parse_doubtful(values));
  InputArguments arguments{depth, texts.stream_above_mb};
  arguments.are_pipes_fine = true;
  arguments.keeps_doubtful = keeps_doubtful;
  return arguments;
}

void add_scene_flags(CLI::App& command, SceneArguments& arguments) {
  command
      .add_option("input", arguments.paths,
                  "point cloud, mesh or depth image, several of them, or a scene (JSON), as for make")
      ->required()
      ->type_name("INPUT");
  const auto is_of_view = [](const OptionRow& option) { return option.stage == OptionStage::view; };
  add_flags(command, arguments.view, is_of_view, [](const OptionRow&) { return "as for make"; });
  add_input_flags(command, arguments.in);
}

Result<SampledView> read_sample(const SceneArguments& arguments, Progress* progress) {
  RELIEVO_TRY(const InputArguments in, parse_input_texts(arguments.in));
  RELIEVO_TRY(const ReliefOptions options, parse_options(arguments.view));
  const PointsWanted wanted{options.view};
  RELIEVO_TRY(const Scene scene, read_scene(arguments.paths, in, wanted, progress));
  const View chosen = chosen_view(scene, options.view);
  RELIEVO_TRY(ViewSample sample, sample_for_view(scene, chosen, {}, progress));
  return SampledView{std::move(sample), chosen};
}

}  // namespace relievo::app::cli
