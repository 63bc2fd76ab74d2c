// Frames: reliefs that are made from a prepared model within milliseconds, in single precision. For final
// output ReliefModel makes reliefs in double precision.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/relief/relief.h"

namespace relievo {

// The options that can change from frame to frame. No change requires a new factorisation. The shape is that of
// make_relief() without options; shape_of() in make_relief.h returns that of other ReliefOptions.
struct FrameOptions {
  Shape shape = layered_shape();
  // A locked height, in units of the cloud: u is searched until the relief has it. mm_per_unit() in
  // make_relief.h converts it.
  std::optional<double> height = {};
  std::shared_ptr<const std::vector<float>> base = {};  // heights of the base, one per point; null is a plane
  double height_tolerance = 5e-4;  // relative to the locked height; a larger tolerance may save a solve

  bool operator==(const FrameOptions&) const = default;  // bases are equal if they are the same object
};

struct FrameTimes {
  double heights_s = 0;      // t1: weights, slopes, right-hand side and solve, summed over all solves
  double after_solve_s = 0;  // t2: detail or height correction, and the extension from control points
  double normals_s = 0;      // t3: normals
  int solves = 0;            // number of solves: 1, or more for a locked height
};

struct Frame {
  FrameOptions options;           // the options used, including the u that was found
  std::vector<float> heights;     // heights of the surface's points, in the cloud's units, base included
  std::vector<Vec3f> normals;     // unit normals: means over the triangles around a point, weighted by area
  double height = 0;              // highest minus lowest height without the base; 0 counts as a height
  float lowest = 0, highest = 0;  // lowest and highest of `heights` and 0, the base plane
  bool is_height_met =
      true;  // false if a locked height is out of reach: then the relief is as high as possible
  FrameTimes times;
};

// Returns the normals of a frame of the surface with these heights, one per point (stage 13).
std::vector<Vec3f> vertex_normals(const Surface& surface, std::span<const float> heights);

// Makes frames of one model. Not for concurrent use. make() allocates nothing if the frame has been used
// before.
class FrameMaker {
 public:
  // Prepares the memory that frames need. The model must outlive it.
  explicit FrameMaker(const ReliefModel& model);
  FrameMaker(FrameMaker&&) noexcept;
  ~FrameMaker();

  // Overwrites `frame` with the relief asked for. The same options give the same bits, for any number of
  // threads and after any earlier frames. Only a frame with a locked height depends on earlier frames,
  // because its search starts from the last u.
  void make(const FrameOptions& options, Frame& frame);

  // Makes frames one step ahead, as section 3.5 of the paper does: each stage has a thread of its own. While
  // the heights of the frame asked for are solved, the frame of the last call is mapped to all points, and the
  // one before gets its normals and is written to `frame`. Returns false, and no frame, for the first two
  // calls, and for the first two after make(). Frames have the bits of make(). This is for models of
  // Method::paper and options without a height; other frames are made at once.
  bool make_ahead(const FrameOptions& options, Frame& frame);

  // Writes a gain for each point of the last frame: the change of the relief's slope per change of the scan
  // normal's x and y. Gains apply to normals at a scale that the points do not resolve, see SurfaceDetail in
  // render.h.
  void write_gains(std::vector<float>& gains) const;

  // Returns the memory used, in bytes, without the model's.
  std::size_t memory() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
