#include "relievo/relief/relief.h"

#include <cmath>
#include <optional>
#include <variant>

#include "core/height_span.h"
#include "paper/surface.h"
#include "relief/aimed_slopes.h"
#include "relief/colour_lines.h"
#include "relief/correction/height_correction.h"
#include "relief/height_search.h"
#include "relief/own_heights.h"
#include "relief/paper_relief.h"
#include "relief/step_heights.h"
#include "relief/stroke_fields.h"
#include "relief/style.h"
#include "relievo/core/parallel.h"
#include "relievo/relief/heights.h"
#include "relievo/relief/subspace.h"
#include "relievo/scan/surface.h"
#include "scan/measured_cloud.h"

namespace relievo {

Mode resolve_mode(Mode mode, const Surface& surface) {
  if (mode != Mode::automatic) return mode;
  return surface.points.size() > most_exact_points ? Mode::subspace : Mode::exact;
}

struct ReliefModel::State {
  // The parts of a model that depend only on its surface. `solver` is either the system of all points or the
  // model of the control points.
  struct Parts {
    std::vector<PointLayers> layers;
    StepFields fields;
    HeightCorrection correction;
    OwnHeights own_heights;
    std::variant<HeightSystem, SubspaceModel> solver;
  };

  Surface surface;
  std::variant<Parts, PaperModel> parts_or_paper;

  const Parts& parts() const { return std::get<Parts>(parts_or_paper); }
  const PaperModel* paper() const { return std::get_if<PaperModel>(&parts_or_paper); }

  static Result<Parts> prepare_parts(const Surface& surface, Progress* progress);

