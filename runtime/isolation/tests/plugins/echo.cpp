// SPDX-License-Identifier: Apache-2.0
// A program whose commands depend on everything it is given.

#include <optional>

#include "rave/math/scalar.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace {

class Echo final : public rave::DecisionProcess {
 public:
  rave::Status start(const rave::Setup& setup) override {
    RAVE_TRY_ASSIGN(laser_, setup.sensor<float>("laser"));
    RAVE_TRY_ASSIGN(camera_, setup.sensor<rave::Sighting>());
    RAVE_TRY_ASSIGN(drive_, setup.controller(rave::CommandKind::kVelocity));
    RAVE_TRY_ASSIGN(goal_, setup.controller(rave::CommandKind::kGoal));
    RAVE_TRY_ASSIGN(radio_, setup.communicator("air"));
    RAVE_TRY_ASSIGN(friend_, setup.robot_id("carl"));
    setup_ = setup;
    RAVE_TRY(parameters_changed(setup.params()));
    setup.log(setup.params().text("greeting"));
    offset_ = laser_.info().bearings_rad[1] + laser_.info().X_RS.x + setup.period_s() +
              setup.robot_radius_m() + static_cast<double>(setup.team().size());
    return {};
  }

  rave::Status parameters_changed(const rave::Params& params) override {
    if (params.number("gain") < 0) {
      return rave::fail(rave::ErrorCode::kInvalidArgument, "a negative gain");
    }
    gain_ = params.number("gain") + setup_->robot_radius_m();
    for (const double weight : params.numbers("weights")) gain_ += weight;
    return {};
  }

  void decide(const rave::Percepts& percepts, rave::Commands& commands) override {
    double sum = offset_ + percepts.now().seconds() + percepts.pose().x_m;
    for (const float range_m : percepts[laser_]) sum += static_cast<double>(range_m);
    for (const rave::Sighting& sighting : percepts[camera_]) {
      sum += static_cast<double>(sighting.bearing_rad) * sighting.code;
    }
    sum += percepts.header(laser_).sequence;
    for (const rave::Message message : percepts.messages(radio_)) {
      sum += message.from + static_cast<double>(message.bytes.size() + message.to.robot);
      sum += static_cast<double>(message.stamp.ns) * 1e-3;
      for (const std::byte byte : message.bytes) sum += std::to_integer<int>(byte);
      commands.send(radio_, message.bytes, rave::Recipient::one(friend_));
    }
    sum += percepts.messages(radio_).dropped();
    rave::RandomStream random = percepts.random();
    memory_ = 0.5 * memory_ + rave::sin(sum) * gain_ + random.uniform();
    commands.velocity(drive_, memory_, sum);
    commands.send(radio_, sum);
    if (percepts.header(laser_).sequence % 2 == 0) commands.goal(goal_, {sum, memory_}, 0.1);
  }

 private:
  std::optional<rave::Setup> setup_;
  rave::RangesHandle laser_;
  rave::SensorHandle<rave::Sighting> camera_;
  rave::CommunicatorHandle radio_;
  std::uint32_t friend_ = 0;
  rave::ControllerHandle drive_;
  rave::ControllerHandle goal_;
  double gain_ = 0;
  double offset_ = 0;
  double memory_ = 0;
};

}  // namespace

RAVE_PLUGIN("echo") {
  rave::add_program<Echo>(registry,
                          {.name = "echo", .summary = "Answers with all that it is given."});
}
