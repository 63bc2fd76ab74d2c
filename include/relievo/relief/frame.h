// Frames: reliefs in milliseconds, in single precision, from a prepared model. For the final output see
// ReliefModel.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "relievo/relief.h"

namespace relievo {

// All that can change from frame to frame. Nothing here touches the factorisation.
struct FrameOptions {
  Shape shape;
  std::optional<double> height;   // locked: shape.compression.u is found so that this height is met to 0.1 %
  Vec3f light = Vec3f(-1, 1, 1);  // towards the light, not zero
  std::shared_ptr<const std::vector<float>> base;  // added to the heights, per point; none is a plane

  bool operator==(const FrameOptions&) const = default;  // bases are alike if they are the same
};

struct FrameTimes {
  double heights_s = 0;  // t1: weights, slopes, right-hand side, solve; all rounds of a locked height
  double detail_s = 0;   // t2: detail, or holding heights within their span; the mapping from control points
  double normals_s = 0;  // t3: normals and shading
  int solves = 0;        // 1, or as many as a locked height took
};

struct Frame {
  FrameOptions options;        // what it was made with, compression and hold that were found included
  std::vector<float> heights;  // per point of the surface, in the cloud's units, base included
  std::vector<Vec3f> normals;  // unit length: the mean of the triangles around the point, by their areas
  std::vector<float> shading;  // cosine of the angle to the light, 0 where turned away
  double height = 0;           // highest minus lowest, base plane included, base shape not
  bool is_height_met =
      true;  // false if a locked height is out of reach: then the relief is as high as can be
  FrameTimes times;
};

// Makes frames of one model. Not for concurrent use; allocates nothing per frame once a frame has its size.
class FrameMaker {
 public:
  // Packs what frames need. The model must outlive it.
  explicit FrameMaker(const ReliefModel& model);
  FrameMaker(FrameMaker&&) noexcept;
  ~FrameMaker();

  // Overwrites `frame` with the relief asked for. Same options, same bits, for any number of threads and,
  // unless the height is locked, whatever was made before; a locked height starts from the last frame's.
  void make(const FrameOptions& options, Frame& frame);

  // Bytes held, the model's not included.
  std::size_t memory() const;

 private:
  struct Packed;
  std::unique_ptr<Packed> packed_;
};

}  // namespace relievo
