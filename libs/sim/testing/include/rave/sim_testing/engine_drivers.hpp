// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "rave/math/scalar.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "rave/sim/virtual_sensor.hpp"
#include "rave/sim_testing/given.hpp"

/// Tiny drivers and programs for tests of the engine, used through their tables of functions.
namespace rave::sim::testing {

/// Drives with one velocity; can stop commanding, throw or say nonsense at a given decision.
class Drive final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    params_ = {given(setup.params(), "v"), given(setup.params(), "w")};
    quiet_after_ = when(setup, "quiet_after");
    throw_at_ = when(setup, "throw_at");
    nan_at_ = when(setup, "nan_at");
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    return {};
  }
  void decide(const Percepts&, Commands& commands) override {
    const int decision = decision_++;
    if (decision == throw_at_) throw std::runtime_error("out of ideas");
    if (quiet_after_ >= 0 && decision >= quiet_after_) return;
    const double v = decision == nan_at_ ? std::numeric_limits<double>::quiet_NaN() : params_.v_mps;
    commands.velocity(drive_, v, params_.w_radps);
  }

 private:
  /// 0 stands for never, so that tests need not give it.
  static int when(const Setup& setup, std::string_view name) {
    const auto decision = static_cast<int>(given(setup.params(), name));
    return decision > 0 ? decision : -1;
  }
  VelocityReading params_;
  ControllerHandle drive_;
  int decision_ = 0;
  int quiet_after_ = -1;
  int throw_at_ = -1;
  int nan_at_ = -1;
};

/// Goes ahead and turns away from what its first range sensor says is near; draws random turns.
class Roam final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    RAVE_TRY_ASSIGN(laser_, setup.sensor<float>());
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    return {};
  }
  void decide(const Percepts& percepts, Commands& commands) override {
    RandomStream random = percepts.random();
    float nearest = std::numeric_limits<float>::infinity();
    for (const float range : percepts[laser_]) nearest = range < nearest ? range : nearest;
    if (nearest < 0.4F) {
      commands.velocity(drive_, 0.05, 1.5);
    } else {
      commands.velocity(drive_, 0.5, random.uniform(-1, 1));
    }
  }

 private:
  RangesHandle laser_;
  ControllerHandle drive_;
};

/// Keeps an entry for each decision.
class Diary final : public DecisionProcess {
 public:
  struct Entry {
    std::int64_t now_ns = 0;
    std::int64_t stamp_ns = 0;
    std::uint32_t sequence = 0;
    std::uint32_t fresh = 0;
    std::uint32_t count = 0;
    double first = 0;
    double reported_x_m = 0;
  };
  /// Belongs to the one test that runs an engine of one robot.
  static std::vector<Entry>& entries() {
    static std::vector<Entry> all;
    return all;
  }
  Status start(const Setup& setup) override {
    const auto found = setup.sensor<double>();
    if (found) values_ = *found;
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    entries().clear();
    v_mps_ = given(setup.params(), "v");
    return {};
  }
  void decide(const Percepts& percepts, Commands& commands) override {
    Entry entry;
    entry.now_ns = percepts.now().ns;
    entry.reported_x_m = percepts.pose().x_m;
    if (values_.valid()) {
      const SampleHeader& header = percepts.header(values_);
      entry.stamp_ns = header.stamp_ns;
      entry.sequence = header.sequence;
      entry.fresh = header.fresh;
      entry.count = header.count;
      if (header.count > 0) entry.first = percepts[values_][0];
    }
    entries().push_back(entry);
    commands.velocity(drive_, v_mps_, 0);
  }

 private:
  SensorHandle<double> values_;
  ControllerHandle drive_;
  double v_mps_ = 0;
};

