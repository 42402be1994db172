// SPDX-License-Identifier: Apache-2.0
#include "../src/closing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "rave/base/crash_note.hpp"
#include "rave/base_testing/no_threads.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::sim::testing {
namespace {

using Names = std::vector<std::string>;

/// Drivers that write down that they were closed; those that are held do not return before that.
class Drivers {
 public:
  void add(std::uint32_t robot, const char* name, bool is_held = false, bool is_shared = false) {
    instances_.push_back({this, name, is_held});
    asked_.push_back({RobotId(robot), "sensor", name, "fake", &Drivers::close, nullptr, is_shared});
  }
  [[nodiscard]] Names close_within(std::chrono::milliseconds limit) {
    for (std::size_t i = 0; i < asked_.size(); ++i) asked_[i].instance = &instances_[i];
    Names stuck;
    for (const ToClose& driver : sim::close_within(asked_, limit, nullptr))
      stuck.emplace_back(driver.name);
    return stuck;
  }
  void let_go() {
    held_ = false;
    held_.notify_all();
  }
  void await_closed(std::size_t count) {
    while (closed().size() < count) std::this_thread::yield();
  }
  [[nodiscard]] Names closed() {
    const std::lock_guard lock(mutex_);
    return closed_;
  }

 private:
  struct Instance {
    Drivers* drivers;
    std::string name;
    bool is_held;
  };
  static void close(void* instance) {
    const auto& [drivers, name, is_held] = *static_cast<Instance*>(instance);
    if (is_held) drivers->held_.wait(true);
    const std::lock_guard lock(drivers->mutex_);
    drivers->closed_.push_back(name);
  }

  std::vector<Instance> instances_;
  std::vector<ToClose> asked_;
  std::atomic<bool> held_ = true;
  std::mutex mutex_;
  Names closed_;
};

constexpr std::chrono::milliseconds kLong{60'000};

TEST(CloseWithin, ClosesAllInTheirOrder) {
  Drivers drivers;
  EXPECT_EQ(drivers.close_within(kLong), Names());
  for (const char* name : {"a", "b", "c"}) drivers.add(0, name);
  EXPECT_EQ(drivers.close_within(kLong), Names());
  EXPECT_EQ(drivers.closed(), Names({"a", "b", "c"}));
}

TEST(CloseWithin, WithoutAThreadClosesAllByItself) {
  Drivers drivers;
  for (const char* name : {"a", "b"}) drivers.add(0, name);
  const base_testing::NoThreads none;
  EXPECT_EQ(drivers.close_within(kLong), Names());
  EXPECT_EQ(drivers.closed(), (Names{"a", "b"}));
}

TEST(CloseWithin, ACrashInADriverWouldNameItAndItsRobot) {
  std::string named;
  ToClose driver{RobotId(0), "sensor", "laser", "fake"};
  driver.robot_name = "anna";
  driver.instance = &named;
  driver.close = [](void* instance) {
    const CrashNote* const note = detail::crash_note;
    if (note == nullptr) return;
    *static_cast<std::string*>(instance) =
        std::string(note->part) + " " + note->driver + " of " + note->robot;
  };
  EXPECT_TRUE(sim::close_within({driver}, kLong, nullptr).empty());
  EXPECT_EQ(named, "sensor fake of anna");
}

TEST(CloseWithin, LeavesWhoDoesNotReturnAndClosesTheOthers) {
  Drivers drivers;
  drivers.add(0, "first");
  drivers.add(1, "held", true);
  drivers.add(1, "beside it");
  drivers.add(1, "what it uses", false, true);
  drivers.add(2, "held, too", true);
  drivers.add(3, "another's device", false, true);
  EXPECT_EQ(drivers.close_within(std::chrono::seconds(3)), Names({"held", "held, too"}));
  EXPECT_EQ(drivers.closed(), Names({"first", "beside it", "another's device"}));
  // Their threads close nothing but what they were at.
  drivers.let_go();
  drivers.await_closed(5);
  Names closed = drivers.closed();
  std::sort(closed.begin(), closed.end());
  EXPECT_EQ(closed, Names({"another's device", "beside it", "first", "held", "held, too"}));
}

/// A pose source that is never done with its end.
class NeverCloses final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  static std::atomic<bool> at_last;  // for good: the thread goes with the process
  Status configure(const HardwareSetup&, HardwareDeclaration& declaration) override {
    declaration.clock = DriverClock::kLive;
    return {};
  }
  Status open(SampleSink&) override {
    ++opened;
    return {};
  }
  void close() override { at_last.wait(false); }
  static std::atomic<int> opened;
};
std::atomic<bool> NeverCloses::at_last = false;
std::atomic<int> NeverCloses::opened = 0;

std::atomic<int> kept = 0;

/// Live runs whose end does not wait for long.
class EngineEnd : public ::testing::Test {
 protected:
  EngineSpec live_spec() {
    EngineSpec spec;
    spec.live_clock = &clock_;
    spec.log = &ears_;
    spec.last_wait = std::chrono::milliseconds(500);
    return spec;
  }
  [[nodiscard]] const std::string& heard() const { return ears_.heard; }

