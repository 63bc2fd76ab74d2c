// The frames behind pictures: each is made once, and with one or two solves while a slider moves.
#pragma once

#include <optional>

#include "relievo/relief/frame.h"

namespace relievo::app::studio {

// A frame to draw. It is valid until the cache makes the next one.
struct CachedFrame {
  const Frame* frame = nullptr;
  std::span<const float> gains = {};  // of the frame, if they are wanted, see Shown
  double stretch = 1;                 // factor of the heights in the picture
  bool is_new = false;                // was made for this call
};

// Makes frames of one model, which must outlive the cache. Not for concurrent use.
class FrameCache {
 public:
  FrameCache(const ReliefModel& model, bool wants_gains) : maker_(model), wants_gains_(wants_gains) {}

  // Returns the frame asked for.
  CachedFrame exact(const FrameOptions& wanted);

  // Returns the frame asked for or, if a height is locked, one that nearly has it, which takes one or two solves. The
  // stretch makes up for what is missing, at most 3 %.
  CachedFrame quick(FrameOptions wanted);

  // Returns the height of the highest relief of that shape: that without compression. Steps at depth jumps, which a locked
  // height may add, are left out.
  double highest(FrameOptions wanted);

  // Returns what the last call returned; a null frame before the first.
  CachedFrame last() const { return last_; }

 private:
  FrameMaker maker_;
  bool wants_gains_;
  std::vector<float> gains_;  // of the frame
  Frame frame_;
  Frame spare_;                       // of highest()
  std::optional<FrameOptions> made_;  // options of the frame; none before the first
  CachedFrame last_;
};

}  // namespace relievo::app::studio
