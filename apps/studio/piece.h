// Pieces of a model: finished ones as export makes them, for files and pictures, and coarse ones for while it changes.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "relievo/core/parallel.h"
#include "relievo/core/progress.h"
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

// A solid with its renderer.
struct DrawnPiece {
  std::shared_ptr<const Solid> solid;
  std::shared_ptr<const ToolReach> reach;  // of the options' tool; null without one
  SolidRenderer renderer;
  std::optional<double> height_mm;  // see relief_height_mm(); nothing of a piece that is not finished
};

// Returns the height of the relief in a piece: exactly the height that was asked for, unless the piece is
// only what a tool reaches.
double relief_height_mm(const MadeRelief& made, const ReliefOptions& options);

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

// A prepared model with a number that no other model has.
struct NumberedModel {
  std::shared_ptr<const ReliefModel> model;
  std::uint64_t number = 0;
};

// The use of a piece, or of the height that its draft angle allows: for an export, for an entry that is tried, or for a
// picture, which is given up when another one is asked for.
enum class PieceUse { file, entry, picture };

// Makes finished pieces, one at a time, while other pictures are drawn. Every method may be called from any thread.
class PieceMaker {
 public:
  // `changed` is called within piece() and draft_limit() when stage() has changed. It may be empty.
  explicit PieceMaker(std::function<void()> changed) : changed_(std::move(changed)) {}

  struct Stage {
    std::string name;  // empty while nothing is made
    double fraction = 0;
  };
  Stage stage() const;

  // Returns the piece, and keeps it for the next call with that model and key. Errors: those of make_relief(); kind
  // cancelled after cancel().
  Result<std::shared_ptr<const MadeRelief>> piece(const NumberedModel& shown, const ReliefOptions& options,
                                                  const std::string& key, PieceUse use);

  // Returns highest_with_draft(), and keeps it for the next call with that model and key. Errors: those of
  // highest_with_draft(); kind cancelled after cancel().
  Result<double> draft_limit(PieceUse use, const NumberedModel& shown, const ReliefOptions& options,
                             const std::string& key);

  // Returns what draft_limit() returned for that model and key; nothing if it is not known.
  std::optional<double> known_draft_limit(const NumberedModel& shown, const std::string& key) const;

  // Ends what is being made.
  void cancel();

  // Ends what is being made for a picture.
  void cancel_for_picture();

 private:
  struct Making {
    Stage stage;
    Progress* progress = nullptr;  // null while nothing is made
    PieceUse use = PieceUse::file;
  };

  // Calls make(progress), which is in stage() and can be cancelled meanwhile.
  template <typename Make>
  auto watched(const NumberedModel& shown, PieceUse use, const Make& make);

  std::function<void()> changed_;
  Guarded<Making> making_;
  Guarded<std::map<std::string, double>> draft_limits_;  // by model and key
  Mutex mutex_;                                          // guards what follows
  std::shared_ptr<const MadeRelief> made_;               // null before the first
  std::string made_key_;
};

}  // namespace relievo::app::studio
