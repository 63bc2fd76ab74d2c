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
  double height_tolerance = 5e-4;  // relative to the locked height; a larger one may save a solve

  bool operator==(const FrameOptions&) const = default;  // bases are equal if they are the same object
};

struct FrameTimes {
  double heights_s = 0;      // t1: weights, slopes, right-hand side, solve; all rounds of a locked height
  double after_solve_s = 0;  // t2: detail or height correction; the mapping from control points
  double normals_s = 0;      // t3: normals
  int solves = 0;            // number of solves: 1, or more for a locked height
};

struct Frame {
  FrameOptions options;           // those used, including the u and the membrane parameters that were found
  std::vector<float> heights;     // heights of the surface's points, in the cloud's units, base included
  std::vector<Vec3f> normals;     // unit length: the mean of the triangles around the point, by their areas
  double height = 0;              // highest minus lowest of 0 and the heights without the base
  float lowest = 0, highest = 0;  // lowest and highest of `heights` and 0, the base plane
  bool is_height_met =
      true;  // false if a locked height is out of reach: then the relief is as high as possible
  FrameTimes times;
};

// Returns the normals of a frame of the surface with these heights, one per point (stage 13).
std::vector<Vec3f> vertex_normals(const Surface& surface, std::span<const float> heights);

// Makes frames of one model. Not for concurrent use. make() allocates nothing for a frame that has been used
// before.
class FrameMaker {
 public:
  // Prepares the memory that frames need. The model must outlive it.
  explicit FrameMaker(const ReliefModel& model);
  FrameMaker(FrameMaker&&) noexcept;
  ~FrameMaker();

  // Overwrites `frame` with the relief asked for. The same options give the same bits, for any number of
  // threads and after any earlier frames. The search for a locked height is an exception: it starts from the
  // u of the last one.
  void make(const FrameOptions& options, Frame& frame);

  // Writes a gain for each point of the frame that was made last: the change of its slope per change of the
  // normal's x and y, for normals at a scale that the points do not resolve. See SurfaceDetail in render.h.
  void write_gains(std::vector<float>& gains) const;

  // Returns the memory used, in bytes, the model's not included.
  std::size_t memory() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
