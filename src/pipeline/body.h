// Makes the front and the body of a relief, as its options ask.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "relievo/core/progress.h"
#include "relievo/job.h"
#include "relievo/options.h"
#include "relievo/plate/simplify.h"
#include "relievo/plate/solid.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Returns whether the form swaps left and right.
bool is_mirrored(Form form);

// Returns whether the options ask for a curved base or a wrap.
inline bool is_curved(const ReliefOptions& options) {
  return options.base.kind != BaseKind::plane || options.wrap.kind != WrapKind::none;
}

// Returns whether the options ask for a simplified solid.
inline bool is_simplified(const ReliefOptions& options) {
  return options.tolerance_mm || options.triangles;
}

// Returns the width and height of the plate in millimetres; 0 if they are computed from the size of the
// relief.
Vec2 plate_size_of(const ReliefOptions& options);

// Returns the plate options for a relief with that height. The options must have passed check(). If the
// options ask for simplification, `options.triangles` limits the triangles of the front, not those of the
// solid.
PlateOptions plate_of(const ReliefOptions& options, double relief_mm);

// Returns the limits for simplifying the front. The tolerance is reduced by the shares that later steps need,
// such as bending the front to a curved base. The options must ask for simplification.
SimplifyOptions simplest_front(const ReliefOptions& options);

// Returns whether make_plate() simplifies the solid, because simplified_front() cannot. Returns true for
// curved ground, whose triangles are not triangles of the front, and for the finish `reachable`. Always
// returns false for the outline `none`, or if the options do not ask for simplification.
bool is_simplified_as_plate(const ReliefOptions& options);

// Returns the options with a height in mm. A height that is given as a share of the diagonal is converted.
// The options must have a width.
ReliefOptions with_height(const Surface& surface, ReliefOptions options);

// A solid, and the same solid before it was bent around a wrap.
struct Body {
  Solid solid;
  Solid flat = {};  // empty if there is no wrap
  std::optional<Wrap> wrap = {};

  const Solid& plate() const { return wrap ? flat : solid; }
};

// Returns the body that has this front. `relief_mm` is the height of the relief. Errors: kind option if the
// rim's bevel is too close to the vertical for the draft angle; those of make_plate(),
// enforce_draft_in_float() and wrap_plate().
Result<Body> make_body(const HeightFieldMesh& front, double relief_mm, const ReliefOptions& options);

struct FormedFront {
  HeightFieldMesh front;
  double height_mm = 0;                // distance from the lowest to the highest point
  double simplification_error_mm = 0;  // largest height difference from the front before simplification
  std::size_t full_triangles = 0;      // number of triangles of the front before simplification
};

// Returns the height in millimetres of the base under each point of a front, whose form must be Form::relief.
// Returns no heights if the base is a plane. Errors: those of plate_base().
Result<std::vector<double>> base_heights_mm(const HeightFieldMesh& front, const ReliefOptions& options);

// Returns the surface's triangles as a front in millimetres, with the given heights of its points.
HeightFieldMesh front_in_mm(const Surface& surface, const std::vector<double>& heights, double mm_per_unit);

// Returns the front before simplification, in the form `options.form`. Errors: kind cancelled.
Result<FormedFront> full_front(const Surface& surface, const Relief& relief, const ReliefOptions& options,
                               const Progress* progress);

// Returns the front, simplified as the options ask, unless make_plate() will simplify it. For the outline
// `none` the result has only the relief. Errors: those of simplify().
Result<FormedFront> simplified_front(FormedFront full, const ReliefOptions& options, Progress* progress);

// Returns how far the front's lowest point is below the ground, >= 0.
double depth_below_ground(const HeightFieldMesh& front);

// A front, simplified if the options ask for it, and the body that has this front. If the options limit the
// number of triangles, the body's solid has at most that many.
struct FormedBody {
  FormedFront formed;
  Body body;
};

// Simplifies the front as the options ask, and returns the body that has it. Errors: those of
// simplified_front() and make_body(); kind option if the outline and the walls of the solid alone need more
// triangles than the limit.
Result<FormedBody> make_formed_body(FormedFront full, const ReliefOptions& options, Progress* progress);

// Returns, per point, whether it is on an edge of a tile, where the relief does not go down to the ground. A
// point is on such an edge if it is on a straight side of the surface's hull, and not at a hole.
std::vector<std::uint8_t> tile_edges(const Surface& surface);

// Returns the relief whose heights are `options.mm_per_value` times the surface's values above the ground.
// Lower values get the height of the ground. Points on the edges of a tile keep their heights. Errors: kind
// option if the surface's depths are not proportional to the values of its file, or if the relief would be
// higher than 1e5 mm; kind geometry if nothing is above the ground.
Result<Relief> relief_of_values(const Surface& surface, const ReliefOptions& options, double mm_per_unit);

// Adds nearly vertical walls under the edges of a tile, because the hull of a front must be on the ground.
// Each point on an edge gets a copy with the point's height, about a hundredth of a millimetre further
// inside. The walls are appended to the front's triangles.
void raise_walls(HeightFieldMesh& front, const Surface& surface);

struct SampledModel {
  ReliefModel model;
  std::vector<SampleNote> notes;  // notes on how the points of the scene were sampled
};

// Returns the model of the scene in its view. Errors: those of prepare() in job.h.
Result<SampledModel> prepare_sampled(Job job, Progress* progress);

// Prepares a model as prepare() in make_relief.h does, but frees the points early, unless they have other
// owners.
Result<ReliefModel> prepare_owned(std::shared_ptr<const Cloud> points, const View& view,
                                  const ModelOptions& options, Progress* progress);

}  // namespace relievo
