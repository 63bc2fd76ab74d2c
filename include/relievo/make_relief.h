// One call from a cloud to a body that can be cut: the whole pipeline.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relievo/core/progress.h"
#include "relievo/io.h"
#include "relievo/options.h"
#include "relievo/plate/solid.h"
#include "relievo/plate/tool.h"
#include "relievo/relief.h"
#include "relievo/scan/cloud.h"

namespace relievo {

// What was made, and how.
struct ReliefReport {
  std::size_t input_points = 0, visible_points = 0;
  double rho = 0;       // sampling distance, in the cloud's units
  double diagonal = 0;  // L_d: diagonal of the cloud's box, in its units
  std::string method;   // its name, see method.h; alpha, beta, gamma and u mean nothing for the rivals
  double alpha = 0;     // NaN where beta is 0 or a tone curve rules: alpha has no effect there, u has
  double beta = 0, gamma = 0;
  double u = 0;  // alpha^-beta, see Compression
  std::optional<double> height_requested_mm;
  double height_mm = 0;  // reached, lowest to highest point of the front, above its base
  double below_ground_mm =
      0;                    // of it, how deep the lowest point lies below the flat ground, which may be all
  double steepest_deg = 0;  // of the front's triangles, as files hold them

  // Millimetres of the solid = scale * rotation * p + offset, for a point p of the cloud: exact in x and y;
  // in z the model keeps its depth and its lowest visible point lies on the ground, of a curved base on that
  // in the middle of the plate. The rotation of a mirrored form holds the mirror, too.
  Mat3 rotation = Mat3::Identity();
  double scale = 1;
  Vec3 offset = Vec3::Zero();

  // What the tool asked for reaches of the front; there are no samples without one.
  std::optional<ToolReach> reach;

  // Largest difference to the front before it was made simpler, if a tolerance was given.
  std::optional<double> simplification_error_mm;

  // Of a wrap: the ground's diameter, how far the plate goes around, and how wide a degree is on the ground
  // and so in the flat plate.
  struct Wrapped {
    double diameter_mm = 0, turn_deg = 0, mm_per_degree = 0;
  };
  std::optional<Wrapped> wrap;  // offset and scale are then those of the flat plate

  std::vector<std::string> remarks;  // what the user should know: normals estimated, or turned
};

struct MadeRelief {
  Solid solid;
  ReliefReport report;
  Solid flat = {};  // the solid before it was bent around its wrap, for height maps; empty without one
};

// What a relief is made of.
struct SeenPoints {
  std::shared_ptr<const Cloud> cloud;  // in the model's frame; the file's own where nothing had to be made
  std::size_t left_out = 0;            // points far from all others, see far_points()
  std::vector<std::string> remarks;    // on that and on the mesh
};

// Returns the points of a file: of a mesh those that the viewer sees of it, about as many as wanted; without
// those far from all others. The file must outlive them. Errors: those of sample_mesh().
Result<SeenPoints> seen_points(const CloudFile& file, const View& view, double points,
                               Progress* progress = nullptr);

// Returns the plate with the relief of the cloud. Stages and their times are in `progress`; the caller ends
// the last one. Errors: those of check(), parse_view(), find_surface() and ReliefModel::make_at_height();
// kind cancelled.
Result<MadeRelief> make_relief(const Cloud& cloud, const ReliefOptions& options,
                               Progress* progress = nullptr);

// The same for what a file holds: of a mesh the points that the viewer sees of it, see sample_mesh().
Result<MadeRelief> make_relief(const CloudFile& file, const ReliefOptions& options,
                               Progress* progress = nullptr);

// The same for points that were seen in that view; options.view and options.up are not looked at.
Result<MadeRelief> make_relief(const SeenPoints& seen, const View& view, const ReliefOptions& options,
                               Progress* progress = nullptr);

// The same, bit for bit, in a fraction of the time: from a model that was prepared from the
// seen_points() in the view asked for. options.view and options.up are not looked at.
Result<MadeRelief> make_relief(const ReliefModel& model, const ReliefOptions& options,
                               Progress* progress = nullptr);

// The shape that the options ask for; where they give a height, at its starting point. Errors: kind option
// for a tone curve that is none.
Result<Shape> shape_of(const ReliefOptions& options);

// Millimetres per unit of the surface at the width asked for.
double mm_per_unit(const Surface& surface, const ReliefOptions& options);

}  // namespace relievo
