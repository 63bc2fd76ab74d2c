// The options of a relief, named once: struct, command line, help and documents all come from visit().
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "relievo/core/error.h"
#include "relievo/plate/base.h"

namespace relievo {

struct ReliefOptions {
  double width_mm = 100;             // longer side of the relief, without margin
  std::optional<double> height_mm;   // lowest to highest point of the front; without it alpha rules
  std::optional<double> alpha;       // the paper's height coefficient, 4 if neither it nor a height is given
  std::optional<double> saturation;  // the paper's beta: 0.01, or 0 with a height
  std::optional<double> detail;      // the paper's gamma: 0.02, or 0.04 with a height
  std::string method;                // see method.h; ours with a height, else the paper's
  std::optional<double> steepest_deg;    // steepest slope of the front, 76 without it
  std::optional<double> draft_deg;       // least lean of walls off the vertical, held by every triangle
  std::optional<double> boundary_width;  // of (7), in sampling distances; 2, with method ours 0.5
  std::string tone;  // a curve in place of (6), see parse_tone_curve(); empty is the paper's
  std::string mode = "exact";
  std::string view = "front";
  std::string up;
  std::string outline = "rectangle";  // of the plate; or "round", "circle" ...: see outline.h
  double corner_mm = 5;               // radius of the corners of outline "round"
  double margin_mm = 5;
  double thickness_mm = 3;
  std::optional<double> rim_mm;         // width of a raised edge along the outline; without it there is none
  std::optional<double> rim_height_mm;  // above the ground; the relief's height, at most the rim's width
  std::optional<double> rim_bevel_mm;   // width of its slanting inner side; 0.3 of its height
  std::string base = "plane";           // that the relief lies on: see parse_base()
  std::shared_ptr<const HeightGrid> base_image;  // of base "image"; not told by visit()
  std::string wrap = "none";                     // that the plate is bent around: see parse_wrap()
  double points = 3e5;                           // visible points to take from what is no cloud
  std::string form = "relief";                   // or "mirror", "die", "lithophane": see forms.h
  std::string tool;                    // a milling tool to be told of, see parse_tool(); none if empty
  std::string surface = "full";        // or "reachable": what that tool leaves
  std::optional<double> tolerance_mm;  // largest error of a mesh made simpler; without it all points stay

