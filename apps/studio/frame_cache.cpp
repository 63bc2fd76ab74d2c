#include "studio/frame_cache.h"

namespace relievo::app::studio {
namespace {

// From here on weights are 1 to the last bit.
constexpr double uncompressed_u = 1e12;

// Stretching by less than this is not seen while things move.
constexpr double moving_tolerance = .03;

}  // namespace

CachedFrame FrameCache::exact(const FrameOptions& wanted) {
  const bool is_known = made_ == wanted;
  if (!is_known) {
    made_.reset();  // so that nobody takes a frame for it that was only begun when memory ran out
    last_ = {};
    maker_.make(wanted, frame_);
    if (wants_gains_) maker_.write_gains(gains_);
    made_ = wanted;
  }
  return last_ = {&frame_, gains_, 1, !is_known};
}

CachedFrame FrameCache::quick(FrameOptions wanted) {
  if (!wanted.height || made_ == wanted) return exact(wanted);
  wanted.height_tolerance = moving_tolerance;
  CachedFrame made = exact(wanted);
  if (made.frame->is_height_met) made.stretch = *wanted.height / made.frame->height;
  return last_ = made;
}

double FrameCache::highest(FrameOptions wanted) {
  wanted.height = std::nullopt;
  wanted.shape.compression.u = uncompressed_u;
  maker_.make(wanted, spare_);
  return spare_.height;
}

}  // namespace relievo::app::studio
