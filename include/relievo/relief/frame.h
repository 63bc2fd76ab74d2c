// Frames: reliefs in milliseconds, in single precision, from a prepared model. ReliefModel makes the final
// output.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/relief/relief.h"

namespace relievo {

// The quantities that can change from frame to frame. None of them touches the factorisation.
struct FrameOptions {
  Shape shape;
  std::optional<double> height;                    // locked: u is found so that this height is met
  std::shared_ptr<const std::vector<float>> base;  // added to the heights, per point; null is a plane
  double height_tolerance = 5e-4;  // share of the locked height; a larger one may save a solve

  bool operator==(const FrameOptions&) const = default;  // bases are equal if they are the same object
};

struct FrameTimes {
  double heights_s = 0;      // t1: weights, slopes, right-hand side, solve; all rounds of a locked height
  double after_solve_s = 0;  // t2: detail or height correction; the mapping from control points
  double normals_s = 0;      // t3: normals
  int solves = 0;            // 1, or as many as a locked height took
};

struct Frame {
  FrameOptions options;  // what it was made with, including the u and the membrane parameters that were found
  std::vector<float> heights;     // per point of the surface, in the cloud's units, base included
  std::vector<Vec3f> normals;     // unit length: the mean of the triangles around the point, by their areas
  double height = 0;              // highest minus lowest; 0 counts as a height, the base's shape is not added
  float lowest = 0, highest = 0;  // of `heights`, base plane and base shape included
  bool is_height_met =
      true;  // false if a locked height is out of reach: then the relief is as high as can be
  FrameTimes times;
};

// Returns the normals that a frame of the surface with these heights, one per point, has (stage 13).
std::vector<Vec3f> vertex_normals(const Surface& surface, std::span<const float> heights);

// Makes frames of one model. Not for concurrent use. Allocates nothing per frame once a frame has its size.
class FrameMaker {
 public:
  // Prepares the memory that frames need. The model must outlive it.
  explicit FrameMaker(const ReliefModel& model);
  FrameMaker(FrameMaker&&) noexcept;
  ~FrameMaker();

  // Overwrites `frame` with the relief asked for. The same options give the same bits, for any number of
  // threads and whatever was made before; but a locked height is searched from where the last one was found.
  void make(const FrameOptions& options, Frame& frame);

  // Writes, for each point of the frame that was made last, by how much its slope would change with the x and y of a
  // normal that differs from the point's at a scale that the points do not resolve. See SurfaceDetail in render.h.
  void write_gains(std::vector<float>& gains) const;

  // Bytes held, the model's not included.
  std::size_t memory() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
