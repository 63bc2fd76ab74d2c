#include "grip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/extent.h"
#include "quality/plane_measures.h"
#include "relievo/core/parallel.h"
#include "relievo/detail.h"
#include "relievo/quality/measures.h"
#include "yardstick.h"

namespace relievo {
namespace {

// Shares, as for u = 0, and reaches that are tried. Beyond the usual most, shading and angle of thin figures
// fall behind equalisation's, so that only order is worth it.
constexpr double least_share = .2, usual_most_share = .75, most_share = 1, least_reach = .035,
                 most_reach = .2;
// How finely: halved that often. Before each search estimates are set right by a whole relief.
constexpr int reach_steps = 4;
constexpr std::array<int, 2> share_steps{3, 6};
// What is asked beyond what gradient-domain compression keeps: what corrections leave, and as far as holds
// may be wrong between the u that they are found for.
constexpr Kept margin{.0003, .002};
// How fast the share grows with u.
constexpr double growth = .25;
// Of the longer side: between points further apart there is no such detail as is measured.
constexpr double coarsest_rho = static_cast<double>(detail_scales_px.back()) / Judge::longer_side_px;
// Where the search starts, and what stays where nothing can be measured.
constexpr Hold usual{.5};

double share_at(double u, double share) {
  return 1 - (1 - share) * std::exp(-growth * u);
}

struct Lacks {
  bool detail, order;
  bool any() const { return detail || order; }
};

struct Found {
  std::optional<double> share;
  Lacks bound;  // what keeps it from being less
};

// Of the holds for one u.
class Search {
 public:
  Search(const Yardstick& yardstick, double u)
      : yardstick_(yardstick), u_(u), workspace_(yardstick.membrane().make_workspace()) {
    usual_heights_ = yardstick.heights(u, held(usual));
    yardstick.membrane().gather(std::span<const double>(usual_heights_), workspace_);
    drawn_ = yardstick.judge().draw(usual_heights_);
    span_ = height_span(usual_heights_);
  }

  // What (9) gives at a share of 1, about.
  double span() const { return span_ / (2 - held(usual).share); }

  Hold tightest() {
    Hold hold = usual;
    for (const int steps : share_steps) {
      steps_ = steps;
      const Lacks lacking =
          set_right_by(hold, hold == usual ? usual_heights_ : yardstick_.heights(u_, held(hold)));
      hold = tightest_by_estimate(lacking.any() ? std::nullopt : std::optional(hold));
    }
    return held(hold);
  }

 private:
  Hold held(const Hold& hold) const { return {share_at(u_, hold.share), hold.reach}; }

  // By estimate. For other holds than the usual, what (9) gives is about as many times 2 - share.
  Kept kept(const Hold& hold) {
    const double share = held(hold).share;
    yardstick_.membrane().settle(Membrane::Limits::of(share * span_, held(hold)), workspace_);
    const QuickJudge& judge = yardstick_.judge();
    Plane z = judge.draw_smooth([&](Index p) { return yardstick_.membrane().at(p, workspace_); });
    const auto scale = static_cast<float>((2 - share) / (2 - held(usual).share));
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = scale * (z[i] + drawn_[i]);
    return judge.kept(z);
  }

  // Has estimates of that hold lack what its relief does, and returns that.
  Lacks set_right_by(const Hold& hold, std::vector<double> heights) {
    const Kept lacking = yardstick_.lacking(std::move(heights), held(hold)), estimate = kept(hold);
    asked_ = {estimate.detail + lacking.detail + margin.detail,
              estimate.order + lacking.order + margin.order};
    least_shortfall_ = std::numeric_limits<double>::infinity();
    return compared(hold, estimate);
  }

  Lacks lacks(const Hold& hold) { return compared(hold, kept(hold)); }

  // With what is asked.
  Lacks compared(const Hold& hold, const Kept& k) {
    const double detail = std::max(asked_.detail - k.detail, 0.0),
                 order = std::max(asked_.order - k.order, 0.0);
    const double shortfall = detail / margin.detail + order / margin.order;
    if (shortfall < least_shortfall_) least_shortfall_ = shortfall, nearest_ = hold;
    return {detail > 0, order > 0};
  }