/// Hands a velocity on; stops when the command is older than 0.1 s.
class Pass final : public Controller {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  static constexpr CommandKind kGives = CommandKind::kVelocity;
  Status start(const DeviceSetup& setup) override {
    throw_after_ = static_cast<std::int64_t>(given(setup.parameters(), "throw_after"));
    return {};
  }
  Command control(const ControlInput& input) override {
    if (throw_after_ > 0 && ++calls_ > throw_after_) throw std::runtime_error("burnt out");
    const bool stop = input.command.kind == CommandKind::kNone || input.command_age_s > 0.1;
    return stop ? velocity_command(0, 0) : input.command;
  }

 private:
  std::int64_t throw_after_ = 0;
  std::int64_t calls_ = 0;
};

/// Reaches each command at once.
class Wheels final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  Status start(const DeviceSetup& setup) override {
    const Params params = setup.parameters();
    throw_after_ = static_cast<std::int64_t>(given(params, "throw_after"));
    nan_after_ = static_cast<std::int64_t>(given(params, "nan_after"));
    shake_ = given(params, "shake");
    return {};
  }
  Twist2 propose(const MotionInput& input) override {
    ++calls_;
    if (throw_after_ > 0 && calls_ > throw_after_) throw std::runtime_error("a wheel came off");
    if (nan_after_ > 0 && calls_ > nan_after_) {
      return {std::numeric_limits<double>::quiet_NaN(), 0, 0};
    }
    RandomStream random = input.random();
    return {input.command.value[0] + shake_ * random.uniform(-1, 1), 0, input.command.value[1]};
  }

 private:
  std::int64_t throw_after_ = 0;
  std::int64_t nan_after_ = 0;
  std::int64_t calls_ = 0;
  double shake_ = 0;
};

/// A laser of `rays` over `fov_rad`.
class Laser final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kRanges;
  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const auto rays =
        static_cast<std::uint32_t>(static_cast<std::int64_t>(given(setup.parameters(), "rays")));
    const double fov_rad = given(setup.parameters(), "fov_rad");
    for (std::uint32_t i = 0; i < rays; ++i) {
      bearings_rad_.push_back(rays == 1 ? 0 : fov_rad * (double{1} * i / (rays - 1) - 0.5));
    }
    declaration.uses_fan = 1;
    declaration.fan = {bearings_rad_.data(), rays, 1, 0.01, given(setup.parameters(), "range_m")};
    return {};
  }

 private:
  std::vector<double> bearings_rad_;
};

/// Says how often it was asked, kept in the state of the robot; throws at `throw_at`.
class Counter final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;
  struct State {
    double calls = 0;
  };
  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration&) override {
    throw_at_ = given(setup.parameters(), "throw_at");
    return {};
  }
  void sample(const WorldView&, const SampleItem& item) const override {
    auto* const state = static_cast<State*>(item.state);
    state->calls += 1;
    if (throw_at_ > 0 && state->calls >= throw_at_) throw std::runtime_error("lens cap on");
    *static_cast<double*>(item.records) = state->calls;
    item.header->count = 1;
  }

 private:
  double throw_at_ = 0;
};

/// The true pose, `offset_m` beside it, with a random error up to `error_m`.
class Beacon final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration&) override {
    offset_m_ = given(setup.parameters(), "offset_m");
    error_m_ = given(setup.parameters(), "error_m");
    return {};
  }
  void sample(const WorldView&, const SampleItem& item) const override {
    RandomStream random = item.random();
    auto* const reading = static_cast<PoseReading*>(item.records);
    *reading = {item.X_WR.x + offset_m_ + error_m_ * random.uniform(-1, 1), item.X_WR.y,
                item.X_WR.yaw, 0, 0};
    item.header->count = 1;
  }

 private:
  double offset_m_ = 0;
  double error_m_ = 0;
};

