// Implements parallel.h for systems without threads.
#include "relievo/core/parallel.h"

namespace relievo {

int thread_count() {
  return 1;
}

void set_thread_count(int) {}

void detail::run_blocks(std::size_t blocks, BlockFunction f, void* context) {
  for (std::size_t b = 0; b < blocks; ++b) f(context, b);
}

// Does nothing: blocks run in order, so earlier blocks are done.
void BlockFlags::wait(std::size_t) const {}

namespace {

struct WaitingStep {
  std::function<bool()> step;
  bool is_woken = false;
};

}  // namespace

struct BackgroundLoop::State : WaitingStep {};

BackgroundLoop::BackgroundLoop(std::function<bool()> step) : state_(std::make_unique<State>()) {
  state_->step = std::move(step);
}

BackgroundLoop::~BackgroundLoop() = default;

void BackgroundLoop::wake() {
  state_->is_woken = true;
}

bool BackgroundLoop::wait_until_idle(std::chrono::milliseconds timeout) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  while (state_->is_woken && Clock::now() - start < timeout) {
    state_->is_woken = false;
    state_->is_woken |= state_->step();
  }
  return !state_->is_woken;
}

}  // namespace relievo
