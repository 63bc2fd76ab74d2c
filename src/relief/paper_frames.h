// Frames of a model of Method::paper, see FrameMaker.
#pragma once

#include <optional>

#include "core/stopwatch.h"
#include "relief/paper_relief.h"
#include "relief/sliced_ell_matrix.h"
#include "relievo/relief/frame.h"
#include "relievo/scan/surface.h"

namespace relievo {

class PaperFrames {
 public:
  explicit PaperFrames(const ReliefModel& model)
      : relief_(*model.paper()),
        normal_matrix_(vertex_normal_matrix(in_plane(model.surface().points), model.surface().triangulation,
                                            model.surface().boundary)) {}

  // Makes the relief; `frame` has its options, and room for its points.
  void make(Frame& frame) {
    const bool is_known = last_ && last_->wanted == frame.options;
    if (is_known) frame.options.shape = last_->found;
    if (!frame.options.height || is_known)
      raise(frame);
    else
      raise_to(*frame.options.height, frame);
    finish(frame);
    const Stopwatch watch;
    normal_matrix_.normals(frame.heights, frame.normals);
    frame.times.normals_s = watch.seconds();
  }

  std::size_t memory() const { return relief_.memory() + normal_matrix_.memory(); }

 private:
  struct Found {
    FrameOptions wanted;
    Shape found;
  };

  double raise(Frame& frame) {
    const Stopwatch watch;
    relief_.solve(frame.options.shape);
    frame.times.heights_s += watch.seconds();
    const Stopwatch mapping;
    relief_.map(frame.options.shape, frame.heights);
    const HeightSpan<float> span = span_of(std::span<const float>(frame.heights));
    frame.times.after_solve_s += mapping.seconds();
    ++frame.times.solves;
    frame.lowest = span.lowest;
    frame.highest = span.highest;
    return frame.height = static_cast<double>(span.size());
  }

  void raise_to(double height, Frame& frame) {
    last_.reset();
    const FrameOptions wanted = frame.options;
    frame.is_height_met = search_paper_height(height, frame.options.height_tolerance, frame.options.shape,
                                              [&] { return raise(frame); });
    if (frame.is_height_met) last_ = Found{wanted, frame.options.shape};
  }

  // Scales the heights to the height asked for, and adds the base.
  void finish(Frame& frame) {
    const bool is_met = frame.options.height && frame.is_height_met;
    const auto scale = static_cast<float>(is_met ? *frame.options.height / frame.height : 1);
    if (is_met) frame.height = *frame.options.height;
    const std::vector<float>* base = frame.options.base.get();
    parallel_for(frame.heights.size(), [&](std::size_t i) {
      frame.heights[i] = scale * frame.heights[i] + (base ? (*base)[i] : 0);
    });
    const HeightSpan<float> span = span_of(std::span<const float>(frame.heights));
    frame.lowest = span.lowest;
    frame.highest = span.highest;
  }

  PaperRelief relief_;
  SlicedEllMatrix normal_matrix_;
  std::optional<Found> last_;  // the shape of the last locked height
};

}  // namespace relievo
