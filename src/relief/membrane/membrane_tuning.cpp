#include "relief/membrane/membrane_tuning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/height_span.h"
#include "quality/image_measures.h"
#include "relief/style.h"
#include "relievo/core/parallel.h"
#include "relievo/quality/measures.h"
#include "relievo/relief/baselines.h"

namespace relievo {
namespace {

// With fewer pixels than this the scores are noise.
constexpr std::size_t least_pixels = 100;

// Search range of the height share (stated for u = 0) and of the pull length. Above 0.75, thin figures score
// worse than histogram equalisation in shading and angle, so larger shares are used only to satisfy depth
// order. See docs/decisions/membrane-tuning.md.
constexpr double least_share = .2, usual_most_share = .75, most_share = 1, least_pull_length = .035,
                 most_pull_length = .2;
// Numbers of bisection steps: of the pull length, and of the height share in the first, coarse search and in
// the second search. Each search starts with a calibration.
constexpr int pull_steps = 4;
constexpr std::array<int, 2> share_steps{3, 6};
// Safety margin over the gradient-domain baseline. It covers the residual error of the calibration and the
// interpolation error between knots. See docs/decisions/membrane-tuning.md.
constexpr Scores margin{.0003, .002};
// The height share approaches 1 as u grows: 1 - share is proportional to e^(-growth u). So high reliefs are
// compressed less.
constexpr double growth = .25;
// The largest sampling distance, as a share of the longer side, at which points still resolve the coarsest
// detail of the metrics.
constexpr double coarsest_rho = static_cast<double>(detail_scales_px.back()) / ReliefMetrics::longer_side_px;
// The parameters at which the search starts, between the extremes of the range. They are also the result if
// nothing can be measured.
constexpr MembraneParams initial{.5};
// From one knot to the next the compressed height grows by this factor at least.
constexpr double least_height_growth = 1.1;

double share_at(double u, double share_at_zero) {
  return 1 - (1 - share_at_zero) * std::exp(-growth * u);
}

// The constraints that a candidate violates.
struct Violation {
  bool detail, order;
  bool any() const { return detail || order; }
};

struct LeastShare {
  std::optional<double> share;
  Violation bound;  // violation at the next smaller share
};

// Searches the parameters for one u. All height shares here are stated for u = 0.
class TuningSearch {
 public:
  TuningSearch(const BaselineComparison& comparison, double u)
      : comparison_(comparison), u_(u), workspace_(comparison.correction().make_workspace()) {
    initial_heights_ = comparison.heights(u, at_u(initial));
    comparison.correction().set_heights(std::span<const double>(initial_heights_), workspace_);
    drawn_ = comparison.metrics().draw(initial_heights_);
    span_ = height_span(initial_heights_);
  }

  // Returns the approximate span of the heights that (9) gives at a height share of 1.
  double span() const { return span_ / (2 - at_u(initial).height_share); }

  MembraneParams strongest() {
    MembraneParams params = initial;
    for (const int steps : share_steps) {
      steps_ = steps;
      const Violation violation =
          calibrate(params, params == initial ? initial_heights_ : comparison_.heights(u_, at_u(params)));
      params = strongest_by_estimate(violation.any() ? std::nullopt : std::optional(params));
    }
    return at_u(params);
  }

 private:
  MembraneParams at_u(const MembraneParams& params) const {
    return {share_at(u_, params.height_share), params.pull_length};
  }

  // Returns estimated scores. Heights from (9) scale approximately with (2 - share), so one solve serves all
  // candidates.
  Scores estimate(const MembraneParams& params) {
    const double share = at_u(params).height_share;
    comparison_.correction().solve(HeightLimits::of(share * span_, at_u(params)), workspace_);
    const FastMetrics& metrics = comparison_.metrics();
    Image<float> z = metrics.draw_smooth([&](Index p) { return comparison_.correction().at(p, workspace_); });
    const auto scale = static_cast<float>((2 - share) / (2 - at_u(initial).height_share));
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = scale * (z[i] + drawn_[i]);
    return metrics.estimate(z);
  }

