// Real time: a model prepared in the background, frames on request, the latest request first.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "relievo/relief/frame.h"

namespace relievo {

struct SessionStatus {
  bool is_preparing = false;
  std::string stage;           // of the preparation, for people
  double fraction = 0;         // of it that is done, in [0, 1]
  std::optional<Error> error;  // why the last preparation failed or that it was cancelled
  std::uint64_t requested = 0,
                finished = 0;  // numbers of the newest request and of the newest finished frame
};

// Every method may be called from any thread, and none waits for work but wait_until_idle() and the
// destructor.
//
// - open() prepares in the background; a newer open() cancels an older one. Until it is done the old model
// and its frames
//   stay; if it fails they stay, too.
// - request() asks for a frame. Requests that a newer one overtakes are never worked on.
// - Models and frames are immutable and live as long as someone holds them.
class Session {
 public:
  Session();
  ~Session();  // cancels what runs and waits for it

  void open(std::shared_ptr<const Cloud> cloud, const View& view, const SurfaceOptions& options = {},
            Mode mode = Mode::automatic);

  // Cancels the preparation that runs or waits, if any. Frames are too short for that.
  void cancel();

  // Returns the request's number. Before a model is ready the request waits for it.
  std::uint64_t request(const FrameOptions& options);

  SessionStatus status() const;
  std::shared_ptr<const ReliefModel> model() const;  // null before the first
  std::shared_ptr<const Frame> frame() const;        // the newest; null before the first

  // Waits until nothing is left to do. Returns false if that takes longer than the timeout.
  bool wait_until_idle(std::chrono::milliseconds timeout);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace relievo
