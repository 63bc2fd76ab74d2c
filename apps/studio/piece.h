// Makes finished pieces of a model, as they are exported, and sections of them.
#pragma once

#include <cstddef>
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
#include "relievo/plate/solid.h"

namespace relievo::app::studio {

// Returns the height of the relief in a piece. This is the requested height, unless the piece has the surface that a
// milling tool leaves: then the relief may be lower, and its measured height is returned.
double relief_height_mm(const MadeRelief& made, const ReliefOptions& options);

// A line across the front. Its ends are in mm from the centre of the relief or, in a section of a piece, from
// the centre of the piece.
struct SectionLine {
  Vec2 from, to;
  std::size_t samples = 400;  // at least 2
};

// Returns the heights of the solid's highest surface above its ground, in mm, at equal distances along the
// line. Outside the solid, the height is that of its lowest point.
std::vector<float> section_of(const Solid& solid, const SectionLine& line);

// A prepared model with its unique number.
struct NumberedModel {
  std::shared_ptr<const ReliefModel> model;
  std::uint64_t number = 0;
};

// The purpose of a finished piece: a file to export, a check of the user's entry, or a picture. The next picture
// cancels work whose purpose is a picture.
enum class PieceUse { file, entry, picture };

// Makes finished pieces, one at a time. Pictures can be drawn while a piece is made. Every method may be
// called from any thread.
class PieceMaker {
 public:
  // `changed` is called when stage() has changed during piece() or draft_limit(). It may be empty.
  explicit PieceMaker(std::function<void()> changed) : changed_(std::move(changed)) {}

  struct Stage {
    std::string name;  // empty if nothing is being made
    double fraction = 0;
  };
  Stage stage() const;

  // Returns the piece, and keeps it for the next call with the same model and options. Errors: those of
  // make_relief(); kind cancelled after cancel().
  Result<std::shared_ptr<const MadeRelief>> piece(PieceUse use, const NumberedModel& shown,
                                                  const ReliefOptions& options);

  // Returns the result of highest_with_draft(), and keeps it for later calls with the same model and the same options
  // except for the height. Errors: those of highest_with_draft(); kind cancelled after cancel().
  Result<double> draft_limit(PieceUse use, const NumberedModel& shown, const ReliefOptions& options);

  // Returns the kept result of draft_limit() for that model and these options; nothing if there is none.
  std::optional<double> known_draft_limit(const NumberedModel& shown, const ReliefOptions& options) const;

  // Cancels the running work. If `use` is given, cancels it only if it has that purpose.
  void cancel(std::optional<PieceUse> use = {});

 private:
  struct Making {
    Stage stage;
    Progress* progress = nullptr;  // null if nothing is being made
    PieceUse use = PieceUse::file;
  };

  struct DraftLimit {
    std::uint64_t model = 0;
    ReliefOptions options;  // without a height
    double height_mm = 0;
  };

  // Calls make(progress). During the call, stage() returns its progress, and cancel() cancels it.
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