 private:
  ClockAtZero clock_;
  Ears ears_;
};

TEST_F(EngineEnd, IsNotHeldUpByADriverThatNeverCloses) {
  EngineSpec spec = live_spec();
  spec.keep_loaded = [](const void* function) { kept += function != nullptr ? 1 : 0; };
  RobotType type = real_type({});
  type.sensors.front() = real_sensor<NeverCloses>("mocap", {});
  add_robot(spec, std::move(type));
  const std::string name = spec.robots.back().name;
  auto engine = make_engine(std::move(spec));
  run(*engine, 3);
  const Status again = engine->reset();
  ASSERT_FALSE(again) << "its driver is in use";
  EXPECT_NE(again.error().text().find("cannot restart"), std::string::npos);
  engine.reset();
  const std::string expected = fmt::format(
      "robot {}: sensor `mocap` (driver `mocap`) is still closing; the run ends without it", name);
  EXPECT_NE(heard().find(expected), std::string::npos) << heard();
  EXPECT_GE(kept, 1) << "the plug-in of a thread that goes on";
}

TEST_F(EngineEnd, IsNotHeldUpByADriverOfAHandOverThatNeverCloses) {
  EngineSpec spec = live_spec();
  // The 30 s in which drivers have to open are three million steps.
  spec.step = Duration{10'000};
  RobotType simulated = simulated_type();
  simulated.sensors.push_back(virtual_sensor<Beacon>("mocap"));
  const RobotId robot = add_robot(spec, std::move(simulated));
  RobotType real = real_type({});
  real.sensors.front() = real_sensor<NeverCloses>("mocap", {});
  spec.robots.back().twin = static_cast<std::uint32_t>(spec.types.size());
  spec.types.push_back(std::move(real));
  auto engine = make_engine(std::move(spec));
  const int opened = NeverCloses::opened;
  ASSERT_TRUE(engine->hand_over(robot, DriverSet::kTwin));
  // It is open and says nothing, so it never serves.
  while (NeverCloses::opened == opened) {
    run(*engine, 1);
    std::this_thread::yield();
  }
  engine.reset();
  EXPECT_NE(heard().find("sensor `mocap` (driver `mocap`) is still closing"), std::string::npos)
      << heard();
}

class NeverOpened final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  Status configure(const HardwareSetup&, HardwareDeclaration& declaration) override {
    declaration.clock = DriverClock::kLive;
    return {};
  }
  Status open(SampleSink&) override { return fail(ErrorCode::kIo, "no device"); }
  void close() override {}
};

/// As of a topic that nobody writes.
class NeverConfigured final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  Status configure(const HardwareSetup&, HardwareDeclaration&) override {
    return fail(ErrorCode::kIo, "nobody is there");
  }
  Status open(SampleSink&) override { return {}; }
  void close() override {}
};

TEST_F(EngineEnd, ComesAfterAStartThatFailedWithADriverThatNeverCloses) {
  EngineSpec spec = live_spec();
  RobotType type = real_type({});
  type.sensors.front() = real_sensor<NeverCloses>("mocap", {});
  type.sensors.push_back(real_sensor<NeverOpened>("second", {}));
  add_robot(spec, std::move(type));
  const auto engine = Engine::create(std::move(spec));
  ASSERT_FALSE(engine);
  EXPECT_NE(engine.error().text().find("no device"), std::string::npos) << engine.error().text();
  EXPECT_NE(heard().find("is still closing"), std::string::npos) << heard();
}

TEST_F(EngineEnd, ComesAfterAStartThatFailedBeforeAllWasMade) {
  EngineSpec spec;
  RobotType type = real_type({});
  type.sensors.insert(type.sensors.begin(), real_sensor<NeverConfigured>("first", {}));
  add_robot(spec, std::move(type));
  const auto engine = Engine::create(std::move(spec));
  ASSERT_FALSE(engine);
  EXPECT_NE(engine.error().text().find("nobody is there"), std::string::npos);
}

}  // namespace
}  // namespace rave::sim::testing
