// Makes the frames for FrameMaker if the model uses Method::paper.
#pragma once

#include <array>
#include <optional>

#include "core/stopwatch.h"
#include "relief/paper_relief.h"
#include "relief/sliced_ell_matrix.h"
#include "relievo/relief/frame.h"
#include "relievo/scan/surface.h"

namespace relievo {

// Stores the options in a frame, and allocates its points.
inline void begin_frame(const FrameOptions& options, std::size_t points, Frame& frame) {
  frame.options = options;
  frame.heights.resize(points);
  frame.normals.resize(points);
  frame.times = {};
  frame.is_height_met = true;
}

class PaperFrames {
 public:
  explicit PaperFrames(const ReliefModel& model)
      : relief_(*model.paper()),
        vertex_normals_matrix_(vertex_normal_matrix(
            in_plane(model.surface().points), model.surface().triangulation, model.surface().boundary)) {}

  // Makes the relief. `frame` already has its options and memory for its points.
  void make(Frame& frame) {
    frames_begun_ = 0;  // discards the frames that make_ahead() has begun
    const bool is_known = last_ && last_->wanted == frame.options;
    if (is_known) frame.options.shape = last_->found;
    if (!frame.options.height || is_known)
      raise(frame);
    else
      raise_to(*frame.options.height, frame);
    finish(frame);
    find_normals(frame);
  }

  // Advances the pipeline of section 3.5 of the paper by one step, see FrameMaker::make_ahead(). Three
  // frames are in the pipeline at the same time, each in another stage.
  bool make_ahead(const FrameOptions& options, Frame& frame) {
    std::swap(ahead_[1], ahead_[2]);
    std::swap(ahead_[0], ahead_[1]);
    relief_.hand_over();
    begin_frame(options, relief_.size(), ahead_[0]);
    frames_begun_ = std::min(frames_begun_ + 1, ahead_.size());
    parallel_for(
        frames_begun_,
        [&](std::size_t stage) {
          if (stage == 0) solve(ahead_[0]);
          if (stage == 1) map(ahead_[1]), finish(ahead_[1]);
          if (stage == 2) find_normals(ahead_[2]);
        },
        1);
    if (frames_begun_ == ahead_.size()) std::swap(frame, ahead_[2]);
    return frames_begun_ == ahead_.size();
  }

  std::size_t memory() const { return relief_.memory() + vertex_normals_matrix_.memory(); }

 private:
  struct Found {
    FrameOptions wanted;
    Shape found;
  };

  void solve(Frame& frame) {
    const Stopwatch watch;
    relief_.solve(frame.options.shape);
    frame.times.heights_s += watch.seconds();
    ++frame.times.solves;
  }

  void map(Frame& frame) {
    const Stopwatch watch;
    relief_.map(frame.options.shape, frame.heights);
    const HeightSpan<float> span = span_of(std::span<const float>(frame.heights));
    frame.times.after_solve_s += watch.seconds();
    frame.lowest = span.lowest;
    frame.highest = span.highest;
    frame.height = static_cast<double>(span.size());
  }

  void find_normals(Frame& frame) const {
    const Stopwatch watch;
    vertex_normals_matrix_.normals(frame.heights, frame.normals);
    frame.times.normals_s = watch.seconds();
  }

  double raise(Frame& frame) {
    solve(frame);
    relief_.hand_over();
    map(frame);
    return frame.height;
  }

  void raise_to(double height, Frame& frame) {
    last_.reset();
    const FrameOptions wanted = frame.options;
    frame.is_height_met = search_paper_height(height, frame.options.height_tolerance, frame.options.shape,
                                              [&] { return raise(frame); });
    if (frame.is_height_met) last_ = Found{wanted, frame.options.shape};
  }

  // Scales the heights so that the relief has exactly the requested height.
  static void finish(Frame& frame) {
    if (!frame.options.height || !frame.is_height_met) return;
    const auto scale = static_cast<float>(*frame.options.height / frame.height);
    frame.height = *frame.options.height;
    parallel_for(frame.heights.size(), [&](std::size_t i) { frame.heights[i] *= scale; });
    const HeightSpan<float> span = span_of(std::span<const float>(frame.heights));
    frame.lowest = span.lowest;
    frame.highest = span.highest;
  }

  PaperRelief relief_;
  SlicedEllMatrix vertex_normals_matrix_;
  std::optional<Found> last_;   // the last requested height and the shape found for it
  std::array<Frame, 3> ahead_;  // the frames in the stages: solve, map, normals
  std::size_t frames_begun_ = 0;
};

}  // namespace relievo
