// Loads and prepares jobs. A job consists of scans and the options of their relief. The result is a live
// model, which makes solids in seconds, and frames and pictures in milliseconds.
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

// Returns the job of a single scan from the bytes of its file. Error messages call the file `name`. The job's
// SceneModel::remarks say which parts of the file were not read. Errors: those of read_cloud().
Result<Job> load(std::span<const std::byte> file, std::string_view name);

// A frame of a live model. It is valid until that model makes its next frame.
struct LiveFrame {
  const Frame* frame = nullptr;
  // The gains that FrameMaker::write_gains() returns; empty without SurfaceDetail.
  std::span<const float> gains = {};
  double stretch = 1;  // factor by which pictures stretch the heights
  double mm_per_unit = 1;
  bool is_new = false;  // false if the frame is the same as the previous one
};

// The request for a frame. A quick frame usually takes one or two solves. Its height may differ from a
// requested height by up to 3 %. LiveFrame::stretch compensates for this difference in pictures.
struct FrameWish {
  std::optional<double> u;  // u of Compression; if given, it replaces a requested height
  bool is_quick = false;
};

// Returns an error of kind option, naming the field, if the size of a picture or the position of its camera
// is invalid.
Result<void> check(const RenderOptions& options);

// A prepared model, with the state for its frames and pictures. Results that need a pass over all points are
// computed once. If memory runs out in relief(), frame() or picture(), these functions return an error of
// kind memory. Not for concurrent use.
class LiveModel {
 public:
  // Shares ownership of the model. `notes` describe how the model's points were sampled.
  explicit LiveModel(ShownModel shown, std::vector<SampleNote> notes = {});
  LiveModel(LiveModel&&) noexcept;
  ~LiveModel();

  const ReliefModel& model() const;

  // Returns the solid for the options. May be called concurrently. Errors: those of make_relief().
  Result<MadeRelief> relief(const ReliefOptions& options, Progress* progress = nullptr) const;

  // Returns the frame of the relief for the options. Errors: those of with_width(); kind option for a method
  // that has no frames.
  Result<LiveFrame> frame(const ReliefOptions& options);

  // Returns a picture of the frame on its plate. Lengths in `options` replace the lengths in `render`.
  // Errors: those of frame() and check().
  Result<Picture> picture(const ReliefOptions& options, RenderOptions render = {});

  // The functions below are the steps of frame() and picture(), for programs that show a relief during
  // editing. Except for with_width(), they need options with a width.

  // Returns the same as relievo::with_width(). Searches for the largest width only if the sizes of the plate
  // have changed since the last call.
  Result<ReliefOptions> with_width(const ReliefOptions& options);

  // Returns the largest width that fits into the plate of the options in the last call of with_width();
  // nothing if these options gave the plate no size.
  std::optional<double> most_width_mm() const;

  double mm_per_unit(const ReliefOptions& options) const;

  // Returns the frame for the options. Makes a new frame only if the options or the wish have changed.
  LiveFrame make_frame(const ReliefOptions& options, const FrameWish& wish = {});

  // Returns the last result of make_frame(). Before the first call its `frame` is null.
  LiveFrame last_frame() const;

  // Returns the height in mm of the highest relief with the options' shape, which is the uncompressed relief.
  // The steps that may be added at depth jumps to reach a requested height are not included.
  double highest_mm(const ReliefOptions& options);

  Shown shown(const LiveFrame& made) const;
  // Draws `made` on the plate of the options. The picture shows no ornaments, no simplification and no tool
  // marks, and it shows the draft angle only at the rim. Options without ground must have a plane base and no
  // wrap. Errors: those of check(), check_model(), make_plate() and wrap_plate().
  Result<PlacedRelief> draw_on_plate(const LiveFrame& made, const ReliefOptions& options,
                                     const RenderOptions& render, Picture& picture, const Progress* progress);
  RenderOptions with_lengths(RenderOptions render, const ReliefOptions& options) const;
  FrameRenderer& renderer();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Returns the live model of a job. Chooses the view if View::is_best is set, samples the points that the view
// shows, and prepares their model. Errors: those of sample_for_view() and of prepare() for a cloud.
Result<LiveModel> prepare(const Job& job, Progress* progress = nullptr);

}  // namespace relievo
