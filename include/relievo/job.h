// A relief as a job: scans and options. It is loaded and prepared once; the live model that comes of it gives solids in
// seconds, frames and pictures in milliseconds.
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

// Returns the job of one scan, whose file has these bytes and is called `name` in errors. Errors: those of
// read_cloud().
Result<Job> load(std::span<const std::byte> file, std::string_view name);

// A frame of a live model. It is valid until the model makes the next one.
struct LiveFrame {
  const Frame* frame = nullptr;
  std::span<const float> gains = {};  // of a model of a few points, see Shown
  double stretch = 1;                 // factor of the heights in a picture
  double mm_per_unit = 1;
  bool is_new = false;  // false if the frame before it was the same
};

// Selects a frame of the options. A quick one takes one or two solves, and leaves at most 3 % of a height
// that is asked for to the stretch.
struct FrameWish {
  std::optional<double> u;  // of the compression, in place of a height, which then follows the shape
  bool is_quick = false;
};

// Checks the size of a picture and where its camera stands. Errors: kind option, naming the field.
Result<void> check(const RenderOptions& options);

// A prepared model with all that its frames and pictures need. Results that take a pass over all points are
// computed once. If memory runs out in relief(), frame() or picture(), that is an error of kind memory. Not
// for concurrent use.
class LiveModel {
 public:
  // Shares the model. `notes` say how its points were sampled.
  explicit LiveModel(TurnedRelief shown, std::vector<SampleNote> notes = {});
  LiveModel(LiveModel&&) noexcept;
  ~LiveModel();

  const ReliefModel& model() const;

  // Returns the solid. It may be called concurrently. Errors: those of make_relief().
  Result<MadeRelief> relief(const ReliefOptions& options, Progress* progress = nullptr) const;

  // Returns the frame of the relief that the options ask for. Errors: those of with_width(); kind option for a method
  // that has no frames.
  Result<LiveFrame> frame(const ReliefOptions& options);

  // Returns a picture of that frame on its plate; `render` has its lengths from the options. Errors: those of frame()
  // and check().
  Result<Picture> picture(const ReliefOptions& options, RenderOptions render = {});

  // The parts of these calls, for programs that show a relief while it is worked on. Options are to have a width.

  // Does what relievo::with_width() does, and searches the largest width anew only if it has changed.
  Result<ReliefOptions> with_width(const ReliefOptions& options);

  // Returns the largest width that fits into the plate of the last options that with_width() took; nothing if it had no
  // size.
  std::optional<double> most_width_mm() const;

  double mm_per_unit(const ReliefOptions& options) const;

  // Makes the frame, unless it was the last one.
  LiveFrame make_frame(const ReliefOptions& options, const FrameWish& wish = {});

  // Returns what make_frame() returned last; a null frame before the first.
  LiveFrame last_frame() const;

  // Returns the height in mm of the highest relief of that shape: that without compression. Steps at depth jumps, which
  // a height may add, are left out.
  double highest_mm(const ReliefOptions& options);

  Shown shown(const LiveFrame& made) const;
  RenderOptions with_lengths(RenderOptions render, const ReliefOptions& options) const;
  FrameRenderer& renderer();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Samples the points that show the view of a job, which is chosen first if need be, and prepares their model. Errors:
// those of sample_for_view() and of prepare() for a cloud.
Result<LiveModel> prepare(const Job& job, Progress* progress = nullptr);

}  // namespace relievo
