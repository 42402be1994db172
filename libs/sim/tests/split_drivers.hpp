// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "fuse_drivers.hpp"
#include "rave/sim_testing/given.hpp"
#include "rave/sim_testing/radio_fixture.hpp"

/// Drivers and a program that let all that passes between hosts show, for tests of split worlds.
namespace rave::sim::testing {

inline constexpr ParamSpec kGossipParams[] = {
    number_param("v", "m/s", 0.5, 0, 2, "Speed."),
    number_param("throw_at", "", 0, 0, 1e6, "Decision in which it fails; 0: never."),
};

/// Goes ahead, turns away from what is near or touched, and lets what it hears say which way. Tells
/// others where it is. Fails at `throw_at`.
class Gossip final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    const auto laser = setup.sensor<float>();
    if (laser) laser_ = *laser;
    const auto bumper = setup.sensor<ContactReading>();
    if (bumper) bumper_ = *bumper;
    const auto radio = setup.communicator("air");
    if (radio) radio_ = *radio;
    own_ = setup.own_id();
    radius_m_ = setup.robot_radius_m();
    setup_ = setup;
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    return parameters_changed(setup.params());
  }
  Status parameters_changed(const Params& params) override {
    v_mps_ = given(params, "v");
    throw_at_ = given(params, "throw_at");
    radius_m_ = setup_->robot_radius_m();
    return {};
  }
  void decide(const Percepts& percepts, Commands& commands) override {
    if (throw_at_ > 0 && ++decisions_ >= throw_at_) throw std::runtime_error("out of ideas");
    RandomStream random = percepts.random();
    double heard = 0;
    if (radio_) heard = listen(percepts, commands);
    float nearest = std::numeric_limits<float>::infinity();
    if (laser_) {
      for (const float range : percepts[*laser_]) nearest = std::min(nearest, range);
    }
    bool touching = false;
    if (bumper_ && percepts.header(*bumper_).count > 0) {
      touching = percepts[*bumper_][0].touching != 0;
    }
    const double w_radps = random.uniform(-1, 1) + 0.5 * heard + (touching ? 1.0 : 0.0) + radius_m_;
    if (nearest < 0.3F + static_cast<float>(radius_m_)) {
      commands.velocity(drive_, 0.3 * v_mps_, 1.5 + w_radps);
    } else {
      commands.velocity(drive_, v_mps_, w_radps);
    }
  }

 private:
  /// What is heard bends the way.
  double listen(const Percepts& percepts, Commands& commands) {
    double bend = 0;
    for (const Message message : percepts.messages(*radio_)) {
      double place[2];
      std::memcpy(place, message.bytes.data(), sizeof place);
      bend += place[0] > percepts.pose().x_m ? 0.3 : -0.3;
    }
    const double place[] = {percepts.pose().x_m, percepts.pose().y_m, v_mps_};
    const std::int64_t turn = percepts.now().ns / 10'000'000 % 3;
    const Recipient to = turn == 0   ? Recipient::everyone()
                         : turn == 1 ? Recipient::team()
                                     : Recipient::one((own_ * 7 + 3) % 30);
    const std::size_t size = own_ % 2 == 0 ? 3 : 2;
    commands.send(*radio_, std::as_bytes(std::span<const double>(place, size)), to);
    return bend;
  }

  std::optional<Setup> setup_;
  std::optional<SensorHandle<float>> laser_;
  std::optional<SensorHandle<ContactReading>> bumper_;
  std::optional<CommunicatorHandle> radio_;
  ControllerHandle drive_;
  std::uint32_t own_ = 0;
  double radius_m_ = 0;
  double v_mps_ = 0;
  double throw_at_ = 0;
  double decisions_ = 0;
};

/// Comes up to speed by and by, trembles, and turns away when something stopped it.
class Wagon final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  Status start(const DeviceSetup& setup) override {
    shake_ = given(setup.parameters(), "shake");
    return {};
  }
  Twist2 propose(const MotionInput& input) override {
    RandomStream random = input.random();
    const double wanted_mps = input.command.value[0] + shake_ * random.uniform(-1, 1);
    const double turn_radps = input.contact != 0 ? 0.8 : 0.0;
    return {0.3 * input.velocity.vx + 0.7 * wanted_mps, 0, input.command.value[1] + turn_radps};
  }

 private:
  double shake_ = 0;
};

/// What the robot touches, and how others near it move.
class Feeler final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;
  Status configure(const VirtualSensorSetup&, VirtualDeclaration& declaration) override {
    declaration.capacity = 5;
    return {};
  }
  void sample(const WorldView& world, const SampleItem& item) const override {
    auto* const values = static_cast<double*>(item.records);
    const TouchState touch = world.touch(item.robot);
    values[0] = touch.direction_W.x;
    values[1] = touch.direction_W.y;
    values[2] = values[3] = values[4] = 0;
    RobotId near[40];
    const std::uint32_t count = world.robots_within(item.X_WR.position(), 1, near);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (near[i] == item.robot) continue;
      const Twist2 velocity_W = world.velocity_W(near[i]);
      values[2] += velocity_W.vx;
      values[3] += velocity_W.vy;
      values[4] += velocity_W.wz;
    }
    item.header->count = 5;
  }
};

/// A recording of a laser: its two rays change with time; a sample every 33 ms. Own thread.
class ScanRecording final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kRanges;
  ~ScanRecording() override { close(); }
  Status configure(const HardwareSetup&, HardwareDeclaration& declaration) override {
    declaration.capacity = 2;
    declaration.bearings_rad = kBearings;
    declaration.range_min_m = 0.1;
    declaration.range_max_m = 8;
    return {};
  }
  Status open(SampleSink& sink) override {
    thread_ = std::thread([&sink] {
      for (int k = 1; k < 100'000; ++k) {
        const float ranges[] = {1.0F + 0.1F * static_cast<float>(k % 7), 3.0F};
        if (!sink.publish(SimTime{33'000'000LL * k}, ranges, 2)) return;
      }
    });
    return {};
  }
  void close() override {
    if (thread_.joinable()) thread_.join();
  }

 private:
  static constexpr double kBearings[] = {-0.3, 0.3};
  std::thread thread_;
};

}  // namespace rave::sim::testing
