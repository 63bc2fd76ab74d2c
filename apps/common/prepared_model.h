// Prepares a model once and makes many frames and reliefs from it, for Python and WebAssembly.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "common/make_order.h"
#include "relievo/core/parallel.h"
#include "relievo/job.h"

namespace relievo::app {

// A frame with its heights in millimetres.
struct FrameInMm {
  Frame frame;
  double mm_per_unit = 1;
};

// A model that is prepared once for many frames and reliefs. Every method may be called from any thread.
class PreparedModel {
 public:
  // Reads the inputs of an order and prepares a model from them. Errors: those of check_order(), load() and
  // prepare(), which name the inputs.
  static Result<std::shared_ptr<PreparedModel>> prepare(MakeOrder order, Progress& progress);

  const ReliefModel& model() const { return live_.model(); }

  // Makes a finished relief. Options that the order does not state are those with which the model was
  // prepared. Errors: those of options_of() and make_relief().
  Result<std::shared_ptr<FinishedRelief>> make(const MakeOrder& order, Progress& progress) const;

  // Makes a frame. Options that the order does not state are those with which the model was prepared. Errors: those
  // of options_of(); kind option for a method without frames.
  Result<std::shared_ptr<FrameInMm>> frame(const MakeOrder& order);

  // Draws a frame of this model in that material. Errors: kind input for a frame whose number of points is
  // not that of the model; kind option for wrong options or an unknown material.
  Result<Picture> picture(const FrameInMm& shown, RenderOptions options, std::string_view material);

 private:
  PreparedModel(const LoadedOrder& loaded, LiveModel live);

  // Returns the order, completed by the options and the base's height map with which the model was prepared. Leaves
  // out the options in MakeOrder::unset, and the height map if the order has another base.
  MakeOrder completed(const MakeOrder& order) const;

  InputFacts facts_;
  OptionValues values_;  // those of the order with which the model was prepared, and the method
  std::shared_ptr<const Image<float>> base_image_;
  std::optional<StoredProject> project_;
  Mutex mutex_;  // guards the model's frames and pictures
  LiveModel live_;
};

}  // namespace relievo::app
