#include "relievo/session.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"

#include <gtest/gtest.h>

#include <atomic>
#include <semaphore>
#include <thread>

#include "support/shapes.h"

namespace relievo {
namespace {

using namespace std::chrono_literals;

Preparation preparation_of(std::size_t points = 5000) {
  return {.points = [points](Progress&) -> Preparation::Points {
    return std::make_shared<const Cloud>(test::torus(points, 1, .4));
  }};
}

Preparation failing() {
  return {.points = [](Progress&) -> Preparation::Points {
    return std::unexpected(Error{ErrorKind::input, "scan.ply", {}, "expected a scan"});
  }};
}

// A preparation whose points come only when it has been cancelled.
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

TEST(Session, Prepares) {
  Session session;
  EXPECT_EQ(session.model(), nullptr);
  session.open(preparation_of(5000));
  ASSERT_TRUE(session.wait_until_idle(60s));
  ASSERT_NE(session.model(), nullptr);
  EXPECT_EQ(session.model()->surface().input_points, 5000U);
  EXPECT_FALSE(session.status().is_preparing);
  EXPECT_EQ(session.status().fraction, 1);
  EXPECT_FALSE(session.status().error);
}

TEST(Session, HandsOverTheModelOnceAndBeforeItIsReady) {
  Session session;
  std::vector<std::shared_ptr<const ReliefModel>> models;
  Preparation preparation = preparation_of();
  preparation.ready = [&](const Preparation::Model& model) { models.push_back(model); };
  session.open(preparation);
  while (session.status().is_preparing) std::this_thread::yield();
  ASSERT_EQ(models.size(), 1U);
  EXPECT_EQ(models[0], session.model());
}

TEST(Session, AFailedPreparationKeepsTheOldModel) {
  Session session;
  session.open(preparation_of());
  ASSERT_TRUE(session.wait_until_idle(60s));
  const auto model = session.model();
  bool was_ready = false;
  Preparation preparation = failing();
  preparation.ready = [&](const Preparation::Model&) { was_ready = true; };
  session.open(preparation);
  ASSERT_TRUE(session.wait_until_idle(60s));
  ASSERT_TRUE(session.status().error);
  EXPECT_EQ(session.status().error->kind, ErrorKind::input);
  EXPECT_EQ(session.model(), model);
  EXPECT_FALSE(was_ready);
}

TEST(Session, ANewOpeningForgetsAnOldError) {
  Stuck stuck;
  Session session;
  session.open(failing());
  ASSERT_TRUE(session.wait_until_idle(60s));
  session.open(stuck.preparation());
  stuck.has_begun.acquire();
  EXPECT_FALSE(session.status().error);
  EXPECT_TRUE(session.status().is_preparing);
}

TEST(Session, CanBeCancelledBeforeAndAfter) {
  Session session;
  session.cancel();
  EXPECT_FALSE(session.status().error);
  session.open(preparation_of());
  ASSERT_TRUE(session.wait_until_idle(60s));
  session.cancel();
  session.cancel();
  EXPECT_NE(session.model(), nullptr);
  EXPECT_FALSE(session.status().error);
}

TEST(Session, CanBeCancelledWhileItPrepares) {
  Stuck stuck;
  Session session;
  session.open(stuck.preparation());
  stuck.has_begun.acquire();
  session.cancel();
  session.cancel();
  ASSERT_TRUE(session.wait_until_idle(60s));
  ASSERT_TRUE(session.status().error);
  EXPECT_EQ(session.status().error->kind, ErrorKind::cancelled);
  EXPECT_EQ(session.model(), nullptr);
}

// Work that asks rarely must not keep the user waiting, nor may what comes of it appear later.
TEST(Session, SaysAtOnceThatItIsCancelled) {
  Session session;
  std::binary_semaphore has_begun{0}, goes_on{0};
  Preparation slow = preparation_of();
  slow.points = [&, points = slow.points](Progress& progress) {
    has_begun.release();
    goes_on.acquire();
    return points(progress);
  };
  bool is_ready = false;
  slow.ready = [&](const Preparation::Model&) { is_ready = true; };
  session.open(slow);
  has_begun.acquire();
  session.cancel();
  EXPECT_FALSE(session.status().is_preparing);
  EXPECT_EQ(session.status().error->kind, ErrorKind::cancelled);
  goes_on.release();
  ASSERT_TRUE(session.wait_until_idle(60s));
  EXPECT_FALSE(is_ready);
  EXPECT_EQ(session.model(), nullptr);
  EXPECT_EQ(session.status().error->kind, ErrorKind::cancelled);
}

TEST(Session, LetsGoOfPointsOfWhichNoModelCame) {
  Session session;
  std::weak_ptr<const Cloud> read;
  std::binary_semaphore is_measured{0}, goes_on{0};
  Preparation preparation = preparation_of();
  preparation.points = [&, points = preparation.points](Progress& progress) {
    const Preparation::Points made = points(progress);
    read = *made;
    return made;
  };
  bool is_first = true;
  preparation.changed = [&] {
    if (!is_first || session.status().stage != "curvature") return;
    is_first = false;
    is_measured.release();
    goes_on.acquire();
  };
  session.open(preparation);
  is_measured.acquire();
  EXPECT_FALSE(read.expired());
  session.cancel();
  goes_on.release();
  ASSERT_TRUE(session.wait_until_idle(60s));
  EXPECT_TRUE(read.expired());
  session.open(preparation_of());
  ASSERT_TRUE(session.wait_until_idle(60s));
  EXPECT_NE(session.model(), nullptr);
}

TEST(Session, CanBeCancelledWhileItWaits) {
  Stuck stuck;
  Session session;
  session.open(stuck.preparation());
  stuck.has_begun.acquire();
  bool was_called = false;
  session.open({.points = [&](Progress&) -> Preparation::Points {
    was_called = true;
    return std::make_shared<const Cloud>();
  }});
  session.cancel();
  ASSERT_TRUE(session.wait_until_idle(60s));
  ASSERT_TRUE(session.status().error);
  EXPECT_EQ(session.status().error->kind, ErrorKind::cancelled);
  EXPECT_FALSE(session.status().is_preparing);
  EXPECT_FALSE(was_called || session.model());
}

TEST(Session, ANewerOpeningReplacesAnOlder) {
  Stuck stuck;
  Session session;
  std::atomic<int> ready = 0;
  const auto count = [&](const Preparation::Model&) { ++ready; };
  Preparation first = stuck.preparation(), second = preparation_of(4000), third = preparation_of(3000);
  first.ready = second.ready = third.ready = count;
  session.open(first);
  stuck.has_begun.acquire();
  session.open(second);  // cancels the first, and is itself never begun
  session.open(third);
  ASSERT_TRUE(session.wait_until_idle(60s));
  ASSERT_NE(session.model(), nullptr);
  EXPECT_EQ(ready, 1);
  EXPECT_EQ(session.model()->surface().input_points, 3000U);
  EXPECT_FALSE(session.status().error);
}

TEST(Session, EndsInTheMiddleOfWorkWhichItWaitsFor) {
  Stuck stuck;
  {
    Session session;
    session.open(stuck.preparation());
    stuck.has_begun.acquire();
    EXPECT_FALSE(stuck.has_ended);
  }
  EXPECT_TRUE(stuck.has_ended);
}

TEST(Session, ManyThreadsMayAsk) {
  Session session;
  std::atomic<int> ready = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 10; ++i) {
        Preparation preparation = preparation_of(2000);
        preparation.ready = [&](const Preparation::Model&) { ++ready; };
        session.open(preparation);
        (void)session.status();
        (void)session.model();
      }
    });
  for (std::thread& thread : threads) thread.join();
  ASSERT_TRUE(session.wait_until_idle(60s));
  EXPECT_NE(session.model(), nullptr);
  EXPECT_GE(ready, 1);
  EXPECT_LE(ready, 40);
}

