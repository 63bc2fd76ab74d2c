// Makes a solid with a relief from a scan, in one call. Each step of that call is also a function: sample the
// points that a view shows (sample_for_view), find their surface and factor its system (prepare), and make
// the solid (make_relief).
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

// Facts about the points of a scan and its visible points.
struct ScanReport {
  std::size_t input_points = 0, repeated_points = 0, visible_points = 0, removed_points = 0,
              crumbs = 0;                        // see Surface
  double measured_noise = 0, removed_noise = 0;  // standard deviations in rho, see Surface
  double rho = 0;                                // sampling distance, in the cloud's units
  double diagonal = 0;  // L_d: diagonal of the cloud's bounding box, in the cloud's units

  // The table or background in the scan.
  struct FoundPlane {
    PlaneKind kind = PlaneKind::background;
    double share = 0;          // share of the visible points that belong to the plane
    bool is_left_out = false;  // whether the view leaves the plane out
  };
  std::optional<FoundPlane> plane;

  bool lacks_plane = false;            // whether a plane was to be left out, but none was found
  bool has_estimated_normals = false;  // whether normals were estimated because the points had none
  bool has_turned_normals = false;     // whether the points' normals pointed inwards and were reversed

  // Returns the facts about the points of a surface.
  static ScanReport of(const Surface& surface);
};

// Facts about a relief, and the options that were used.
struct ReliefReport : ScanReport {
  Form form = Form::relief;
  Method method = Method::paper;  // alpha, beta, gamma and u have no meaning for baselines
  // NaN if beta is 0 or there is a tone curve, because then u determines the height, and alpha has no effect.
  double alpha = 0;
  double beta = 0, gamma = 0;
  double u = 0;      // alpha^-beta, see Compression
  double steps = 0;  // share of the height taken by steps at depth jumps, see Shape
  std::optional<double> height_requested_mm;
  std::optional<double> height_usual_mm;  // default height if none was requested, see effective_height_mm()
  double height_mm = 0;        // height of the front above its base, from the lowest to the highest point
  double below_ground_mm = 0;  // the part of height_mm below the flat ground; for a die, all of height_mm
  double steepest_deg = 0;     // steepest slope of the front's triangles, with corners in single precision

  // Maps a point p of the cloud to coordinates of the solid in mm: scale * rotation * p + offset. The
  // resulting x and y are those of the point in the solid. The resulting z is a depth of the uncompressed
  // model, not a height of the relief. The model's lowest visible point is mapped to the ground or, with a
  // curved base, to the ground in the plate's middle. For a mirrored form `rotation` includes the reflection.
  Mat3 rotation = Mat3::Identity();
  double scale = 1;
  Vec3 offset = Vec3::Zero();

  std::optional<Tool> tool;        // the tool in the options
  std::optional<ToolReach> reach;  // the part of the front that the tool reaches
  OrnamentFacts ornaments;
  std::optional<double> rim_height_mm;  // above the ground; empty without a rim

  // The largest height difference between the simplified front and the front before simplification. It is set
  // if a tolerance or a number of triangles was requested.
  std::optional<double> simplification_error_mm;
  // Numbers of triangles: of the final front, and of the front before simplification.
  std::size_t front_triangles = 0, full_triangles = 0;

  // The dimensions of a wrap: the diameter of the ground, the angle that the plate covers, and the length of
  // one degree on the ground, which bending does not change.
  struct Wrapped {
    double diameter_mm = 0, turn_deg = 0, mm_per_degree = 0;
    bool is_inside = false;       // whether the relief is on the inner side
    Vec2 across = Vec2::UnitX();  // the direction in which the plate is bent
  };
  std::optional<Wrapped> wrap;  // if set, `offset` and `scale` are for the plate before bending

  // Facts that programs may warn about.
  std::vector<IdleOption> idle_options;  // given options that have no effect
  bool has_needed_steps = false;         // whether the height needed more steps at depth jumps than requested
  std::vector<SampleNote> sample;        // notes on the sampling; empty if the caller prepared the model
};

struct MadeRelief {
  Solid solid;
  ReliefReport report;
  Solid flat = {};  // the solid before bending, for height maps; empty without a wrap
};

// Returns the surface of the points in that view, with its factored system. Errors: those of find_surface()
// and ReliefModel::prepare().
Result<ReliefModel> prepare(const Cloud& points, const View& view, const ModelOptions& options = {},
                            Progress* progress = nullptr);

// Returns the plate with the relief of a prepared model. Ignores the options view, mode, control points and
// points, because the model already has them. Reports stages and their times to `progress`; the caller must
// end the last stage with Progress::finish(). Errors: those of check(), of ReliefModel::make_at_height() and
// of the functions for the plate; kind cancelled.
Result<MadeRelief> make_relief(const ReliefModel& model, const ReliefOptions& options,
                               Progress* progress = nullptr);

// Returns the height in mm of the highest relief with the options' shape. If the options have a draft angle,
// the walls of this relief satisfy it. The method must have a shape, see has_shape(). Errors: those of
// make_relief().
Result<double> highest_with_draft(const ReliefModel& model, const ReliefOptions& options,
                                  Progress* progress = nullptr);

// Returns an error of kind option if the model cannot make the relief of the options. The reasons are:
// - The model was not prepared for the options' method, see ReliefModel::serves().
// - The options lower dark lines, but the model has no colours.
// - The options have a light or attention, but the model has only control points.
// - A stroke uses Brush::protect, but a model of the scene has its own height, see Pose::height.
Result<void> check_model(const ReliefModel& model, const ReliefOptions& options);

// Returns an error of kind option if, for a relief of height `height_mm`, the bevel of the options' rim is
// closer to the vertical than the options' draft angle allows. make_relief() includes this check.
Result<void> check_rim(const ReliefOptions& options, double height_mm);

// Samples the points of a file for the view, prepares their model, and makes its relief. scene.h has the same
// function for several files. Errors: those of sample_for_view(), of prepare(), and of make_relief() for a
// model.
Result<MadeRelief> make_relief(CloudFile file, const ReliefOptions& options, Progress* progress = nullptr);

// Does for a cloud in memory what the function above does for a file.
Result<MadeRelief> make_relief(Cloud cloud, const ReliefOptions& options, Progress* progress = nullptr);

// Returns the shape for the options. If the relief must have a requested or default height, the search for
// that height starts with this shape. `mm_per_unit` converts the depth of dark lines from mm.
Shape shape_of(const ReliefOptions& options, double mm_per_unit = 1);

// Returns the options with width_mm set. A given width stays. If only the size of the plate is given, the
// width is the largest with which relief, margin and rim fit into the plate. If neither is given, the width
// is the default. A height that is a share of the diagonal is converted to mm. make_relief() includes this
// step. Errors: kind option if the plate is too small.
Result<ReliefOptions> with_width(const Surface& surface, const ReliefOptions& options);

// Returns the number of millimetres per unit of the surface, for the width from with_width().
double mm_per_unit(const Surface& surface, const ReliefOptions& options);

}  // namespace relievo
