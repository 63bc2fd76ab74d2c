#include "relievo/relief/frame.h"

#include <cmath>
#include <limits>
#include <variant>

#include "core/memory.h"
#include "core/stopwatch.h"
#include "relief/aimed_slopes.h"
#include "relief/colour_lines.h"
#include "relief/height_search.h"
#include "relief/own_heights.h"
#include "relief/paper_frames.h"
#include "relief/sliced_ell_matrix.h"
#include "relief/step_heights.h"
#include "relief/stroke_fields.h"
#include "relief/style.h"
#include "relief/weight_table.h"
#include "relievo/core/parallel.h"
#include "relievo/relief/heights.h"
#include "relievo/relief/subspace.h"
#include "relievo/scan/surface.h"

namespace relievo {
namespace {

using SolverWorkspace = std::variant<HeightSystem::Workspace, SubspaceModel::Workspace>;

SolverWorkspace make_workspace(const ReliefModel& model) {
  if (const HeightSystem* system = model.system()) return system->make_workspace();
  return model.subspace()->make_workspace();
}

// Makes the frames of a model of any method except the paper's.
struct OwnFrames {
  const ReliefModel& model;
  const Surface& surface = model.surface();
  SlicedEllMatrix vertex_normals_matrix =
      vertex_normal_matrix(in_plane(surface.points), surface.triangulation, surface.boundary,
                           model.system() ? &model.system()->divergence_matrix() : nullptr);
  SolverWorkspace workspace = make_workspace(model);
  OwnHeights::Workspace<float> own_workspace = {};
  std::optional<LightDirection> light = {};  // the light for which `contrast` was computed
  std::vector<float> contrast = {};
  std::vector<std::uint16_t> attention = {};  // per point: its level; computed at the first need
  StrokeFields<float> strokes{surface};
  std::vector<float> uncorrected = {};           // heights before the height correction, if strokes need them
  std::optional<std::vector<float>> lines = {};  // dark_lines(), computed when a frame first needs them
  HeightCorrection::Workspace correction_workspace = model.correction().make_workspace();
  std::vector<Vec2f> slopes{model.system() ? surface.points.size() : 0};
  std::vector<float> boundary_weight{std::vector<float>(surface.points.size())};
  SlopeInput input = slope_input(surface, model.layers(), boundary_weight);
  double boundary_width = 0;  // the boundary width for which boundary_weight was computed
  WeightTable weight;
  std::vector<HeightSpan<float>> spans;
  Shape made = {};                              // shape of the last frame
  HeightSearch::Track last_height, last_steps;  // results of the last searches for u and for steps
  bool needs_steps = false;                     // whether slopes alone missed the last height

  explicit OwnFrames(const ReliefModel& m) : model(m) {}

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

  void aim_at_light(const Shape& shape) {
    if (!shape.light) return;
    if (light != shape.light->from) contrast = local_contrast(surface, *(light = shape.light->from));
    aim_slopes<float>(shape, contrast, layer_weights(shape).fine, slopes);
  }

  void write_slopes_of(const PaperWeightsStyle& style) { write_slopes<float>(input, style, weight, slopes); }
  void write_slopes_of(const LayeredStyle& style) { write_slopes_by_eight(input, style, weight, slopes); }

  void set_attention(const Shape& shape) {
    if (shape.attention > 0 && attention.empty()) attention = levels_of(relievo::attention(surface));
    input.attention =
        shape.attention > 0 ? std::span<const std::uint16_t>(attention) : std::span<const std::uint16_t>();
  }

  void solve_system(const HeightSystem& system, Frame& frame) {
    set_attention(frame.options.shape);
    const Stopwatch watch;
    with_style(frame.options.shape, [&](const auto& style) {
      weight.fill(input.delta, style.weighted());
      write_slopes_of(style);
    });
    aim_at_light(frame.options.shape);
    system.solve(slopes, frame.heights, std::get<HeightSystem::Workspace>(workspace));
    frame.times.heights_s += watch.seconds();
  }

