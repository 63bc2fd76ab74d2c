// Makes frames, which are reliefs of a prepared model, in milliseconds and single precision. ReliefModel
// makes final reliefs in double precision.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "relievo/core/types.h"
#include "relievo/relief/relief.h"

namespace relievo {

// The options that can change from frame to frame; none requires a new factorisation. The default shape is
// that of make_relief() without options; shape_of() in make_relief.h returns the shape for other
// ReliefOptions.
struct FrameOptions {
  Shape shape = layered_shape();
  // The height of the frame in units of the cloud. If it is set, make() searches for the u that gives it.
  // mm_per_unit() in make_relief.h gives the conversion to millimetres.
  std::optional<double> height = {};
  double height_tolerance = 5e-4;  // relative error of `height`; a larger tolerance can save a solve

  bool operator==(const FrameOptions&) const = default;
};

struct FrameTimes {
  double heights_s = 0;      // the paper's t1: weights, slopes, right-hand side and solve, for all solves
  double after_solve_s = 0;  // the paper's t2: detail or height correction, and extension to all points
  double normals_s = 0;      // the paper's t3: normals
  int solves = 0;            // number of solves: 1, or more for a given height
};

struct Frame {
  FrameOptions options;           // the effective options, including the u that was found
  std::vector<float> heights;     // heights of the surface's points, in the cloud's units
  std::vector<Vec3f> normals;     // unit normals: area-weighted means over the triangles around a point
  double height = 0;              // highest minus lowest height; the base, at height 0, counts as a height
  float lowest = 0, highest = 0;  // lowest and highest height; the base, at height 0, counts as a height
  bool is_height_met =
      true;  // false if no u gives the height of the options; the relief is then as high as possible
  FrameTimes times;
};

// Returns the normals of the surface with these heights, one per point (stage 13).
std::vector<Vec3f> vertex_normals(const Surface& surface, std::span<const float> heights);

// Makes frames of one model. make() allocates nothing if the frame has been used before. Not for concurrent
// use.
class FrameMaker {
 public:
  // Allocates the memory for frames. The model must outlive this object.
  explicit FrameMaker(const ReliefModel& model);
  FrameMaker(FrameMaker&&) noexcept;
  ~FrameMaker();

  // Overwrites `frame` with the requested relief. The same options give the same bits for any number of
  // threads. If the options have a height, the bits also depend on the previous frames, because the search
  // for u starts from the last result.
  void make(const FrameOptions& options, Frame& frame);

  // Makes frames in a pipeline of three stages, as in section 3.5 of the paper. The stages run at the same
  // time on up to three threads: one solves the heights of the requested frame, one extends the previous
  // frame to all points, and one computes the normals of the frame before the previous one and writes it to
  // `frame`. Returns false, and no frame, in the first two calls and in the first two calls after make().
  // Frames have the same bits as those of make(). The pipeline is used only for models of Method::paper and
  // options without a height. For all others this function calls make().
  bool make_ahead(const FrameOptions& options, Frame& frame);

  // Writes a gain for each point of the last frame: the derivative of the relief's slope with respect to the
  // x and y of the scan's normal. Gains are for detail that is finer than the points, see SurfaceDetail.
  void write_gains(std::vector<float>& gains) const;

  // Returns the number of bytes of memory in use, without the model.
  std::size_t memory() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
