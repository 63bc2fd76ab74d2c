#include "pipeline/formed_body.h"

#include <algorithm>
#include <cmath>

#include "relievo/core/text.h"

namespace relievo {
namespace {

// The largest number of simplifications. On plane ground the first guess of the front's number of triangles
// is right.
constexpr int most_attempts = 4;
constexpr double close_enough = .98;  // share of the triangles asked for

Result<FormedBody> make(FormedFront full, const ReliefOptions& options, Progress* progress) {
  RELIEVO_TRY(FormedFront formed, simplified_front(std::move(full), options, progress));
  RELIEVO_CHECK(check_cancelled(progress));
  RELIEVO_TRY(Body body, make_body(formed.front, formed.height_mm, options));
  return FormedBody{std::move(formed), std::move(body)};
}

// Returns the options with that limit for the front's triangles.
ReliefOptions with_front_limit(ReliefOptions options, double front_triangles) {
  options.triangles = std::max(1., std::floor(front_triangles));
  return options;
}

double count(const FormedBody& made) {
  return static_cast<double>(made.body.solid.triangles.size());
}

// Returns the body whose front has as many triangles as the limit allows, given the full front and the body
// with all triangles.
Result<FormedBody> make_within(const FormedFront& full, const FormedBody& whole, const ReliefOptions& options,
                               Progress* progress) {
  const double most = *options.triangles, in_front = static_cast<double>(whole.body.plate().front_triangles);
  // The bottom of a relief without ground repeats its front.
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
  return option_error("triangles", cat("expected at least ", std::ceil(least),
                                       ", which the outline of this relief and its body need, found ", most));
}

}  // namespace

Result<FormedBody> make_formed_body(FormedFront full, const ReliefOptions& options, Progress* progress) {
  if (!options.triangles) return make(std::move(full), options, progress);
  ReliefOptions unlimited = options;
  unlimited.triangles.reset();
  RELIEVO_TRY(FormedBody whole, make(full, unlimited, progress));
  if (count(whole) <= *options.triangles) return whole;
  return make_within(full, whole, options, progress);
}

}  // namespace relievo
