// Reads the values of options, and checks each by its row of the table.
#include "pipeline/option_targets.h"
#include "relievo/core/length.h"
#include "relievo/core/text.h"
#include "relievo/option_table.h"

namespace relievo {
namespace {

// Returns the value in the option's type. A length may be given as a text with a unit.
Result<OptionValue> typed_value(const OptionRow& option, const OptionValue& value) {
  if (std::holds_alternative<double>(value) == option.is_number()) return value;
  if (!option.is_length() || !option.is_number()) return option_error({}, std::string(expected_type(option)));
  RELIEVO_TRY(const double mm, parse_length(std::get<std::string>(value)));
  return mm;
}

Result<void> read_value(const OptionRow& option, const OptionValue& given, OptionTargets& to) {
  if (!option.is_number() && given == option.initial) return {};
  RELIEVO_TRY(const OptionValue value, typed_value(option, given));
  if (option.is_number() && !option.is_of_relief())
    RELIEVO_CHECK(check_range(option, std::get<double>(value)));
  return option.access.read(value, to);
}

// Reads the values of the relief's options, or of the other options, which are for depth images.
Result<OptionTargets> read_values(const OptionValues& values, bool is_of_relief) {
  OptionTargets to;
  for (const OptionRow& option : option_table()) {
    const auto found = values.find(option.name);
    if (found == values.end() || option.is_of_relief() != is_of_relief) continue;
    Result<void> done = read_value(option, found->second, to);
    if (!done && done.error().input.empty()) done.error().input = option.name;
    RELIEVO_CHECK(std::move(done));
  }
  return to;
}

}  // namespace

Result<void> check_range(const OptionRow& option, double number) {
  if (number >= option.min && number <= option.max) return {};
  const std::string_view hint = number == 0 && option.otherwise == "none" ? "; leave it out for none" : "";
  return option_error(std::string(option.name), cat("expected a number from ", option.min, " to ", option.max,
                                                    ", found ", number, hint));
}

std::string_view expected_type(const OptionRow& option) {
  if (!option.is_number()) return "expected a text";
  return option.is_length() ? "expected a number or a length such as '4in'" : "expected a number";
}

Result<ReliefOptions> parse_options(const OptionValues& values) {
  for (const auto& [name, value] : values)
    if (!find_option(name)) return option_error(name, "expected the name of an option");
  RELIEVO_TRY(OptionTargets to, read_values(values, true));
  ReliefOptions& options = to.relief;
  RELIEVO_TRY(const View side, parse_view(to.side, to.up));
  options.view.R_view_model = side.R_view_model;
  options.view.is_best = side.is_best;
  options.outline = to.outline.value_or(options.diameter_mm ? Outline::circle : Outline::rectangle);
  RELIEVO_CHECK(check(options));
  return std::move(options);
}

Result<DepthOptions> parse_depth(const OptionValues& values) {
  RELIEVO_TRY(OptionTargets to, read_values(values, false));
  RELIEVO_CHECK(check(to.depth));
  return to.depth;
}

}  // namespace relievo
