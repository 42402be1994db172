// SPDX-License-Identifier: Apache-2.0
#include "@NAME@.hpp"

#include <rave/math/scalar.hpp>
#include <rave/robot/plugin_entry.hpp>

// Looks up once what decide() uses. A robot without it is refused with a message.
rave::Status @CLASS@::start(const rave::Setup& setup) {
  RAVE_TRY(setup.sensor<float>());
  scan_ = rave::Scan(setup);
  RAVE_TRY_ASSIGN(drive_, setup.controller(rave::CommandKind::kVelocity));
  return parameters_changed(setup.params());
}

// Called again when somebody sets a parameter during a run. An error refuses the new values.
rave::Status @CLASS@::parameters_changed(const rave::Params& params) {
  speed_mps_ = params.number("speed_mps");
  stop_m_ = params.number("stop_m");
  return {};
}

// Fill this in. Called once a period: what the robot knows goes in, what it wants comes out.
// As it stands the robot drives ahead, and turns on the spot while something is near.
void @CLASS@::decide(const rave::Percepts& percepts, rave::Commands& commands) {
  scan_.update(percepts);
  // A sensor that fell silent says nothing about the present: the robot waits for it.
  if (scan_.is_old()) {
    commands.velocity(drive_, 0.0, 0.0);
    return;
  }
  // From the middle of the robot. Where it is blind ahead, that is as far as its body reaches.
  const double nearest_m = scan_.nearest_m(-rave::kPi, rave::kPi);
  if (nearest_m < stop_m_) {
    commands.velocity(drive_, 0.0, 1.0);
  } else {
    commands.velocity(drive_, speed_mps_, 0.0);
  }
}

namespace {
constexpr rave::ParamSpec kParams[] = {
    rave::number_param("speed_mps", "m/s", 0.2, 0.0, 2.0, "How fast it drives ahead."),
    rave::number_param("stop_m", "m", 0.5, 0.0, 10.0, "Nearer than this it turns."),
};
}  // namespace

RAVE_PLUGIN("@NAME@") {
  rave::add_program<@CLASS@>(
      registry, {.name = "@NAME@", .summary = "Says what it does.", .params = kParams});
}
