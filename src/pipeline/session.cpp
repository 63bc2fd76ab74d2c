#include "relievo/session.h"

#include <algorithm>
#include <array>

#include "relievo/core/parallel.h"

namespace relievo {
namespace {

struct Opening {
  std::shared_ptr<const Cloud> cloud;
  View view;
  SurfaceOptions options;
  Mode mode = Mode::automatic;
};

// What the callers and the loop share.
struct Shared {
  std::optional<Opening> opening;      // waits to be prepared
  std::optional<FrameOptions> wanted;  // waits to be made
  std::shared_ptr<Progress> progress;  // of the preparation that runs
  std::shared_ptr<const ReliefModel> model;
  std::shared_ptr<const Frame> frame;
  SessionStatus status;
};

Result<ReliefModel> prepare(const Opening& opening, Progress& progress) {
  Result<Surface> surface = find_surface(*opening.cloud, opening.view, opening.options, &progress);
  if (!surface) return std::unexpected(surface.error());
  return ReliefModel::prepare(std::move(*surface), &progress, opening.mode);
}

}  // namespace

struct Session::State {
  Guarded<Shared> shared;

  // The loop's own: no one else touches it.
  std::shared_ptr<const ReliefModel> model;
  std::optional<FrameMaker> maker;
  std::array<std::shared_ptr<Frame>, 3> frames;  // used again when nobody holds them

  BackgroundLoop loop{[this] { return step(); }};  // last: it starts when all else is there

  // Does one thing; returns whether there may be more.
  bool step() {
    auto [opening, progress] = shared.with([&](Shared& s) {
      std::optional<Opening> next = std::exchange(s.opening, std::nullopt);
      if (next) s.progress = watched();
      return std::pair(std::move(next), s.progress);
    });
    if (opening) {
      open(*opening, *progress);
      return true;
    }
    return make_frame();
  }

  std::shared_ptr<Progress> watched() {
    return std::make_shared<Progress>([this](std::string_view stage, double fraction) {
      shared.with([&](Shared& s) {
        s.status.stage = stage;
        s.status.fraction = fraction;
      });
    });
  }

  void open(const Opening& opening, Progress& progress) {
    Result<ReliefModel> prepared = prepare(opening, progress);
    std::shared_ptr<const ReliefModel> ready;
    if (prepared) ready = std::make_shared<const ReliefModel>(std::move(*prepared));
    shared.with([&](Shared& s) {
      s.progress = nullptr;
      s.status.is_preparing = s.opening.has_value();
      if (!prepared) {
        s.status.error = prepared.error();
        return;
      }
      s.status.error = std::nullopt;
      s.status.fraction = 1;
      s.model = ready;
    });
    if (!ready) return;
    maker.reset();
    model = std::move(ready);
    maker.emplace(*model);
  }

  bool make_frame() {
    if (!maker) return false;
    const auto [wanted, number] = shared.with(
        [](Shared& s) { return std::pair(std::exchange(s.wanted, std::nullopt), s.status.requested); });
    if (!wanted) return false;
    const std::shared_ptr<Frame> frame = unused_frame();
    maker->make(*wanted, *frame);
    shared.with([&](Shared& s) {
      s.frame = frame;
      s.status.finished = number;
    });
    return true;
  }

  std::shared_ptr<Frame> unused_frame() {
    for (std::shared_ptr<Frame>& frame : frames) {
      if (!frame) frame = std::make_shared<Frame>();
      if (frame.use_count() == 1) return frame;
    }
    return frames[0] = std::make_shared<Frame>();
  }
};

Session::Session() : state_(std::make_unique<State>()) {}

Session::~Session() {
  cancel();
}

void Session::open(std::shared_ptr<const Cloud> cloud, const View& view, const SurfaceOptions& options,
                   Mode mode) {
  state_->shared.with([&](Shared& s) {
    if (s.progress) s.progress->cancel();
    s.opening = Opening{std::move(cloud), view, options, mode};
    s.status.is_preparing = true;
    s.status.stage = "waiting";
    s.status.fraction = 0;
  });
  state_->loop.wake();
}

void Session::cancel() {
  state_->shared.with([](Shared& s) {
    if (s.progress) s.progress->cancel();
    if (s.opening) s.status.error = Error{ErrorKind::cancelled, {}, {}, "cancelled"};
    s.opening = std::nullopt;
    s.status.is_preparing = s.progress != nullptr;
  });
}

std::uint64_t Session::request(const FrameOptions& options) {
  const std::uint64_t number = state_->shared.with([&](Shared& s) {
    s.wanted = options;
    return ++s.status.requested;
  });
  state_->loop.wake();
  return number;
}

SessionStatus Session::status() const {
  return state_->shared.with([](const Shared& s) { return s.status; });
}

std::shared_ptr<const ReliefModel> Session::model() const {
  return state_->shared.with([](const Shared& s) { return s.model; });
}

std::shared_ptr<const Frame> Session::frame() const {
  return state_->shared.with([](const Shared& s) { return s.frame; });
}

bool Session::wait_until_idle(std::chrono::milliseconds timeout) {
  return state_->loop.wait_until_idle(timeout);
}

}  // namespace relievo
