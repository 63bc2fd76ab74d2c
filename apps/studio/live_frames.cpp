#include "live_frames.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace relievo::studio {
namespace {

using namespace std::chrono_literals;

// What two frames that differ in u alone tell of the elasticity; else `before`.
double elasticity_between(const Frame& a, const Frame& b, double before) {
  Shape same = a.options.shape;
  same.compression.u = b.options.shape.compression.u;
  same.hold = b.options.shape.hold;  // the model's own depends on u
  const double change = std::log(b.options.shape.compression.u / a.options.shape.compression.u);
  if (!(same == b.options.shape) || !(std::abs(change) > 1e-4) || !(a.height > 0 && b.height > 0))
    return before;
  return std::clamp(std::log(b.height / a.height) / change, .1, 2.0);
}

}  // namespace

LiveFrame LiveFrames::exact(const FrameOptions& wanted, std::size_t points) {
  return give(ask(wanted, points), 1);
}

LiveFrame LiveFrames::quick(const FrameOptions& wanted, std::size_t points) {
  const bool is_known = asked_ == wanted;
  const std::optional<FrameOptions> guessed = is_known ? std::nullopt : guess(wanted);
  if (!guessed) return exact(wanted, points);
  const auto frame = ask(*guessed, points);
  const double stretch = frame && frame->height > 0 ? *wanted.height / frame->height : 0;
  return std::abs(stretch - 1) < .03 ? give(frame, stretch) : exact(wanted, points);
}

void LiveFrames::forget() {
  asked_ = std::nullopt;
  given_ = nullptr;
}

// Light and camera are no part of a frame: it need not be made again for them.
std::shared_ptr<const Frame> LiveFrames::ask(const FrameOptions& options, std::size_t points) {
  if (!session_.status().is_preparing && asked_ != options) {
    asked_ = options;
    session_.request(options);
    session_.wait_until_idle(10s);
  }
  std::shared_ptr<const Frame> frame = session_.frame();
  return frame && frame->heights.size() == points ? frame : nullptr;
}

std::optional<FrameOptions> LiveFrames::guess(const FrameOptions& wanted) const {
  if (!wanted.height || !given_ || !given_->is_height_met || !(given_->height > 0)) return std::nullopt;
  const double ratio = *wanted.height / given_->height, far = 1.5;
  if (!(ratio < far && ratio > 1 / far)) return std::nullopt;
  FrameOptions options = wanted;
  options.height = std::nullopt;
  options.shape.compression.u = given_->options.shape.compression.u * std::pow(ratio, 1 / elasticity_);
  return options;
}

LiveFrame LiveFrames::give(std::shared_ptr<const Frame> frame, double stretch) {
  const bool is_new = given_ != frame;
  if (frame && given_) elasticity_ = elasticity_between(*given_, *frame, elasticity_);
  if (frame) given_ = frame;
  return {std::move(frame), stretch, is_new};
}

}  // namespace relievo::studio
