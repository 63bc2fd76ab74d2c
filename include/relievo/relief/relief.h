// The relief of a surface: prepared once, shaped many times. Stages 7 to 12 and 14.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "relievo/core/progress.h"
#include "relievo/relief/method.h"
#include "relievo/relief/shape.h"

namespace relievo {

class HeightCorrection;
class HeightSystem;
class JumpLift;
class SubspaceModel;
struct PointLayers;
struct StepHeights;
struct Surface;

struct Relief {
  std::vector<double> heights;  // heights of the surface's points above the base, in the surface's units
  double height = 0;            // h: highest minus lowest of the heights and 0, detail included
  Shape shape;                  // the shape that it was made with
};

// Above this number of visible points Mode::automatic means subspace: exact frames would take more than 40 ms
// on two cores.
inline constexpr std::size_t most_exact_points = 1'500'000;

// Resolves `automatic` by the number of points; returns any other mode unchanged.
Mode resolve_mode(Mode mode, const Surface& surface);

// A surface with its factored system, and with the height correction that compresses layered reliefs.
// Movable. Const calls may run concurrently.
class ReliefModel {
 public:
  // Takes the surface, splits its normals into layers, factors its system and tunes the height correction; in
  // subspace mode it also builds the system of the control points. Errors: see HeightSystem::build(); kind
  // cancelled.
  static Result<ReliefModel> prepare(Surface surface, Progress* progress = nullptr, Mode mode = Mode::exact);

  // Does the same for exact reliefs, without tuning: the height correction has the parameters of `other`, a
  // model of the same scan in another view, or the defaults if `other` is null. It is for reliefs that are
  // shown only briefly.
  static Result<ReliefModel> prepare_like(const ReliefModel* other, Surface surface,
                                          Progress* progress = nullptr);

  ReliefModel(ReliefModel&&) noexcept;
  ReliefModel& operator=(ReliefModel&&) noexcept;
  ~ReliefModel();

  const Surface& surface() const;

  // Returns the layers of the surface's normals; empty in subspace mode, whose control points have their own.
  std::span<const PointLayers> layers() const;

  // Returns the system of all points, or of the control points; the other is null.
  const HeightSystem* system() const;
  const SubspaceModel* subspace() const;

  // Returns the heights that Shape::steps adds at depth jumps.
  const StepHeights& steps() const;

  // Returns the fields that keep the front sides of depth jumps in front in layered reliefs.
  const JumpLift& jump_lift() const;

  // Returns the correction that compresses layered heights.
  const HeightCorrection& correction() const;

  // Returns the parameters of the height correction at u in [0, infinity], for shapes that set none. They are
  // tuned to this surface: the strongest compression that keeps detail and depth order at least as good as
  // gradient-domain compression does, where that is possible.
  MembraneParams membrane_at(double u) const;

  // Returns the shape, with the parameters of membrane_at() for its u if it is layered and sets none.
  Shape with_membrane(Shape shape) const;

  // Returns the memory used, in bytes.
  std::size_t memory() const;

  // Returns the relief of that shape.
  Relief make(const Shape& shape) const;

  // Returns the relief whose height is `height`, detail included, by changing the compression's u at the
  // beta, gamma and slope asked for (the intent of Algorithm 1, section 3.6). If no u gives that height, u is
  // infinite and depth jumps supply the missing height, at most their depth: Shape::steps of the result.
  // Errors: kind geometry if that does not suffice; the message states the largest height that is reached, in
  // units of `unit_mm` millimetres. Kind cancelled.
  Result<Relief> make_at_height(double height, Shape shape, double unit_mm,
                                Progress* progress = nullptr) const;

 private:
  struct State;
  class Maker;
  explicit ReliefModel(std::unique_ptr<const State> state);

  std::unique_ptr<const State> state_;
};

}  // namespace relievo
