// The piece of a model as export makes it, for pictures of it, and a coarse one for while it changes.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "relievo/make_relief.h"
#include "relievo/picture/solid_renderer.h"

namespace relievo::app::studio {

// Returns whether the options ask for nothing but the relief on a rectangular plate, which FrameRenderer can draw.
bool is_plain(const ReliefOptions& options);

// The options that a piece is made of; equal keys mean equal options.
struct PieceOrder {
  ReliefOptions options;
  std::string key;
};

// A solid with what draws it.
struct DrawnPiece {
  std::shared_ptr<const Solid> solid;
  std::shared_ptr<const ToolReach> reach;  // of the options' tool; null without one
  SolidRenderer renderer;
};

// Not for concurrent use.
class Piece {
 public:
  explicit Piece(std::shared_ptr<const ReliefModel> model) : model_(std::move(model)) {}

  // Takes a piece that was made of an order. It stays until the next one.
  void take(std::shared_ptr<const MadeRelief> made, const PieceOrder& order);

  // Returns whether the piece of that key was taken.
  bool is_finished(const std::string& key) const { return finished_ && finished_key_ == key; }

  // Returns the finished piece if it was taken; otherwise one that is made faster, of fewer samples and without a draft
  // angle or tool. Valid until the next call. Errors: those of make_relief().
  Result<DrawnPiece*> drawn(const PieceOrder& order);

 private:
  std::shared_ptr<const ReliefModel> model_;
  std::optional<DrawnPiece> finished_, coarse_;
  std::string finished_key_, coarse_key_;
};

}  // namespace relievo::app::studio
