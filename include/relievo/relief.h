// The relief of a surface: prepared once, shaped many times. Stages 7 to 12 and 14.
#pragma once

#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "relievo/relief/heights.h"
#include "relievo/relief/subspace.h"
#include "relievo/scan/surface.h"
#include "relievo/weights.h"

namespace relievo {

class Grip;
class Membrane;

struct Relief {
  std::vector<double> heights;  // per point of the surface, above the base, in its units
  double height = 0;            // h: highest minus lowest, base and detail included
  Shape shape;                  // what it was made with
};

// How heights are found.
enum class Mode {
  exact,     // from all visible points
  subspace,  // from a few thousand control points: see SubspaceModel
  automatic  // exact, unless there are more visible points than `most_exact_points`
};

// Their frames take about 40 ms on two cores.
inline constexpr std::size_t most_exact_points = 1'500'000;

// Returns the mode of that name: exact, subspace or auto. Errors: kind option, naming --mode.
Result<Mode> parse_mode(std::string_view name);

// Returns exact or subspace: what `automatic` comes to for that surface, other modes as they are.
Mode settle(Mode mode, const Surface& surface);

// A surface with its factored system, and with what holds layered reliefs within their height. Const calls
// may run concurrently.
class ReliefModel {
 public:
  // Takes the surface, factors its system, finds how tightly layered reliefs are held, and in subspace mode
  // goes on to that of the control points. Errors: see
  // HeightSystem::build(); kind cancelled.
  static Result<ReliefModel> prepare(Surface surface, Progress* progress = nullptr, Mode mode = Mode::exact);

  const Surface& surface() const { return surface_; }

  // The system of all points, or of the control points; the other is null.
  const HeightSystem* system() const { return std::get_if<HeightSystem>(&solver_); }
  const SubspaceModel* subspace() const { return std::get_if<SubspaceModel>(&solver_); }

  // What holds layered reliefs within their height.
  const Membrane& membrane() const { return *membrane_; }

  // Returns how tightly layered reliefs are held at u in [0, infinity], unless their shape says it: as
  // tightly as they may be without losing more of the model's detail and of the order of its depths than
  // gradient-domain compression, where that can be.
  Hold hold_at(double u) const;

  // Bytes held.
  std::size_t memory() const;

  // Returns the relief of that shape.
  Relief make(const Shape& shape) const;

  // Returns the relief whose height is `height`, detail included, by changing the
  // compression's u at the beta, gamma and slope asked for (the intent of Algorithm 1, section 3.6). Errors:
  // kind geometry if no u gives that height, telling the largest that is reached, in units of `unit_mm`
  // millimetres; kind cancelled.
  Result<Relief> make_at_height(double height, Shape shape, double unit_mm,
                                Progress* progress = nullptr) const;

 private:
  using Solver = std::variant<HeightSystem, SubspaceModel>;

  ReliefModel(Surface surface, Solver solver, std::shared_ptr<const Membrane> membrane, const Grip& grip);
  std::vector<double> heights(const Shape& shape, std::span<const float> boundary_weight) const;
  Relief raise(Shape shape, std::span<const float> boundary_weight) const;
  void hold(Relief& relief, std::span<const float> boundary_weight) const;
  std::vector<float> boundary_weight(const Shape& shape) const;

  Surface surface_;
  Solver solver_;
  std::shared_ptr<const Membrane> membrane_;
  std::shared_ptr<const Grip> grip_;
};

}  // namespace relievo
