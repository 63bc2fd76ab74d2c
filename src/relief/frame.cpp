#include "relievo/relief/frame.h"

#include <chrono>
#include <cmath>
#include <limits>

#include "core/root_finding.h"
#include "frame_slopes.h"
#include "membrane.h"
#include "relief/height_span.h"
#include "relief/vertex_normals.h"
#include "relievo/core/parallel.h"
#include "slope_input.h"

namespace relievo {
namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

using SolverWorkspace = std::variant<HeightSystem::Workspace, SubspaceModel::Workspace>;

SolverWorkspace make_workspace(const ReliefModel& model) {
  if (const HeightSystem* system = model.system()) return system->make_workspace();
  return model.subspace()->make_workspace();
}

}  // namespace

struct FrameMaker::Packed {
  const ReliefModel& model;
  const Surface& surface = model.surface();
  PointLinks normal_links =
      vertex_normal_links(in_plane(surface.points), surface.triangulation, surface.boundary,
                          model.system() ? &model.system()->links() : nullptr);
  SolverWorkspace workspace = make_workspace(model);
  Membrane::Workspace membrane_workspace = model.membrane().make_workspace();
  std::vector<Vec2f> slopes{model.system() ? surface.points.size() : 0};
  std::vector<float> boundary_weight{std::vector<float>(surface.points.size())};
  bool is_hold_given = false;  // by the shape asked for
  double boundary_width = 0;   // that boundary_weight is for
  WeightTable weight;
  std::vector<HeightSpan<float>> spans{(surface.points.size() + default_grain - 1) / default_grain};
  // Where the last locked height was found, and by how much ln h changes with ln u there.
  double last_log_u = 0, elasticity = 1;

  explicit Packed(const ReliefModel& m) : model(m) {}

  std::size_t size() const { return surface.points.size(); }

  void set_boundary_width(double width) {
    if (width == boundary_width) return;
    boundary_width = width;
    const double rho = boundary_rho(surface, width);
    parallel_for(size(), [&](std::size_t i) {
      const auto distance = static_cast<double>(surface.boundary.distance[i]);
      boundary_weight[i] = static_cast<float>(relievo::boundary_weight(distance, rho));
    });
  }

  void find_slopes(const Shape& shape) {
    const bool is_layered = shape.style == Style::layered;
    weight.fill(surface.curvature.delta,
                is_layered ? saturation_alone(shape.compression) : shape.compression);
    const SlopeInput input = slope_input(surface, boundary_weight);
    if (is_layered)
      frame_layered_slopes(input, weight, shape, slopes);
    else
      frame_slopes(input, weight, shape.max_slope, slopes);
  }

  void find_heights(Frame& frame) {
    const Shape& shape = frame.options.shape;
    const Stopwatch watch;
    if (const HeightSystem* system = model.system()) {
      find_slopes(shape);
      system->solve(slopes, frame.heights, std::get<HeightSystem::Workspace>(workspace));
      frame.times.heights_s += watch.seconds();
    } else {
      auto& own = std::get<SubspaceModel::Workspace>(workspace);
      model.subspace()->solve(shape, boundary_weight, own);
      frame.times.heights_s += watch.seconds();
      const Stopwatch mapping;
      model.subspace()->carry(boundary_weight, own, frame.heights);
      frame.times.detail_s += mapping.seconds();
    }
    ++frame.times.solves;
  }