  // Sets the scores that estimates must reach, so that the estimate of these parameters has the same deficit
  // as their full relief. Returns the violation of that relief.
  Violation calibrate(const MembraneParams& params, std::vector<double> heights) {
    const Scores deficit = comparison_.deficit(std::move(heights), at_u(params)), scores = estimate(params);
    required_ = {scores.detail + deficit.detail + margin.detail, scores.order + deficit.order + margin.order};
    least_shortfall_ = std::numeric_limits<double>::infinity();
    return compare(params, scores);
  }

  Violation violation_of(const MembraneParams& params) { return compare(params, estimate(params)); }

  // Compares scores with the required scores, and remembers the parameters with the smallest violation.
  Violation compare(const MembraneParams& params, const Scores& scores) {
    const double detail = std::max(required_.detail - scores.detail, 0.0),
                 order = std::max(required_.order - scores.order, 0.0);
    const double shortfall = detail / margin.detail + order / margin.order;
    if (shortfall < least_shortfall_) least_shortfall_ = shortfall, nearest_ = params;
    return {detail > 0, order > 0};
  }

  // Returns the least share up to `known` that satisfies both constraints with this pull length, if there is
  // one. Shares above the usual maximum are used only if depth order needs them.
  LeastShare least_share_with(double pull_length, double known) {
    double low = least_share, high = std::min(known, usual_most_share);
    Violation violation = violation_of({high, pull_length});
    if (violation.order && high < known) {
      low = high, high = known;
      violation = violation_of({high, pull_length});
    }
    if (violation.any()) return {{}, violation};
    Violation bound{false, high > usual_most_share};
    for (int i = 0; i < steps_; ++i) {
      const double middle = (low + high) / 2;
      violation = violation_of({middle, pull_length});
      (violation.any() ? low : high) = middle;
      if (violation.any()) bound = violation;
    }
    return {high, bound};
  }

  // Returns the parameters of the strongest compression that satisfies both constraints, by estimates; if
  // nothing satisfies both, the candidate with the smallest violation. Starts from the best known candidate
  // so that hopeless ones are rejected early. A shorter pull length keeps more of the depth order and less of
  // the detail.
  MembraneParams strongest_by_estimate(std::optional<MembraneParams> best) {
    double low = least_pull_length, high = most_pull_length, length = most_pull_length;
    for (int i = 0; i <= pull_steps; ++i) {
      const auto [share, bound] = least_share_with(length, best ? best->height_share : most_share);
      if (share && (!best || *share < best->height_share)) best = MembraneParams{*share, length};
      // If both are violated, a shorter length does not help. But the first length is the longest, so the
      // search can only continue with shorter ones.
      const bool is_shorter_better = bound.order && (share || !bound.detail || i == 0);
      if (i == 0 && !is_shorter_better) break;
      (is_shorter_better ? high : low) = length;
      length = std::sqrt(low * high);
    }
    return best.value_or(nearest_);
  }

