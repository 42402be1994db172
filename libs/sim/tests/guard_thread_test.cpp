// SPDX-License-Identifier: Apache-2.0
#include "../src/guard_thread.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "live_fixture.hpp"
#include "rave/base/crash_note.hpp"
#include "rave/base_testing/no_threads.hpp"

namespace rave::sim::testing {
namespace {

const Command kDrive = velocity_command(0.3, 0);
const Command kStand = velocity_command(0, 0);

/// A robot whose pose comes all the time, and its guard; steps come when the test says so.
class Robot {
 public:
  explicit Robot(HandClock& clock) : clock_(clock) {}
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;
  ~Robot() { hand.let_go(); }

  void begin(GuardSpec limits = {}) {
    publish(0);
    auto started = GuardThread::start(setup_of(std::move(limits)), "anna");
    ASSERT_TRUE(started) << started.error().text();
    guard = *std::move(started);
  }
  [[nodiscard]] GuardThread::Setup setup_of(GuardSpec limits) {
    GuardThread::Setup setup;
    setup.limits = std::move(limits);
    setup.pose = {&queue_, ReadingKind::kPose, {}, from_seconds(0.5)};
    setup.actuators = {{&Hand::ops(), &hand, "hand"}};
    setup.clock = &clock_;
    setup.period = from_seconds(0.001);
    return setup;
  }
  void order(const Command& command) {
    GuardOrder& order = guard->next_order();
    order.demands = {{command, CommandKind::kVelocity, true, clock_.now()}};
    order.world_time = clock_.now();
    order.radius_m = 0.2;
    guard->give_order();
  }
  void publish(double x_m) {
    const PoseReading pose{x_m, 0, 0, 0, 0};
    EXPECT_TRUE(queue_.publish(clock_.now(), &pose, 1));
  }

  Hand hand;
  std::unique_ptr<GuardThread> guard;

