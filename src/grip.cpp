#include "grip.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "extent.h"
#include "quick_judge.h"
#include "relievo/detail.h"
#include "relievo/gradient_slopes.h"
#include "relievo/parallel.h"
#include "slope_input.h"

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
// Of the longer side: between points further apart there is no such detail as is measured, 4 px of 512.
constexpr double coarsest_rho = 4. / 512;
// Where no hold keeps the detail; where nothing can be measured.
constexpr Hold loosest{most_share}, usual{.5};

double share_at(double u, double share) {
  return 1 - (1 - share) * std::exp(-growth * u);
}

struct Kept {
  double detail = 0, order = 0;
};

struct Found {
  std::optional<double> share;
  bool is_bound_by_order = false;
};

// A model, and gradient-domain compression of it to measure by.
struct Yardstick {
  const Surface& surface;
  const HeightSystem& system;
  QuickJudge judge{surface};
  std::vector<float> boundary_weight;
  Plane compressed;  // drawn
  double compressed_span = 0, compressed_order = 0;

  Yardstick(const Surface& s, const HeightSystem& h) : surface(s), system(h) {
    const double rho = boundary_rho(surface, layered_shape().boundary_width);
    boundary_weight = boundary_weights(surface.boundary.distance, rho);
    const std::vector<double> heights = solved(gradient_slopes(surface));
    compressed = judge.draw(heights);
    compressed_span = height_span(heights);
    compressed_order = judge.order(compressed);
  }

  bool is_of_use() const { return judge.pixels() >= least_pixels && compressed_span > 0; }

  std::vector<double> solved(std::span<const Vec2> slopes) const {
    std::vector<double> heights(slopes.size());
    system.solve(slopes, heights);
    return heights;
  }

  // For the usual hold; for others, what (9) gives is about as many times 2 - share.
  std::vector<double> layered_heights(double u) const {
    Shape shape = layered_shape();
    shape.compression.u = u;
    shape.hold = usual;
    std::vector<Vec2> slopes(surface.points.size());
    layered_slopes(slope_input(surface, boundary_weight), shape, slopes);
    return solved(slopes);
  }

  // What compression as high as that keeps, and a little more.
  Kept asked(double span) const {
    Plane as_high = compressed;
    for (float& z : as_high) z *= static_cast<float>(span / compressed_span);
    return {judge.detail(as_high) + detail_margin, compressed_order + order_margin};
  }
};

// Of the holds for one u.
class Search {
 public:
  Search(const Yardstick& yardstick, const Membrane& membrane, double u)
      : judge_(yardstick.judge),
        membrane_(membrane),
        u_(u),
        workspace_(membrane.make_workspace()),
        membrane_heights_(yardstick.surface.points.size()) {
    const std::vector<double> heights = yardstick.layered_heights(u);
    membrane_.gather(std::span(heights), workspace_);
    heights_ = judge_.draw(heights);
    span_ = height_span(heights);
    asked_ = yardstick.asked(share_at(u, usual.share) * span_);
  }

  double span() const { return span_; }

  Hold tightest() {
    if (const auto hold = tightest_of_all()) return *hold;
    asked_.order = 0;
    return tightest_of_all().value_or(loosest);
  }

 private:
  Kept kept(double share, double reach) {
    membrane_.settle({share * span_, reach}, workspace_);
    parallel_for(membrane_heights_.size(),
                 [&](std::size_t i) { membrane_heights_[i] = membrane_.at(i, workspace_); });
    Plane z = judge_.draw_smooth(membrane_heights_);
    const auto scale = static_cast<float>((2 - share) / (2 - usual.share));
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
  std::optional<Hold> tightest_of_all() {
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

  const QuickJudge& judge_;
  const Membrane& membrane_;
  double u_, span_ = 0;
  Membrane::Workspace workspace_;
  std::vector<float> membrane_heights_;  // per point
  Plane heights_;                        // drawn
  Kept asked_;
};

}  // namespace

Result<Grip> Grip::find(const Surface& surface, const Membrane& membrane, const HeightSystem& system,
                        const Progress* progress) {
  Grip grip;
  grip.holds_.fill(usual);
  if (surface.rho > coarsest_rho * longer_side_of(surface.points)) return grip;
  const Yardstick yardstick(surface, system);
  if (!yardstick.is_of_use()) return grip;
  std::array<double, knots.size()> spans;
  const auto is_cancelled = [&] { return progress && progress->is_cancelled(); };
  const auto find_hold = [&](std::size_t k) {
    if (is_cancelled()) return;
    Search search(yardstick, membrane, knots[k]);
    grip.holds_[k] = search.tightest();
    spans[k] = search.span();
  };
  parallel_for(knots.size(), find_hold, 1);
  if (is_cancelled()) return std::unexpected(Error{ErrorKind::cancelled, {}, {}, "cancelled"});
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
