#include "relievo/relief/draft.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/angle.h"
#include "core/height_span.h"
#include "geometry/slope_limit.h"
#include "relief/height_search.h"
#include "relief/nearest_draft.h"
#include "relief/own_heights.h"
#include "relievo/core/text.h"
#include "relievo/relief/heights.h"
#include "relievo/scan/surface.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// The least-squares fit aims at this share of the limit. At a few triangles its result exceeds the target, by
// up to 0.4 %.
constexpr double solved_share = .9945;

double draft_deg_of(double slope) {
  return 90 - to_degrees(std::atan(slope));
}

// Limits the slopes of reliefs of one model.
class Limiter {
 public:
  Limiter(const ReliefModel& model, const DraftOptions& options)
      : model_(&model), options_(options), plane_(in_plane(model.surface().points)) {
    std::ranges::copy(triangles_inside(model.surface()), std::back_inserter(triangles_));
  }

  // Returns whether the slopes of relief and base together are at most the share kept_slope of the limit.
  bool keeps(std::span<const double> heights) const {
    return steepest_of(field(), with_base(heights)) <= kept_slope * options_.max_slope;
  }

  double max_slope() const { return options_.max_slope; }

  Result<void> limit(Relief& relief, Progress* progress) {
    if (!keeps(std::vector<double>(plane_.size(), 0.0)))
      return geometry_error("draft",
                            cat("expected a base that leans by at least ", draft_deg_of(options_.max_slope),
                                " degrees off the vertical everywhere, found a steeper one"));
    const auto is_cancelled = [&] { return progress && progress->is_cancelled(); };
    RELIEVO_CHECK(build_nearest());
    nearest_->apply(relief.heights, is_cancelled);
    if (is_cancelled()) return cancelled_error();
    keep_own_heights(relief);
    for (int tries = 0; tries < most_tries; ++tries) {
      std::vector<double> whole = with_base(relief.heights);
      const bool is_flat = limit_slopes(field(), kept_slope * options_.max_slope, Rounding::none, whole);
      for (std::size_t i = 0; i < whole.size(); ++i)
        relief.heights[i] = is_flat ? whole[i] - base(i) : .95 * relief.heights[i];
      relief.height = height_span(relief.heights);
      if (is_flat) return {};
    }
    return geometry_error("draft", "expected triangles that can be made flat enough, found some that cannot");
  }

 private:
  // Gives models of a scene the heights that were requested for them. If a wall rises between two
  // neighbouring rows of points, the least-squares fit keeps the slope limit by lowering the wall. Here the
  // wall gets its height back and becomes wider instead.
  void keep_own_heights(Relief& relief) {
    if (model_->paper() || model_->own_heights().empty()) return;
    constexpr double share = .9;  // share of the limit; the rest is for the slope of the surface behind
    OwnHeights::Workspace<double> workspace;
    model_->own_heights().apply<double>(relief.height, relief.heights, workspace, share * options_.max_slope);
  }

  PlaneMesh field() const { return {plane_, triangles_, model_->surface().boundary.is_boundary}; }

  double base(std::size_t i) const { return options_.base.empty() ? 0 : options_.base[i]; }

  std::vector<double> with_base(std::span<const double> heights) const {
    std::vector<double> whole(heights.begin(), heights.end());
    for (std::size_t i = 0; i < whole.size(); ++i) whole[i] += base(i);
    return whole;
  }

  // Creates the least-squares solver at the first call. Uses the model's system if that contains all points.
  Result<void> build_nearest() {
    if (nearest_) return {};
    const Surface& surface = model_->surface();
    if (!model_->system()) {
      RELIEVO_TRY(own_system_, HeightSystem::build(plane_, surface.triangulation, surface.boundary));
    }
    const HeightSystem& system = own_system_ ? *own_system_ : *model_->system();
    nearest_.emplace(surface, system, options_.base, solved_share * options_.max_slope);
    return {};
  }

  // The least-squares result can be far above the limit, for example if walls are a hundred times too steep. Then
  // limit_slopes() fails, and all heights are lowered before it is called again, at most `most_tries` times.
  static constexpr int most_tries = 40;

  const ReliefModel* model_;
  DraftOptions options_;
  std::vector<Vec2> plane_;
  std::vector<Triangle> triangles_;  // all triangles inside the relief
  std::optional<HeightSystem> own_system_;
  std::optional<NearestDraft> nearest_;
};

