#include "relievo/options.h"

#include "relievo/core/text.h"
#include "relievo/method.h"
#include "relievo/plate/forms.h"
#include "relievo/plate/outline.h"
#include "relievo/plate/tool.h"
#include "relievo/plate/wrap.h"

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

std::unexpected<Error> contradiction(std::string option, std::string expected) {
  return std::unexpected(Error{ErrorKind::option, std::move(option), {}, std::move(expected)});
}

Result<void> check_method(const ReliefOptions& options) {
  const std::optional<Method> method = parse_method(options.effective_method());
  if (!method)
    return contradiction("--method",
                         cat("expected one of ", method_names(), ", found '", options.method, "'"));
  if (*method != Method::paper && !options.height_mm)
    return contradiction("--method", cat("expected --height with method ", name_of(*method)));
  const bool is_shaped =
      options.saturation || options.detail || options.steepest_deg || !options.tone.empty();
  if (is_shaped && !has_shape(*method))
    return contradiction(
        "--method",
        cat("expected none of --saturation, --detail, --steepest and --tone with method ", name_of(*method)));
  return {};
}

Result<void> check_tool(const ReliefOptions& options) {
  if (options.surface != "full" && options.surface != "reachable")
    return contradiction("--surface", cat("expected full or reachable, found '", options.surface, "'"));
  if (options.surface == "reachable" && options.tool.empty())
    return contradiction("--surface", "expected --tool, which tells what is reachable");
  if (options.tool.empty()) return {};
  const Result<Tool> tool = parse_tool(options.tool);
  return tool ? Result<void>{} : std::unexpected(tool.error());
}

Result<void> check_rim(const ReliefOptions& options) {
  if (!options.rim_mm && options.rim_height_mm)
    return contradiction("--rim-height", "expected --rim with it, found none");
  if (!options.rim_mm && options.rim_bevel_mm)
    return contradiction("--rim-bevel", "expected --rim with it, found none");
  if (options.rim_mm && options.outline == "none")
    return contradiction("--rim", "expected an outline to lie along, found --outline none");
  if (options.rim_bevel_mm > options.rim_mm)
    return contradiction("--rim-bevel", cat("expected at most the rim's width, ", *options.rim_mm,
                                            " mm, found ", *options.rim_bevel_mm, " mm"));
  return {};
}

Result<void> check_base(const ReliefOptions& options) {
  const Result<BaseOptions> base = parse_base(options.base);
  if (!base) return std::unexpected(base.error());
  if (base->kind != BaseKind::plane && options.form == "lithophane")
    return contradiction("--base", "expected a plane for a lithophane, whose thickness is the picture");
  if (base->kind != BaseKind::plane && options.surface == "reachable")
    return contradiction("--surface", "expected full with a --base that is not a plane");
  return {};
}

Result<void> check_wrap(const ReliefOptions& options) {
  const Result<WrapOptions> wrap = parse_wrap(options.wrap);
  if (!wrap) return std::unexpected(wrap.error());
  if (wrap->kind == WrapKind::none) return {};
  if (parse_base(options.base)->kind != BaseKind::plane)
    return contradiction("--wrap", "expected either --base or --wrap, found both");
  if (options.draft_deg)
    return contradiction("--wrap",
                         "expected either --draft or --wrap, found both: no die comes off all around");
  return {};
}

}  // namespace

Result<void> check(const ReliefOptions& options) {
  RangeCheck ranges;
  visit(options, ranges);
  if (ranges.error) return std::unexpected(*ranges.error);
  if (options.height_mm && options.alpha)
    return contradiction("--alpha", "expected either --height or --alpha, found both");
  const Result<Form> form = parse_form(options.form);
  if (!form) return std::unexpected(form.error());
  if (options.draft_deg && *form == Form::lithophane)
    return contradiction("--draft", "expected a form other than lithophane, whose walls the light decides");
  if (const auto outline = parse_outline(options.outline); !outline) return std::unexpected(outline.error());
  if (auto ok = check_tool(options); !ok) return ok;
  if (auto good = check_rim(options); !good) return good;
  if (auto good = check_base(options); !good) return good;
  if (auto good = check_wrap(options); !good) return good;
  return check_method(options);
}

}  // namespace relievo