  // None if that is more than `known`, of another reach, or for the detail alone more than usual.
  Found least_share_with(double reach, double known) {
    double low = least_share, high = std::min(known, usual_most_share);
    Lacks lacking = lacks({high, reach});
    if (lacking.order && high < known) {
      low = high, high = known;
      lacking = lacks({high, reach});
    }
    if (lacking.any()) return {{}, lacking};
    Lacks bound{false, high > usual_most_share};
    for (int i = 0; i < steps_; ++i) {
      const double middle = (low + high) / 2;
      lacking = lacks({middle, reach});
      (lacking.any() ? low : high) = middle;
      if (lacking.any()) bound = lacking;
    }
    return {high, bound};
  }

  // From the best that is known, if any does: what cannot be tighter is soon told. Less reach keeps more of
  // the order and less of the detail. Where nothing keeps both, what comes nearest.
  Hold tightest_by_estimate(std::optional<Hold> best) {
    double low = least_reach, high = most_reach, reach = most_reach;
    for (int i = 0; i <= reach_steps; ++i) {
      const auto [share, bound] = least_share_with(reach, best ? best->share : most_share);
      if (share && (!best || *share < best->share)) best = Hold{*share, reach};
      // Where neither is kept, less reach keeps no more; but of the most there is only less.
      const bool is_less_better = bound.order && (share || !bound.detail || i == 0);
      if (i == 0 && !is_less_better) break;
      (is_less_better ? high : low) = reach;
      reach = std::sqrt(low * high);
    }
    return best.value_or(nearest_);
  }

  const Yardstick& yardstick_;
  double u_, span_ = 0;
  int steps_ = 0;
  Membrane::Workspace workspace_;
  std::vector<double> usual_heights_;  // not yet held
  Plane drawn_;
  Kept asked_;
  Hold nearest_;
  double least_shortfall_ = 0;
};

}  // namespace

Result<Grip> Grip::find(const Surface& surface, const Membrane& membrane, const HeightSystem& system,
                        const Progress* progress) {
  Grip grip;
  for (std::size_t k = 0; k < knots.size(); ++k) grip.holds_[k] = {share_at(knots[k], usual.share)};
  if (surface.rho > coarsest_rho * longer_side_of(surface.points)) return grip;
  const Yardstick yardstick(surface, membrane, system);
  if (!yardstick.is_of_use()) return grip;
  std::array<double, knots.size()> spans;
  const auto is_cancelled = [&] { return progress && progress->is_cancelled(); };
  const auto find_hold = [&](std::size_t k) {
    if (is_cancelled()) return;
    Search search(yardstick, knots[k]);
    grip.holds_[k] = search.tightest();
    spans[k] = search.span();
  };
  parallel_for(knots.size(), find_hold, 1);
  if (is_cancelled()) return std::unexpected(Error{ErrorKind::cancelled, {}, {}, "cancelled"});
  // The height that they are held to has to grow with u.
  for (std::size_t k = knots.size() - 1; k-- > 0;) {
    const double most = grip.holds_[k + 1].share * spans[k + 1] / spans[k] / 1.1;
    grip.holds_[k].share = std::min(grip.holds_[k].share, most);
  }
  return grip;
}

Hold Grip::at(double u) const {
  const Hold& last = holds_.back();
  if (u > knots.back()) return {share_at(u - knots.back(), last.share), last.reach};
  const double at = std::max(std::log(u / knots[0]) / std::log(knots[1] / knots[0]), 0.0);
  const auto k = std::min(static_cast<std::size_t>(at), knots.size() - 2);
  const double part = at - static_cast<double>(k);
  const Hold &before = holds_[k], &after = holds_[k + 1];
  // What the membrane's energy has.
  const auto pull = [](const Hold& hold) { return 1 / (hold.reach * hold.reach); };
  return {std::lerp(before.share, after.share, part),
          1 / std::sqrt(std::lerp(pull(before), pull(after), part))};
}

}  // namespace relievo
