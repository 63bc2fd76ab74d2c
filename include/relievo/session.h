// Prepares models in the background, while the previous model can still be used.
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
  std::string stage;    // current stage of the preparation, see Progress
  double fraction = 0;  // share of the preparation that is done, in [0, 1]
  // Error of the last preparation, if it failed or was cancelled; empty during a preparation.
  std::optional<Error> error;
  // Whether turn() can return a coarse relief. It can when the points are measured or the first coarse relief
  // is made, long before the first model of the points is ready; but not while the first coarse relief is
  // being made. The first coarse relief of a large cloud is made before all points are measured. Until they
  // are measured, turn() to a view other than that of this relief returns an error of kind `cancelled`.
  bool can_turn = false;
};

// A model to prepare. Its functions are called in the session's thread.
struct Preparation {
  using Points = Result<std::shared_ptr<const Cloud>>;
  using Model = std::shared_ptr<const ReliefModel>;

  // Returns the cloud. May read files and may take long. For a mesh, the cloud from read_cloud() has only the
  // vertices; sample_for_view() in scene.h samples its triangles.
  std::function<Points(Progress&)> points;
  View view = {};
  ModelOptions model = {Mode::automatic};

  // Whether the points are from another scan than those of the previous preparation. If true, the previous
  // points are freed at once unless a model was made of them, so that turn() does not show them any more.
  bool is_of_other_scan = false;

  // If set, it is called after points(), and returns a view that depends on the points.
  std::function<View()> chosen_view = {};

  // If set, it is called for coarse reliefs, and returns the points of all sides. If not set, coarse reliefs
  // use the result of points(). Meshes need all_sides, because points() samples them for a single view.
  std::function<Points(Progress&)> all_sides = {};

  // Whether to make a coarse relief of this view if there is no model yet. It is made as soon as the points
  // are measured; for a large cloud, from a part of the points before all are measured. It is made in the
  // session's thread, and turn() returns it.
  bool makes_first_relief = false;

  // Called with the model just before status() reports that the model is ready. During the call the session
  // is locked: the function must not call the session, nor take a lock that a caller of the session may own.
  std::function<void(const Model&)> ready = {};

  // If set, it is called when status() has changed. It may call no function of the session except status().
  // Programs with threads may call status() repeatedly instead.
  std::function<void()> changed = {};
};

// A session; every method may be called from any thread. Only turn(), wait_until_idle() and the destructor
// may take long. Callers make frames of the model with a FrameMaker.
class Session {
 public:
  Session();
  ~Session();  // cancels the running preparation and waits for its end

  // Prepares a model in the background. A newer call cancels an older preparation, whose end is then not
  // reported. The previous model stays until the new one is ready, or for good if the preparation fails.
  void open(Preparation preparation);

  // Cancels the preparation that is running or waiting, if any. status() reports the cancellation
  // immediately. The preparation ends when it next checks its Progress, and only then does the next one
  // begin. If there is no model yet, the points are freed.
  void cancel();

  // Returns a coarse relief, in another view, of the points that were prepared last. It is shown while the
  // view changes; open() prepares the final view. It is made in the calling thread, in a few hundredths of a
  // second. The first call for a cropped cloud or a mesh takes longer, because it also measures the points of
  // all sides. A newer call of turn() and a call of cancel() cancel this call. turn() does not cancel a
  // preparation, and open() does not cancel turn(), because turn() may be called late, when the final view is
  // already being prepared. Errors: kind geometry if no points have been measured yet, or if the view shows
  // no area; kind cancelled.
  Result<ShownModel> turn(const View& view);

  SessionStatus status() const;
  std::shared_ptr<const ReliefModel> model() const;  // the newest model; null before the first one

  // Waits until nothing is left to do. Returns false if that takes longer than the timeout. On systems
  // without threads, this call runs the preparation passed to open(); with a timeout of 0 it does nothing.
  bool wait_until_idle(std::chrono::milliseconds timeout);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