  const BaselineComparison& comparison_;
  double u_, span_ = 0;
  int steps_ = 0;
  HeightCorrection::Workspace workspace_;
  std::vector<double> initial_heights_;  // before compression
  Image<float> drawn_;                   // the same heights as an image
  Scores required_;
  MembraneParams nearest_;
  double least_shortfall_ = 0;
};

using Spans = std::array<double, MembraneTuning::knots.size()>;

// Lowers height shares so that the compressed height grows from knot to knot.
void make_heights_grow(MembraneTuning& tuning, const Spans& spans) {
  for (std::size_t k = spans.size() - 1; k-- > 0;) {
    const double most = tuning.params[k + 1].height_share * spans[k + 1] / spans[k] / least_height_growth;
    tuning.params[k].height_share = std::min(tuning.params[k].height_share, most);
  }
}

}  // namespace

MembraneTuning::MembraneTuning() {
  for (std::size_t k = 0; k < knots.size(); ++k) params[k] = {share_at(knots[k], initial.height_share)};
}

MembraneParams MembraneTuning::at(double u) const {
  const MembraneParams& last = params.back();
  if (u > knots.back()) return {share_at(u - knots.back(), last.height_share), last.pull_length};
  const double at = std::max(std::log(u / knots[0]) / std::log(knots[1] / knots[0]), 0.0);
  const auto k = std::min(static_cast<std::size_t>(at), knots.size() - 2);
  const double part = at - static_cast<double>(k);
  const MembraneParams &before = params[k], &after = params[k + 1];
  // The membrane's energy contains 1 / pull_length^2, so this value is interpolated.
  const auto pull = [](const MembraneParams& p) { return 1 / (p.pull_length * p.pull_length); };
  return {std::lerp(before.height_share, after.height_share, part),
          1 / std::sqrt(std::lerp(pull(before), pull(after), part))};
}

Result<MembraneTuning> tune_membrane(const TuningInput& input, const Progress* progress) {
  MembraneTuning tuning;
  if (input.surface.rho > coarsest_rho * input.surface.longer_side()) return tuning;
  const BaselineComparison comparison(input);
  if (!comparison.is_measurable()) return tuning;
  Spans spans;
  const auto is_cancelled = [&] { return progress && progress->is_cancelled(); };
  const auto search_at = [&](std::size_t k) {
    if (is_cancelled()) return;
    TuningSearch search(comparison, MembraneTuning::knots[k]);
    tuning.params[k] = search.strongest();
    spans[k] = search.span();
  };
  parallel_for(spans.size(), search_at, 1);
  if (is_cancelled()) return cancelled_error();
  make_heights_grow(tuning, spans);
  return tuning;
}

BaselineComparison::BaselineComparison(const TuningInput& input)
    : input_(input),
      metrics_(input.surface),
      boundary_weight_(boundary_weights(input.surface.boundary.distance,
                                        boundary_rho(input.surface, layered_shape().boundary_width))),
      baseline_(solved(gradient_slopes(input.surface))),
      baseline_span_(height_span(baseline_)) {}

bool BaselineComparison::is_measurable() const {
  return metrics_.pixels() >= least_pixels && baseline_span_ > 0;
}

std::vector<double> BaselineComparison::solved(std::span<const Vec2> slopes) const {
  std::vector<Vec2f> single(slopes.size());
  parallel_for(slopes.size(), [&](std::size_t i) { single[i] = slopes[i].cast<float>(); });
  std::vector<float> heights(slopes.size());
  HeightSystem::Workspace workspace = input_.system.make_workspace();
  input_.system.solve(single, heights, workspace);
  return {heights.begin(), heights.end()};
}

std::vector<double> BaselineComparison::heights(double u, const MembraneParams& params) const {
  Shape shape = layered_shape();
  shape.compression.u = u;
  shape.membrane = params;
  std::vector<Vec2> slopes(input_.surface.points.size());
  find_slopes(slope_input(input_.surface, input_.layers, boundary_weight_), shape, slopes);
  std::vector<double> heights = solved(slopes);
  input_.jump_lift.add_to(std::span(heights), shape);
  return heights;
}

Scores BaselineComparison::deficit(std::vector<double> relief, const MembraneParams& params) const {
  std::vector<double> baseline = baseline_;
  const double height = params.height_share * height_span(relief);
  HeightCorrection::Workspace workspace = correction().make_workspace();
  correction().compress_heights<double>({relief, boundary_weight_, HeightLimits::of(height, params)},
                                        workspace);
  for (double& z : baseline) z *= height / baseline_span_;
  const Scores theirs = metrics_.exact_scores(baseline), ours = metrics_.exact_scores(relief);
  return {theirs.detail - ours.detail, theirs.order - ours.order};
}

}  // namespace relievo
