#include "relievo/options.h"

#include <utility>

#include "pipeline/option_targets.h"
#include "relievo/core/length.h"
#include "relievo/core/text.h"
#include "relievo/option_table.h"
#include "relievo/relief/shape.h"

namespace relievo {
namespace {

Result<void> check_ranges(const ReliefOptions& options) {
  for (const OptionRow& option : option_table())
    if (option.access.number)
      if (const std::optional<double> number = option.access.number(options))
        RELIEVO_CHECK(check_range(option, *number));
  return {};
}

Result<void> check_height(const ReliefOptions& options) {
  if (options.height_mm && options.height_of_diagonal)
    return option_error("height-of-diagonal", "expected either height or height-of-diagonal, found both");
  if (!options.alpha || !(options.height_mm || options.height_of_diagonal)) return {};
  return option_error("alpha", "expected either height or alpha, found both");
}

Result<void> check_method(const ReliefOptions& options) {
  const Method method = options.effective_method();
  if (method != Method::paper && options.alpha)
    return option_error("alpha", cat("expected method paper with it, found ", name_of(method)));
  const bool has_more = options.tone || options.steps > 0 || options.planes || !options.strokes.empty() ||
                        options.colour_mm > 0;
  if (method == Method::paper && has_more)
    return option_error(
        "method", "expected none of tone, steps, planes, colour and strokes with method paper, found some");
  for (const auto& [name, is_used] :
       {std::pair("light", options.light.has_value()), std::pair("attention", options.attention > 0)})
    if (is_used && method != Method::layered)
      return option_error(name, cat("expected method layered with it, found ", name_of(method)));
  const bool is_shaped = options.saturation || options.detail || options.steepest_deg ||
                         options.boundary_width || options.tone || options.steps > 0 || options.planes;
  if (is_shaped && !has_shape(method))
    return option_error(
        "method",
        cat("expected none of saturation, detail, steepest, boundary, tone, steps and planes with method ",
            name_of(method), ", found some"));
  return {};
}

Result<void> check_vertical_scale(const ReliefOptions& options) {
  if (!options.mm_per_value && options.ground_value)
    return option_error("ground", "expected mm-per-value with it, found none");
  if (!options.mm_per_value) return {};
  if (options.height_mm || options.height_of_diagonal)
    return option_error("mm-per-value", "expected no height beside it, found one");
  if (options.effective_method() != Method::linear)
    return option_error("mm-per-value",
                        cat("expected method linear with it, found ", name_of(options.effective_method())));
  if (options.form == Form::lithophane || options.draft_deg)
    return option_error("mm-per-value", "expected neither a lithophane nor a draft beside it, found one");
  if (!options.strokes.empty() || options.colour_mm > 0)
    return option_error("mm-per-value", "expected neither strokes nor colour beside it, found one");
  return {};
}

Result<void> check_rim(const ReliefOptions& options) {
  if (!options.rim_mm && options.rim_height_mm)
    return option_error("rim-height", "expected a rim with it, found none");
  if (!options.rim_mm && options.rim_bevel_mm)
    return option_error("rim-bevel", "expected a rim with it, found none");
  if (options.rim_mm && options.outline == Outline::none)
    return option_error("rim", "expected an outline to lie along, found outline none");
  if (options.rim_bevel_mm > options.rim_mm)
    return option_error("rim-bevel", cat("expected at most the rim's width, ", *options.rim_mm, " mm, found ",
                                         *options.rim_bevel_mm, " mm"));
  return {};
}

// Returns an error if the base is not a plane, but the options need one: for the finish `reachable`, for a
// lithophane, or for bending the plate.
Result<void> check_base(const ReliefOptions& options) {
  if (options.base.kind == BaseKind::plane) return {};
  if (options.form == Form::lithophane)
    return option_error("base", "expected a plane for a lithophane, whose thickness is the picture");
  if (options.finish == Finish::reachable)
    return option_error("finish", "expected full with a base that is not a plane");
  if (options.wrap.kind != WrapKind::none)
    return option_error("wrap", "expected either base or wrap, found both");
  return {};
}

Result<void> check_draft(const ReliefOptions& options) {
  if (!options.draft_deg) return {};
  if (options.form == Form::lithophane)
    return option_error("draft", "expected a form other than lithophane, whose walls the light decides");
  if (options.wrap.kind != WrapKind::none)
    return option_error("wrap", "expected either draft or wrap, found both: no die comes off all around");
  return {};
}

Result<void> check_text_options(const ReliefOptions& options) {
  const bool has_text = !options.text.empty();
  if (!has_text && (options.text_mm || options.text_height_mm || options.text_inset_mm ||
                    options.text_arc != TextArc::straight || !options.font_name.empty()))
    return option_error(
        "text", "expected a text with text-arc, text-size, text-height, text-inset and font, found none");
  if (!has_text && options.ornament_source.empty()) return {};
  if (options.outline == Outline::none)
    return option_error("text", "expected an outline with ground for it, found none");
  if (options.form == Form::lithophane)
    return option_error("text", "expected a form other than lithophane, which has no ground");
  return {};
}

// Returns the name of the option that determines the size of the plate, and the shorter side of the plate.
std::pair<std::string, double> size_of_plate(const ReliefOptions& options) {
  if (options.diameter_mm) return {"diameter", *options.diameter_mm};
  return {"plate", options.plate_mm ? options.plate_mm->minCoeff() : 0};
}

Result<void> check_plate_size(const ReliefOptions& options) {
  if (!options.diameter_mm && !options.plate_mm) {
    if (options.shift_mm.isZero()) return {};
    return option_error("shift", "expected a size of the plate with it, diameter or plate");
  }
  if (options.diameter_mm && options.plate_mm)
    return option_error("plate", "expected either plate or diameter, found both");
  if (options.diameter_mm && options.outline != Outline::circle)
    return option_error("diameter",
                        cat("expected outline circle, found ", name_in(outline_choices, options.outline)));
  if (options.plate_mm && !has_free_size(options.outline))
    return option_error("plate", cat("expected outline rectangle, round or ellipse, found ",
                                     name_in(outline_choices, options.outline)));
  const auto [name, least_mm] = size_of_plate(options);
  const double edge_mm = 2 * (options.effective_margin_mm() + options.rim_mm.value_or(0));
  if (least_mm > edge_mm) return {};
  return option_error(
      name, cat("expected more than ", edge_mm, " mm, which margin and rim take, found ", least_mm, " mm"));
}

// Returns `paper` for the paper's method, `others` for all others.
double by_method(const ReliefOptions& options, double paper, double others) {
  return options.effective_method() == Method::paper ? paper : others;
}

// Returns whether an option of the relief's shape is given and differs from its default.
bool is_given(const OptionRow& option, const ReliefOptions& options) {
  ReliefOptions plain;
  plain.form = options.form;
  plain.method = options.effective_method();
  if (option.access.number) return option.access.number(options) != option.access.number(plain);
  if (option.name == "tone") return options.tone.has_value();
  if (option.name == "light") return options.light.has_value();
  return option.name == "strokes" && !options.strokes.empty();
}

// Returns the value with the option's type. A length may be a text with a unit.
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

// Reads the values of the relief's options or, if `is_of_relief` is false, of the options for reading a file.
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

Method ReliefOptions::effective_method() const {
  return method.value_or(mm_per_value ? Method::linear : alpha ? Method::paper : Method::layered);
}

std::optional<double> ReliefOptions::effective_height_mm() const {
  if (effective_method() == Method::paper || form == Form::lithophane || mm_per_value) return height_mm;
  return usual_height_mm();
}

View ReliefOptions::effective_view() const {
  return effective_method() == Method::paper ? view.for_paper() : view;
}

double ReliefOptions::effective_saturation() const {
  return saturation.value_or(by_method(*this, .01, 0));
}

double ReliefOptions::effective_detail() const {
  return detail.value_or(by_method(*this, .02, .04));
}

double ReliefOptions::effective_boundary_width() const {
  return boundary_width.value_or(default_shape(effective_method()).boundary_width);
}

double ReliefOptions::effective_planes() const {
  return planes.value_or(default_shape(effective_method()).planes);
}

std::vector<Ornament> ReliefOptions::all_ornaments() const {
  std::vector<Ornament> all;
  if (!text.empty()) {
    Ornament ornament{.text = text, .font = font, .arc = text_arc};
    ornament.size_mm = text_mm;
    ornament.height_mm = text_height_mm;
    ornament.inset_mm = text_inset_mm;
    all.push_back(std::move(ornament));
  }
  all.insert(all.end(), ornaments.begin(), ornaments.end());
  return all;
}

Result<void> check(const ReliefOptions& options) {
  RELIEVO_CHECK(check_ranges(options));
  RELIEVO_CHECK(check_height(options));
  RELIEVO_CHECK(check_vertical_scale(options));
  if (options.mode == Mode::exact && options.control_points != NumericOptions{}.control_points)
    return option_error("control-points", "expected mode subspace or auto with it, found exact");
  if (options.finish == Finish::reachable && !options.tool)
    return option_error("finish", "expected a tool, which tells what is reachable");
  RELIEVO_CHECK(check_draft(options));
  RELIEVO_CHECK(check_rim(options));
  RELIEVO_CHECK(check_plate_size(options));
  RELIEVO_CHECK(check_base(options));
  RELIEVO_CHECK(check_text_options(options));
  return check_method(options);
}

std::vector<IdleOption> idle_options(const ReliefOptions& options) {
  std::vector<IdleOption> idle;
  const bool is_lithophane = options.form == Form::lithophane;
  if (options.alpha && options.effective_saturation() == 0 && !is_lithophane)
    idle.push_back({"alpha", "at saturation 0; a height sets how flat the relief is"});
  if (options.corner_mm != NumericOptions{}.corner_mm && options.outline != Outline::round)
    idle.push_back({"corner", "without outline round"});
  if (options.light_contrast != NumericOptions{}.light_contrast && !options.light && !is_lithophane)
    idle.push_back({"light-contrast", "without light"});
  if (!is_lithophane) return idle;
  for (const OptionRow& row : option_table())
    if (row.stage == OptionStage::shape && !row.name.contains("height") && row.name != "width" &&
        is_given(row, options))
      idle.push_back({row.name, "on a lithophane, which is thick where the picture of the model is dark"});
  return idle;
}

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

Result<bool> parse_doubtful(const OptionValues& values) {
  RELIEVO_TRY(const OptionTargets to, read_values(values, false));
  return to.keeps_doubtful;
}

}  // namespace relievo
