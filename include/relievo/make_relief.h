// Makes a body that can be cut from a scan, in one call. Its steps can be called separately: sample the
// points that show a view (sample_for_view), find their surface and factor its system (prepare), and make its
// relief as a body (make_relief).
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
    bool is_left_out = false;  // because the view asked for it
  };
  std::optional<FoundPlane> plane;

  bool lacks_plane = false;            // a plane was to be left out, but none was found
  bool has_estimated_normals = false;  // the points had none, so they were estimated
  bool has_turned_normals = false;     // they pointed inwards and were reversed

  // Returns the facts about the points of a surface.
  static ScanReport of(const Surface& surface);
};

// Facts about the relief that was made and the options it was made with.
struct ReliefReport : ScanReport {
  Form form = Form::relief;
  Method method = Method::paper;  // alpha, beta, gamma and u have no meaning for a method without shape
  double alpha = 0;  // NaN if beta is 0 or there is a tone curve: then u has an effect, alpha has none
  double beta = 0, gamma = 0;
  double u = 0;      // alpha^-beta, see Compression
  double steps = 0;  // share of the height that depth jumps take, see Shape
  std::optional<double> height_requested_mm;
  std::optional<double> height_usual_mm;  // the default, if none was requested, see effective_height_mm()
  double height_mm = 0;        // height reached, lowest to highest point of the front, above its base
  double below_ground_mm = 0;  // the part of height_mm that lies below the flat ground, in a die all of it
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
  std::optional<Wrapped> wrap;  // offset and scale are then those of the flat plate

  // Facts that a user may want to be warned of.
  bool has_idle_alpha = false;     // an alpha was given, which has no effect
  bool has_needed_steps = false;   // depth jumps take more than asked for, as slopes do not reach the height
  std::vector<SampleNote> sample;  // none for a model that the caller prepared
};

struct MadeRelief {
  Solid solid;
  ReliefReport report;
  Solid flat = {};  // the solid before it was bent around its wrap, for height maps; empty without one
};

// Returns the surface that the points show in that view, with its factored system. Errors: those of
// find_surface() and ReliefModel::prepare().
Result<ReliefModel> prepare(const Cloud& points, const View& view, Mode mode = Mode::exact,
                            Progress* progress = nullptr);

// Returns the plate with the relief of a prepared model; options.view, mode and points are ignored. Stages
// and their times are reported to `progress`; the caller ends the last stage by Progress::finish(). Errors:
// those of check(), of ReliefModel::make_at_height() and of the plate's parts; kind cancelled.
Result<MadeRelief> make_relief(const ReliefModel& model, const ReliefOptions& options,
                               Progress* progress = nullptr);

// Returns the height in mm of the highest relief whose walls keep the draft angle of the options, or of the
// highest relief of all if the options give no draft angle. The method must be one with a shape, see
// has_shape(). Errors: those of make_relief().
Result<double> highest_with_draft(const ReliefModel& model, const ReliefOptions& options,
                                  Progress* progress = nullptr);

// Checks that the bevel of the options' rim leans as their draft angle asks, around a relief of that height.
// make_relief() does this itself. Errors: kind option.
Result<void> check_rim(const ReliefOptions& options, double height_mm);

// Samples the points of a file for the view, prepares them, and makes the relief of that model. scene.h has
// such a function for several files. Errors: also those of sample_for_view() and prepare().
Result<MadeRelief> make_relief(CloudFile file, const ReliefOptions& options, Progress* progress = nullptr);

// Does the same for a cloud.
Result<MadeRelief> make_relief(Cloud cloud, const ReliefOptions& options, Progress* progress = nullptr);

// Returns the shape that the options ask for. A search for their height starts from it.
Shape shape_of(const ReliefOptions& options);

// Returns the options with a width: the one given; else the largest that fits, with margin and rim, into a
// plate of the given size; else the default. make_relief() does this itself. Errors: kind option if the plate
// is too small.
Result<ReliefOptions> with_width(const Surface& surface, const ReliefOptions& options);

// Returns millimetres per unit of the surface at the width of the options, see with_width().
double mm_per_unit(const Surface& surface, const ReliefOptions& options);

}  // namespace relievo
