// Makes preparations for tests of sessions.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <semaphore>
#include <thread>

#include "relievo/session.h"
#include "support/shapes.h"

namespace relievo::test {

// Returns a preparation of a torus with `points` points.
inline Preparation preparation_of(std::size_t points = 5000) {
  return {.points = [points](Progress&) -> Preparation::Points {
    return std::make_shared<const Cloud>(test::torus(points, 1, .4));
  }};
}

// Opens a preparation, and waits for its end.
inline void open_and_wait(Session& session, const Preparation& preparation = preparation_of()) {
  session.open(preparation);
  ASSERT_TRUE(session.wait_until_idle(std::chrono::seconds(60)));
}

// A preparation that delivers its points only after it was cancelled.
struct Stuck {
  std::binary_semaphore has_begun{0};
  std::atomic<bool> has_ended = false;

  Preparation preparation() {
    return {.points = [this](Progress& progress) -> Preparation::Points {
      has_begun.release();
      while (!progress.is_cancelled()) std::this_thread::yield();
      has_ended = true;
      return std::make_shared<const Cloud>(test::torus(5000, 1, .4));
    }};
  }
};

// A preparation that pauses after its points were measured.
struct HeldAtPoints {
  const Session& session;
  std::binary_semaphore has_measured{0}, may_go_on{0};

  Preparation preparation(std::size_t points) {
    Preparation made = preparation_of(points);
    made.changed = [this] {
      if (session.status().stage != "visible points") return;
      has_measured.release();
      may_go_on.acquire();
    };
    return made;
  }
};

}  // namespace relievo::test
