#include "studio/frame_cache.h"

#include <algorithm>
#include <cmath>

namespace relievo::app::studio {
namespace {

// A first guess within this factor of the last height is worth a solve; farther away it would miss.
constexpr double farthest_guess = 1.5;

// From here on weights are 1 to the last bit.
constexpr double uncompressed_u = 1e12;

// Stretching by less than this is not seen while things move.
constexpr double largest_stretch = .03;

// Estimates the elasticity from two frames that differ in u alone; returns `before` for others.
double elasticity_between(const Frame& a, const Frame& b, double before) {
  Shape same = a.options.shape;
  same.compression.u = b.options.shape.compression.u;
  same.membrane = b.options.shape.membrane;  // the model's own depends on u
  const double change = std::log(b.options.shape.compression.u / a.options.shape.compression.u);
  if (!(same == b.options.shape) || !(std::abs(change) > 1e-4) || !(a.height > 0 && b.height > 0))
    return before;
  return std::clamp(std::log(b.height / a.height) / change, .1, 2.0);
}

}  // namespace

CachedFrame FrameCache::exact(const FrameOptions& wanted) {
  const bool is_known = made_ == wanted;
  if (!is_known) {
    Frame& next = frames_[1 - newest_];
    maker_.make(wanted, next);
    if (wants_gains_) maker_.write_gains(gains_);
    if (made_) elasticity_ = elasticity_between(newest(), next, elasticity_);
    newest_ = 1 - newest_;
    made_ = wanted;
  }
  return last_ = {&newest(), gains_, 1, !is_known};
}

CachedFrame FrameCache::quick(const FrameOptions& wanted) {
  const std::optional<FrameOptions> guessed = made_ == wanted ? std::nullopt : guess(wanted);
  if (!guessed) return exact(wanted);
  const CachedFrame made = exact(*guessed);
  const double stretch = made.frame->height > 0 ? *wanted.height / made.frame->height : 0;
  if (!(std::abs(stretch - 1) < largest_stretch)) return exact(wanted);
  return last_ = {made.frame, gains_, stretch, made.is_new};
}

double FrameCache::highest(FrameOptions wanted) {
  wanted.height = std::nullopt;
  wanted.shape.compression.u = uncompressed_u;
  maker_.make(wanted, spare_);
  return spare_.height;
}

std::optional<FrameOptions> FrameCache::guess(const FrameOptions& wanted) const {
  if (!wanted.height || !made_ || !newest().is_height_met || !(newest().height > 0)) return std::nullopt;
  const double ratio = *wanted.height / newest().height;
  if (!(ratio < farthest_guess && ratio > 1 / farthest_guess)) return std::nullopt;
  FrameOptions options = wanted;
  options.height = std::nullopt;
  options.shape.compression.u = newest().options.shape.compression.u * std::pow(ratio, 1 / elasticity_);
  return options;
}

}  // namespace relievo::app::studio