View view_to(const char* direction) {
  return parse_view(direction).value();
}

TEST(Session, TurnsWhatWasPrepared) {
  Session session;
  session.open(preparation_of(20'000));
  ASSERT_TRUE(session.wait_until_idle(60s));
  const auto model = session.model();
  const auto turned = session.turn(view_to("1,1,1"));
  ASSERT_TRUE(turned) << turned.error().message();
  EXPECT_EQ(turned->model->surface().view, view_to("1,1,1"));
  EXPECT_EQ(turned->model->membrane_at(1), model->membrane_at(1));
  EXPECT_EQ(session.model(), model);
}

TEST(Session, HasNothingToTurnAtFirst) {
  Session session;
  EXPECT_FALSE(session.status().can_turn);
  EXPECT_EQ(session.turn({}).error().kind, ErrorKind::geometry);
}

TEST(Session, TurnsWhatIsMeasuredBeforeTheFirstModel) {
  Session session;
  std::binary_semaphore has_measured{0}, may_go_on{0};
  Preparation preparation = preparation_of(20'000);
  preparation.changed = [&] {
    if (session.status().stage != "visible points") return;
    has_measured.release();
    may_go_on.acquire();
  };
  session.open(preparation);
  has_measured.acquire();
  EXPECT_TRUE(session.status().can_turn);
  EXPECT_EQ(session.model(), nullptr);
  const auto turned = session.turn({});
  may_go_on.release();
  EXPECT_TRUE(turned);
  ASSERT_TRUE(session.wait_until_idle(60s));
  EXPECT_NE(session.model(), nullptr);
}

// A picture of the model while it is turned may be asked for late, when the view in which it rests is being prepared.
TEST(Session, TurningLeavesThePreparationAlone) {
  Session session;
  session.open(preparation_of());
  ASSERT_TRUE(session.wait_until_idle(60s));
  Stuck stuck;
  session.open(stuck.preparation());
  stuck.has_begun.acquire();
  EXPECT_TRUE(session.turn(view_to("1,0,1")));
  EXPECT_TRUE(session.status().is_preparing);
  EXPECT_FALSE(stuck.has_ended);
  session.cancel();
  ASSERT_TRUE(session.wait_until_idle(60s));
}

// Points of all sides that come only when the turn that waits for them has been cancelled.
struct StuckTurn {
  std::binary_semaphore has_begun{0};
  std::atomic<bool> is_first = true, has_ended = false;
  Session session;

  StuckTurn() {
    Preparation preparation = preparation_of();
    preparation.all_sides = [this](Progress& progress) -> Preparation::Points {
      if (is_first.exchange(false)) {
        has_begun.release();
        while (!progress.is_cancelled()) std::this_thread::yield();
      }
      return std::make_shared<const Cloud>(test::torus(3000, 1, .4));
    };
    session.open(preparation);
    EXPECT_TRUE(session.wait_until_idle(60s));
  }

  // Calls turn() in a thread, then `end`, and returns the error.
  template <typename F>
  std::optional<ErrorKind> error_after(F&& end) {
    std::optional<ErrorKind> error;
    std::thread thread([&] {
      const auto turned = session.turn(view_to("1,1,1"));
      has_ended = true;
      if (!turned) error = turned.error().kind;
    });
    has_begun.acquire();
    end();
    thread.join();
    return error;
  }
};

TEST(Session, TheNewestTurnWins) {
  StuckTurn stuck;
  bool has_turned = false;
  EXPECT_EQ(stuck.error_after([&] { has_turned = stuck.session.turn(view_to("1,2,3")).has_value(); }),
            ErrorKind::cancelled);
  EXPECT_TRUE(has_turned);
}

TEST(Session, TurningCanBeCancelled) {
  StuckTurn stuck;
  EXPECT_EQ(stuck.error_after([&] { stuck.session.cancel(); }), ErrorKind::cancelled);
  EXPECT_TRUE(stuck.session.turn(view_to("1,1,1")));
}

// The view in which a drag rests is opened while the last picture of the drag is still drawn.
TEST(Session, AnOpeningLeavesTurningAlone) {
  StuckTurn stuck;
  EXPECT_EQ(stuck.error_after([&] {
    stuck.session.open(preparation_of(4000));
    EXPECT_TRUE(stuck.session.wait_until_idle(60s));
    EXPECT_FALSE(stuck.has_ended);
    stuck.session.cancel();
  }),
            ErrorKind::cancelled);
}

TEST(Session, ManyThreadsMayTurn) {
  Session session;
  session.open(preparation_of(3000));
  ASSERT_TRUE(session.wait_until_idle(60s));
  std::atomic<int> turned = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 8; ++i) {
        View view = view_from_euler(.1 * i, .2 * t);
        if (i == 3) session.open(preparation_of(2000 + static_cast<std::size_t>(t)));
        const auto made = session.turn(view);
        turned += made.has_value();
        EXPECT_EQ(made.has_value() ? ErrorKind::cancelled : made.error().kind, ErrorKind::cancelled);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_GE(turned, 1);
}

}  // namespace
}  // namespace relievo
