#include <memory>

#include "cli/commands.h"
#include "common/files.h"
#include "common/output_files.h"
#include "common/prepared_model.h"
#include "relievo/io/write.h"

namespace relievo::app::cli {
namespace {

struct ThumbnailArguments {
  std::string input, output;
  int size_px = 256;
};

// Returns an order for a relief that is made quickly, from few points. Large clouds are read in blocks. A scan is
// seen from the side that suits a relief best; a project has its own view.
MakeOrder quick_order(const std::string& input) {
  MakeOrder order;
  order.inputs = {input};
  order.values.emplace("points", 40000.);
  if (ending_of(input) != "relievo") order.values.emplace("view", "auto");
  order.input_arguments.stream_above_mb = 30;
  return order;
}

Result<void> draw_thumbnail(const ThumbnailArguments& arguments) {
  RELIEVO_CHECK(check_output(arguments.output, {}, {&arguments.input, 1}));
  Progress progress;
  RELIEVO_TRY(const auto model, PreparedModel::prepare(quick_order(arguments.input), progress));
  RELIEVO_TRY(const auto frame, model->frame({}));
  RenderOptions options;
  options.width = options.height = arguments.size_px;
  options.is_fine = true;
  RELIEVO_TRY(const Picture picture, model->picture(*frame, options, "plaster"));
  const OutputFile file{arguments.output, write_png(picture.image)};
  return write_files({&file, 1});
}

}  // namespace

void add_thumbnail(CLI::App& program, Result<void>& result) {
  const auto arguments = std::make_shared<ThumbnailArguments>();
  CLI::App& command =
      *program.add_subcommand("thumbnail", "Draw a small picture of a relief, for file managers");
  command.add_option("input", arguments->input, "scan or project")->required()->type_name("INPUT");
  command.add_option("output", arguments->output, "picture, PNG")->required()->type_name("OUT.png");
  command.add_option("--size", arguments->size_px, "pixels of each side")
      ->type_name("PX")
      ->check(CLI::Range(16, 2048))
      ->capture_default_str();
  command.callback([arguments, &result] { result = draw_thumbnail(*arguments); });
}

}  // namespace relievo::app::cli
