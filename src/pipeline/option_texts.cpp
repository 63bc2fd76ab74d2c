#include "relievo/option_texts.h"

#include <array>
#include <vector>

#include "relievo/core/text.h"

namespace relievo {
namespace {

double width_of(const ReliefOptions& options) {
  return options.effective_width_mm();
}
double alpha_of(const ReliefOptions& options) {
  return options.effective_alpha();
}
double steepest_of(const ReliefOptions& options) {
  return options.steepest_deg.value_or(76);  // that of Shape::max_slope
}
double saturation_of(const ReliefOptions& options) {
  return options.effective_saturation();
}
double detail_of(const ReliefOptions& options) {
  return options.effective_detail();
}
double margin_of(const ReliefOptions& options) {
  return options.effective_margin_mm();
}
double thickness_of(const ReliefOptions& options) {
  return options.effective_thickness_mm();
}
double boundary_of(const ReliefOptions& options) {
  return options.effective_boundary_width();
}

std::vector<std::string_view> all_method_names() {
  std::vector<std::string_view> names;
  for (const MethodInfo& info : methods) names.push_back(info.name);
  return names;
}

std::string_view method_without_one() {
  static const std::string text =
      cat(name_of(Method::paper), " with an alpha, else ", name_of(Method::layered));
  return text;
}

// Returns the rows of the relief's height and compression.
std::vector<ReliefField> shape_rows() {
  return {
      ReliefField{{"width", "MM", "length of the relief's longer side; margin and rim are added to it", .1,
                   1e5, "100, or as much as diameter or plate allow"},
                  &OptionTexts::width_mm,
                  width_of},
      ReliefField{
          {"height", "MM", "from the lowest to the highest point of the front, met exactly", 1e-4, 1e5,
           "5 % of the width, or what the view reaches; by method paper what alpha gives; 2.4 for a "
           "lithophane"},
          &OptionTexts::height_mm},
      ReliefField{
          {"alpha", "A", "the paper's height coefficient, more is flatter; not together with height", 0, 1e9},
          &OptionTexts::alpha,
          alpha_of},
      ReliefField{{"saturation", "B",
                   "the paper's beta: 0 compresses all parts alike, more favours what is strongly "
                   "curved",
                   0, 100},
                  &OptionTexts::saturation,
                  saturation_of},
      ReliefField{{"detail", "G",
                   "the paper's gamma, the strength of detail; with method layered, how much coarse "
                   "shapes are attenuated",
                   0, 1},
                  &OptionTexts::detail,
                  detail_of},
      ReliefField{{.name = "method",
                   .unit = "NAME",
                   .help = "method that compresses the depths",
                   .otherwise = method_without_one(),
                   .choices = all_method_names()},
                  &OptionTexts::method},
  };
}

// The words for whether the view has crumbs, or a support plane.
constexpr std::array<Choice<bool>, 2> keep_choices{{{"drop", false}, {"keep", true}}};

// Returns the rows of the relief's limits.
std::vector<ReliefField> limit_rows() {
  return {
      ReliefField{{"steepest", "DEG",
                   "steepest slope asked of the surface, which walls at depth jumps can exceed", 1, 89},
                  &OptionTexts::steepest_deg,
                  steepest_of},
      ReliefField{{"draft", "DEG",
                   "least angle of walls off the vertical, kept by every triangle of the front: 15 for "
                   "coin dies",
                   1, 80, "any"},
                  &OptionTexts::draft_deg},
      ReliefField{{"boundary", "W", "width of the soft rim, in sampling distances", .1, 100},
                  &OptionTexts::boundary_width,
                  boundary_of},
      ReliefField{
          {"steps", "SHARE",
           "share of the height that depth jumps take, which else vanish; they take more where slopes alone "
           "do not reach the height",
           0, .95},
          &OptionTexts::steps},
      ReliefField{{.name = "tone",
                   .unit = "X,Y;..",
                   .help = "tone curve that replaces the saturation: share of the "
                           "slope kept over the square root of the curvature",
                   .otherwise = "none"},
                  &OptionTexts::tone},
      ReliefField{
          {.name = "mode",
           .unit = "MODE",
           .help = "subspace solves for about 8,000 control points: half the "
                   "memory, 1 to 4 % of the height off; auto does so above 1.5 million visible points",
           .choices = names_of(mode_choices)},
          &OptionTexts::mode},
  };
}

// Returns the rows of the side of the model that the relief shows.
std::vector<ReliefField> view_rows() {
  return {
      ReliefField{
          {.name = "view",
           .unit = "SIDE",
           .help =
               "side shown: front (+Z), back, left, right, top, bottom or "
               "the direction X,Y,Z towards the viewer; auto: the side that suits a relief best, upright"},
          &OptionTexts::view},
      ReliefField{{.name = "up",
                   .unit = "X,Y,Z",
                   .help = "direction shown upright",
                   .otherwise = "+Y, of top -Z, of bottom +Z"},
                  &OptionTexts::up},
      ReliefField{
          {.name = "crop",
           .unit = "X0,Y0,X1,Y1",
           .help = "part of the scan that is used, in shares of its box as seen, from below on the left; "
                   "with ,NEAR,FAR a part of its depth, too",
           .otherwise = "all of it"},
          &OptionTexts::crop},
      ReliefField{{.name = "crumbs",
                   .unit = "WHAT",
                   .help = "drop or keep pieces of less than 0.5 % of what is seen",
                   .choices = names_of(keep_choices)},
                  &OptionTexts::crumbs},
      ReliefField{
          {.name = "plane",
           .unit = "WHAT",
           .help = "keep or drop a table or background that is found: a plane that the figure stands on or "
                   "before, and what lies behind it",
           .choices = names_of(keep_choices)},
          &OptionTexts::plane},
      ReliefField{
          {.name = "denoise",
           .unit = "NOISE",
           .help = "noise that is removed while creases stay, as standard deviation in sampling distances, "
                   "0 to 1; auto: as much as is measured"},
          &OptionTexts::denoise},
  };
}

// Returns the rows of the plate.
std::vector<ReliefField> plate_rows() {
  return {
      ReliefField{{.name = "outline",
                   .unit = "SHAPE",
                   .help = "outline of the plate; round has round corners, none is "
                           "the relief alone, cut out along its silhouette",
                   .otherwise = "rectangle; circle with a diameter",
                   .choices = names_of(outline_choices)},
                  &OptionTexts::outline},
      ReliefField{{"corner", "MM", "radius of the corners of outline round", .01, 1e5},
                  &OptionTexts::corner_mm},
      ReliefField{
          {"diameter", "MM",
           "diameter of a round plate with margin and rim, in which the relief is as large as fits, or as "
           "width says; in a die, of the piece that it makes",
           .1, 1e5, "what the relief needs"},
          &OptionTexts::diameter_mm},
      ReliefField{
          {.name = "plate",
           .unit = "WxH",
           .help = "width and height of the plate with margin and rim, in which the relief is as large as "
                   "fits, or as width says: 200x150 or 8inx6in, with outline rectangle, round or ellipse",
           .otherwise = "what the relief needs"},
          &OptionTexts::plate},
      ReliefField{{.name = "shift",
                   .unit = "X,Y",
                   .help = "how far the relief lies to the right of the middle of a plate whose size is "
                           "given, and above it",
                   .otherwise = "0,0"},
                  &OptionTexts::shift},
      ReliefField{{"margin", "MM", "least flat ground around the relief", .01, 1e5, "5; 1 with a diameter"},
                  &OptionTexts::margin_mm,
                  margin_of},
      ReliefField{{"thickness", "MM", "smallest thickness of the plate, without the relief", .01, 1e5,
                   "3; 0.8 for a lithophane"},
                  &OptionTexts::thickness_mm,
                  thickness_of},
      ReliefField{{"rim", "MM",
                   "width of a raised edge along the outline, as coins have; in a die, of the groove that "
                   "it fits",
                   .01, 1e5, "none"},
                  &OptionTexts::rim_mm},
      ReliefField{{"rim-height", "MM", "height of the rim above the ground", .001, 1e5,
                   "the relief's height, as far as the rim is wide enough for its bevel"},
                  &OptionTexts::rim_height_mm},
      ReliefField{
          {"rim-bevel", "MM", "width of the rim's slanting inner side", .001, 1e5, "0.3 of the rim's height"},
          &OptionTexts::rim_bevel_mm},
  };
}

// Returns the rows by which the solid is bent and formed.
std::vector<ReliefField> body_rows() {
  return {
      ReliefField{{.name = "base",
                   .unit = "SHAPE",
                   .help = "surface under the relief, with numbers in mm and degrees: "
                           "wave:height=4,length=40 fold:angle=15,hollow cylinder:diameter=200,direction=0 "
                           "dome:height=5; image "
                           "is the height map that base-image names",
                   .choices = names_of(base_choices)},
                  &OptionTexts::base},
      ReliefField{
          {.name = "wrap",
           .unit = "BODY",
           .help = "body around which the finished plate is bent: "
                   "cylinder:diameter=60 cylinder:turn=360 cone:turn=90,angle=8 sphere:diameter=80,inside; "
                   "without a "
                   "size it goes around 180 degrees, a sphere 120; height maps stay flat",
           .choices = names_of(wrap_choices)},
          &OptionTexts::wrap},
      ReliefField{{"points", "N",
                   "visible points to take from a mesh, a scene, a depth image or a cloud too large for "
                   "memory",
                   1000, 1e7, "300000; 15 for each triangle of meshes that have few, at least 100000"},
                  &OptionTexts::points},
      ReliefField{{.name = "form",
                   .unit = "FORM",
                   .help = "mirror swaps left and right, die is the hollow that strikes "
                           "or casts the relief, lithophane is thick where the model is dark",
                   .choices = names_of(form_choices)},
                  &OptionTexts::form},
      ReliefField{{.name = "tool",
                   .unit = "TOOL",
                   .help = "report which areas a milling tool can reach: ball:DIAMETER, "
                           "flat:DIAMETER, v:ANGLE or, with a round tip, v:ANGLE:DIAMETER",
                   .otherwise = "none"},
                  &OptionTexts::tool},
      ReliefField{{.name = "finish",
                   .unit = "KIND",
                   .help = "reachable is the surface that the tool leaves, on a plane "
                           "base",
                   .choices = names_of(finish_choices)},
                  &OptionTexts::finish},
  };
}

// Returns the rows by which the solid's triangles are chosen.
std::vector<ReliefField> triangle_rows() {
  return {
      ReliefField{{"resolution", "MM", "finest step of the samples of which the solid is made", 1e-3, 100,
                   "a 700th of the width, or the sampling distance if that is less"},
                  &OptionTexts::resolution_mm},
      ReliefField{{"tolerance", "MM", "fewer triangles, nowhere further than this from the full relief", 1e-4,
                   100, "all triangles"},
                  &OptionTexts::tolerance_mm},
      ReliefField{{"triangles", "N",
                   "most triangles of the solid, which are finest where it curves; with tolerance as many as "
                   "that needs, at most these",
                   100, 1e9, "any number"},
                  &OptionTexts::triangles},
  };
}

}  // namespace

std::span<const ReliefField> option_fields() {
  static const std::vector<ReliefField> rows = [] {
    std::vector<ReliefField> all;
    for (const auto& part :
         {shape_rows(), limit_rows(), view_rows(), plate_rows(), body_rows(), triangle_rows()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return rows;
}

Result<View> parse_view(const ViewTexts& texts) {
  RELIEVO_TRY(View view, parse_view(texts.view, texts.up));
  RELIEVO_TRY(view.crop, parse_crop(texts.crop));
  RELIEVO_TRY(view.has_crumbs, parse_choice("crumbs", texts.crumbs, keep_choices));
  RELIEVO_TRY(view.has_plane, parse_choice("plane", texts.plane, keep_choices));
  RELIEVO_TRY(view.denoise, parse_denoise(texts.denoise));
  return view;
}

Result<ReliefOptions> parse_options(const OptionTexts& texts) {
  ReliefOptions options;
  static_cast<NumericOptions&>(options) = texts;
  if (!texts.method.empty()) {
    RELIEVO_TRY(options.method, parse_method(texts.method));
  }
  if (!texts.tone.empty()) {
    RELIEVO_TRY(options.tone, parse_tone_curve(texts.tone));
  }
  if (!texts.tool.empty()) {
    RELIEVO_TRY(options.tool, parse_tool(texts.tool));
  }
  RELIEVO_TRY(options.mode, parse_mode(texts.mode));
  RELIEVO_TRY(options.view, parse_view(static_cast<const ViewTexts&>(texts)));
  if (!texts.outline.empty()) {
    RELIEVO_TRY(options.outline, parse_outline(texts.outline));
  } else if (options.diameter_mm) {
    options.outline = Outline::circle;
  }
  if (!texts.plate.empty()) {
    Result<Vec2> size = parse_plate_size(texts.plate);
    if (!size) return option_error("plate", size.error().expected);
    options.plate_mm = *size;
  }
  if (!texts.shift.empty()) {
    Result<Vec2> shift = parse_shift(texts.shift);
    if (!shift) return option_error("shift", shift.error().expected);
    options.shift_mm = *shift;
  }
  RELIEVO_TRY(options.base, parse_base(texts.base));
  RELIEVO_TRY(options.wrap, parse_wrap(texts.wrap));
  RELIEVO_TRY(options.form, parse_form(texts.form));
  RELIEVO_TRY(options.finish, parse_choice("finish", texts.finish, finish_choices));
  RELIEVO_CHECK(check(options));
  return options;
}

}  // namespace relievo
