// Tests sessions while their model is being turned.
#include <thread>

#include "relievo/relief/relief.h"
#include "relievo/scan/surface.h"
#include "support/preparations.h"
#include "support/results.h"

namespace relievo {
namespace {

using namespace std::chrono_literals;
using test::HeldAtPoints, test::preparation_of, test::Stuck;

View view_to(const char* direction) {
  return parse_view(direction).value();
}

TEST(Session, TurnsWhatWasPrepared) {
  Session session;
  test::open_and_wait(session, preparation_of(20'000));
  const auto model = session.model();
  const auto turned = value_of(session.turn(view_to("1,1,1")));
  EXPECT_EQ(turned.model->surface().view, view_to("1,1,1"));
  EXPECT_EQ(session.model(), model);
}

TEST(Session, HasNothingToTurnAtFirst) {
  Session session;
  EXPECT_FALSE(session.status().can_turn);
  EXPECT_EQ(session.turn({}).error().kind, ErrorKind::geometry);
}

TEST(Session, TurnsWhatIsMeasuredBeforeTheFirstModel) {
  Session session;
  HeldAtPoints held{session};
  session.open(held.preparation(20'000));
  held.has_measured.acquire();
  EXPECT_TRUE(session.status().can_turn);
  EXPECT_EQ(session.model(), nullptr);
  const auto turned = session.turn({});
  held.may_go_on.release();
  EXPECT_TRUE(turned);
  ASSERT_TRUE(session.wait_until_idle(60s));
  EXPECT_NE(session.model(), nullptr);
}

std::shared_ptr<const ReliefModel> turned_model(Session& session, const View& view = {}) {
  return value_of(session.turn(view)).model;
}

// Opens a scan, and waits until its points are measured.
void open_until_measured(Session& session, HeldAtPoints& held, bool makes_first_relief = true) {
  Preparation preparation = held.preparation(20'000);
  preparation.makes_first_relief = makes_first_relief;
  session.open(preparation);
  held.has_measured.acquire();
}

// Calls turn() twice before the first model is ready. Returns whether both calls returned the same relief.
bool turns_once(bool makes_first_relief) {
  Session session;
  HeldAtPoints held{session};
  open_until_measured(session, held, makes_first_relief);
  const auto first = turned_model(session), second = turned_model(session);
  EXPECT_NE(turned_model(session, view_to("1,0,1")), first);
  held.may_go_on.release();
  EXPECT_TRUE(session.wait_until_idle(60s));
  return first == second;
}

TEST(Session, HasTheFirstReliefBeforeItIsAskedFor) {
  EXPECT_TRUE(turns_once(true));
  EXPECT_FALSE(turns_once(false));
}

TEST(Session, ForgetsTheFirstReliefOfOtherPoints) {
  Session session;
  HeldAtPoints old{session}, held{session};
  open_until_measured(session, old);
  const auto first = turned_model(session);
  session.open(held.preparation(10'000));
  old.may_go_on.release();
  held.has_measured.acquire();
  EXPECT_NE(turned_model(session), first);
  held.may_go_on.release();
  ASSERT_TRUE(session.wait_until_idle(60s));
}

// Returns whether a scan that was measured can still be turned while the next preparation reads its points.
bool turns_while_reading(bool is_of_other_scan) {
  Session session;
  HeldAtPoints held{session};
  open_until_measured(session, held);
  EXPECT_TRUE(session.status().can_turn);
  Stuck stuck;
  Preparation next = stuck.preparation();
  next.is_of_other_scan = is_of_other_scan;
  session.open(next);
  held.may_go_on.release();
  stuck.has_begun.acquire();
  const bool can_turn = session.status().can_turn;
  for (const char* view : {"front", "left"})
    EXPECT_EQ(session.turn(view_to(view)).has_value(), can_turn) << view;
  session.cancel();
  EXPECT_TRUE(session.wait_until_idle(60s));
  return can_turn;
}

TEST(Session, DoesNotTurnThePreviousScanWhileItReadsAnother) {
  EXPECT_FALSE(turns_while_reading(true));
  EXPECT_TRUE(turns_while_reading(false));
}

TEST(Session, TurnsThePreviousModelWhileItReadsAnotherScan) {
  Session session;
  test::open_and_wait(session);
  Stuck stuck;
  Preparation next = stuck.preparation();
  next.is_of_other_scan = true;
  session.open(next);
  stuck.has_begun.acquire();
  EXPECT_TRUE(session.turn(view_to("1,0,1")));
  session.cancel();
  ASSERT_TRUE(session.wait_until_idle(60s));
}

TEST(Session, CancelsTheFirstReliefWithItsPreparation) {
  Session session;
  std::binary_semaphore has_begun{0};
  Preparation preparation = preparation_of(20'000);
  preparation.makes_first_relief = true;
  std::atomic<int> asked = 0;
  preparation.all_sides = [&](Progress& progress) -> Preparation::Points {
    ++asked;
    has_begun.release();
    while (!progress.is_cancelled()) std::this_thread::sleep_for(1ms);
    return cancelled_error();
  };
  session.open(preparation);
  has_begun.acquire();
  EXPECT_FALSE(session.status().can_turn);
  test::open_and_wait(session, preparation_of(5000));
  EXPECT_NE(session.model(), nullptr);
  EXPECT_EQ(asked, 1);
}

// The view at the end of a turn may already be in preparation when the last picture of the turn is requested.
TEST(Session, TurningLeavesThePreparationAlone) {
  Session session;
  test::open_and_wait(session);
  Stuck stuck;
  session.open(stuck.preparation());
  stuck.has_begun.acquire();
  EXPECT_TRUE(session.turn(view_to("1,0,1")));
  EXPECT_TRUE(session.status().is_preparing);
  EXPECT_FALSE(stuck.has_ended);
  session.cancel();
  ASSERT_TRUE(session.wait_until_idle(60s));
}

// A session whose first turn gets no points until it is cancelled; then it gets the points of all sides.
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
    test::open_and_wait(session, preparation);
  }

  // Calls turn() in another thread, and calls `end` while turn() waits for the points. Returns the error of
  // turn(), if there is one.
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

// The view at the end of a drag is opened while the last picture of this drag is still being drawn.
TEST(Session, AnOpeningLeavesTurningAlone) {
  StuckTurn stuck;
  EXPECT_EQ(stuck.error_after([&] {
    test::open_and_wait(stuck.session, preparation_of(4000));
    EXPECT_FALSE(stuck.has_ended);
    stuck.session.cancel();
  }),
            ErrorKind::cancelled);
}

TEST(Session, ManyThreadsMayTurn) {
  Session session;
  test::open_and_wait(session, preparation_of(3000));
  std::atomic<int> turned = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 8; ++i) {
        View view = *parse_view(cat(.1 * i, ",", .2 * t, ",1"));
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
