// Command-line flags from options that name their fields in visit().
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <optional>
#include <string>

#include "relievo/options.h"
#include "relievo/text.h"

namespace relievo::cli {

struct FlagAdder {
  CLI::App& command;

  void operator()(const OptionField& field, double& value) const {
    describe(command.add_option(flag(field), value, help(field)), field)->capture_default_str();
  }
  void operator()(const OptionField& field, std::optional<double>& value) const {
    describe(command.add_option(flag(field), value, help(field)), field);
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
};

// Adds one flag for each field.
template <typename Options>
void add_flags(CLI::App& command, Options& options) {
  visit(options, FlagAdder{command});
}

}  // namespace relievo::cli
