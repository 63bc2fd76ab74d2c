#include "relievo/options.h"

#include "relievo/forms.h"
#include "relievo/text.h"

namespace relievo {
namespace {

// Collects the first value out of its range.
struct RangeCheck {
  std::optional<Error> error;

  void operator()(const OptionField& field, double value) {
    const bool is_inside = value >= field.min && value <= field.max;
    if (is_inside || error) return;
    error = Error{ErrorKind::option,
                  cat("--", field.name),
                  {},
                  cat("expected a number from ", field.min, " to ", field.max, ", found ", value)};
  }
  void operator()(const OptionField& field, const std::optional<double>& value) {
    if (value) (*this)(field, *value);
  }
  void operator()(const OptionField&, const std::string&) {}
};

}  // namespace

Result<void> check(const ReliefOptions& options) {
  RangeCheck ranges;
  visit(options, ranges);
  if (ranges.error) return std::unexpected(*ranges.error);
  if (options.height_mm && options.alpha)
    return std::unexpected(
        Error{ErrorKind::option, "--alpha", {}, "expected either --height or --alpha, found both"});
  if (const auto form = parse_form(options.form); !form) return std::unexpected(form.error());
  return {};
}

}  // namespace relievo
