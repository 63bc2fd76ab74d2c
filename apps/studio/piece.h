// Makes the finished pieces of a model, as export makes them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relievo/core/parallel.h"
#include "relievo/core/progress.h"
#include "relievo/make_relief.h"
#include "relievo/picture/preview.h"

namespace relievo::app::studio {

// Returns the height of the relief in a piece: exactly the requested one. Only if the piece is made as a tool
// leaves it, returns the height that it got.
double relief_height_mm(const MadeRelief& made, const ReliefOptions& options);

// A prepared model with a number that no other model has.
struct NumberedModel {
  std::shared_ptr<const ReliefModel> model;
  std::uint64_t number = 0;
};

// The purpose of a piece, or of the largest height under its draft angle: a file to export, a check of the
// user's entry, or a picture. Work for a picture is cancelled by the next picture.
enum class PieceUse { file, entry, picture };

// Makes finished pieces, one at a time, while other pictures are drawn. Every method may be called from any
// thread.
class PieceMaker {
 public:
  // `changed` is called during piece() and draft_limit() when stage() has changed. It may be empty.
  explicit PieceMaker(std::function<void()> changed) : changed_(std::move(changed)) {}

  struct Stage {
    std::string name;  // empty while nothing is made
    double fraction = 0;
  };
  Stage stage() const;

  // Returns the piece, and keeps it for the next call with that model and options. Errors: those of
  // make_relief(); kind cancelled after cancel().
  Result<std::shared_ptr<const MadeRelief>> piece(PieceUse use, const NumberedModel& shown,
                                                  const ReliefOptions& options);

  // Returns highest_with_draft(), and keeps it for the next call with that model and the same options apart
  // from their height. Errors: those of highest_with_draft(); kind cancelled after cancel().
  Result<double> draft_limit(PieceUse use, const NumberedModel& shown, const ReliefOptions& options);

  // Returns the result of draft_limit() for that model and these options; nothing if it is not known.
  std::optional<double> known_draft_limit(const NumberedModel& shown, const ReliefOptions& options) const;

  // Cancels the work that is running. If a use is given, cancels only work for that use.
  void cancel(std::optional<PieceUse> use = {});

 private:
  struct Making {
    Stage stage;
    Progress* progress = nullptr;  // null while nothing is made
    PieceUse use = PieceUse::file;
  };

  struct DraftLimit {
    std::uint64_t model = 0;
    ReliefOptions options;  // without a height
    double height_mm = 0;
  };

  // Calls make(progress). Meanwhile stage() returns the progress, and cancel() cancels the work.
  template <typename Make>
  auto watched(const NumberedModel& shown, PieceUse use, const Make& make);

  std::function<void()> changed_;
  Guarded<Making> making_;
  Guarded<std::vector<DraftLimit>> draft_limits_;
  Mutex mutex_;                             // guards the members below
  std::shared_ptr<const MadeRelief> made_;  // null before the first piece
  std::uint64_t made_model_ = 0;
  ReliefOptions made_options_;
};

}  // namespace relievo::app::studio
