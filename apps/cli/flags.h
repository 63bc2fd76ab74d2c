// Command-line flags from options that name their fields in visit().
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "relievo/core/length.h"
#include "relievo/core/text.h"
#include "relievo/options.h"

namespace relievo::cli {

struct FlagAdder {
  CLI::App& command;

  void operator()(const OptionField& field, double& value) const {
    take_units(describe(command.add_option(flag(field), value, help(field)), field), field)
        ->capture_default_str();
  }
  void operator()(const OptionField& field, std::optional<double>& value) const {
    take_units(describe(command.add_option(flag(field), value, help(field)), field), field);
  }
  void operator()(const OptionField& field, std::string& value) const {
    CLI::Option* option = command.add_option(flag(field), value, std::string(field.help));
    describe(option, field)->capture_default_str();
  }

  static std::string flag(const OptionField& field) { return cat("--", field.name); }
  static std::string help(const OptionField& field) {
    return cat(field.help, " [", field.min, " to ", field.max, "]");
  }
  static CLI::Option* describe(CLI::Option* option, const OptionField& field) {
    const bool has_unit = !field.unit.empty();
    return has_unit ? option->type_name(std::string(field.unit)) : option;
  }
  // Lengths may carry a unit, or be in that of --units, wherever that stands.
  CLI::Option* take_units(CLI::Option* option, const OptionField& field) const {
    if (field.unit != "MM") return option;
    const auto in_mm = [&at = command](std::string& text) {
      const Result<double> mm = parse_length(text, unit_of(at));
      if (!mm) return mm.error().expected;
      std::array<char, 32> digits{};
      text.assign(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), *mm).ptr);
      return std::string();
    };
    return option->transform(CLI::Validator(in_mm, ""));
  }

  // What --units of the command says; millimetres if it does not, or is none of its flags.
  static LengthUnit unit_of(const CLI::App& command) {
    const CLI::Option* const units = command.get_option_no_throw("--units");
    if (units == nullptr || units->count() == 0) return LengthUnit::mm;
    return parse_unit(units->results().back()).value_or(LengthUnit::mm);
  }
};

// Adds one flag for each field.
template <typename Options>
void add_flags(CLI::App& command, Options& options) {
  visit(options, FlagAdder{command});
}

}  // namespace relievo::cli
