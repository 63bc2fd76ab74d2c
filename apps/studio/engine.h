// The native engine of a document: reads one scan, makes its relief, and draws both.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/project.h"
#include "relievo/make_relief.h"
#include "relievo/option_table.h"
#include "studio/drawing.h"
#include "studio/piece.h"

namespace relievo::app::studio {

// An engine's present work, and the scan that it shows.
struct EngineStatus {
  bool is_busy = false;
  std::string stage;
  double fraction = 0;
  std::optional<Error> error;  // error of the last opening or change of view
  ScanSource input;            // the shown scan
  OptionValues view;           // last requested options for preparing the scan
  std::string making_stage;    // stage of the finished piece that is being made; empty if there is none
  double making_fraction = 0;
  std::uint64_t model = 0;  // number of the shown model, unique among all engines; 0 before the first model
  bool can_turn = false;    // whether pictures can show the model in other views
};

// Every method may be called from any thread. Methods that draw wait for each other.
class Engine {
 public:
  // `changed` is for systems without threads: it is called when status() has changed within a call.
  explicit Engine(const std::function<void()>& changed = {});
  ~Engine();

  // Reads the scan and prepares the view in the background. The old relief stays until the new one is ready,
  // or for good if the new one fails.
  void open(const ScanSource& input, const OptionValues& view);

  // Does the parts of open() and choose_view() that are needed to show the scan in that view: none if it is
  // shown already.
  void show(const ScanSource& input, const OptionValues& view);

  // Prepares another view of the scan that was opened last or, if that failed, of the shown scan. Errors:
  // those of parse_options(); kind geometry if there is no scan.
  Result<void> choose_view(const OptionValues& view);

  void cancel();

  // Returns whether all work has ended, cancelled work included.
  bool is_idle();

  // Without threads, this does the work that open(), show() and choose_view() have requested.
  void work();

  EngineStatus status() const;

  // Returns the facts about the shown model. Errors of this and the methods below: kind geometry if there is
  // no relief yet.
  Result<ModelFacts> facts();

  // picture() and profile() draw as Drawing does. While another view is being prepared, pictures show the
  // last frame of the model that is shown until then. A picture of a finished piece waits until the piece is
  // made. Any other picture cancels the making of that piece, so as not to wait for it. A picture that is
  // neither fine nor of a finished piece also cancels all pictures that are. If ornaments have no room, the
  // finished piece is made without them, and the answer says so. Errors: also those of piece().
  Result<PictureAnswer> picture(PictureRequest request);
  Result<std::vector<float>> profile(PictureRequest request, const SectionLine& line);

  // Returns the height in mm of the highest relief that the options allow, their draft angle included. With a
  // draft angle this takes as long as making a piece, unless the height is already known. Any picture that is
  // not of a finished piece cancels this. Errors: those of Drawing::reachable_height() and
  // highest_with_draft(); kind cancelled.
  Result<double> reachable_height(PictureRequest request);

  // Returns where the ornaments of the options lie on the piece, whether they have room or not.
  Result<std::vector<OrnamentPlace>> ornament_places(const ReliefOptions& options);

  // Draws the scan itself as it looks in a view.
  Result<Picture> scan_picture(const View& view, int width, int height);

  // Returns the shown scan if it is a single depth image, else null. It shares the model with the scan.
  std::shared_ptr<const SceneModel> depth_image() const;

  // Returns the six sides, the best one first; see rank_views().
  Result<std::vector<ViewGuess>> suggest_views();

  // Returns the finished relief as `relievo make` makes it, and keeps it for the next call with these
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
