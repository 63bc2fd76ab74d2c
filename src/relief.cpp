#include "relievo/relief.h"

#include <cmath>
#include <limits>

#include "height_tails.h"
#include "raised.h"
#include "relievo/detail.h"
#include "relievo/parallel.h"
#include "relievo/text.h"
#include "root.h"

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

ReliefModel::ReliefModel(Surface surface, Solver solver)
    : surface_(std::move(surface)),
      solver_(std::move(solver)),
      raised_layers_(std::make_shared<Once<RaisedLayers>>()) {}

Result<ReliefModel> ReliefModel::prepare(Surface surface, Progress* progress, Mode mode) {
  if (settle(mode, surface) == Mode::subspace) {
    Result<SubspaceModel> subspace = SubspaceModel::prepare(surface, {}, {}, progress);
    if (!subspace) return std::unexpected(subspace.error());
    return ReliefModel(std::move(surface), std::move(*subspace));
  }
  if (auto go = begin_stage(progress, "factorisation", .75); !go) return std::unexpected(go.error());
  Result<HeightSystem> system =
      HeightSystem::build(in_plane(surface.points), surface.triangulation, surface.boundary);
  if (!system) return std::unexpected(system.error());
  return ReliefModel(std::move(surface), std::move(*system));
}

const RaisedLayers& ReliefModel::raised_layers() const {
  return raised_layers_->get([&] { return relievo::raised_layers(surface_); });
}

std::size_t ReliefModel::memory() const {
  const std::size_t solver = std::visit([](const auto& s) { return s.memory(); }, solver_);
  const RaisedLayers* raised = raised_layers_->find();
  return solver + surface_.memory() + (raised ? raised->memory() : 0);
}

namespace {

// Heights in subspace mode, where `solve` finds those of the control points.
template <typename Solve>
std::vector<double> carried_heights(const SubspaceModel& model, std::span<const float> boundary_weight,
                                    Solve&& solve) {
  SubspaceModel::Workspace workspace = model.make_workspace();
  std::vector<float> heights(model.size());
  solve(workspace);
  model.carry(boundary_weight, workspace, heights);
  return {heights.begin(), heights.end()};
}

// What the layers' own heights leave, by the ordinary system.
std::vector<double> raised_rest(const ReliefModel& model, const Shape& shape, const RaisedWeights& weights,
                                std::span<const float> boundary_weight) {
  const Surface& surface = model.surface();
  const std::vector<float>& fade = model.raised_layers().fade;
  if (const SubspaceModel* subspace = model.subspace())
    return carried_heights(*subspace, boundary_weight, [&](SubspaceModel::Workspace& workspace) {
      subspace->solve_raised(shape, weights, fade, workspace);
    });
  const SaturationShare share(surface.curvature.delta, shape.compression);
  std::vector<Vec2> slopes(surface.points.size());
  parallel_for(slopes.size(), [&](std::size_t i) {
    slopes[i] = weights.rest(surface.layers[i], share(surface.curvature.k[i]), static_cast<double>(fade[i]),
                             shape.max_slope);
  });
  std::vector<double> heights(slopes.size());
  model.system()->solve(slopes, heights);
  return heights;
}

std::vector<double> raised_heights(const ReliefModel& model, const Shape& shape,
                                   std::span<const float> boundary_weight) {
  const Surface& surface = model.surface();
  const SaturationShare share(surface.curvature.delta, shape.compression);
  const RaisedWeights weights =
      RaisedWeights::of(shape, mean_share(shape.compression, surface.curvature.k, share));
  std::vector<double> heights = raised_rest(model, shape, weights, boundary_weight);
  const std::vector<LayerHeights>& layers = model.raised_layers().heights;
  parallel_for(heights.size(),
               [&](std::size_t i) { heights[i] += static_cast<double>(weights.height(layers[i])); });
  const Bevel<double> bevel(heights, surface.boundary, boundary_weight);
  parallel_for(heights.size(), [&](std::size_t i) { heights[i] = bevel(i, heights[i]); });
  return heights;
}

void round_tails(std::vector<double>& heights) {
  const HeightTails<double> tails(heights);
  parallel_for(heights.size(), [&](std::size_t i) { heights[i] = tails(heights[i]); });
}

}  // namespace

std::vector<double> ReliefModel::heights(const Shape& shape, std::span<const float> boundary_weight) const {
  if (const SubspaceModel* model = subspace())
    return carried_heights(*model, boundary_weight, [&](SubspaceModel::Workspace& workspace) {
      model->solve(shape, boundary_weight, workspace);
    });
  std::vector<Vec2> slopes(surface_.points.size());
  const SlopeInput input{surface_.normals, surface_.curvature.k, boundary_weight, surface_.curvature.delta,
                         surface_.layers};
  if (shape.style == Style::layered)
    layered_slopes(input, shape, slopes);
  else
    compressed_slopes(input, shape.compression, shape.max_slope, slopes);
  std::vector<double> heights(slopes.size());
  system()->solve(slopes, heights);
  return heights;
}

Relief ReliefModel::make(const Shape& shape) const {
  const std::vector<float> boundary_weight =
      boundary_weights(surface_.boundary.distance, surface_.rho * shape.boundary_width / 2);  // (7) has 2 rho
  const bool is_raised = shape.style == Style::raised;
  Relief relief{is_raised ? raised_heights(*this, shape, boundary_weight) : heights(shape, boundary_weight),
                0, shape};
  if (shape.style == Style::layered) round_tails(relief.heights);
  if (shape.style == Style::paper)
    add_detail(relief.heights, {surface_.curvature.k, boundary_weight, shape.gamma});
  relief.height = height_span(relief.heights);
  return relief;
}

Result<Relief> ReliefModel::make_at_height(double height, Shape shape, double unit_mm,
                                           Progress* progress) const {
  shape.compression.u = std::numeric_limits<double>::infinity();
  Relief relief = make(shape);
  const auto excess = [&] { return std::log(std::max(relief.height, 1e-300) / height); };
  constexpr double tolerance = 1e-5;
  bool is_cancelled = false;
  const auto excess_at = [&](double log_u) {
    shape.compression.u = std::exp(log_u);
    relief = make(shape);
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
  // What the search leaves, a part in 10^5 at most, is scaled away.
  for (double& z : relief.heights) z *= height / relief.height;
  relief.height = height;
  return relief;
}

}  // namespace relievo
