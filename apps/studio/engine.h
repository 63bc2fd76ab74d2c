// Reads the scan of a document, makes its relief, and draws both. It is the engine of the native program.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/project.h"
#include "relievo/make_relief.h"
#include "relievo/option_table.h"
#include "studio/drawing.h"
#include "studio/piece.h"

namespace relievo::app::studio {

// The current work of an engine, and the scan that it shows.
struct EngineStatus {
  bool is_busy = false;
  std::string stage;
  double fraction = 0;
  std::optional<Error> error;  // error of the last opening or change of the view
  ScanSource input;            // the shown scan
  OptionValues view;           // the last requested options for preparing the scan
  std::string making_stage;    // stage of the making of the finished piece; empty if none is being made
  double making_fraction = 0;
  std::uint64_t model = 0;  // number of the shown model, unique among all engines; 0 before the first model
  bool can_turn = false;    // whether pictures can show the model from other views
};

// The engine of a document. Every method may be called from any thread. While one call draws, other calls
// that draw wait.
class Engine {
 public:
  // `changed` is for systems without threads. It is called when status() has changed within a call of this object.
  explicit Engine(const std::function<void()>& changed = {});
  ~Engine();

  // Reads the scan and prepares the view in the background. The old relief stays until the new one is ready.
  // If the new one fails, the old one stays.
  void open(const ScanSource& input, const OptionValues& view);

  // Does only those parts of open() and choose_view() that are needed to show the scan in that view. Does
  // nothing if it is already shown.
  void show(const ScanSource& input, const OptionValues& view);

  // Prepares another view of the scan that was opened last or, if that scan failed, of the shown scan.
  // Errors: those of parse_options(); kind geometry if there is no scan.
  Result<void> choose_view(const OptionValues& view);

  void cancel();

  // Returns whether no work is running, not even cancelled work.
  bool is_idle();

  // On a system without threads, does the work that open(), show() and choose_view() have requested.
  void work();

  EngineStatus status() const;

  // Returns the facts about the shown model. This method and those below fail with kind geometry if there is
  // no relief yet.
  Result<ModelFacts> facts();

  // Draw as the methods of Drawing do. While another view is being prepared, a picture shows a coarse relief
  // of the view that the request names or, if it names none, the last frame of the current model. A picture
  // of a finished piece waits until that piece is made. Any other picture cancels the making of that piece
  // instead of waiting for it. A picture whose request has neither `is_at_rest` nor `is_finished` also
  // cancels all pictures whose requests have one of the two. If ornaments have no room, the finished piece is
  // made without them, and the answer says so. Errors: also those of piece().
  Result<PictureAnswer> picture(PictureRequest request);
  Result<std::vector<float>> profile(PictureRequest request, const SectionLine& line);

  // Returns the greatest height of the relief, in mm, that the options and their draft angle allow. With a
  // draft angle this takes as long as making a piece, unless the height is already known. Any picture that is
  // not of a finished piece cancels this call. Errors: those of Drawing::reachable_height() and
  // highest_with_draft(); kind cancelled.
  Result<double> reachable_height(PictureRequest request);

  // Returns where the ornaments of the options lie on the piece, whether they have room or not.
  Result<std::vector<OrnamentPlace>> ornament_places(const ReliefOptions& options);

  // Draws the scan itself in a view.
  Result<Picture> scan_picture(const View& view, int width, int height);

  // Returns the shown scan if it is a single depth image, otherwise null. The pointer shares ownership of the
  // scan.
  std::shared_ptr<const SceneModel> depth_image() const;

  // Returns the points of the shown model under positions in its picture; see points_under(). Does not wait for
  // pictures.
  Result<std::vector<std::optional<Vec3>>> points_under(std::span<const Vec2> places) const;

  // Returns the six sides of the scan as views, the best one first; see rank_views().
  Result<std::vector<ViewGuess>> suggest_views();

  // Returns the finished relief, as `relievo make` makes it, and keeps it for the next call with the same
  // options. Errors: those of make_relief(); kind option if the view of the options is not prepared; kind
  // cancelled after cancel_making().
  Result<std::shared_ptr<const MadeRelief>> piece(const ReliefOptions& options,
                                                  PieceUse use = PieceUse::file);
  void cancel_making();

 private:
  struct State;
  Result<void> find_draft_limit(PictureRequest& request, PieceUse use);
  Result<void> finish(PictureRequest& request);

  std::unique_ptr<State> state_;
};

}  // namespace relievo::app::studio
