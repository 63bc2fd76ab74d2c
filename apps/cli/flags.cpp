#include "cli/flags.h"

#include <array>
#include <charconv>

#include "common/option_list.h"
#include "relievo/core/length.h"
#include "relievo/core/text.h"
#include "relievo/plate/tool.h"

namespace relievo::app::cli {
namespace {

std::string exact_text(double number) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

Result<std::string> length_in_mm(std::string_view text, LengthUnit bare) {
  RELIEVO_TRY(const double mm, parse_length(text, bare));
  return exact_text(mm) + "mm";
}

// The option mm-per-value has its unit in its name, so --units does not apply to it.
Result<std::string> scale_in_mm(std::string_view text, LengthUnit) {
  return length_in_mm(text, LengthUnit::mm);
}

Result<std::string> plate_in_mm(std::string_view text, LengthUnit bare) {
  RELIEVO_TRY(const Vec2 mm, parse_plate_size(text, bare));
  return cat(exact_text(mm.x()), "mmx", exact_text(mm.y()), "mm");
}

Result<std::string> shift_in_mm(std::string_view text, LengthUnit bare) {
  RELIEVO_TRY(const Vec2 mm, parse_shift(text, bare));
  return cat(exact_text(mm.x()), "mm,", exact_text(mm.y()), "mm");
}

Result<std::string> tool_in_mm(std::string_view text, LengthUnit bare) {
  RELIEVO_TRY(const Tool tool, parse_tool(text, bare));
  return text_of(tool);
}

using InMm = Result<std::string> (*)(std::string_view, LengthUnit);

// Returns the function that converts the option's lengths to millimetres; null if it has none.
InMm converter_of(const OptionRow& option) {
  if (option.name == "mm-per-value") return scale_in_mm;
  if (option.is_length()) return length_in_mm;
  if (option.unit == "TOOL") return tool_in_mm;
  if (option.unit == "WxH") return plate_in_mm;
  if (option.unit == "X,Y") return shift_in_mm;
  return nullptr;
}

// Returns the unit that --units sets; millimetres if the user has not given that flag or the command lacks it.
LengthUnit unit_of(const CLI::App& command) {
  const CLI::Option* const units = command.get_option_no_throw("--units");
  if (units == nullptr || units->count() == 0) return LengthUnit::mm;
  return parse_unit(units->results().back()).value_or(LengthUnit::mm);
}

// Converts a length to millimetres. If the text names no unit, the unit is that of --units, which may stand
// before or after this flag. The converted text names its unit, because `batch` passes it to `make` together
// with --units, and a row of a table may set another --units.
CLI::Validator in_mm(const CLI::App& command, InMm convert) {
  const auto transform = [&command, convert](std::string& text) {
    const Result<std::string> mm = convert(text, unit_of(command));
    if (!mm) return mm.error().expected;
    text = *mm;
    return std::string();
  };
  return CLI::Validator(transform, "");
}

// Does the same as in_mm(), but leaves a text that is not a length unchanged for the function that reads the
// flag.
CLI::Validator length_in_mm_if_any(const CLI::App& command) {
  const auto transform = [&command](std::string& text) {
    text = length_in_mm(text, unit_of(command)).value_or(text);
    return std::string();
  };
  return CLI::Validator(transform, "");
}

template <typename T>
CLI::Option* add_flag(CLI::App& command, OptionValues& values, const OptionRow& option) {
  const auto take = [&values, &option](const T& value) { values[std::string(option.name)] = value; };
  return command.add_option_function<T>(cat("--", option.name), take);
}

// Adds a flag for a length. in_mm() converts the text of the flag before it is stored in `values`.
CLI::Option* add_length_flag(CLI::App& command, OptionValues& values, const OptionRow& option) {
  const auto take = [&values, &option](const std::string& mm) {
    values[std::string(option.name)] = parse_length(mm).value_or(0);
  };
  return command.add_option_function<std::string>(cat("--", option.name), take);
}

CLI::Option* add_flag_of(CLI::App& command, OptionValues& values, const OptionRow& option) {
  if (option.is_number() && option.is_length()) return add_length_flag(command, values, option);
  if (option.is_number()) return add_flag<double>(command, values, option);
  return add_flag<std::string>(command, values, option);
}

std::string initial_text(const OptionRow& option) {
  if (const double* const number = std::get_if<double>(&option.initial)) return cat(*number);
  return std::get<std::string>(option.initial);
}

}  // namespace

std::string flag_help(const OptionRow& option) {
  const bool is_shown = !initial_text(option).empty();
  return cat(help_text(option), is_shown ? "" : cat("; default: ", default_text(option)));
}

void add_number(CLI::App& command, const char* name, int& value, const CLI::Range& range, const char* help) {
  command.add_option(name, value, help)
      ->check(CLI::Range(range).description(""))
      ->type_name("N")
      ->capture_default_str();
}

void add_flags(CLI::App& command, OptionValues& values,
               const std::function<bool(const OptionRow&)>& is_wanted,
               const std::function<std::string(const OptionRow&)>& help) {
  for (const OptionRow& option : option_table()) {
    if (!is_wanted(option)) continue;
    CLI::Option* const flag = add_flag_of(command, values, option);
    flag->description(help(option))->type_name(std::string(option.unit))->default_str(initial_text(option));
    if (const InMm convert = converter_of(option)) flag->transform(in_mm(command, convert));
  }
}

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

void add_make_options(CLI::App& command, MakeOptions& options) {
  command
      .add_option("--units", options.units,
                  "mm or in: of lengths without a unit of their own, and of the solid's coordinates")
      ->type_name("UNIT")
      ->capture_default_str();
  add_number(command, "--heightmap-size", options.files.heightmap_px, CLI::Range(16, 16384),
             "longer side of the height map in pixels [16 to 16384]");
  for (const HeightMapFlag& flag : height_map_flags) {
    CLI::Option* const option =
        command.add_option(cat("--", flag.name), options.files.map.*flag.text, flag.help)
            ->type_name(flag.unit);
    if (std::string_view(flag.unit) == "MM") option->transform(length_in_mm_if_any(command));
  }
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
