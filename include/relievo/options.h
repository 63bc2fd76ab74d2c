// Defines the options of a relief as typed values. A program sets them itself, or parse_options() reads them.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relievo/core/choice.h"
#include "relievo/lettering/ornament.h"
#include "relievo/plate/base.h"
#include "relievo/plate/forms.h"
#include "relievo/plate/outline.h"
#include "relievo/plate/tool.h"
#include "relievo/plate/wrap.h"
#include "relievo/relief/light.h"
#include "relievo/relief/method.h"
#include "relievo/relief/stroke.h"
#include "relievo/relief/tone_curve.h"
#include "relievo/scan/view.h"

namespace relievo {

// The options that are numbers. option_table() has their ranges and defaults.
struct NumericOptions {
  std::optional<double> width_mm;     // longer side of the relief, without margin; see effective_width_mm()
  std::optional<double> diameter_mm;  // diameter of a round plate; default: the smallest that fits
  std::optional<double> height_mm;    // front's height, lowest to highest point; see effective_height_mm()
  std::optional<double> height_of_diagonal;  // height as a share of the diagonal L_d; replaces height_mm
  std::optional<double> mm_per_value;        // vertical scale, see relief_of_values(); default: none
  std::optional<double> ground_value;        // the value at the ground; only with mm_per_value
  std::optional<double> alpha;               // the paper's height coefficient; default: 4
  std::optional<double> saturation;          // the paper's beta; see effective_saturation()
  std::optional<double> detail;              // the paper's gamma; see effective_detail()
  std::optional<double> steepest_deg;        // largest target slope; default: 76
  double light_contrast = .8;                // factor of the model's local contrast, see ReliefLight
  double attention = 0;                      // exponent of the attention, see Shape
  double colour_mm = 0;                      // depth by which dark lines of the scan are lowered
  std::optional<double> draft_deg;       // least angle between any triangle and the vertical; default: none
  std::optional<double> boundary_width;  // width of the soft rim, in rho; see effective_boundary_width()
  double steps = 0;                      // least share of the height for steps at depth jumps, see Shape
  std::optional<double> planes;          // least step between a model's parts, see Shape, effective_planes()
  double control_points = static_cast<double>(usual_control_points);  // approximate number in subspace mode
  double corner_mm = 5;                  // radius of the corners of Outline::round
  std::optional<double> margin_mm;       // least flat ground around the relief; see effective_margin_mm()
  std::optional<double> thickness_mm;    // least thickness of the plate; see effective_thickness_mm()
  std::optional<double> rim_mm;          // width of a raised rim along the outline; default: no rim
  std::optional<double> rim_height_mm;   // height of the rim; default: the relief's, or less to fit the bevel
  std::optional<double> rim_bevel_mm;    // width of the rim's bevel; default: 0.3 of the rim's height
  std::optional<double> text_mm;         // height of the text's capital letters; default: 0.6 of the margin
  std::optional<double> text_height_mm;  // height of the text above the ground, see Ornament
  std::optional<double> text_inset_mm;   // distance from the rim to the text, see Ornament
  std::optional<double> points;          // number of visible points to sample; see usual_points()
  std::optional<double> resolution_mm;   // distance between samples; default: min(width / 700, rho)
  std::optional<double> tolerance_mm;    // largest error of the simplified mesh; default: no simplification
  std::optional<double> triangles;       // largest number of triangles of the solid; default: no limit

