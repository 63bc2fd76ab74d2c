#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/slope_limit.h"
#include "pipeline/body.h"
#include "plate/front/sample_front.h"
#include "plate/front/silhouette.h"
#include "relievo/core/text.h"
#include "relievo/make_relief.h"
#include "relievo/plate/simplify.h"
#include "relievo/relief/draft.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"
#include "scan/jumps.h"

namespace relievo {
namespace {

// Returns the lowest and the highest height of the front, including the ground.
std::pair<double, double> span_of(const HeightFieldMesh& front) {
  double lowest = front.ground_mm, highest = lowest;
  for (const Vec3& p : front.points) lowest = std::min(lowest, p.z()), highest = std::max(highest, p.z());
  return {lowest, highest};
}

// Returns, per triangle, whether it is part of a smooth surface: inside the relief, and not part of a wall at
// a depth jump.
std::vector<std::uint8_t> smooth_triangles(const Surface& surface) {
  std::vector<std::uint8_t> is_smooth(surface.triangulation.triangles.size());
  const Boundary& boundary = surface.boundary;
  for (std::size_t t = 0; t < is_smooth.size(); ++t) {
    const auto& [a, b, c] = surface.triangulation.triangles[t];
    const bool is_wall =
        boundary.is_across_wall(a, b) || boundary.is_across_wall(b, c) || boundary.is_across_wall(c, a);
    is_smooth[t] = boundary.is_inside[t] && !is_wall;
  }
  return is_smooth;
}

// Returns the distance between samples. The default is about a 700th of the width, because the eye cannot
// resolve smaller distances when it sees the whole plate at arm's length. If the surface's sampling distance
// is smaller, the sampling distance is the default.
Result<double> sample_step(const Surface& surface, const ReliefOptions& options) {
  constexpr double samples = 700, most_samples = 10'000;
  const double width_mm = options.effective_width_mm(), least_mm = width_mm / most_samples;
  if (options.resolution_mm && *options.resolution_mm < least_mm)
    return option_error("resolution", cat("expected at least ", least_mm, " mm, a ", most_samples,
                                          "th of the width, found ", *options.resolution_mm, " mm"));
  return options.resolution_mm.value_or(
      std::min(width_mm / samples, surface.rho * mm_per_unit(surface, options)));
}

// Returns, for each point of a front, whether its height must not change: it is on the ground, or is the
// highest or the lowest point.
std::vector<std::uint8_t> fixed_points(const HeightFieldMesh& front) {
  std::vector<std::uint8_t> is_fixed;
  for (const Vec3& p : front.points) is_fixed.push_back(p.z() == front.ground_mm);
  const auto [lowest, highest] =
      std::ranges::minmax_element(front.points, {}, [](const Vec3& p) { return p.z(); });
  for (const auto extreme : {lowest, highest})
    is_fixed[static_cast<std::size_t>(extreme - front.points.begin())] = 1;
  return is_fixed;
}

// Limits the slopes of a sampled front on its base to the draft angle. Points on the ground, the highest and
// the lowest point do not move, and no point leaves the range between the highest and the lowest. Returns
// whether that is possible. Errors: those of base_heights_mm().
Result<bool> keep_draft(HeightFieldMesh& front, const ReliefOptions& options) {
  RELIEVO_TRY(const std::vector<double> base, base_heights_mm(front, options));
  std::vector<std::uint8_t> is_fixed = fixed_points(front);
  std::vector<Triangle> free = front.triangles;
  std::erase_if(
      free, [&](const Triangle& t) { return std::ranges::all_of(t, [&](Index i) { return is_fixed[i]; }); });
  const std::vector<Vec2> plane = in_plane(front.points);
  const double max_slope = kept_slope * slope_at_draft(*options.draft_deg);
  const auto [low, high] = span_of(front);
  for (bool is_within = false; !is_within;) {
    std::vector<double> heights;
    for (std::size_t i = 0; i < plane.size(); ++i)
      heights.push_back(front.points[i].z() + (base.empty() ? 0 : base[i]));
    const std::vector<double> before = heights;
    if (!limit_slopes({plane, free, is_fixed}, max_slope, Rounding::none, heights)) return false;
    is_within = true;
    for (std::size_t i = 0; i < plane.size(); ++i) {
      const double moved = front.points[i].z() + (heights[i] - before[i]);
      front.points[i].z() = std::clamp(moved, low, high);
      if (front.points[i].z() != moved) is_fixed[i] = 1, is_within = false;
    }
  }
  return true;
}

// Samples the smooth surface of a front. Returns the front unchanged if it is a lithophane, whose heights are
// not those of a surface, or if the samples cannot satisfy the draft angle.
Result<HeightFieldMesh> sampled(HeightFieldMesh front, const Surface& surface,
                                std::span<const std::uint8_t> is_smooth, const ReliefOptions& options,
                                const Progress* progress) {
  if (options.form == Form::lithophane) return front;
  RELIEVO_TRY(const double step_mm, sample_step(surface, options));
  RELIEVO_TRY(HeightFieldMesh samples, sample_front(front, is_smooth, {step_mm}, progress));
  if (!options.draft_deg) return samples;
  RELIEVO_TRY(const bool keeps_draft, keep_draft(samples, options));
  return keeps_draft ? std::move(samples) : std::move(front);
}

// The front is simplified at most this often to find how many triangles it may have, or with which tolerance.
constexpr int most_attempts = 4, most_tolerances = 8;
constexpr double close_enough = .98;  // this share of the requested number of triangles suffices
constexpr double first_tolerance_mm = .05;

Result<FormedBody> make(FormedFront full, const ReliefOptions& options, Progress* progress) {
  RELIEVO_TRY(FormedFront formed, simplified_front(std::move(full), options, progress));
  RELIEVO_CHECK(check_cancelled(progress));
  RELIEVO_TRY(Body body, make_body(formed.front, formed.height_mm, options));
  return FormedBody{std::move(formed), std::move(body)};
}

// Returns the options with `front_triangles` as the limit for the number of the front's triangles.
ReliefOptions with_front_limit(ReliefOptions options, double front_triangles) {
  options.triangles = std::max(1., std::floor(front_triangles));
  return options;
}

double count(const FormedBody& made) {
  return static_cast<double>(made.body.solid.triangles.size());
}

std::unexpected<Error> too_few_triangles(double least, double most) {
  return option_error("triangles", cat("expected at least ", std::ceil(least),
                                       ", which the outline of this relief and its body need, found ", most));
}

// Returns a body whose front has nearly as many triangles as the limit for the solid allows. `full` is the
// front before simplification, and `whole` is the body that was made without the limit.
Result<FormedBody> make_within(const FormedFront& full, const FormedBody& whole, const ReliefOptions& options,
                               Progress* progress) {
  const double most = *options.triangles, in_front = static_cast<double>(whole.body.plate().front_triangles);
  // For a relief without ground, each triangle of the front counts twice, because the bottom repeats the
  // front.
  const double sides = options.outline == Outline::none ? 2 : 1;
  double limit = (most - (count(whole) - sides * in_front)) / sides;
  double least = count(whole);
  std::optional<FormedBody> best;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    RELIEVO_TRY(FormedBody made, make(full, with_front_limit(options, limit), progress));
    const double made_count = count(made);
    least = std::min(least, made_count);
    if (made_count <= most && (!best || made_count > count(*best))) best = std::move(made);
    const bool is_close = made_count <= most && made_count > close_enough * most;
    if (is_close || limit < 1) break;
    limit = std::max(0., limit + 1.005 * (most - made_count) / sides);
  }
  if (best) return std::move(*best);
  return too_few_triangles(least, most);
}

// A body that was made with a tolerance, and the tolerances between which the best one lies.
struct ToleranceSearch {
  double most;                          // largest number of triangles
  double most_tolerance_mm;             // with larger tolerances, the front could cross the back
  double least;                         // smallest number of triangles so far
  std::optional<FormedBody> best = {};  // has the most triangles of those within the limit
  double too_fine_mm = 0, coarse_mm = std::numeric_limits<double>::infinity();

