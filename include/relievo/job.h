// Jobs: scans with the options of their relief. A job is loaded and prepared once. The resulting live model
// makes solids in seconds, and frames and pictures in milliseconds.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "relievo/make_relief.h"
#include "relievo/picture/render.h"
#include "relievo/relief/frame.h"
#include "relievo/scene.h"
#include "relievo/turning.h"

namespace relievo {

struct Job {
  Scene inputs;
  ReliefOptions options = {};
};

// Returns the job of one scan, whose file has these bytes and is called `name` in errors. The remarks of its model
// say what of the file is left out. Errors: those of read_cloud().
Result<Job> load(std::span<const std::byte> file, std::string_view name);

// A frame of a live model. It is valid until the model makes the next frame.
struct LiveFrame {
  const Frame* frame = nullptr;
  std::span<const float> gains = {};  // see FrameMaker::write_gains(); empty without SurfaceDetail
  double stretch = 1;                 // factor of the heights in a picture
  double mm_per_unit = 1;
  bool is_new = false;  // false if the previous frame was the same
};

// Selects the frame to make for given options. A quick frame takes one or two solves and may miss a requested
// height by up to 3 %. LiveFrame::stretch corrects that in pictures.
struct FrameWish {
  std::optional<double> u;  // the compression's u, used instead of a requested height
  bool is_quick = false;
};

// Checks the size of a picture and the position of its camera. Errors: kind option, naming the field.
Result<void> check(const RenderOptions& options);

// A prepared model with the state that its frames and pictures need. Results that require a pass over all
// points are computed once. If memory runs out in relief(), frame() or picture(), they return an error of
// kind memory. Not for concurrent use.
class LiveModel {
 public:
  // Shares ownership of the model. `notes` describe how its points were sampled.
  explicit LiveModel(TurnedRelief shown, std::vector<SampleNote> notes = {});
  LiveModel(LiveModel&&) noexcept;
  ~LiveModel();

  const ReliefModel& model() const;

  // Returns the solid that the options describe. May be called concurrently. Errors: those of make_relief().
  Result<MadeRelief> relief(const ReliefOptions& options, Progress* progress = nullptr) const;

  // Returns the frame of the relief that the options describe. Errors: those of with_width(); kind option for
  // a method that has no frames.
  Result<LiveFrame> frame(const ReliefOptions& options);

  // Returns a picture of the frame on its plate. The options' lengths replace the lengths in `render`.
  // Errors: those of frame() and check().
  Result<Picture> picture(const ReliefOptions& options, RenderOptions render = {});

  // The functions below are the steps of frame() and picture(), for programs that show a relief while it is
  // edited. Except for with_width(), they need options with a width.

  // Returns the same as relievo::with_width(), but searches for the largest width only if the plate's sizes
  // have changed.
  Result<ReliefOptions> with_width(const ReliefOptions& options);

  // Returns the largest width that fits into the plate of the last options that were passed to with_width();
  // nothing if these gave the plate no size.
  std::optional<double> most_width_mm() const;

  double mm_per_unit(const ReliefOptions& options) const;

  // Makes the frame, unless the last frame was the same.
  LiveFrame make_frame(const ReliefOptions& options, const FrameWish& wish = {});

  // Returns the last result of make_frame(); before the first call the frame in it is null.
  LiveFrame last_frame() const;

  // Returns the height in mm of the highest relief with the options' shape, which is the relief without
  // compression. Steps at depth jumps, which may be added to reach a requested height, are not counted.
  double highest_mm(const ReliefOptions& options);

  Shown shown(const LiveFrame& made) const;
  RenderOptions with_lengths(RenderOptions render, const ReliefOptions& options) const;
  FrameRenderer& renderer();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Chooses the job's view if it is not given, samples the points that are visible in it, and prepares their
// model. Errors: those of sample_for_view() and of prepare() for a cloud.
Result<LiveModel> prepare(const Job& job, Progress* progress = nullptr);

}  // namespace relievo
