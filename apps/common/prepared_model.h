// A model that is prepared once, and its frames and reliefs, for Python and WebAssembly.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/make_order.h"
#include "relievo/core/parallel.h"
#include "relievo/picture/render.h"
#include "relievo/relief/frame.h"
#include "relievo/relief/relief.h"

namespace relievo::app {

// A frame with its heights in millimetres.
struct FrameInMm {
  Frame frame;
  double mm_per_unit = 1;
};

// A picture of a frame, as users ask for it.
struct PictureOrder {
  int width, height;
  double yaw_deg, pitch_deg, zoom;
  std::string material;
  bool is_fine;
};

// Every method may be called from any thread.
class PreparedModel {
 public:
  // Reads the inputs of an order and prepares their model. Errors: those of check_order(), load(), sample_for_view() and
  // prepare(), naming the inputs.
  static Result<std::shared_ptr<PreparedModel>> prepare(MakeOrder order, Progress& progress);

  const ReliefModel& model() const { return *model_; }

  // Errors: those of options_of() and make_relief().
  Result<std::shared_ptr<FinishedRelief>> make(const MakeOrder& order, Progress& progress) const;

  // Errors: those of options_of(); kind option for a method that has no frames.
  Result<std::shared_ptr<FrameInMm>> frame(const MakeOrder& order);

  // Draws a frame of this model. Errors: kind input for a frame of another model, kind option.
  Result<Picture> picture(const FrameInMm& shown, const PictureOrder& order);

 private:
  PreparedModel(const LoadedOrder& loaded, std::vector<SampleNote> notes,
                std::shared_ptr<const ReliefModel> model);

  InputFacts facts_;
  std::optional<StoredProject> project_;
  std::vector<SampleNote> notes_;
  std::shared_ptr<const ReliefModel> model_;
  double longer_side_;  // of the surface

  Mutex mutex_;  // guards what follows, which is not for concurrent use
  FrameMaker frames_;
  FrameRenderer renderer_;
};

}  // namespace relievo::app