  void take(FormedBody made, double tolerance_mm) {
    least = std::min(least, count(made));
    (count(made) > most ? too_fine_mm : coarse_mm) = tolerance_mm;
    if (count(made) <= most && (!best || count(made) > count(*best))) best = std::move(made);
  }

  bool is_over() const {
    return (best && count(*best) > close_enough * most) || coarse_mm < 1.01 * too_fine_mm ||
           too_fine_mm >= most_tolerance_mm;
  }

  // Returns the next tolerance. The number of triangles is about inversely proportional to the tolerance, unless most
  // triangles follow an outline.
  double next(double tolerance_mm, double count) const {
    const double ratio = count / (.99 * most), next_mm = tolerance_mm * (best ? ratio : std::max(3., ratio));
    const bool is_between = next_mm > too_fine_mm && next_mm < coarse_mm;
    return std::min(most_tolerance_mm, is_between ? next_mm : std::sqrt(too_fine_mm * coarse_mm));
  }
};

// Returns a body on a curved surface that has nearly as many triangles as allowed. Ground, walls and back follow that
// surface, too, so the tolerance is chosen with which the whole body has that many. `whole` has too many triangles.
Result<FormedBody> make_curved_within(const FormedFront& full, const FormedBody& whole, ReliefOptions options,
                                      Progress* progress) {
  ToleranceSearch search{.most = *options.triangles,
                         .most_tolerance_mm = options.effective_thickness_mm() / 2,
                         .least = count(whole),
                         .too_fine_mm = options.tolerance_mm.value_or(0)};
  options.triangles.reset();
  double tolerance_mm =
      options.tolerance_mm ? search.next(*options.tolerance_mm, count(whole)) : first_tolerance_mm;
  for (int attempt = 0; attempt < most_tolerances && !search.is_over(); ++attempt) {
    options.tolerance_mm = tolerance_mm;
    RELIEVO_TRY(FormedBody made, make(full, options, progress));
    const double made_count = count(made);
    search.take(std::move(made), tolerance_mm);
    tolerance_mm = search.next(tolerance_mm, made_count);
  }
  if (search.best) return std::move(*search.best);
  return too_few_triangles(search.least, search.most);
}

}  // namespace