// Searches for the relief of a given height under the slope limit. The search varies a number x, and the
// height grows with x. If the method has a shape, x is the logarithm of u. For baselines, x is the logarithm
// of a scale factor.
class DraftSearch {
 public:
  DraftSearch(const ReliefModel& model, const DraftOrder& order, Limiter& limiter, Progress* progress)
      : model_(model), order_(order), limiter_(limiter), progress_(progress) {}

  // `start` is the relief of the wanted height before the limit is applied; null if no such relief exists.
  Result<Relief> run(const Relief* start) {
    if (!start) return at_most();
    start_ = start;
    const double first = has_shape(order_.method) ? std::log(start->shape.compression.u) : 0;
    const double last = has_shape(order_.method) ? largest_log_u : largest_log_scale();
    if (!(first < last)) return at_most();
    return search(first, last);
  }

 private:
  // The search ends at u = e^4.5. Beyond this, the weights of equation (6) are nearly 1 in all layers, unless
  // gamma is large.
  static constexpr double largest_log_u = 4.5;

  // A baseline's relief grows with the scale until it consists of walls only. Imagine a cone of the largest
  // slope, with a radius of half the longer side. At the largest scale, and before its slopes are limited,
  // the relief is 64 times as high as this cone. This does not depend on the requested height, so the largest
  // height is the same for all requests.
  double largest_log_scale() const {
    const double half_side = model_.surface().longer_side() / 2;
    return std::log(64 * half_side * limiter_.max_slope() / order_.height);
  }

  // Relative tolerance of the search. A relief that is too high, by up to twice this share, is scaled down.
  // Scaling down cannot make it steeper.
  static constexpr double tolerance = .003;

  Result<void> make(double x) {
    if (has_shape(order_.method)) {
      Shape shape = order_.shape;
      shape.compression.u = std::exp(x);
      relief_ = model_.make(shape);
    } else {
      relief_ = *start_;
      for (double& z : relief_.heights) z *= std::exp(x);
    }
    return limiter_.limit(relief_, progress_);
  }

  Result<Relief> search(double low, double last) {
    Result<void> made;
    const bool is_found = HeightSearch(order_.height, tolerance).climb(low, last, [&](double x) {
      made = make(x);
      return made ? relief_.height : order_.height;
    });
    if (!made) return std::unexpected(made.error());
    return is_found ? scaled() : at_most();
  }

  // Makes the highest possible relief and scales it down to the requested height. Returns an error if it is
  // too low.
  Result<Relief> at_most() {
    const double end =
        has_shape(order_.method) ? std::numeric_limits<double>::infinity() : largest_log_scale();
    RELIEVO_CHECK(make(end));
    return scaled();
  }

  Result<Relief> scaled() {
    if (relief_.height < order_.height) return too_high();
    const double scale = order_.height / relief_.height;
    for (double& z : relief_.heights) z *= scale;
    relief_.height = order_.height;
    return std::move(relief_);
  }

  Result<Relief> too_high() const {
    return geometry_error("draft",
                          cat("expected a height that walls under this draft angle can reach, at most ",
                              relief_.height * order_.unit_mm, " mm for this view, width and method, found ",
                              order_.height * order_.unit_mm, " mm"));
  }

  const ReliefModel& model_;
  const DraftOrder& order_;
  Limiter& limiter_;
  Progress* progress_;
  const Relief* start_ = nullptr;
  Relief relief_;
};

}  // namespace

double slope_at_draft(double draft_deg) {
  return std::tan(to_radians(90 - draft_deg));
}

Result<Relief> limit_draft(const ReliefModel& model, Relief relief, const DraftOptions& options,
                           Progress* progress) {
  Limiter limiter(model, options);
  if (limiter.keeps(relief.heights)) return relief;
  RELIEVO_CHECK(limiter.limit(relief, progress));
  return relief;
}

Result<Relief> make_with_draft(const ReliefModel& model, const DraftOrder& order, const DraftOptions& options,
                               Progress* progress) {
  Limiter limiter(model, options);
  Result<Relief> free =
      make_by_method(order.method, model, order.height, order.shape, order.unit_mm, progress);
  if (!free && (free.error().kind != ErrorKind::geometry || !has_shape(order.method))) return free;
  if (free && limiter.keeps(free->heights)) return free;
  return DraftSearch(model, order, limiter, progress).run(free ? &*free : nullptr);
}

}  // namespace relievo
