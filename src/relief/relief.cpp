#include "relievo/relief.h"

#include <cmath>
#include <limits>

#include "core/root_finding.h"
#include "grip.h"
#include "jumps.h"
#include "membrane.h"
#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/detail.h"
#include "slope_input.h"

namespace relievo {

Result<Mode> parse_mode(std::string_view name) {
  if (name == "exact") return Mode::exact;
  if (name == "subspace") return Mode::subspace;
  if (name == "auto") return Mode::automatic;
  return std::unexpected(
      Error{ErrorKind::option, "--mode", {}, cat("expected exact, subspace or auto, found \"", name, "\"")});
}

Mode settle(Mode mode, const Surface& surface) {
  if (mode != Mode::automatic) return mode;
  return surface.points.size() > most_exact_points ? Mode::subspace : Mode::exact;
}

ReliefModel::ReliefModel(Surface surface, Solver solver, std::shared_ptr<const Membrane> membrane,
                         const Grip& grip)
    : surface_(std::move(surface)),
      solver_(std::move(solver)),
      membrane_(std::move(membrane)),
      grip_(std::make_shared<const Grip>(grip)) {}

Hold ReliefModel::hold_at(double u) const {
  return grip_->at(u);
}

Result<ReliefModel> ReliefModel::prepare(Surface surface, Progress* progress, Mode mode) {
  if (auto go = begin_stage(progress, "factorisation", .75); !go) return std::unexpected(go.error());
  const std::vector<float> weights = jump_weights(surface);
  Result<HeightSystem> system =
      HeightSystem::build(in_plane(surface.points), surface.triangulation, surface.boundary, weights);
  if (!system) return std::unexpected(system.error());
  if (auto go = begin_stage(progress, "hold", .8); !go) return std::unexpected(go.error());
  auto membrane = std::make_shared<const Membrane>(surface, weights);
  const Result<Grip> grip = Grip::find(surface, *membrane, *system, progress);
  if (!grip) return std::unexpected(grip.error());
  if (settle(mode, surface) == Mode::exact)
    return ReliefModel(std::move(surface), std::move(*system), std::move(membrane), *grip);
  if (auto go = begin_stage(progress, "reference heights", .83); !go) return std::unexpected(go.error());
  const SubspaceOptions options;
  const auto reference = [&] {
    const HeightSystem all = std::move(*system);  // most of the memory, needed no more
    return reference_heights(surface, all, options.max_slope);
  }();
  Result<SubspaceModel> subspace = SubspaceModel::prepare(surface, options, reference, progress);
  if (!subspace) return std::unexpected(subspace.error());
  return ReliefModel(std::move(surface), std::move(*subspace), std::move(membrane), *grip);
}

std::size_t ReliefModel::memory() const {
  const std::size_t solver = std::visit([](const auto& s) { return s.memory(); }, solver_);
  return solver + surface_.memory() + membrane_->memory();
}

namespace {

std::vector<double> subspace_heights(const SubspaceModel& model, const Shape& shape,
                                     std::span<const float> boundary_weight) {
  SubspaceModel::Workspace workspace = model.make_workspace();
  std::vector<float> heights(model.size());
  model.solve(shape, boundary_weight, workspace);
  model.carry(boundary_weight, workspace, heights);
  return {heights.begin(), heights.end()};
}

}  // namespace

std::vector<double> ReliefModel::heights(const Shape& shape, std::span<const float> boundary_weight) const {
  if (const SubspaceModel* model = subspace()) return subspace_heights(*model, shape, boundary_weight);
  std::vector<Vec2> slopes(surface_.points.size());
  const SlopeInput input = slope_input(surface_, boundary_weight);
  if (shape.style == Style::layered)
    layered_slopes(input, shape, slopes);
  else
    compressed_slopes(input, shape.compression, shape.max_slope, slopes);
  std::vector<double> heights(slopes.size());
  system()->solve(slopes, heights);
  return heights;
}

// Layered heights are yet to be held within relief.height.
Relief ReliefModel::raise(Shape shape, std::span<const float> boundary_weight) const {
  const bool is_layered = shape.style == Style::layered;
  if (is_layered && !shape.hold) shape.hold = hold_at(shape.compression.u);
  Relief relief{heights(shape, boundary_weight), 0, shape};
  if (!is_layered) add_detail(relief.heights, {surface_.curvature.k, boundary_weight, shape.gamma});
  relief.height = height_span(relief.heights);
  if (is_layered) relief.height *= shape.hold->share;
  return relief;
}

void ReliefModel::hold(Relief& relief, std::span<const float> boundary_weight) const {
  if (relief.shape.style != Style::layered) return;
  Membrane::Workspace workspace = membrane_->make_workspace();
  const Membrane::Limits limits = Membrane::Limits::of(relief.height, *relief.shape.hold);
  membrane_->hold<double>({relief.heights, boundary_weight, limits}, workspace);
  relief.height = height_span(relief.heights);
}

std::vector<float> ReliefModel::boundary_weight(const Shape& shape) const {
  return boundary_weights(surface_.boundary.distance, boundary_rho(surface_, shape.boundary_width));
}

Relief ReliefModel::make(const Shape& shape) const {
  const std::vector<float> weight = boundary_weight(shape);
  Relief relief = raise(shape, weight);
  hold(relief, weight);
  return relief;
}

Result<Relief> ReliefModel::make_at_height(double height, Shape shape, double unit_mm,
                                           Progress* progress) const {
  const std::vector<float> weight = boundary_weight(shape);
  shape.compression.u = std::numeric_limits<double>::infinity();
  Relief relief = raise(shape, weight);
  const auto excess = [&] { return std::log(std::max(relief.height, 1e-300) / height); };
  constexpr double tolerance = 1e-5;
  bool is_cancelled = false;
  const auto excess_at = [&](double log_u) {
    shape.compression.u = std::exp(log_u);
    relief = raise(shape, weight);
    is_cancelled = progress && progress->is_cancelled();
    return is_cancelled ? 0 : excess();
  };
  if (excess() > tolerance) find_root(excess_at, tolerance);
  if (is_cancelled) return std::unexpected(Error{ErrorKind::cancelled, {}, {}, "cancelled"});
  if (!(std::abs(excess()) <= tolerance))
    return std::unexpected(
        Error{ErrorKind::geometry,
              {},
              {},
              cat("expected a height that can be reached, at most ", relief.height * unit_mm,
                  " mm for this view and width, found ", height * unit_mm, " mm")});
  hold(relief, weight);
  // What the search leaves, a part in 10^5 at most, is scaled away.
  for (double& z : relief.heights) z *= height / relief.height;
  relief.height = height;
  return relief;
}

}  // namespace relievo
