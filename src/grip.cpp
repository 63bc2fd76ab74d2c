#include "grip.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "quick_judge.h"
#include "relievo/parallel.h"
#include "relievo/rivals.h"

namespace relievo {
namespace {

// Shares, as for u = 0, and reaches that are tried, and how finely: halved that often.
constexpr double least_share = .2, most_share = .7, least_reach = .05, most_reach = .2;
constexpr int share_steps = 6, reach_steps = 3;
// What is asked beyond what gradient-domain compression keeps: as far as QuickJudge may be wrong.
constexpr double detail_margin = .0015, order_margin = .005;
constexpr std::size_t least_pixels = 100;
// How fast the share grows with u.
constexpr double growth = .33;
// That layered heights are found for; with others, what (9) gives is about as many times 2 - share.
constexpr double usual_share = .5;

double share_at(double u, double share) {
  return 1 - (1 - share) * std::exp(-growth * u);
}

double span_of(std::span<const double> heights) {
  const auto [low, high] = std::ranges::minmax(heights);
  return high - low;
}

struct Kept {
  double detail = 0, order = 0;
};

struct Found {
  std::optional<double> share;
  bool is_bound_by_order = false;
};

}  // namespace

class Grip::Search {
 public:
  Search(const Surface& surface, const Membrane& membrane, const HeightSystem& system)
      : surface_(surface),
        membrane_(membrane),
        system_(system),
        judge_(surface),
        workspace_(membrane.make_workspace()),
        boundary_weight_(
            boundary_weights(surface.boundary.distance, surface.rho * layered_shape().boundary_width / 2)),
        membrane_heights_(surface.points.size()) {
    const std::vector<double> heights = solved(gradient_slopes(surface));
    compressed_ = judge_.draw(heights);
    compressed_span_ = span_of(heights);
  }

  bool is_possible() const { return judge_.pixels() >= least_pixels && compressed_span_ > 0; }
  double span() const { return span_; }

  // For u, the least share at u = 0.
  Hold tightest(double u) {
    take(u);
    if (const auto hold = tightest()) return *hold;
    asked_.order = 0;
    return tightest().value_or(Hold{most_share, std::sqrt(least_reach * most_reach)});
  }

 private:
  std::vector<double> solved(std::span<const Vec2> slopes) const {
    std::vector<double> heights(slopes.size());
    system_.solve(slopes, heights);
    return heights;
  }

  std::vector<double> layered_heights(double u) const {
    Shape shape = layered_shape();
    shape.compression.u = u;
    shape.hold = Hold{usual_share};
    std::vector<Vec2> slopes(surface_.points.size());
    layered_slopes(
        {surface_.normals, surface_.curvature.k, boundary_weight_, surface_.curvature.delta, surface_.layers},
        shape, slopes);
    return solved(slopes);
  }

  // Makes u the one that holds are tried for.
  void take(double u) {
    u_ = u;
    const std::vector<double> heights = layered_heights(u);
    membrane_.gather(std::span(heights), workspace_);
    heights_ = judge_.draw(heights);
    span_ = span_of(heights);
    Plane as_high = compressed_;
    const auto scale = static_cast<float>(share_at(u, usual_share) * span_ / compressed_span_);
    for (float& z : as_high) z *= scale;
    asked_ = {judge_.detail(as_high) + detail_margin, judge_.order(compressed_) + order_margin};
  }

  Kept kept(double share, double reach) {
    membrane_.settle({share * span_, reach}, workspace_);
    membrane_.lattice().refine(workspace_.sheet[0].b, workspace_.tiles);
    parallel_for(membrane_heights_.size(),
                 [&](std::size_t i) { membrane_heights_[i] = membrane_.at(i, workspace_); });
    Plane z = judge_.draw_smooth(membrane_heights_);
    const auto scale = static_cast<float>((2 - share) / (2 - usual_share));
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = scale * (z[i] + heights_[i]);
    return {judge_.detail(z), judge_.order(z)};
  }

  // Whether that hold keeps what is asked, noting in `found` what it is short of.
  bool is_enough(const Hold& hold, Found& found) {
    const Kept k = kept(share_at(u_, hold.share), hold.reach);
    if (k.detail >= asked_.detail && k.order >= asked_.order) return true;
    found.is_bound_by_order = k.order < asked_.order;
    return false;
  }

  Found least_share_with(double reach) {
    Found found;
    double low = least_share, high = most_share;
    if (!is_enough({high, reach}, found)) return found;
    for (int i = 0; i < share_steps; ++i) {
      const double middle = (low + high) / 2;
      (is_enough({middle, reach}, found) ? high : low) = middle;
    }
    found.share = high;
    return found;
  }

  // Less reach keeps more of the order and less of the detail.
  std::optional<Hold> tightest() {
    std::optional<Hold> best;
    double low = least_reach, high = most_reach, reach = most_reach;
    for (int i = 0; i <= reach_steps; ++i) {
      const Found found = least_share_with(reach);
      if (found.share && (!best || *found.share < best->share)) best = Hold{*found.share, reach};
      if (i == 0 && !found.is_bound_by_order) break;
      (found.is_bound_by_order ? high : low) = reach;
      reach = std::sqrt(low * high);
    }
    return best;
  }

  const Surface& surface_;
  const Membrane& membrane_;
  const HeightSystem& system_;
  QuickJudge judge_;
  Membrane::Workspace workspace_;
  std::vector<float> boundary_weight_, membrane_heights_;  // per point
  Plane compressed_, heights_;                             // drawn: the rival's, and those for u
  double compressed_span_ = 0, span_ = 0, u_ = 0;
  Kept asked_;
};

Grip Grip::find(const Surface& surface, const Membrane& membrane, const HeightSystem& system) {
  Grip grip;
  grip.holds_.fill({most_share, most_reach});
  Search search(surface, membrane, system);
  if (!search.is_possible()) return grip;
  std::array<double, knots.size()> spans;
  for (std::size_t k = 0; k < knots.size(); ++k) {
    grip.holds_[k] = search.tightest(knots[k]);
    spans[k] = search.span();
  }
  // The height that they are held to has to grow with u.
  for (std::size_t k = knots.size() - 1; k-- > 0;) {
    const double most = share_at(knots[k + 1], grip.holds_[k + 1].share) * spans[k + 1] / spans[k] / 1.1;
    const double share = std::min(grip.holds_[k].share, 1 - (1 - most) * std::exp(growth * knots[k]));
    grip.holds_[k].share = std::max(share, least_share);
  }
  return grip;
}

Hold Grip::at(double u) const {
  const double at = std::clamp(std::log2(u / knots[0]), 0.0, static_cast<double>(knots.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(at), knots.size() - 2);
  const auto mix = [&](double Hold::*value) {
    return std::lerp(holds_[k].*value, holds_[k + 1].*value, at - static_cast<double>(k));
  };
  return {share_at(u, mix(&Hold::share)), mix(&Hold::reach)};
}

}  // namespace relievo
