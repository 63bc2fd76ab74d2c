#include "relievo/option_table.h"

#include <algorithm>
#include <cmath>

#include "pipeline/option_targets.h"
#include "relievo/core/text.h"
#include "relievo/io/read.h"

namespace relievo {
namespace {

using enum OptionStage;

Result<std::string> same(std::string_view text) {
  return std::string(text);
}

Result<void> read_channel(const OptionValue& value, OptionTargets& to) {
  const double channel = std::get<double>(value);
  to.depth.channel = static_cast<int>(channel);
  if (to.depth.channel == channel) return {};
  return option_error({}, cat("expected a whole number, found ", channel));
}

// The words of options that select whether crumbs, a support plane or doubtful points are dropped or kept.
constexpr std::array<Choice<bool>, 2> keep_choices{{{"drop", false}, {"keep", true}}};

Result<void> read_crumbs(const OptionValue& value, OptionTargets& to) {
  const std::string& text = std::get<std::string>(value);
  constexpr double most_pieces = 1e6;
  const std::vector<double> numbers = parse_numbers(text).value_or(std::vector<double>());
  const double number = numbers.size() == 1 ? numbers[0] : 0;
  View& view = to.relief.view;
  view.most_pieces = text == "largest" ? 1 : 0;
  if (number >= 1 && number <= most_pieces && number == std::floor(number))
    view.most_pieces = static_cast<int>(number);
  if (view.most_pieces > 0) return {};
  const Result<bool> has_crumbs = parse_choice({}, text, keep_choices);
  if (!has_crumbs)
    return option_error({}, cat("expected drop, keep, largest or a number of pieces, found '", text, "'"));
  view.has_crumbs = *has_crumbs;
  return {};
}

// Table entries are easier to read in few long lines than with one line per member.
// clang-format off

// Returns the options for the relief's height and compression.
std::vector<OptionRow> shape_rows() {
  return {
      {.name = "width", .unit = "MM", .stage = shape, .min = .1, .max = 1e5,
       .help = "length of the relief's longer side; margin and rim are added to it",
       .otherwise = "100, or as much as diameter or plate allow", .is_stated = true,
       .access = number<&ReliefOptions::width_mm, &ReliefOptions::effective_width_mm>},
      {.name = "height", .unit = "MM", .stage = shape, .min = 1e-4, .max = 1e5,
       .help = "from the lowest to the highest point of the front, met exactly",
       .otherwise = "5 % of the width, or what the view reaches; by method paper what alpha gives; 2.4 for a "
                    "lithophane",
       .is_stated = true,
       .access = number<&ReliefOptions::height_mm, &ReliefOptions::usual_height_mm>},
      {.name = "height-of-diagonal", .unit = "SHARE", .stage = shape, .min = .001, .max = 1,
       .help = "the height as a share of the diagonal of the scan's box, the paper's L_d; in the place of height",
       .otherwise = "none", .is_hidden = true, .access = number<&ReliefOptions::height_of_diagonal>},
      {.name = "mm-per-value", .unit = "MM", .stage = shape, .min = 1e-9, .max = 1e6,
       .help = "one vertical scale in the place of a height: the millimetres of one unit of the heights in the file, so "
               "that tiles of a map fit edge to edge; by method linear",
       .otherwise = "none", .access = number<&ReliefOptions::mm_per_value>},
      {.name = "ground", .unit = "VALUE", .stage = shape, .min = -1e9, .max = 1e9,
       .help = "with mm-per-value: the height in the file at which the ground lies; what is lower is level with it",
       .otherwise = "0 of a picture of heights, else the lowest height",
       .access = number<&ReliefOptions::ground_value>},
      {.name = "alpha", .unit = "A", .stage = shape, .min = 0, .max = 1e9,
       .help = "the paper's height coefficient, more is flatter; not together with height",
       .access = number<&ReliefOptions::alpha, &ReliefOptions::effective_alpha>},
      {.name = "saturation", .unit = "B", .stage = shape, .min = 0, .max = 100,
       .help = "the paper's beta: 0 compresses all parts alike, more favours what is strongly curved",
       .is_stated = true,
       .access = number<&ReliefOptions::saturation, &ReliefOptions::effective_saturation>},
      {.name = "detail", .unit = "G", .stage = shape, .min = 0, .max = 1,
       .help = "the paper's gamma, the strength of detail; with method layered, how much coarse shapes are attenuated",
       .is_stated = true,
       .access = number<&ReliefOptions::detail, &ReliefOptions::effective_detail>},
      {.name = "method", .unit = "NAME", .stage = model, .choices = names_of(methods),
       .help = "method that compresses the depths", .otherwise = "paper with an alpha, else layered",
       .in_studio = "layered", .is_stated = true,
       .access = text<&ReliefOptions::method, [](auto t) { return parse_method(t); }>},
  };
}

// Returns the options for the relief's limits.
std::vector<OptionRow> limit_rows() {
  return {
      {.name = "steepest", .unit = "DEG", .stage = shape, .min = 1, .max = 89,
       .help = "steepest slope asked of the surface, which walls at depth jumps can exceed",
       .access = number<&ReliefOptions::steepest_deg, &ReliefOptions::effective_steepest_deg>},
      {.name = "draft", .unit = "DEG", .stage = triangles, .min = 1, .max = 80,
       .help = "least angle of walls off the vertical, kept by every triangle of the front: 15 for coin dies",
       .otherwise = "any",
       .access = number<&ReliefOptions::draft_deg>},
      {.name = "boundary", .unit = "W", .stage = shape, .min = .1, .max = 100,
       .help = "width of the soft rim, in sampling distances", .is_stated = true,
       .access = number<&ReliefOptions::boundary_width, &ReliefOptions::effective_boundary_width>},
      {.name = "steps", .unit = "SHARE", .stage = shape, .min = 0, .max = .95,
       .help = "share of the height that depth jumps take, which else vanish; they take more where slopes alone do "
               "not reach the height",
       .initial = NumericOptions{}.steps, .is_stated = true,
       .access = number<&ReliefOptions::steps>},
      {.name = "planes", .unit = "SHARE", .stage = shape, .min = 0, .max = .3,
       .help = "least share of the height by which each part stands off what is behind it, and off the ground",
       .is_stated = true,
       .access = number<&ReliefOptions::planes, &ReliefOptions::effective_planes>},
      {.name = "tone", .unit = "X,Y;..", .stage = shape,
       .help = "tone curve that replaces the saturation: share of the slope kept over the square root of the curvature",
       .otherwise = "none", .access = text<&ReliefOptions::tone, parse_tone_curve>},
      {.name = "light", .unit = "AZ,EL", .stage = shape,
       .help = "azimuth and elevation in degrees of a light under which the piece will hang, for which slopes are chosen: "
               "135,30 is from the upper left",
       .otherwise = "none", .access = text<&ReliefOptions::light, parse_light>},
      {.name = "light-contrast", .unit = "C", .stage = shape, .min = 0, .max = 1,
       .help = "how much of the model's contrast under the light the relief gets", .initial = NumericOptions{}.light_contrast,
       .access = number<&ReliefOptions::light_contrast>},
      {.name = "attention", .unit = "E", .stage = shape, .min = 0, .max = 4,
       .help = "how much more detail parts get at which viewers are guessed to look, and how much less the others",
       .initial = NumericOptions{}.attention, .access = number<&ReliefOptions::attention>},
      {.name = "colour", .unit = "MM", .stage = shape, .min = 0, .max = 100,
       .help = "depth by which dark lines of a coloured scan sink, such as pupils and painted letters",
       .initial = NumericOptions{}.colour_mm, .access = number<&ReliefOptions::colour_mm>},
      {.name = "strokes", .unit = "JSON", .stage = shape,
       .help = "local changes painted onto the model, as JSON or a file with it: brush, area, amount, radius and points of each",
       .otherwise = "none", .is_hidden = true, .access = text<&ReliefOptions::strokes, parse_strokes>},
      {.name = "mode", .unit = "MODE", .stage = model, .choices = names_of(mode_choices),
       .help = "subspace solves for control points: half the memory, 1 to 4 % of the height off; auto does "
               "so above 1.5 million visible points",
       .initial = "exact", .in_studio = "auto", .is_stated = true,
       .access = word<&ReliefOptions::mode, mode_choices>},
      {.name = "control-points", .unit = "N", .stage = model, .min = 100, .max = 1e6,
       .help = "control points asked of the subspace, of which method paper gets about 0.6", .initial = NumericOptions{}.control_points,
       .is_hidden = true, .access = number<&ReliefOptions::control_points>},
  };
}

// Returns the options that select the part of the model to show.
std::vector<OptionRow> view_rows() {
  return {
      {.name = "view", .unit = "SIDE", .stage = view,
       .help = "side shown: front (+Z), back, left, right, top, bottom or the direction X,Y,Z towards the viewer; "
               "auto: the side that suits a relief best, upright",
       .initial = "front", .in_studio = "auto", .is_stated = true, .access = text<&OptionTargets::side, same>},
      {.name = "up", .unit = "X,Y,Z", .stage = view,
       .help = "direction shown upright", .otherwise = "+Y, of top -Z, of bottom +Z",
       .access = text<&OptionTargets::up, same>},
      {.name = "crop", .unit = "X0,Y0,X1,Y1", .stage = view,
       .help = "part of the scan that is used, in shares of its box as seen, from below on the left; with ,NEAR,FAR a "
               "part of its depth, too",
       .otherwise = "all of it", .access = text<&View::crop, parse_crop>},
      {.name = "crumbs", .unit = "WHAT", .stage = view, .choices = names_of(keep_choices),
       .help = "drop or keep pieces of less than 0.5 % of what is seen; largest, or a number of pieces, drops all others",
       .initial = "drop", .access = {read_crumbs}},
      {.name = "plane", .unit = "WHAT", .stage = view, .choices = names_of(keep_choices),
       .help = "keep or drop a table or background that is found: a plane that the figure stands on or before, and "
               "what lies behind it",
       .initial = "keep", .access = word<&View::has_plane, keep_choices>},
      {.name = "gap", .unit = "N", .stage = view, .min = 1, .max = 6,
       .help = "widest gap between parts of a cloud, such as fingers, that is closed, in sampling distances",
       .initial = View{}.gap, .access = number<&View::gap>},
      {.name = "denoise", .unit = "NOISE", .stage = view,
       .help = "noise that is removed while creases stay, as standard deviation in sampling distances, 0 to 1; auto: "
               "as much as is measured",
       .initial = "auto", .access = text<&View::denoise, parse_denoise>},
  };
}

std::vector<OptionRow> plate_rows() {
  return {
      {.name = "outline", .unit = "SHAPE", .stage = plate, .choices = names_of(outline_choices),
       .help = "outline of the plate; round has round corners, none is the relief alone, cut out along its silhouette",
       .otherwise = "rectangle; circle with a diameter", .in_studio = "rectangle",
       .access = word<&OptionTargets::outline, outline_choices>},
      {.name = "corner", .unit = "MM", .stage = plate, .min = .01, .max = 1e5,
       .help = "radius of the corners of outline round", .initial = NumericOptions{}.corner_mm,
       .access = number<&ReliefOptions::corner_mm>},
      {.name = "diameter", .unit = "MM", .stage = plate, .min = .1, .max = 1e5,
       .help = "diameter of a round plate with margin and rim, in which the relief is as large as fits, or as width "
               "says; in a die, of the piece that it makes",
       .otherwise = "what the relief needs",
       .access = number<&ReliefOptions::diameter_mm>},
      {.name = "plate", .unit = "WxH", .stage = plate,
       .help = "width and height of the plate with margin and rim, in which the relief is as large as fits, or as "
               "width says: 200x150 or 8inx6in, with outline rectangle, round or ellipse",
       .otherwise = "what the relief needs",
       .access = text<&ReliefOptions::plate_mm, [](auto t) { return parse_plate_size(t); }>},
      {.name = "shift", .unit = "X,Y", .stage = plate,
       .help = "how far the relief lies to the right of the middle of a plate whose size is given, and above it",
       .otherwise = "0,0",
       .access = text<&ReliefOptions::shift_mm, [](auto t) { return parse_shift(t); }>},
      {.name = "margin", .unit = "MM", .stage = plate, .min = .01, .max = 1e5,
       .help = "least flat ground around the relief", .otherwise = "5; 1 with a diameter and no ornaments", .is_stated = true,
       .access = number<&ReliefOptions::margin_mm, &ReliefOptions::effective_margin_mm>},
      {.name = "thickness", .unit = "MM", .stage = plate, .min = .01, .max = 1e5,
       .help = "smallest thickness of the plate, without the relief",
       .otherwise = "3; 0.8 for a lithophane", .is_stated = true,
       .access = number<&ReliefOptions::thickness_mm, &ReliefOptions::effective_thickness_mm>},
      {.name = "rim", .unit = "MM", .stage = plate, .min = .01, .max = 1e5,
       .help = "width of a raised edge along the outline, as coins have; in a die, of the groove that it fits",
       .otherwise = "none", .access = number<&ReliefOptions::rim_mm>},
      {.name = "rim-height", .unit = "MM", .stage = plate, .min = .001, .max = 1e5,
       .help = "height of the rim above the ground",
       .otherwise = "the relief's height, as far as the rim is wide enough for its bevel",
       .access = number<&ReliefOptions::rim_height_mm>},
      {.name = "rim-bevel", .unit = "MM", .stage = plate, .min = .001, .max = 1e5,
       .help = "width of the rim's slanting inner side", .otherwise = "0.3 of the rim's height",
       .access = number<&ReliefOptions::rim_bevel_mm>},
  };
}

// Returns the options for texts and ornaments on the ground.
std::vector<OptionRow> ornament_rows() {
  return {
      {.name = "text", .unit = "TEXT", .stage = plate,
       .help = "text on the ground, in any script that the font has; the margin gives it room, and must be clear",
       .otherwise = "none", .is_hidden = true, .access = text<&ReliefOptions::text, same>},
      {.name = "text-arc", .unit = "LINE", .stage = plate, .choices = names_of(text_arc_choices),
       .help = "line on which the text stands: straight below the relief, or on a circle at the top, at the bottom or "
               "all around",
       .initial = "straight", .is_hidden = true, .access = word<&ReliefOptions::text_arc, text_arc_choices>},
      {.name = "text-size", .unit = "MM", .stage = plate, .min = .1, .max = 1e4,
       .help = "height of the text's capitals", .otherwise = "0.6 of the margin inside of borders",
       .is_hidden = true, .access = number<&ReliefOptions::text_mm>},
      {.name = "text-height", .unit = "MM", .stage = plate, .min = -100, .max = 100,
       .help = "height of the text above the ground; a negative one sinks it. Its walls lean as draft says, else by 15 "
               "degrees",
       .otherwise = "0.2 of its size, below the rim", .is_hidden = true, .access = number<&ReliefOptions::text_height_mm>},
      {.name = "text-inset", .unit = "MM", .stage = plate, .min = 0, .max = 1e4,
       .help = "distance from the rim to the text, to the foot of a straight one",
       .otherwise = "in the middle of the margin inside of borders", .is_hidden = true,
       .access = number<&ReliefOptions::text_inset_mm>},
      {.name = "font", .unit = "FILE", .stage = plate,
       .help = "TrueType or OpenType font of the text; none takes its place",
       .otherwise = "the font inside, Noto Serif Bold, for Latin, Greek and Cyrillic", .is_hidden = true,
       .access = text<&ReliefOptions::font_name, same>},
      {.name = "ornaments", .unit = "FILE", .stage = plate,
       .help = "further texts, beads, rope, lines and SVG drawings, as JSON such as [{\"kind\": \"beads\"}] or a file with it",
       .otherwise = "none", .access = text<&ReliefOptions::ornament_source, same>},
  };
}

// Returns the options for the shape of the solid.
std::vector<OptionRow> body_rows() {
  return {
      {.name = "base", .unit = "SHAPE", .stage = body, .choices = names_of(base_choices),
       .help = "surface under the relief, with numbers in mm and degrees: wave:height=4,length=40 fold:angle=15,hollow "
               "cylinder:diameter=200,direction=0 dome:height=5; image is the height map that base-image names",
       .initial = "plane", .access = text<&ReliefOptions::base, parse_base>},
      {.name = "wrap", .unit = "BODY", .stage = body, .choices = names_of(wrap_choices),
       .help = "body around which the finished plate is bent: cylinder:diameter=60 cylinder:turn=360 "
               "cone:turn=90,angle=8 sphere:diameter=80,inside; without a size it goes around 180 degrees, a sphere "
               "120; height maps stay flat",
       .initial = "none", .access = text<&ReliefOptions::wrap, parse_wrap>},
      {.name = "points", .unit = "N", .stage = model, .min = 1000, .max = 1e7,
       .help = "visible points to take from a mesh, a scene, a depth image or a cloud too large for memory",
       .otherwise = "300000; 15 for each triangle of meshes that have few, at least 100000",
       .access = number<&ReliefOptions::points>},
      {.name = "form", .unit = "FORM", .stage = body, .choices = names_of(form_choices),
       .help = "mirror swaps left and right, die is the hollow that strikes or casts the relief, lithophane is thick "
               "where the model is dark",
       .initial = "relief", .access = word<&ReliefOptions::form, form_choices>},
      {.name = "tool", .unit = "TOOL", .stage = triangles,
       .help = "report which areas a milling tool can reach: ball:DIAMETER, flat:DIAMETER, v:ANGLE or, with a round "
               "tip, v:ANGLE:DIAMETER",
       .otherwise = "none",
       .access = text<&ReliefOptions::tool, [](auto t) { return parse_tool(t); }>},
      {.name = "finish", .unit = "KIND", .stage = triangles, .choices = names_of(finish_choices),
       .help = "reachable is the surface that the tool leaves, on a plane base",
       .initial = "full", .access = word<&ReliefOptions::finish, finish_choices>},
  };
}

std::vector<OptionRow> triangle_rows() {
  return {
      {.name = "resolution", .unit = "MM", .stage = triangles, .min = 1e-3, .max = 100,
       .help = "finest step of the samples of which the solid is made",
       .otherwise = "a 700th of the width, or the sampling distance if that is less",
       .access = number<&ReliefOptions::resolution_mm>},
      {.name = "tolerance", .unit = "MM", .stage = triangles, .min = 1e-4, .max = 100,
       .help = "fewer triangles, nowhere further than this from the full relief", .otherwise = "all triangles",
       .access = number<&ReliefOptions::tolerance_mm>},
      {.name = "triangles", .unit = "N", .stage = triangles, .min = 100, .max = 1e9,
       .help = "most triangles of the solid, which are finest where it curves; with tolerance as many as that needs, "
               "at most these",
       .otherwise = "any number",
       .access = number<&ReliefOptions::triangles>},
  };
}

// Returns the options for reading a file.
std::vector<OptionRow> input_rows() {
  return {
      {.name = "doubtful", .unit = "WHAT", .stage = input, .choices = names_of(keep_choices),
       .help = "drop or keep points that the file itself marks as noise or withheld (LAS), and splats less than half "
               "opaque",
       .initial = "drop", .access = word<&OptionTargets::keeps_doubtful, keep_choices>},
      {.name = "depth-values", .unit = "KIND", .stage = input, .choices = names_of(depth_value_choices),
       .help = "of a depth image: depth (0 is missing), height, inverse depth as estimators give it, or luminance, "
               "also of colours, bright being near; auto: luminance of colours, height in formats of terrain, else "
               "depth",
       .initial = "depth", .in_studio = "auto", .is_stated = true,
       .access = word<&DepthOptions::values, depth_value_choices>},
      {.name = "channel", .unit = "N", .stage = input, .min = 0, .max = 64,
       .help = "of a depth image with several channels: the one with the depths; 0: the only one",
       .initial = 0., .access = {read_channel}},
      {.name = "camera", .unit = "FX,FY,CX,CY", .stage = input,
       .help = "of a depth image: focal lengths and centre, in pixels, or the nine numbers of the matrix, or a file with "
               "either",
       .otherwise = "none",
       .access = text<&DepthOptions::camera, [](auto t) { return parse_camera(t); }>},
      {.name = "depth-range", .unit = "R", .stage = input, .min = .01, .max = 10,
       .help = "of a depth image without camera: nearest to farthest, as a share of the longer side of the picture",
       .initial = DepthOptions{}.range, .access = {read_number<&DepthOptions::range>}},
      {.name = "background", .unit = "B", .stage = input, .choices = names_of(removal_choices),
       .help = "of a depth image: what lies behind a depth jump all around the figure; auto drops it, but keeps it "
               "with a camera and in heights; drop without such a jump takes the far depths",
       .initial = "auto", .access = word<&DepthOptions::background, removal_choices>},
      {.name = "blur", .unit = "B", .stage = input, .choices = names_of(removal_choices),
       .help = "of a depth image: points between two levels that continue neither; auto drops them over at most 3 "
               "pixels, but keeps them in heights; drop over at most 12, as auto does for depth cameras, whose thin "
               "teeth of outlines go, too",
       .initial = "auto", .access = word<&DepthOptions::blur, removal_choices>},
  };
}

// clang-format on

}  // namespace

std::span<const OptionRow> option_table() {
  static const std::vector<OptionRow> rows = [] {
    std::vector<OptionRow> all;
    for (const auto& part : {shape_rows(), limit_rows(), view_rows(), plate_rows(), ornament_rows(),
                             body_rows(), triangle_rows(), input_rows()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return rows;
}

const OptionRow* find_option(std::string_view name) {
  const auto found = std::ranges::find(option_table(), name, &OptionRow::name);
  return found == option_table().end() ? nullptr : &*found;
}

}  // namespace relievo
