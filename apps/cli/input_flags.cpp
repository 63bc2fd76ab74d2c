#include "cli/input_flags.h"

#include "cli/flags.h"

namespace relievo::app::cli {

void add_input_flags(CLI::App& command, InputTexts& texts) {
  add_flags(command, texts.depth);
  command
      .add_option("--camera", texts.camera, "of a depth image: focal lengths and centre, or a file with them")
      ->type_name("FX,FY,CX,CY");
  command
      .add_option("--stream-above", texts.stream_above_mb,
                  "size from which binary PLY, PCD and LAS are read piece by piece")
      ->type_name("MB")
      ->capture_default_str();
}

Result<InputArguments> parse_input_texts(const InputTexts& texts) {
  RELIEVO_TRY(const DepthOptions depth, parse_depth(texts.depth));
  return InputArguments{depth, texts.camera, texts.stream_above_mb, true};
}

void add_scene_flags(CLI::App& command, SceneArguments& arguments) {
  command
      .add_option("input", arguments.paths,
                  "point cloud, mesh or depth image, several of them, or a scene (JSON), as for make")
      ->required()
      ->type_name("INPUT");
  command.add_option("--view", arguments.view, "as for make")->type_name("SIDE")->capture_default_str();
  command.add_option("--up", arguments.up, "as for make")->type_name("X,Y,Z");
  command.add_option("--crop", arguments.crop, "as for make")->type_name("X0,Y0,X1,Y1");
  command.add_option("--crumbs", arguments.crumbs, "as for make")->type_name("WHAT")->capture_default_str();
  command.add_option("--plane", arguments.plane, "as for make")->type_name("WHAT")->capture_default_str();
  command.add_option("--denoise", arguments.denoise, "as for make")
      ->type_name("NOISE")
      ->capture_default_str();
  add_input_flags(command, arguments.in);
}

Result<SampledView> read_sample(const SceneArguments& arguments, Progress* progress) {
  RELIEVO_TRY(const InputArguments in, parse_input_texts(arguments.in));
  RELIEVO_TRY(const View view, parse_view(static_cast<const ViewTexts&>(arguments)));
  const PointsWanted wanted{view};
  RELIEVO_TRY(const SceneInput input, read_scene(arguments.paths, in, wanted, progress));
  const View chosen = chosen_view(input.scene, view);
  RELIEVO_TRY(ViewSample sample, sample_for_view(input.scene, chosen, {}, progress));
  return SampledView{std::move(sample), chosen};
}

}  // namespace relievo::app::cli
