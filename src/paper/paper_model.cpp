#include "paper/paper_model.h"

#include <limits>

#include "core/height_span.h"
#include "core/lists.h"
#include "core/memory.h"
#include "paper/control_points.h"
#include "relievo/core/parallel.h"

namespace relievo {
namespace {

// Returns the heights without compression: w_k = 1.
std::vector<float> uncompressed_heights(const PaperModel& model) {
  PaperModel::SolveWorkspace workspace = model.make_solve_workspace();
  std::vector<float> heights(model.control_points());
  model.solve({.u = std::numeric_limits<double>::infinity()}, workspace, heights);
  return heights;
}

}  // namespace

Result<PaperModel> PaperModel::prepare(const Surface& surface, std::size_t control_points,
                                       Progress* progress) {
  RELIEVO_CHECK(begin_stage(progress, "factorisation", .75));
  const std::vector<Vec2> visible = in_plane(surface.points);
  const std::span<const std::uint8_t> is_boundary = surface.boundary.is_boundary;
  const std::vector<Index> chosen = paper::control_points(visible, is_boundary, surface.rho, control_points);
  const std::vector<Vec2> points = pick(visible, chosen);
  RELIEVO_TRY(auto system, paper::NormalEquations::build(points, pick(is_boundary, chosen)));

  PaperModel model(std::move(system));
  model.k_ = surface.curvature.k;
  model.delta_ = surface.curvature.delta;
  model.rho_ = surface.rho;
  for (Index i = 0; i < visible.size(); ++i)
    if (is_boundary[i]) model.boundary_.push_back(i);
  for (const Index i : chosen)
    model.control_.push_back({surface.normals[i], surface.curvature.k[i], surface.boundary.distance[i]});
  RELIEVO_CHECK(check_cancelled(progress));
  if (chosen.size() == visible.size()) return model;
  RELIEVO_TRY(const PaperModel all, prepare(surface, visible.size(), progress));
  model.mapping_.emplace(
      points, visible,
      paper::HeightMapping::Uncompressed{uncompressed_heights(model), uncompressed_heights(all)});
  return model;
}

std::size_t PaperModel::memory() const {
  return system_.memory() + bytes(control_) + bytes(k_) + bytes(boundary_) +
         (mapping_ ? mapping_->memory() : 0);
}

PaperModel::SolveWorkspace PaperModel::make_solve_workspace() const {
  return {system_.make_workspace(), std::vector<Vec2f>(control_points())};
}

PaperModel::MapWorkspace PaperModel::make_map_workspace() const {
  return mapping_ ? mapping_->make_workspace() : MapWorkspace();
}

void PaperModel::solve(const paper::Coefficients& c, SolveWorkspace& workspace,
                       std::span<float> control_heights) const {
  const double width = c.boundary_width * rho_;
  const auto expected_normal = [&](const ControlPoint& p) {
    const double w_k = paper::curvature_weight(static_cast<double>(p.k), delta_, c),
                 w_b = paper::boundary_weight(static_cast<double>(p.distance), width);
    return paper::expected_normal(p.normal.cast<double>(), w_k * w_b);
  };
  parallel_for(
      control_.size(),
      [&](std::size_t i) {
        workspace.slopes[i] = paper::slope_of(expected_normal(control_[i]), c.max_slope).cast<float>();
      },
      512);
  system_.solve(workspace.slopes, control_heights, workspace.system);
}

void PaperModel::map(std::span<const float> control_heights, double gamma, MapWorkspace& workspace,
                     std::span<float> heights) const {
  if (mapping_)
    mapping_->carry(control_heights, workspace, heights);
  else
    std::ranges::copy(control_heights, heights.begin());
  // Adds detail, by the second equation (9).
  const float amount = static_cast<float>(gamma) * span_of(std::span<const float>(heights)).size();
  parallel_for(heights.size(), [&](std::size_t i) { heights[i] += amount * k_[i]; });
  for (const Index i : boundary_) heights[i] = 0;
}

}  // namespace relievo