  // The values that rule where none was given: the paper's, or for a height those that keep most of the
  // model.
  std::string effective_method() const { return !method.empty() ? method : height_mm ? "ours" : "paper"; }
  double effective_alpha() const { return alpha.value_or(4); }
  double effective_saturation() const { return saturation.value_or(effective_method() == "paper" ? .01 : 0); }
  double effective_boundary_width() const {
    const std::string ruling = effective_method();
    return boundary_width.value_or(ruling == "ours" ? .5 : 2);
  }
  double effective_detail() const { return detail.value_or(effective_method() == "paper" ? .02 : .04); }
};

struct OptionField {
  std::string_view name;  // as a command-line flag without its dashes
  std::string_view unit;  // of the value, for help
  std::string_view help;  // one line; for optional values it tells the default
  double min = -std::numeric_limits<double>::infinity();  // smallest and largest allowed value, of numbers
  double max = std::numeric_limits<double>::infinity();
};

// Calls f(field, value) for each option in the order of the help; value is double, optional<double> or
// string.
template <typename Options, typename F>
void visit(Options& o, F&& f) {
  f(OptionField{"width", "MM", "longer side of the relief, without margin", .1, 1e5}, o.width_mm);
  f(OptionField{"height", "MM", "lowest to highest point of the front, met exactly; default: alpha rules",
                1e-4, 1e5},
    o.height_mm);
  f(OptionField{"alpha", "A", "height coefficient, more is flatter; default 4; not together with height", 0,
                1e9},
    o.alpha);
  f(OptionField{"saturation", "B", "saturation coefficient, 0 is even; default 0.01, with height 0", 0, 100},
    o.saturation);
  f(OptionField{"detail", "G", "detail coefficient; default 0.02, with height 0.04", 0, 1}, o.detail);
  f(OptionField{"method", "NAME",
                "ours, paper, linear, equalise, gradient or detail; default ours with a height, else "
                "paper"},
    o.method);
  f(OptionField{"steepest", "DEG",
                "steepest slope asked of the surface, which walls at jumps can exceed; default 76", 1, 89},
    o.steepest_deg);
  f(OptionField{"draft", "DEG",
                "least angle of walls off the vertical, kept by every triangle of the front; default: any", 1,
                80},
    o.draft_deg);
  f(OptionField{"boundary", "W",
                "width of the soft rim, in sampling distances; default 2, with method ours 0.5", .1, 100},
    o.boundary_width);
  f(OptionField{"tone", "X,Y;..", "share of slopes kept over the root of curvature, instead of saturation"},
    o.tone);
  f(OptionField{"mode", "MODE", "exact, subspace (from 8,000 control points, close to exact) or auto"},
    o.mode);
  f(
      OptionField{
          "view", "SIDE",
          "side shown: front (+Z), back, left, right, top, bottom or the direction X,Y,Z towards the viewer"},
      o.view);
  f(OptionField{"up", "X,Y,Z", "direction shown upright; default +Y, for top -Z, for bottom +Z"}, o.up);
  f(OptionField{"outline", "SHAPE",
                "of the plate: rectangle, round (with round corners), circle, ellipse, hexagon, or none: the "
                "relief alone"},
    o.outline);
  f(OptionField{"corner", "MM", "radius of the corners of outline round", .01, 1e5}, o.corner_mm);
  f(OptionField{"margin", "MM", "least flat ground around the relief", .01, 1e5}, o.margin_mm);
  f(OptionField{"thickness", "MM", "smallest thickness of the plate", .01, 1e5}, o.thickness_mm);
  f(OptionField{"rim", "MM", "width of a raised edge along the outline, as coins have; default: none", .01,
                1e5},
    o.rim_mm);
  f(OptionField{"rim-height", "MM",
                "of the rim above the ground; default: as high as the relief, at most as high as wide", .001,
                1e5},
    o.rim_height_mm);
  f(OptionField{"rim-bevel", "MM",
                "of the rim's width, what its slanting side takes; default: 0.3 of its height", .001, 1e5},
    o.rim_bevel_mm);
  f(OptionField{"base", "SHAPE",
                "that the relief lies on: plane, fold, wave, cylinder, dome or image, with numbers in mm and "
                "degrees: wave:height=4,length=40 fold:angle=15,hollow cylinder:diameter=200,direction=0"},
    o.base);
  f(OptionField{"wrap", "BODY",
                "that the finished plate is bent around: cylinder:diameter=60 cylinder:turn=360 "
                "cone:turn=90,angle=8 sphere:diameter=80,inside; default turn: 180 degrees, sphere 120"},
    o.wrap);
  f(OptionField{"points", "N", "visible points to take from a mesh, a scene or a depth image", 1000, 1e7},
    o.points);
  f(OptionField{"form", "FORM",
                "relief; mirror: left and right swapped; die: the hollow that strikes or casts the relief; "
                "lithophane: thick where the model is dark"},
    o.form);
  f(
      OptionField{
          "tool", "TOOL",
          "tells what a milling tool reaches: ball:DIAMETER, flat:DIAMETER or v:ANGLE, with a round tip "
          "v:ANGLE:DIAMETER"},
      o.tool);
  f(OptionField{"surface", "KIND", "full; or reachable: as that tool leaves it"}, o.surface);
  f(OptionField{"tolerance", "MM",
                "fewer triangles, at most so far from the full relief; default: all of them", 1e-4, 100},
    o.tolerance_mm);
}

// Checks every range, that the method exists, and that options do not contradict each other: height and
// alpha; a method other than the paper's without a height; saturation or detail for a method that has none.
// Errors: kind option, naming the option.
Result<void> check(const ReliefOptions& options);

}  // namespace relievo
