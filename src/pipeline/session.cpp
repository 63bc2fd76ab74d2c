#include "relievo/session.h"

#include "relievo/core/parallel.h"
#include "relievo/make_relief.h"
#include "relievo/relief/relief.h"

namespace relievo {
namespace {

// The state that the callers and the session's thread share.
struct Shared {
  std::optional<Preparation> waiting;
  std::shared_ptr<Progress> progress;  // of the preparation that runs
  std::shared_ptr<const ReliefModel> model;
  SessionStatus status;
};

Result<std::shared_ptr<const ReliefModel>> prepare(const Preparation& wanted, Progress& progress) {
  RELIEVO_TRY(const std::shared_ptr<const Cloud> cloud, wanted.points(progress));
  const View view = wanted.chosen_view ? wanted.chosen_view() : wanted.view;
  RELIEVO_TRY(ReliefModel model, relievo::prepare(*cloud, view, wanted.mode, &progress));
  return std::make_shared<const ReliefModel>(std::move(model));
}

}  // namespace

struct Session::State {
  Guarded<Shared> shared;
  BackgroundLoop loop{[this] { return step(); }};  // last: it starts when all else is there

  // Prepares the model that waits, if any; returns whether there was one.
  bool step() {
    const auto [wanted, progress] = shared.with([&](Shared& s) {
      std::optional<Preparation> next = std::exchange(s.waiting, std::nullopt);
      if (next) s.progress = watched(next->changed);
      return std::pair(std::move(next), s.progress);
    });
    if (!wanted) return false;
    const Result<std::shared_ptr<const ReliefModel>> made = prepare(*wanted, *progress);
    finish(*wanted, *progress, made);
    if (wanted->changed) wanted->changed();
    return true;
  }

  void finish(const Preparation& wanted, const Progress& progress,
              const Result<std::shared_ptr<const ReliefModel>>& made) {
    shared.with([&](Shared& s) {
      s.progress = nullptr;
      if (s.waiting || progress.is_cancelled())
        return;  // a newer opening has overtaken this one, or cancel()
      s.status.is_preparing = false;
      if (!made) {
        s.status.error = made.error();
        return;
      }
      s.status.fraction = 1;
      s.model = *made;
      if (wanted.ready) wanted.ready(*made);
    });
  }

  std::shared_ptr<Progress> watched(const std::function<void()>& changed) {
    return std::make_shared<Progress>([this, changed](std::string_view stage, double fraction) {
      shared.with([&](Shared& s) {
        if (s.waiting || s.progress->is_cancelled()) return;
        s.status.stage = stage;
        s.status.fraction = fraction;
      });
      if (changed) changed();
    });
  }
};

Session::Session() : state_(std::make_unique<State>()) {}

Session::~Session() {
  cancel();
}

void Session::open(Preparation preparation) {
  state_->shared.with([&](Shared& s) {
    if (s.progress) s.progress->cancel();
    s.waiting = std::move(preparation);
    s.status = {true, "waiting", 0, std::nullopt};
  });
  state_->loop.wake();
}

void Session::cancel() {
  state_->shared.with([](Shared& s) {
    if (s.progress) s.progress->cancel();
    if (s.status.is_preparing) s.status.error = Error{ErrorKind::cancelled, {}, {}, "cancelled"};
    s.waiting = std::nullopt;
    s.status.is_preparing = false;
  });
}

SessionStatus Session::status() const {
  return state_->shared.with([](const Shared& s) { return s.status; });
}

std::shared_ptr<const ReliefModel> Session::model() const {
  return state_->shared.with([](const Shared& s) { return s.model; });
}

bool Session::wait_until_idle(std::chrono::milliseconds timeout) {
  return state_->loop.wait_until_idle(timeout);
}

}  // namespace relievo