 private:
  HandClock& clock_;
  SampleQueue queue_{ReadingKind::kPose, 1, 16, &clock_};
};

GuardSpec watchdog_alone() {
  GuardSpec limits;
  limits.world_lost = WorldLostPolicy::kIgnore;
  limits.watchdog_s = 0.3;
  return limits;
}

TEST(GuardThread, WithoutAThreadThereIsNoGuardAndNobodyDrives) {
  HandClock clock;
  Robot robot(clock);
  const base_testing::NoThreads none;
  const auto started = GuardThread::start(robot.setup_of({}), "anna");
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, ErrorCode::kIo);
  EXPECT_NE(started.error().message.find("cannot start the thread of the guard of robot `anna`"),
            std::string::npos)
      << started.error().text();
  EXPECT_TRUE(robot.hand.told().empty());
}

TEST(GuardThread, TheWatchdogBitesThoughNoStepComes) {
  HandClock clock;
  Robot robot(clock);
  robot.begin(watchdog_alone());
  robot.order(kDrive);
  ASSERT_TRUE(robot.hand.await(kDrive));
  clock.set(0.31);
  ASSERT_TRUE(robot.hand.await(kStand));
  // What it wrote is told after it was written.
  GuardNews news;
  const auto end = std::chrono::steady_clock::now() + kPatience;
  std::uint32_t begun = 0;
  do {
    robot.guard->look(news);
    begun |= news.begun;
  } while (!(begun != 0 && news.written[0].command == kStand) &&
           std::chrono::steady_clock::now() < end);
  EXPECT_EQ(begun, 1U << static_cast<unsigned>(GuardLimit::kWatchdog));
  EXPECT_EQ(news.written[0].command, kStand);
  robot.order(kDrive);
  EXPECT_TRUE(robot.hand.await(kDrive));
}

TEST(GuardThread, ACrashInTheDriverWouldNameItAndItsRobot) {
  HandClock clock;
  Robot robot(clock);
  std::string named;
  robot.hand.on_write = [&named](const Command&) {
    const CrashNote* const note = detail::crash_note;
    named = note == nullptr ? "nobody"
                            : fmt::format("{} {} of {}", note->part, note->driver, note->robot);
  };
  robot.begin(watchdog_alone());
  robot.order(kDrive);
  ASSERT_TRUE(robot.hand.await(kDrive));
  robot.guard->retire();
  robot.guard->join();
  EXPECT_EQ(named, "actuator hand of anna");
}

TEST(GuardThread, ADriverThatHangsBlindsNoOtherRobot) {
  HandClock clock;
  Robot hanging(clock);
  Robot other(clock);
  hanging.begin(watchdog_alone());
  other.begin(watchdog_alone());
  hanging.hand.hang();
  hanging.order(kDrive);
  other.order(kDrive);
  ASSERT_TRUE(hanging.hand.await_hanging());
  ASSERT_TRUE(other.hand.await(kDrive));
  clock.set(0.31);
  EXPECT_TRUE(other.hand.await(kStand));
  // The engine sees it, and is not held up by it.
  GuardNews news;
  hanging.order(kDrive);
  hanging.guard->look(news);
  EXPECT_NEAR(news.stuck.seconds(), 0.31, 1e-9);
  hanging.guard->stand();
  other.guard->look(news);
  EXPECT_LT(news.stuck.seconds(), 0.31);
  hanging.hand.let_go();
  EXPECT_TRUE(hanging.hand.await(kStand));
}

TEST(GuardThread, StandsWhenItIsToldToUntilTheNextOrder) {
  HandClock clock;
  Robot robot(clock);
  robot.begin();
  robot.order(kDrive);
  ASSERT_TRUE(robot.hand.await(kDrive));
  robot.guard->stand();
  ASSERT_TRUE(robot.hand.await(kStand));
  robot.order(kDrive);
  EXPECT_TRUE(robot.hand.await(kDrive));
}

TEST(GuardThread, ItsLastWordIsToStand) {
  HandClock clock;
  Robot robot(clock);
  robot.begin();
  robot.order(kDrive);
  ASSERT_TRUE(robot.hand.await(kDrive));
  EXPECT_TRUE(robot.guard->retire());
  EXPECT_FALSE(robot.guard->retire()) << "it has been told";
  robot.guard->join();
  EXPECT_EQ(robot.hand.told().back(), kStand);
  const std::size_t count = robot.hand.told().size();
  robot.order(kDrive);
  robot.guard.reset();
  EXPECT_EQ(robot.hand.told().size(), count) << "nobody writes any more";
}

TEST(GuardThread, SaysNothingBeforeItsFirstOrder) {
  HandClock clock;
  Robot robot(clock);
  robot.begin();
  robot.guard.reset();
  EXPECT_TRUE(robot.hand.told().empty());
}

TEST(GuardThread, TellsWhatTheDriverSaysOfACommand) {
  HandClock clock;
  Robot robot(clock);
  robot.begin();
  robot.hand.fail_with("no power");
  robot.order(kDrive);
  ASSERT_TRUE(robot.hand.await_count(2));
  GuardNews news;
  robot.guard->look(news);
  EXPECT_TRUE(news.written[0].failed);
  EXPECT_EQ(news.written[0].text, "no power");
}

/// The cart moves, and time passes, with each command that it is given.
TEST(GuardThread, TheFenceHoldsWhileStepsNeverComeAndOneThreadWrites) {
  HandClock clock;
  Robot robot(clock);
  double x_m = 0;
  std::atomic<double> farthest_m = 0;
  robot.hand.on_write = [&](const Command& command) {
    constexpr double kStep_s = 0.02;
    x_m += command.value[0] * kStep_s;
    farthest_m = std::max(farthest_m.load(), x_m);
    clock.advance(kStep_s);
    robot.publish(x_m);
  };
  GuardSpec limits;
  limits.world_lost = WorldLostPolicy::kIgnore;
  limits.watchdog_s = 1e6;
  limits.fence_W = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  robot.begin(limits);
  robot.order(velocity_command(1, 0));
  ASSERT_TRUE(robot.hand.await_count(1500));
  robot.guard.reset();
  EXPECT_LE(farthest_m, 2 - 0.2 + 1e-3);
  EXPECT_GT(farthest_m, 1.7) << "nothing else has stopped it";
  EXPECT_EQ(robot.hand.writers().size(), 1U);
}

}  // namespace
}  // namespace rave::sim::testing