HeightFieldMesh front_in_mm(const Surface& surface, const std::vector<double>& heights, double mm_per_unit) {
  HeightFieldMesh front{std::vector<Vec3>(surface.points.size()), surface.triangulation.triangles,
                        surface.triangulation.hull};
  for (std::size_t i = 0; i < front.points.size(); ++i) {
    const Vec3& p = surface.points[i];
    front.points[i] = mm_per_unit * Vec3(p.x(), p.y(), heights[i]);
  }
  front.colours = surface.colours;
  return front;
}

Result<std::vector<double>> base_heights_mm(const HeightFieldMesh& front, const ReliefOptions& options) {
  if (options.base.kind == BaseKind::plane) return std::vector<double>();
  ReliefOptions upright = options;
  upright.form = Form::relief;
  RELIEVO_TRY(const Base base, plate_base(front, plate_of(upright, 1)));
  std::vector<double> heights;
  for (const Vec3& p : front.points) heights.push_back(base.height(p.head<2>()));
  return heights;
}

Result<FormedFront> full_front(const Surface& surface, const Relief& relief, const ReliefOptions& options,
                               const Progress* progress) {
  const double scale = mm_per_unit(surface, options);
  FormedFront made;
  if (options.form == Form::lithophane) {
    made.height_mm = options.usual_height_mm();
    made.front = lithophane(surface, scale, made.height_mm);
  } else {
    made.height_mm = relief.height * scale;
    made.front = front_in_mm(surface, relief.heights, scale);
  }
  std::vector<std::uint8_t> is_smooth = smooth_triangles(surface);
  if (options.outline == Outline::none) made.front.is_relief = surface.boundary.is_inside;
  if (options.mm_per_value) {
    raise_walls(made.front, surface);
    is_smooth.resize(made.front.triangles.size());  // the walls were added at the end; they are not smooth
    if (options.outline == Outline::none) made.front.is_relief.resize(is_smooth.size(), 1);
  }
  RELIEVO_TRY(made.front, sampled(std::move(made.front), surface, is_smooth, options, progress));
  made.full_triangles = made.front.triangles.size();
  if (options.form == Form::mirror) made.front = mirrored(std::move(made.front));
  if (options.form == Form::die) made.front = as_die(std::move(made.front));
  return made;
}

Result<FormedFront> simplified_front(FormedFront full, const ReliefOptions& options, Progress* progress) {
  if (is_simplified(options) && !is_simplified_as_plate(options)) {
    RELIEVO_TRY(SimplifiedMesh simpler, simplify(full.front, simplest_front(options), progress));
    full.front = std::move(simpler.front);
    full.simplification_error_mm = simpler.error_mm;
  }
  if (!full.front.is_relief.empty()) full.front = relief_alone(full.front);
  return full;
}

double depth_below_ground(const HeightFieldMesh& front) {
  return front.ground_mm - span_of(front).first;
}

Result<FormedBody> make_formed_body(FormedFront full, const ReliefOptions& options, Progress* progress) {
  if (!options.triangles) return make(std::move(full), options, progress);
  ReliefOptions unlimited = options;
  unlimited.triangles.reset();
  RELIEVO_TRY(FormedBody whole, make(full, unlimited, progress));
  if (count(whole) <= *options.triangles) return whole;
  return is_curved(options) ? make_curved_within(full, whole, options, progress)
                            : make_within(full, whole, options, progress);
}

}  // namespace relievo