  bool operator==(const NumericOptions&) const = default;
};

// The kind of surface that the solid's front has.
enum class Finish {
  full,      // the relief itself
  reachable  // the surface that the tool leaves when it cuts the relief
};

inline constexpr std::array<Choice<Finish>, 2> finish_choices{
    {{"full", Finish::full}, {"reachable", Finish::reachable}}};

struct ReliefOptions : NumericOptions {
  std::optional<Method> method;         // default: see effective_method()
  std::optional<ToneCurve> tone;        // replaces equation (6) and the saturation
  std::optional<LightDirection> light;  // the light for which slopes are chosen
  Strokes strokes;                      // local changes painted onto the model
  Mode mode = Mode::exact;
  View view;
  Outline outline = Outline::rectangle;
  std::optional<Vec2> plate_mm;  // width and height of the plate; default: as small as possible
  Vec2 shift_mm = Vec2::Zero();  // shift of the relief to the right and up, in a plate with a given size
  BaseOptions base;              // a base of kind image includes the height map
  WrapOptions wrap;
  std::string text;  // text on the ground; none if empty
  TextArc text_arc = TextArc::straight;
  std::string font_name;                      // file of the text's font; the built-in font if empty
  std::shared_ptr<const FontFile> font = {};  // contents of the font's file; the calling program reads them
  std::string ornament_source;                // file or JSON with a list of further ornaments
  std::vector<Ornament> ornaments;            // the ornaments in the list; the calling program reads them
  Form form = Form::relief;
  std::optional<Tool> tool;  // if given, the report states which part the tool reaches
  Finish finish = Finish::full;

  bool operator==(const ReliefOptions&) const = default;

  // The functions effective_...() return the given value of an option, or else its default. The defaults of
  // Method::paper are those of the paper; other methods have their own. The default width is for a plate
  // without a given size, see with_width().
  double effective_width_mm() const { return width_mm.value_or(100); }
  // Returns the given method. Without one, returns linear if a vertical scale is given, the paper's method if
  // alpha is given, and layered otherwise.
  Method effective_method() const;
  // Returns the given height, if there is one. Otherwise, returns nothing in three cases: for a lithophane,
  // for a vertical scale, and for the paper's method, whose height follows from the shape. In all other
  // cases, returns usual_height_mm().
  std::optional<double> effective_height_mm() const;
  // Returns the given height. Without one, returns 2.4 mm for a lithophane and 5 % of the width for other
  // forms (docs/decisions/default-height.md).
  double usual_height_mm() const {
    return height_mm.value_or(form == Form::lithophane ? 2.4 : .05 * effective_width_mm());
  }
  double effective_alpha() const { return alpha.value_or(4); }
  // The default is the angle of the default Shape::max_slope.
  double effective_steepest_deg() const { return steepest_deg.value_or(76); }
  // The default margin is small if a diameter is given, as for coins, unless texts or borders need more room.
  double effective_margin_mm() const {
    if (text_mm && !text.empty()) return margin_mm.value_or(std::max(diameter_mm ? 1. : 5., *text_mm / .6));
    const bool has_ornaments = !text.empty() || !ornaments.empty() || !ornament_source.empty();
    return margin_mm.value_or(diameter_mm && !has_ornaments ? 1 : 5);
  }
  // Returns the text and all further ornaments.
  std::vector<Ornament> all_ornaments() const;
  // The plate of a lithophane is thin, because light has to pass through its thinnest parts.
  double effective_thickness_mm() const { return thickness_mm.value_or(form == Form::lithophane ? .8 : 3); }
  // Returns the view; for the paper's method, View::for_paper().
  View effective_view() const;
  ModelOptions effective_model() const { return {mode, static_cast<std::size_t>(control_points)}; }
  double effective_saturation() const;
  double effective_detail() const;
  double effective_boundary_width() const;
  double effective_planes() const;
};

// Checks that all options are in their ranges and do not contradict each other. Contradictions are, among
// others: more than one of height, height as a share of the diagonal, and alpha; control points in exact
// mode; alpha and a method other than the paper's; saturation or detail for a method without them; a tone
// curve, steps or strokes for the paper's method; a plate size that the outline cannot have. Errors: kind
// option, naming the option.
Result<void> check(const ReliefOptions& options);

// A given option that has no effect.
struct IdleOption {
  std::string_view name;
  std::string_view reason;  // completes the sentence "NAME has no effect"
};

// Returns the given options that have no effect with the others, for example a light for a lithophane. A number that
// equals its default does not count as given. The options must have passed check().
std::vector<IdleOption> idle_options(const ReliefOptions& options);

}  // namespace relievo
