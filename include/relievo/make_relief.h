// Makes, in one call, a solid of a scan that a machine can cut. The steps of the call are functions, too:
// sample the points that a view shows (sample_for_view), find their surface and factor its system (prepare),
// and make the solid with its relief (make_relief).
#pragma once

#include <optional>
#include <vector>

#include "relievo/options.h"
#include "relievo/plate/solid.h"
#include "relievo/plate/tool.h"
#include "relievo/scan/support_plane.h"
#include "relievo/view_sample.h"

namespace relievo {

class Progress;
class ReliefModel;
struct CloudFile;
struct Shape;
struct Surface;

// Facts about the points of a scan and the visible ones among them.
struct ScanReport {
  std::size_t input_points = 0, repeated_points = 0, visible_points = 0, removed_points = 0,
              crumbs = 0;                        // see Surface
  double measured_noise = 0, removed_noise = 0;  // see Surface
  double rho = 0;                                // sampling distance, in the cloud's units
  double diagonal = 0;                           // L_d: diagonal of the cloud's box, in its units

  // The table or background that was found.
  struct FoundPlane {
    PlaneKind kind = PlaneKind::background;
    double share = 0;          // share of the visible points that belong to the plane
    bool is_left_out = false;  // true if the view leaves the plane out
  };
  std::optional<FoundPlane> plane;

  bool lacks_plane = false;            // a plane was to be left out, but none was found
  bool has_estimated_normals = false;  // the points had no normals, so normals were estimated
  bool has_turned_normals = false;     // the points' normals pointed inwards and were reversed

  // Returns the facts about the points of a surface.
  static ScanReport of(const Surface& surface);
};

// Facts about a relief, and the options with which it was made.
struct ReliefReport : ScanReport {
  Form form = Form::relief;
  Method method = Method::paper;  // alpha, beta, gamma and u have no meaning for a method without shape
  double alpha = 0;  // NaN if beta is 0 or there is a tone curve: then u has an effect, alpha has none
  double beta = 0, gamma = 0;
  double u = 0;      // alpha^-beta, see Compression
  double steps = 0;  // share of the height that depth jumps take, see Shape
  std::optional<double> height_requested_mm;
  std::optional<double> height_usual_mm;  // default height, if none was requested; see effective_height_mm()
  double height_mm = 0;        // height of the front from its lowest to its highest point, above its base
  double below_ground_mm = 0;  // the part of height_mm below the flat ground; in a die, all of it
  double steepest_deg = 0;     // slope of the front's steepest triangle, rounded as in files

  // Maps a point p of the cloud to coordinates of the solid in mm: scale * rotation * p + offset. This is
  // exact in x and y. In z the model keeps its uncompressed depth, and its lowest visible point lies on the
  // ground (with a curved base, on the ground in the middle of the plate). For a mirrored form `rotation`
  // includes the reflection.
  Mat3 rotation = Mat3::Identity();
  double scale = 1;
  Vec3 offset = Vec3::Zero();

  std::optional<Tool> tool;        // the tool of the options
  std::optional<ToolReach> reach;  // the tool's reach on the front
  OrnamentFacts ornaments;
  std::optional<double> rim_height_mm;  // above the ground; nothing without a rim

  // Largest difference between the simplified front and the full one, if a tolerance or a number of triangles
  // was given.
  std::optional<double> simplification_error_mm;
  std::size_t front_triangles = 0, full_triangles = 0;  // in the front, and in the full relief

  // The measures of a wrap: the ground's diameter, the angle that the plate covers, and the length of one
  // degree on the ground, which is the same in the flat plate.
  struct Wrapped {
    double diameter_mm = 0, turn_deg = 0, mm_per_degree = 0;
    bool is_inside = false;       // the relief is on the inner side
    Vec2 across = Vec2::UnitX();  // the direction in which the plate is bent
  };
  std::optional<Wrapped> wrap;  // if set, offset and scale are those of the flat plate

  // Facts that a user may want to be warned of.
  bool has_idle_alpha = false;     // an alpha was given, which has no effect
  bool has_needed_steps = false;   // depth jumps take more than requested to reach the height
  std::vector<SampleNote> sample;  // empty for a model that the caller prepared
};

struct MadeRelief {
  Solid solid;
  ReliefReport report;
  Solid flat = {};  // the solid before it was bent around its wrap, for height maps; empty without a wrap
};

// Returns the surface that the points show in that view, with its factored system. Errors: those of
// find_surface() and ReliefModel::prepare().
Result<ReliefModel> prepare(const Cloud& points, const View& view, const ModelOptions& options = {},
                            Progress* progress = nullptr);

// Returns the plate with the relief of a prepared model; options.view, mode, control points and points are
// ignored. Stages and their times are reported to `progress`; the caller ends the last stage by
// Progress::finish(). Errors: those of check(), of ReliefModel::make_at_height() and of the plate's parts; kind cancelled.
Result<MadeRelief> make_relief(const ReliefModel& model, const ReliefOptions& options,
                               Progress* progress = nullptr);

// Returns the height in mm of the highest relief whose walls keep the draft angle of the options. If the
// options give no draft angle, all reliefs are considered. The method must have a shape, see has_shape().
// Errors: those of make_relief().
Result<double> highest_with_draft(const ReliefModel& model, const ReliefOptions& options,
                                  Progress* progress = nullptr);

// Checks that the model was prepared for the method of the options, see ReliefModel::serves(), and that the
// surface has colours if lines shall sink. Errors: kind option.
Result<void> check_model(const ReliefModel& model, const ReliefOptions& options);

// Checks that the bevel of the options' rim leans at least as much as the draft angle requires, for a relief
// of that height. make_relief() does this itself. Errors: kind option.
Result<void> check_rim(const ReliefOptions& options, double height_mm);

// Samples the points of a file for the view, prepares their model, and makes its relief. scene.h has such a
// function for several files. Errors: also those of sample_for_view() and prepare().
Result<MadeRelief> make_relief(CloudFile file, const ReliefOptions& options, Progress* progress = nullptr);

// Makes the relief of a cloud in the same way.
Result<MadeRelief> make_relief(Cloud cloud, const ReliefOptions& options, Progress* progress = nullptr);

// Returns the shape that the options ask for. If the relief must have a given or the usual height, the search
// for that height starts from this shape. The depth of lines is in units of `mm_per_unit` millimetres.
Shape shape_of(const ReliefOptions& options, double mm_per_unit = 1);

// Returns the options with a width: the given width; without one, the largest width with which the relief,
// margin and rim included, fits into a plate of the given size; without a size, the default. make_relief()
// does this itself. A height that is a share of the diagonal becomes a height in mm. Errors: kind option if
// the plate is too small.
Result<ReliefOptions> with_width(const Surface& surface, const ReliefOptions& options);

// Returns millimetres per unit of the surface at the width of the options, see with_width().
double mm_per_unit(const Surface& surface, const ReliefOptions& options);

}  // namespace relievo
