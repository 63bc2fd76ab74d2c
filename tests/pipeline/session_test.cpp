#include "relievo/session.h"

#include <gtest/gtest.h>

#include <thread>

#include "support/shapes.h"

namespace relievo {
namespace {

using namespace std::chrono_literals;

std::shared_ptr<const Cloud> cloud(std::size_t n = 5000) {
  return std::make_shared<const Cloud>(test::torus(n, 1, .4));
}

TEST(Session, PreparesAndMakesFrames) {
  Session session;
  EXPECT_EQ(session.model(), nullptr);
  EXPECT_EQ(session.frame(), nullptr);
  session.open(cloud(), {});
  const std::uint64_t number = session.request({});
  ASSERT_TRUE(session.wait_until_idle(60s));
  ASSERT_NE(session.frame(), nullptr);
  EXPECT_EQ(session.status().finished, number);
  EXPECT_FALSE(session.status().is_preparing);
  EXPECT_EQ(session.status().fraction, 1);
  EXPECT_EQ(session.frame()->heights.size(), session.model()->surface().points.size());
}

TEST(Session, ARequestBeforeTheModelWaitsForIt) {
  Session session;
  const std::uint64_t number = session.request({});
  session.open(cloud(), {});
  ASSERT_TRUE(session.wait_until_idle(60s));
  EXPECT_EQ(session.status().finished, number);
}

TEST(Session, TheLatestRequestWins) {
  Session session;
  session.open(cloud(20000), {});
  FrameOptions options;
  for (int i = 1; i <= 500; ++i) {
    options.shape.gamma = .0001 * i;
    session.request(options);
  }
  ASSERT_TRUE(session.wait_until_idle(60s));
  EXPECT_EQ(session.status().finished, 500U);
  EXPECT_DOUBLE_EQ(session.frame()->options.shape.gamma, .05);
}

TEST(Session, FramesDoNotChangeWhileHeld) {
  Session session;
  session.open(cloud(), {});
  session.request({});
  ASSERT_TRUE(session.wait_until_idle(60s));
  const std::shared_ptr<const Frame> held = session.frame();
  const std::vector<float> before = held->heights;
  FrameOptions other;
  for (int i = 0; i < 10; ++i) {
    other.shape.compression.u = .1 * (i + 1);
    session.request(other);
    ASSERT_TRUE(session.wait_until_idle(60s));
    ASSERT_NE(session.frame(), held);
  }
  EXPECT_EQ(held->heights, before);
}

TEST(Session, AFailedPreparationKeepsTheOldModel) {
  Session session;
  session.open(cloud(), {});
  session.request({});
  ASSERT_TRUE(session.wait_until_idle(60s));
  const auto model = session.model();
  session.open(std::make_shared<const Cloud>(), {});
  ASSERT_TRUE(session.wait_until_idle(60s));
  ASSERT_TRUE(session.status().error);
  EXPECT_EQ(session.status().error->kind, ErrorKind::geometry);
  EXPECT_EQ(session.model(), model);
  session.request({});
  ASSERT_TRUE(session.wait_until_idle(60s));
  EXPECT_EQ(session.status().finished, session.status().requested);
}

TEST(Session, CanBeCancelledBeforeDuringAfterAndTwice) {
  Session session;
  session.cancel();
  session.cancel();
  session.open(cloud(100000), {});
  std::this_thread::sleep_for(20ms);
  session.cancel();
  session.cancel();
  ASSERT_TRUE(session.wait_until_idle(60s));
  ASSERT_TRUE(session.status().error);
  EXPECT_EQ(session.status().error->kind, ErrorKind::cancelled);
  EXPECT_EQ(session.model(), nullptr);
  session.open(cloud(), {});
  ASSERT_TRUE(session.wait_until_idle(60s));
  session.cancel();
  EXPECT_NE(session.model(), nullptr);
  EXPECT_FALSE(session.status().error);
}

TEST(Session, ANewerOpeningReplacesAnOlder) {
  Session session;
  for (const std::size_t n : {100000, 80000, 60000, 3000}) session.open(cloud(n), {});
  ASSERT_TRUE(session.wait_until_idle(60s));
  ASSERT_NE(session.model(), nullptr);
  EXPECT_EQ(session.model()->surface().input_points, 3000U);
}

TEST(Session, EndsInTheMiddleOfWork) {
  for (int i = 0; i < 5; ++i) {
    Session session;
    session.open(cloud(30000), {});
    session.request({});
    std::this_thread::sleep_for(std::chrono::milliseconds(7 * i));
  }
}

TEST(Session, ManyThreadsMayAsk) {
  Session session;
  session.open(cloud(), {});
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&session] {
      for (int i = 0; i < 50; ++i) {
        session.request({});
        (void)session.status();
        (void)session.frame();
        (void)session.model();
      }
    });
  for (std::thread& thread : threads) thread.join();
  ASSERT_TRUE(session.wait_until_idle(60s));
  EXPECT_EQ(session.status().finished, 200U);
}

}  // namespace
}  // namespace relievo