  // Calls change(i, z) for every height, which may change it, and returns the span of what comes out.
  template <typename Change>
  float pass(std::vector<float>& heights, Change change) {
    parallel_ranges(heights.size(), default_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) change(i, heights[i]);
      spans[begin / default_grain] = span_of_run(std::span<const float>(heights).subspan(begin, end - begin));
    });
    HeightSpan<float> all;
    for (const HeightSpan<float>& span : spans) all.extend(span);
    return all.size();
  }

  float span_of_heights(Frame& frame) {
    return pass(frame.heights, [](std::size_t, float&) {});
  }

  float add_detail(Frame& frame) {
    const float h = span_of_heights(frame);
    const float amount = static_cast<float>(frame.options.shape.gamma) * h;
    return pass(frame.heights,
                [&](std::size_t i, float& z) { z += amount * surface.curvature.k[i] * boundary_weight[i]; });
  }

  // Heights for the frame's shape: with detail, or yet to be held within frame.height.
  void raise(Frame& frame) {
    Shape& shape = frame.options.shape;
    const bool is_layered = shape.style == Style::layered;
    if (is_layered && !is_hold_given) shape.hold = model.hold_at(shape.compression.u);
    find_heights(frame);
    const Stopwatch watch;
    frame.height = is_layered ? shape.hold->share * static_cast<double>(span_of_heights(frame))
                              : static_cast<double>(add_detail(frame));
    frame.times.detail_s += watch.seconds();
  }

  // Gives layered heights the height that they are yet to be held within.
  void hold(Frame& frame) {
    if (frame.options.shape.style != Style::layered) return;
    const Stopwatch watch;
    const Membrane::Limits limits = Membrane::Limits::of(frame.height, *frame.options.shape.hold);
    model.membrane().hold<float>({frame.heights, boundary_weight, limits}, membrane_workspace);
    frame.times.detail_s += watch.seconds();
  }

  // Finds u from where the last frame's was; two solves as a rule. See ReliefModel::make_at_height().
  void raise_to(double height, Frame& frame) {
    constexpr double tolerance = 5e-4;
    const auto excess = [&](double log_u) {
      frame.options.shape.compression.u = std::exp(log_u);
      raise(frame);
      return std::log(std::max(frame.height, 1e-300) / height);
    };
    double x = last_log_u, fx = excess(x);
    for (int round = 0; round < 6 && std::abs(fx) > tolerance; ++round) {
      const double next = x - std::clamp(fx / elasticity, -2.0, 2.0), fnext = excess(next);
      if (next != x && (fnext - fx) / (next - x) > .02) elasticity = (fnext - fx) / (next - x);
      x = next, fx = fnext;
    }
    if (std::abs(fx) > tolerance) fx = search(excess, tolerance, x);
    frame.is_height_met = std::abs(fx) <= tolerance;
    if (frame.is_height_met) last_log_u = x;
  }

  // The sure way, for far jumps and heights at or out of reach.
  template <typename F>
  static double search(F& excess, double tolerance, double& x) {
    const double most = excess(std::numeric_limits<double>::infinity());
    if (most <= tolerance) return most;
    double f = 0;
    x = find_root([&](double log_u) { return f = excess(log_u); }, tolerance);
    return f;
  }
};

FrameMaker::FrameMaker(const ReliefModel& model) : packed_(std::make_unique<Packed>(model)) {}
FrameMaker::FrameMaker(FrameMaker&&) noexcept = default;
FrameMaker::~FrameMaker() = default;

void FrameMaker::make(const FrameOptions& options, Frame& frame) {
  frame.options = options;
  frame.heights.resize(packed_->size());
  frame.normals.resize(packed_->size());
  frame.shading.resize(packed_->size());
  frame.times = {};
  frame.is_height_met = true;
  packed_->is_hold_given = options.shape.hold.has_value();
  packed_->set_boundary_width(options.shape.boundary_width);
  if (options.height)
    packed_->raise_to(*options.height, frame);
  else
    packed_->raise(frame);
  packed_->hold(frame);

  const Stopwatch watch;
  if (options.base)
    parallel_for(packed_->size(), [&](std::size_t i) { frame.heights[i] += (*options.base)[i]; });
  packed_->normal_links.normals(frame.heights, options.light.normalized(), {frame.normals, frame.shading});
  frame.times.normals_s = watch.seconds();
}

std::size_t FrameMaker::memory() const {
  const std::size_t workspace = std::visit([](const auto& w) { return w.memory(); }, packed_->workspace);
  return packed_->normal_links.memory() + workspace + packed_->membrane_workspace.memory() +
         packed_->slopes.size() * sizeof(Vec2f) + packed_->boundary_weight.size() * sizeof(float);
}

}  // namespace relievo
