// Command-line flags from options that name their fields in visit().
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <optional>
#include <string>

#include "common/option_list.h"
#include "relievo/core/length.h"
#include "relievo/core/option_field.h"
#include "relievo/core/text.h"
#include "relievo/option_texts.h"
#include "relievo/plate/tool.h"

namespace relievo::app::cli {

struct FlagAdder {
  CLI::App& command;

  void operator()(const OptionField& field, double& value) const {
    describe(command.add_option(flag(field), value, number_help(field)), field)->capture_default_str();
  }
  void operator()(const OptionField& field, std::optional<double>& value) const {
    describe(command.add_option(flag(field), value, number_help(field)), field);
  }
  void operator()(const OptionField& field, std::string& value) const {
    describe(command.add_option(flag(field), value, with_default(help_text(field), field)), field)
        ->capture_default_str();
  }

  static std::string flag(const OptionField& field) { return cat("--", field.name); }
  static std::string number_help(const OptionField& field) {
    return with_default(cat(field.help, " [", field.min, " to ", field.max, "]"), field);
  }

  // The default, where it is no value of the field.
  static std::string with_default(std::string help, const OptionField& field) {
    const auto row = std::ranges::find(option_fields(), field.name, &OptionField::name);
    if (!field.otherwise.empty()) return cat(help, "; default: ", field.otherwise);
    if (row != option_fields().end() && row->effective) return cat(help, "; default: ", default_text(*row));
    return help;
  }

  CLI::Option* describe(CLI::Option* option, const OptionField& field) const {
    option->type_name(std::string(field.unit));
    if (field.unit == "MM") option->transform(in_mm(length_in_mm));
    if (field.unit == "TOOL") option->transform(in_mm(tool_in_mm));
    if (field.unit == "WxH") option->transform(in_mm(plate_in_mm));
    return option;
  }

  // Lengths may carry a unit, or be in that of --units, wherever that stands.
  CLI::Validator in_mm(Result<std::string> (*convert)(std::string_view, LengthUnit)) const {
    const auto transform = [&at = command, convert](std::string& text) {
      const Result<std::string> mm = convert(text, unit_of(at));
      if (!mm) return mm.error().expected;
      text = *mm;
      return std::string();
    };
    return CLI::Validator(transform, "");
  }

  static Result<std::string> length_in_mm(std::string_view text, LengthUnit bare) {
    RELIEVO_TRY(const double mm, parse_length(text, bare));
    return exact_text(mm);
  }

  static std::string exact_text(double number) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
  }

  static Result<std::string> plate_in_mm(std::string_view text, LengthUnit bare) {
    RELIEVO_TRY(const Vec2 mm, parse_plate_size(text, bare));
    return cat(exact_text(mm.x()), "x", exact_text(mm.y()));
  }

  static Result<std::string> tool_in_mm(std::string_view text, LengthUnit bare) {
    RELIEVO_TRY(const Tool tool, parse_tool(text, bare));
    return text_of(tool);
  }

  // Returns the unit of --units; millimetres where it is not given or the command has no such flag.
  static LengthUnit unit_of(const CLI::App& command) {
    const CLI::Option* const units = command.get_option_no_throw("--units");
    if (units == nullptr || units->count() == 0) return LengthUnit::mm;
    return parse_unit(units->results().back()).value_or(LengthUnit::mm);
  }
};

// Adds one flag for each field.
template <typename Texts>
void add_flags(CLI::App& command, Texts& texts) {
  visit(texts, FlagAdder{command});
}

}  // namespace relievo::app::cli