  void solve_subspace(const SubspaceModel& subspace, Frame& frame) {
    auto& own = std::get<SubspaceModel::Workspace>(workspace);
    const Stopwatch watch;
    subspace.solve(frame.options.shape, boundary_weight, own);
    frame.times.heights_s += watch.seconds();
    const Stopwatch mapping;
    subspace.carry(boundary_weight, own, frame.heights);
    frame.times.after_solve_s += mapping.seconds();
  }

  // Calls f(heights, style), which may change the frame's heights. Afterwards stores the span of the
  // heights in the frame.
  template <typename F>
  void change_heights(Frame& frame, F&& f) {
    const Stopwatch watch;
    RaisedHeights<float> heights{frame.heights, input, spans, {frame.lowest, frame.highest}, frame.height};
    with_style(frame.options.shape, [&](const auto& style) { f(heights, style); });
    frame.lowest = heights.span.lowest;
    frame.highest = heights.span.highest;
    frame.times.after_solve_s += watch.seconds();
  }

  // Makes the relief of `shape`, except for the last step, which is finish() of the shape's style and does
  // not change frame.height.
  void raise(const Shape& shape, std::optional<double> height, Frame& frame) {
    frame.options.shape = made = shape;
    if (const HeightSystem* system = model.system())
      solve_system(*system, frame);
    else
      solve_subspace(*model.subspace(), frame);
    ++frame.times.solves;
    change_heights(frame, [&](RaisedHeights<float>& heights, const auto& style) {
      if (height) *height /= style.height_share();
      add_planes(model.planes(), frame.options.shape, heights.z);
      add_steps(model.steps(), frame.options.shape.steps, height, heights.z);
      style.raise(heights);
      frame.height = heights.height;
    });
  }

  // Makes a relief of the given height. Searches for the weight u of equation (6), starting from the u of the last
  // frame (see ReliefModel::make_at_height()). If no u is enough, searches for the height of steps at depth jumps. One
  // or two solves are usually enough.
  void raise_to(double height, Shape shape, Frame& frame) {
    const HeightSearch search(height, frame.options.height_tolerance);
    const auto height_at = [&](double log_u) {
      shape.compression.u = std::exp(log_u);
      raise(shape, height, frame);
      return frame.height;
    };
    const auto is_too_low = [&] { return frame.height < height && !model.steps().empty(); };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (needs_steps) height_at(infinity);
    needs_steps = needs_steps && is_too_low();
    if (!needs_steps) frame.is_height_met = search.track(last_height, height_at);
    needs_steps = needs_steps || (!frame.is_height_met && is_too_low());
    if (!needs_steps) return;
    keep_slopes(shape);
    frame.is_height_met = search.track(last_steps, [&](double x) {
      shape.steps = step_share(model.steps(), height, x);
      raise(shape, height, frame);
      return frame.height;
    });
  }

  static void scale(RaisedHeights<float>& heights, double factor) {
    heights.span = heights.change_all([&](std::size_t, float& z) { z *= static_cast<float>(factor); });
  }

  // Scales the relief down if its height exceeds the requested one by over twice the tolerance.
  // HeightSearch::bracket() says when this happens.
  void scale_down(RaisedHeights<float>& heights, Frame& frame) {
    const std::optional<double>& height = frame.options.height;
    if (!height || !frame.is_height_met || frame.height <= *height * (1 + 2 * frame.options.height_tolerance))
      return;
    const double factor = *height / frame.height;
    scale(heights, factor);
    for (float& z : uncorrected) z *= static_cast<float>(factor);
    frame.height = *height;
  }

  void apply_strokes(RaisedHeights<float>& heights, Frame& frame) {
    const Strokes none, *const wanted = frame.options.shape.strokes.list.get();
    strokes.take(wanted ? *wanted : none);
    if (strokes.empty()) return;
    strokes.apply(frame.height, uncorrected, heights.z);
    heights.span = heights.measured();
    const auto height = static_cast<double>(heights.span.size());
    if (height > 0 && height != frame.height) scale(heights, frame.height / height);
  }

