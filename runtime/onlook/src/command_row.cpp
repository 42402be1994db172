// SPDX-License-Identifier: Apache-2.0
#include "rave/onlook/command_row.hpp"

#include <limits>

namespace rave::onlook {
namespace {

constexpr float kNoVelocity = std::numeric_limits<float>::quiet_NaN();

/// The newest velocity command to a controller.
std::optional<Command> asked_of(const sim::Engine& engine, RobotId robot,
                                const sim::RobotType& type) {
  std::optional<Command> newest;
  std::int64_t step = -1;
  for (std::uint32_t c = 0; c < type.controllers.size(); ++c) {
    const std::int64_t given = engine.command_step(robot, c);
    if (type.controllers[c].accepts != CommandKind::kVelocity || given <= step) continue;
    step = given;
    newest = engine.command(robot, c);
  }
  return newest;
}

}  // namespace

std::optional<std::array<float, kCommandFields>> command_row(const sim::Engine& engine,
                                                             RobotId robot) {
  const sim::EngineSpec& spec = engine.spec();
  if (robot.value() >= spec.robots.size() || !engine.is_local(robot)) return std::nullopt;
  const sim::RobotType& type = spec.types[spec.robots[robot.value()].type];
  std::array<float, kCommandFields> row{kNoVelocity, kNoVelocity, kNoVelocity, kNoVelocity};
  const auto put = [&row](std::size_t at, const Command& command) {
    if (command.kind != CommandKind::kVelocity) return;
    row[at] = static_cast<float>(command.value[0]);
    row[at + 1] = static_cast<float>(command.value[1]);
  };
  if (const auto asked = asked_of(engine, robot, type)) put(0, *asked);
  bool drives = false;
  for (std::uint32_t a = 0; a < type.actuators.size() && !drives; ++a) {
    const Command& told = engine.actuator_command(robot, a);
    drives = told.kind == CommandKind::kVelocity;
    if (drives) put(2, told);
  }
  if (!drives && row[0] != row[0]) return std::nullopt;
  return row;
}

}  // namespace rave::onlook