  // Returns the solution of equation (9) for the target slopes of the shape.
  std::vector<double> solve(const Shape& shape, const SlopeInput& input) const;
};

ReliefModel::ReliefModel(std::unique_ptr<State> state) : state_(std::move(state)) {}
ReliefModel::ReliefModel(ReliefModel&&) noexcept = default;
ReliefModel& ReliefModel::operator=(ReliefModel&&) noexcept = default;
ReliefModel::~ReliefModel() = default;

const Surface& ReliefModel::surface() const {
  return state_->surface;
}
Surface ReliefModel::take_surface() && {
  Surface surface = std::move(state_->surface);
  state_.reset();
  return surface;
}
const PaperModel* ReliefModel::paper() const {
  return state_->paper();
}
bool ReliefModel::serves(Method method) const {
  return (method == Method::paper) == (paper() != nullptr);
}
std::size_t ReliefModel::control_points() const {
  if (paper()) return paper()->is_subspace() ? paper()->control_points() : 0;
  return subspace() ? subspace()->control_points().points.size() : 0;
}
std::span<const PointLayers> ReliefModel::layers() const {
  return paper() ? std::span<const PointLayers>() : state_->parts().layers;
}
const HeightSystem* ReliefModel::system() const {
  return paper() ? nullptr : std::get_if<HeightSystem>(&state_->parts().solver);
}
const SubspaceModel* ReliefModel::subspace() const {
  return paper() ? nullptr : std::get_if<SubspaceModel>(&state_->parts().solver);
}
const StepHeights& ReliefModel::steps() const {
  return state_->parts().fields.steps;
}
const StepHeights& ReliefModel::planes() const {
  return state_->parts().fields.planes;
}
const OwnHeights& ReliefModel::own_heights() const {
  return state_->parts().own_heights;
}
const HeightCorrection& ReliefModel::correction() const {
  return state_->parts().correction;
}

namespace {

// Prepares the model of the control points. Consumes `system`, the system of all points.
Result<SubspaceModel> prepare_subspace(const Surface& surface, std::span<const PointLayers> layers,
                                       HeightSystem system, std::size_t control_points, Progress* progress) {
  RELIEVO_CHECK(begin_stage(progress, "reference heights", .83));
  const SubspaceOptions options{.control = {.count = control_points}};
  const auto reference = [&] {
    // The system is freed at the end of this block, because it takes most of the memory.
    const HeightSystem all = std::move(system);
    return reference_heights(surface, all, options.max_slope);
  }();
  return SubspaceModel::prepare(surface, options, {reference, layers}, progress);
}

}  // namespace

Result<ReliefModel::State::Parts> ReliefModel::State::prepare_parts(const Surface& surface,
                                                                    Progress* progress) {
  RELIEVO_CHECK(begin_stage(progress, "layers", .72));
  std::vector<PointLayers> layers;
  std::optional<HeightCorrection> correction;
  parallel_both([&] { layers = normal_layers(surface.points, surface.normals); },
                [&] { correction.emplace(surface); });
  RELIEVO_CHECK(begin_stage(progress, "factorisation", .75));
  RELIEVO_TRY(HeightSystem system,
              HeightSystem::build(in_plane(surface.points), surface.triangulation, surface.boundary));
  RELIEVO_CHECK(check_cancelled(progress));
  StepFields fields = StepFields::find(surface, system);
  RELIEVO_TRY(OwnHeights own_heights, OwnHeights::find(surface));
  return Parts{std::move(layers), std::move(fields), std::move(*correction), std::move(own_heights),
               std::move(system)};
}

Result<ReliefModel> ReliefModel::prepare(Surface surface, Progress* progress, const ModelOptions& options) {
  RELIEVO_TRY(State::Parts parts, State::prepare_parts(surface, progress));
  auto& system = std::get<HeightSystem>(parts.solver);
  if (resolve_mode(options.mode, surface) == Mode::subspace) {
    RELIEVO_TRY(parts.solver,
                prepare_subspace(surface, parts.layers, std::move(system), options.control_points, progress));
    parts.layers = std::vector<PointLayers>();
  }
  return ReliefModel(std::unique_ptr<State>(new State{std::move(surface), std::move(parts)}));
}

Result<ReliefModel> ReliefModel::of_view(const MeasuredCloud& measured, const View& view,
                                         const ModelOptions& options, Progress* progress) {
  if (!view.is_paper) {
    RELIEVO_TRY(Surface surface, find_surface(measured, view, progress));
    return prepare(std::move(surface), progress, options);
  }
  if (!measured.cloud().own_heights.empty())
    return option_error("method",
                        "expected another than paper for a scene in which a model has its own height");
  RELIEVO_TRY(Surface surface, paper::find_surface(measured, view, progress));
  const bool is_exact = resolve_mode(options.mode, surface) == Mode::exact;
  const std::size_t control_points = is_exact ? surface.points.size() : options.control_points;
  RELIEVO_TRY(PaperModel model, PaperModel::prepare(surface, control_points, progress));
  return ReliefModel(std::unique_ptr<State>(new State{std::move(surface), std::move(model)}));
}

std::size_t ReliefModel::memory() const {
  if (const PaperModel* model = paper()) return model->memory() + surface().memory();
  const std::size_t solver = std::visit([](const auto& s) { return s.memory(); }, state_->parts().solver);
  return solver + own_heights().memory() + surface().memory() + layers().size_bytes() +
         correction().memory() + (steps().z.size() + planes().z.size()) * sizeof(float);
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

std::vector<double> ReliefModel::State::solve(const Shape& shape, const SlopeInput& input) const {
  if (const auto* model = std::get_if<SubspaceModel>(&parts().solver))
    return subspace_heights(*model, shape, input.boundary_weight);
  std::vector<Vec2> slopes(surface.points.size());
  find_slopes(input, shape, slopes);
  std::vector<double> heights(slopes.size());
  std::get<HeightSystem>(parts().solver).solve(slopes, heights);
  return heights;
}

void give_own_heights(const ReliefModel& model, Relief& relief) {
  if (model.paper() || model.own_heights().empty()) return;
  OwnHeights::Workspace<double> workspace;
  model.own_heights().apply<double>(relief.height, relief.heights, workspace);
  relief.height = height_span(relief.heights);
}

// Makes reliefs of one boundary width in two steps: raise(), then finish(). A search for a height needs only raise().
class ReliefModel::Maker {
 public:
  Maker(const ReliefModel& model, const Shape& shape)
      : model_(model),
        boundary_weight_(boundary_weights(model.surface().boundary.distance,
                                          boundary_rho(model.surface(), shape.boundary_width))),
        input_(slope_input(model.surface(), model.layers(), boundary_weight_)) {
    if (shape.light) contrast_ = local_contrast(model.surface(), shape.light->from);
    input_.contrast = contrast_;
    if (shape.attention > 0) attention_ = levels_of(attention(model.surface()));
    input_.attention = attention_;
  }

  // Returns the relief of the shape `asked` before finish(). The steps at depth jumps take the share
  // Shape::steps of `height`. If no height is given, the steps take this share of the height that slopes and
  // steps have together.
  Relief raise(const Shape& asked, std::optional<double> height = {}) {
    Relief relief{{}, 0, asked};
    relief.heights = model_.state_->solve(relief.shape, input_);
    RaisedHeights<double> heights{relief.heights, input_, spans_};
    with_style(relief.shape, [&](const auto& style) {
      if (height) *height /= style.height_share();
      add_planes(model_.planes(), relief.shape, heights.z);
      add_steps(model_.steps(), relief.shape.steps, height, heights.z);
      style.raise(heights);
    });
    relief.height = heights.height;
    return relief;
  }

  void finish(Relief& relief) {
    RaisedHeights<double> heights{relief.heights, input_, spans_, {}, relief.height};
    std::vector<double> uncorrected;
    if (needs_uncorrected(relief.shape.strokes)) uncorrected = relief.heights;
    HeightCorrection::Workspace workspace;
    const auto make_workspace = [&]() -> HeightCorrection::Workspace& {
      return workspace = model_.correction().make_workspace();
    };
    with_style(relief.shape,
               [&](const auto& style) { style.finish(heights, model_.correction(), make_workspace); });
    relief.height = heights.height;
    give_own_heights(model_, relief);
    apply_strokes(model_.surface(), uncorrected, relief);
    sink_lines(model_.surface(), relief);
  }

 private:
  const ReliefModel& model_;
  std::vector<float> boundary_weight_, contrast_;
  std::vector<std::uint16_t> attention_;
  SlopeInput input_;
  std::vector<HeightSpan<double>> spans_;
};

Relief ReliefModel::make(const Shape& shape) const {
  if (const PaperModel* model = paper()) return make_paper_relief(*model, shape);
  Maker maker(*this, shape);
  Relief relief = maker.raise(shape);
  maker.finish(relief);
  return relief;
}

Result<Relief> ReliefModel::make_at_height(double height, Shape shape, double unit_mm,
                                           Progress* progress) const {
  if (const PaperModel* model = paper()) {
    const auto is_cancelled = [&] { return progress && progress->is_cancelled(); };
    return make_paper_relief_at(*model, height, shape, unit_mm, is_cancelled);
  }
  Maker maker(*this, shape);
  Relief relief;
  bool is_cancelled = false;
  const auto raised_height = [&] {
    relief = maker.raise(shape, height);
    is_cancelled = progress && progress->is_cancelled();
    return is_cancelled ? height : relief.height;
  };
  constexpr double tolerance = 1e-5;
  const HeightSearch search(height, tolerance);
  bool is_met = search.bracket([&](double log_u) {
    shape.compression.u = std::exp(log_u);
    return raised_height();
  });
  if (!is_met && !steps().empty()) {
    keep_slopes(shape);
    is_met = search.bracket([&](double x) {
      shape.steps = step_share(steps(), height, x);
      return raised_height();
    });
  }
  if (is_cancelled) return cancelled_error();
  // A relief that is too high can be scaled down. So every height below the one in this error can be made.
  if (!is_met && relief.height < height) return out_of_reach(relief.height * unit_mm, height * unit_mm);
  maker.finish(relief);
  // The search ends at a height within a relative error of 10^-5 of the requested height, or at a greater
  // height. Scaling makes the height exact.
  for (double& z : relief.heights) z *= height / relief.height;
  relief.height = height;
  return relief;
}

}  // namespace relievo
