// A model that is prepared in the background while the one before it can still be used.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "relievo/core/progress.h"
#include "relievo/relief/method.h"
#include "relievo/scan/view.h"
#include "relievo/turning.h"

namespace relievo {

struct SessionStatus {
  bool is_preparing = false;
  std::string stage;    // of the preparation, see Progress
  double fraction = 0;  // of the preparation that is done, in [0, 1]
  std::optional<Error>
      error;  // why the last preparation failed or that it was cancelled; none while one runs
  // Whether points were measured, which comes long before their first model, and the first relief was made if wanted.
  bool can_turn = false;
};

// One model to prepare. Its functions are called in the session's own thread.
struct Preparation {
  using Points = Result<std::shared_ptr<const Cloud>>;
  using Model = std::shared_ptr<const ReliefModel>;

  std::function<Points(Progress&)> points;  // returns the cloud; may read files and may take long
  View view = {};
  Mode mode = Mode::automatic;

  // If set, it is called after points(), and returns the view where that depends on the points.
  std::function<View()> chosen_view = {};

  // If set, it is called for coarse reliefs, and returns the points of all sides. Without it, those of
  // points() are turned, which is right for clouds; points of a mesh are samples of one view.
  std::function<Points(Progress&)> all_sides = {};

  // If set, and there is no model yet, the session's thread makes the coarse relief of this view as soon as the points are
  // measured, and turn() returns it.
  bool makes_first_relief = false;

  // Called with the model just before status() says that it is ready. It runs under the session's lock: it must not call the
  // session, and a lock that it takes must not be held by whoever calls the session.
  std::function<void(const Model&)> ready = {};

  // If set, it is called when status() has changed, and may call status() alone. Where there are threads,
  // whoever watches asks from time to time instead.
  std::function<void()> changed = {};
};

// Every method may be called from any thread, and none waits for work but turn(), wait_until_idle() and the
// destructor. Frames of the model are made by a FrameMaker, by whoever shows them.
class Session {
 public:
  Session();
  ~Session();  // cancels what runs and waits for it

  // Prepares a model in the background. A newer call cancels an older one, whose end is not reported. The
  // model before stays until the new one is ready, and for good if the preparation fails.
  void open(Preparation preparation);

  // Cancels the preparation that runs or waits, if any. status() says so at once; the work itself ends when it next asks
  // its Progress, and the next preparation begins after that. Before the first model, points that were read are freed.
  void cancel();

  // Returns a coarse relief of the points that were prepared last in another view, for as long as the view moves; open()
  // prepares the view in which it rests. The work is done in the calling thread, in a few hundredths of a second; the
  // first call for a cropped cloud or a mesh measures the points of all sides as well, which takes longer. A newer call and cancel() cancel it. It cancels no preparation and open() does not
  // cancel it, as the call may come late, when the view in which it rests is already being prepared. Errors: kind geometry
  // if no points have been measured yet, or if the view shows no area; kind cancelled.
  Result<TurnedRelief> turn(const View& view);

  SessionStatus status() const;
  std::shared_ptr<const ReliefModel> model() const;  // the newest; null before the first

  // Waits until nothing is left to do. Returns false if that takes longer than the timeout. Where there are no threads,
  // this call does what open() asked for; with a timeout of 0 it does nothing.
  bool wait_until_idle(std::chrono::milliseconds timeout);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