/// A recording: a pose that moves in a straight line from (x, y) with (vx, vy), every `period_s`
/// from `first_s` on, silent between `gap_s` and `gap_end_s`. Own thread.
class Recording final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  ~Recording() override { close(); }
  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override {
    const Params params = setup.parameters();
    x_m_ = given(params, "x");
    y_m_ = given(params, "y");
    vx_mps_ = given(params, "vx");
    vy_mps_ = given(params, "vy");
    first_s_ = given(params, "first_s");
    gap_s_ = given(params, "gap_s");
    gap_end_s_ = given(params, "gap_end_s");
    fail_s_ = given(params, "fail_s");
    silent_ = (given(params, "silent") != 0);
    steps_back_ = (given(params, "steps_back") != 0);
    if ((given(params, "live") != 0)) declaration.clock = DriverClock::kLive;
    declaration.period_s = (given(params, "no_period") != 0) ? 0 : 0.007;
    return {};
  }
  Status open(SampleSink& sink) override {
    thread_ = std::thread([this, &sink] { play(sink); });
    return {};
  }
  void close() override {
    if (thread_.joinable()) thread_.join();
  }

 private:
  void play(SampleSink& sink) const {
    if (silent_) return;
    constexpr SimTime kEver{std::numeric_limits<std::int64_t>::max()};
    for (int k = 0; k < 100'000; ++k) {
      const double t_s = first_s_ + 0.007 * k;
      const SimTime stamp{from_seconds(t_s).ns};
      if (fail_s_ > 0 && t_s > fail_s_) {
        constexpr std::string_view kText = "cable pulled";
        sink.fail(kText.data(), kText.size());
        return;
      }
      if (t_s > gap_s_ && t_s < gap_end_s_) continue;
      if (!sink.wait_until(stamp)) return;
      const PoseReading pose{x_m_ + vx_mps_ * t_s, y_m_ + vy_mps_ * t_s, 0, 0, 0};
      if (!sink.publish(stamp, &pose, 1)) return;
      if (steps_back_ && k == 3 && !sink.publish(SimTime{}, &pose, 1)) return;
    }
    sink.complete_up_to(kEver);
  }

  double x_m_ = 0;
  double y_m_ = 0;
  double vx_mps_ = 0;
  double vy_mps_ = 0;
  double first_s_ = 0;
  double gap_s_ = 0;
  double gap_end_s_ = 0;
  double fail_s_ = 0;
  bool silent_ = false;
  bool steps_back_ = false;
  std::thread thread_;
};

/// Events as a recording gives them: one value, its number, every `period_s`; put together,
/// `room` of them at most.
class Ticker final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;
  ~Ticker() override { close(); }
  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override {
    period_s_ = given(setup.parameters(), "period_s");
    declaration.capacity =
        static_cast<std::uint32_t>(static_cast<std::int64_t>(given(setup.parameters(), "room")));
    declaration.collect = 1;
    return {};
  }
  Status open(SampleSink& sink) override {
    thread_ = std::thread([this, &sink] {
      for (int k = 1; k < 100'000; ++k) {
        const double value = k;
        if (!sink.publish(SimTime{from_seconds(period_s_ * k).ns}, &value, 1)) return;
      }
    });
    return {};
  }
  void close() override {
    if (thread_.joinable()) thread_.join();
  }

 private:
  double period_s_ = 0;
  std::thread thread_;
};

/// An actuator of a real robot that takes commands and does nothing.
class Deaf final : public HardwareActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  Status open(const DeviceSetup&) override { return {}; }
  Status write(const Command& command, SimTime) override {
    for (const double value : command.value) {
      if (!std::isfinite(value)) return fail(ErrorCode::kInvalidArgument, "not a number");
    }
    return {};
  }
  void close() override {}
  [[nodiscard]] bool obeys() const override { return false; }
};

template <class T>
const VirtualSensorOps* sensor_ops() {
  static constexpr VirtualSensorOps kOps = detail::virtual_sensor_ops<T>();
  return &kOps;
}
template <class T>
const HardwareSensorOps* hardware_ops() {
  static constexpr HardwareSensorOps kOps = detail::hardware_sensor_ops<T>();
  return &kOps;
}
template <class T>
const ProgramOps* program_table() {
  static constexpr ProgramOps kOps = detail::program_ops<T>();
  return &kOps;
}

}  // namespace rave::sim::testing
