#include "relievo/session.h"
#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"

#include <gtest/gtest.h>

#include <thread>

#include "support/preparations.h"

namespace relievo {
namespace {

using namespace std::chrono_literals;
using test::preparation_of, test::Stuck;

Preparation failing() {
  return {.points = [](Progress&) -> Preparation::Points {
    return std::unexpected(Error{ErrorKind::input, "scan.ply", {}, "expected a scan"});
  }};
}

TEST(Session, Prepares) {
  Session session;
  EXPECT_EQ(session.model(), nullptr);
  test::open_and_wait(session, preparation_of(5000));
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
  test::open_and_wait(session);
  const auto model = session.model();
  bool was_ready = false;
  Preparation preparation = failing();
  preparation.ready = [&](const Preparation::Model&) { was_ready = true; };
  test::open_and_wait(session, preparation);
  ASSERT_TRUE(session.status().error);
  EXPECT_EQ(session.status().error->kind, ErrorKind::input);
  EXPECT_EQ(session.model(), model);
  EXPECT_FALSE(was_ready);
}

TEST(Session, ANewOpeningForgetsAnOldError) {
  Stuck stuck;
  Session session;
  test::open_and_wait(session, failing());
  session.open(stuck.preparation());
  stuck.has_begun.acquire();
  EXPECT_FALSE(session.status().error);
  EXPECT_TRUE(session.status().is_preparing);
}

TEST(Session, CanBeCancelledBeforeAndAfter) {
  Session session;
  session.cancel();
  EXPECT_FALSE(session.status().error);
  test::open_and_wait(session);
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

// Even if work rarely checks whether it was cancelled, the user must not have to wait for the work, and the
// result of the work must not appear later.
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

TEST(Session, ShowsALargeCloudBeforeAllItsPointsAreMeasured) {
  Session session;
  Preparation preparation = preparation_of(310'000);
  preparation.makes_first_relief = true;
  std::optional<Result<ShownModel>> first, other;
  preparation.changed = [&] {
    if (first || session.status().stage != "spacing") return;
    EXPECT_TRUE(session.status().can_turn);
    first = session.turn(preparation.view);
    other = session.turn(*view_towards(Vec3::UnitX(), Vec3::UnitY()));
  };
  test::open_and_wait(session, preparation);
  ASSERT_TRUE(first && *first);
  const Surface& early = (*first)->model->surface();
  EXPECT_NEAR(static_cast<double>(early.input_points), 150'000, 1500);
  EXPECT_FALSE(*other);
  EXPECT_EQ(other->error().kind, ErrorKind::cancelled);
  const Box part = Box::of(early.points), whole = Box::of(session.model()->surface().points);
  EXPECT_LT((part.size() - whole.size()).norm(), .01 * whole.diagonal());
  const auto turned = session.turn(*view_towards(Vec3::UnitX(), Vec3::UnitY()));
  ASSERT_TRUE(turned);
  EXPECT_GT(turned->model->surface().input_points, 150'000U);
}

TEST(Session, CropsALargeCloudBeforeAllItsPointsAreMeasured) {
  Session session;
  Preparation preparation = preparation_of(310'000);
  preparation.view.crop = {.least = {.2, 0}, .most = {.6, 1}};
  preparation.makes_first_relief = true;
  std::optional<Box> first;
  preparation.changed = [&] {
    if (first || session.status().stage != "spacing") return;
    first = Box::of(session.turn(preparation.view).value().model->surface().points);
  };
  test::open_and_wait(session, preparation);
  ASSERT_TRUE(first);
  const Box whole = Box::of(session.model()->surface().points);
  EXPECT_LT((first->size() - whole.size()).head<2>().norm(), .02 * whole.diagonal());
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
  test::open_and_wait(session);
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
  session.open(second);  // cancels the first preparation; the second never begins
  test::open_and_wait(session, third);
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

}  // namespace
}  // namespace relievo
