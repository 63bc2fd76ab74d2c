#include "cli/make_options.h"

#include "cli/flags.h"
#include "relievo/core/text.h"

namespace relievo::app::cli {

void add_make_options(CLI::App& command, MakeOptions& options) {
  command
      .add_option("--units", options.units,
                  "mm or in: of lengths without a unit of their own, and of the solid's coordinates")
      ->type_name("UNIT")
      ->capture_default_str();
  add_number(command, "--heightmap-size", options.files.heightmap_px, CLI::Range(16, 16384),
             "longer side of the height map in pixels [16 to 16384]");
  for (const HeightMapFlag& flag : height_map_flags)
    command.add_option(cat("--", flag.name), options.files.map.*flag.text, flag.help)->type_name(flag.unit);
  add_number(command, "--preview-size", options.files.preview_px, CLI::Range(16, 4096),
             "longer side of each of the preview's two views in pixels [16 to 4096]");
  command
      .add_option("--base-image", options.order.base_image_path,
                  "height map that the relief lies on, bright is high: PNG or TIFF")
      ->type_name("B.png");
  add_flags(command, options.order.values, &OptionRow::is_of_relief);
  const auto refuse = [](const std::string&) {
    throw CLI::ValidationError("--surface", "expected --finish, its new name");
  };
  command.add_option_function<std::string>("--surface", refuse)->group("");
  add_input_flags(command, options.in);
}

}  // namespace relievo::app::cli