  void sink_lines(RaisedHeights<float>& heights, const Shape& shape) {
    if (!(shape.line_depth > 0)) return;
    if (!lines) lines = dark_lines(surface);
    relievo::sink_lines<float>(*lines, shape.line_depth, heights.z);
    heights.span = heights.measured();
  }

  void finish(Frame& frame) {
    const auto workspace_of_correction = [&]() -> HeightCorrection::Workspace& {
      return correction_workspace;
    };
    uncorrected.clear();
    if (needs_uncorrected(frame.options.shape.strokes)) uncorrected = frame.heights;
    change_heights(frame, [&](RaisedHeights<float>& heights, const auto& style) {
      style.finish(heights, model.correction(), workspace_of_correction);
      scale_down(heights, frame);
      if (!model.own_heights().empty()) {
        model.own_heights().apply<float>(frame.height, heights.z, own_workspace);
        heights.span = heights.measured();
      }
      apply_strokes(heights, frame);
      sink_lines(heights, frame.options.shape);
    });
  }

  // Makes the relief. `frame` already has its options and memory for its points.
  void make(Frame& frame) {
    set_boundary_width(frame.options.shape.boundary_width);
    if (frame.options.height)
      raise_to(*frame.options.height, frame.options.shape, frame);
    else
      raise(frame.options.shape, std::nullopt, frame);
    finish(frame);
    const Stopwatch watch;
    vertex_normals_matrix.normals(frame.heights, frame.normals);
    frame.times.normals_s = watch.seconds();
  }

  void write_gains(std::vector<float>& gains) const {
    gains.resize(size());
    with_style(made, [&](const auto& style) {
      parallel_for(gains.size(), [&](std::size_t i) {
        gains[i] = style.gain(input, i, weight(input.k[i]), input.boundary_weight[i]);
      });
    });
  }

  std::size_t memory() const {
    const std::size_t solver = std::visit([](const auto& w) { return w.memory(); }, workspace);
    return vertex_normals_matrix.memory() + solver + correction_workspace.memory() + bytes(slopes) +
           bytes(boundary_weight);
  }
};

}  // namespace

struct FrameMaker::State {
  using Frames = std::variant<OwnFrames, PaperFrames>;

  explicit State(const ReliefModel& m)
      : model(m),
        frames(m.paper() ? Frames(std::in_place_type<PaperFrames>, m)
                         : Frames(std::in_place_type<OwnFrames>, m)) {}

  const ReliefModel& model;
  Frames frames;
};

std::vector<Vec3f> vertex_normals(const Surface& surface, std::span<const float> heights) {
  std::vector<Vec3f> normals(heights.size());
  vertex_normal_matrix(in_plane(surface.points), surface.triangulation, surface.boundary)
      .normals(heights, normals);
  return normals;
}

FrameMaker::FrameMaker(const ReliefModel& model) : state_(std::make_unique<State>(model)) {}
FrameMaker::FrameMaker(FrameMaker&&) noexcept = default;
FrameMaker::~FrameMaker() = default;

bool FrameMaker::make_ahead(const FrameOptions& options, Frame& frame) {
  auto* const paper = std::get_if<PaperFrames>(&state_->frames);
  if (paper && !options.height) return paper->make_ahead(options, frame);
  make(options, frame);
  return true;
}

void FrameMaker::make(const FrameOptions& options, Frame& frame) {
  begin_frame(options, state_->model.surface().points.size(), frame);
  std::visit([&](auto& frames) { frames.make(frame); }, state_->frames);
}

void FrameMaker::write_gains(std::vector<float>& gains) const {
  if (const auto* own = std::get_if<OwnFrames>(&state_->frames)) return own->write_gains(gains);
  gains.assign(state_->model.surface().points.size(), 0);  // the paper's models have no finer normals
}

std::size_t FrameMaker::memory() const {
  return std::visit([](const auto& frames) { return frames.memory(); }, state_->frames);
}

}  // namespace relievo
