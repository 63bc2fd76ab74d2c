// The frames behind pictures: each asked for once, and quickly while things move.
#pragma once

#include <memory>
#include <optional>

#include "relievo/session.h"

namespace relievo::studio {

// A frame, and how much higher it is to be drawn. Without a frame there is nothing to draw yet.
struct LiveFrame {
  std::shared_ptr<const Frame> frame;
  double stretch = 1;
  bool is_new = false;  // not the one that was given out before
};

// Asks a session for frames of its model, which has `points` points. While another view is prepared, the
// last frame of the old is given. One thread at a time; the session must outlive it.
class LiveFrames {
 public:
  explicit LiveFrames(Session& session) : session_(session) {}

  // Returns the frame asked for.
  LiveFrame exact(const FrameOptions& wanted, std::size_t points);

  // The same with one solve even if a height is locked: at the u that the last frame's height suggests. What
  // that leaves, at most 3 %, is stretched away.
  LiveFrame quick(const FrameOptions& wanted, std::size_t points);

  // To be called when the session shows another model.
  void forget();

 private:
  std::shared_ptr<const Frame> ask(const FrameOptions& options, std::size_t points);
  std::optional<FrameOptions> guess(const FrameOptions& wanted) const;
  LiveFrame give(std::shared_ptr<const Frame> frame, double stretch);

  Session& session_;
  std::optional<FrameOptions> asked_;   // last
  std::shared_ptr<const Frame> given_;  // last
  double elasticity_ = 1;  // how much ln height changes with ln u, as far as the last two frames tell
};

}  // namespace relievo::studio
