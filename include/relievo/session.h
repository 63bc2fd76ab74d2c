// Prepares models in the background. Meanwhile the previous model can still be used.
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
  std::string stage;           // current stage of the preparation, see Progress
  double fraction = 0;         // share of the preparation that is done, in [0, 1]
  std::optional<Error> error;  // error of the last preparation, failed or cancelled; none while one runs
  // True once the points are measured and the first coarse relief, if wanted, is made. This is long before
  // the first model of the points is ready.
  bool can_turn = false;
};

// One model to prepare. Its functions are called in the session's own thread.
struct Preparation {
  using Points = Result<std::shared_ptr<const Cloud>>;
  using Model = std::shared_ptr<const ReliefModel>;

  // Returns the cloud; may read files and may take long. The cloud of a mesh that read_cloud() has read is its
  // vertices alone: sample_for_view() in scene.h takes points of its triangles.
  std::function<Points(Progress&)> points;
  View view = {};
  ModelOptions model = {Mode::automatic};

  // If set, it is called after points(), and returns a view that depends on the points.
  std::function<View()> chosen_view = {};

  // If set, it is called for coarse reliefs, and returns the points of all sides. If not set, coarse reliefs
  // use the result of points(). This suits clouds, but the points of a mesh are samples of one view.
  std::function<Points(Progress&)> all_sides = {};

  // If set, and there is no model yet, the session's thread makes the coarse relief of this view as soon as
  // the points are measured, and turn() returns it.
  bool makes_first_relief = false;

  // Called with the model just before status() reports that the model is ready. The call is made under the
  // session's lock: this function must not call the session, nor take a lock that a caller of the session may
  // own.
  std::function<void(const Model&)> ready = {};

  // If set, it is called when status() has changed. Of the session's functions it may call only status().
  // Programs with threads may poll status() instead.
  std::function<void()> changed = {};
};

// Every method may be called from any thread. Only turn(), wait_until_idle() and the destructor wait for
// work. Callers make frames of the model with a FrameMaker.
class Session {
 public:
  Session();
  ~Session();  // cancels the running work and waits for its end

  // Prepares a model in the background. A newer call cancels an older one, and the end of the older one is
  // not reported. The previous model stays until the new one is ready; if the preparation fails, the previous
  // model stays for good.
  void open(Preparation preparation);

  // Cancels the preparation that runs or waits, if any. status() reports it at once. The work itself ends
  // when it next checks its Progress, and the next preparation begins after that. If there is no model yet,
  // points that were read are freed.
  void cancel();

  // Returns a coarse relief, in another view, of the points that were prepared last. It is shown while the
  // view moves; open() prepares the final view. The work is done in the calling thread, in a few hundredths
  // of a second. The first call for a cropped cloud or a mesh takes longer, because it also measures the
  // points of all sides. A newer call of turn() and cancel() cancel this one. turn() does not cancel a
  // preparation, and open() does not cancel turn(): a call may come late, when the final view is already
  // being prepared. Errors: kind geometry if no points have been measured yet, or if the view shows no area;
  // kind cancelled.
  Result<TurnedRelief> turn(const View& view);

  SessionStatus status() const;
  std::shared_ptr<const ReliefModel> model() const;  // the newest model; null before the first

  // Waits until nothing is left to do. Returns false if that takes longer than the timeout. Where there are
  // no threads, this call runs the preparation passed to open(); with a timeout of 0 it does nothing.
  bool wait_until_idle(std::chrono::milliseconds timeout);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
