// SPDX-License-Identifier: Apache-2.0
// What keeps a robot from moving although it is not stopped, for people who look at the run.
#include <algorithm>

#include "engine_impl.hpp"
#include "sensor_age.hpp"

namespace rave::sim {
namespace {

void add(std::string& text, std::string_view what) {
  if (!text.empty()) text += "; ";
  text += what;
}

}  // namespace

std::string Engine::lacks(RobotId robot) const {
  std::string text;
  const Impl& engine = *impl_;
  // Before the first step nothing has been heard.
  if (engine.step == 0 || !is_local(robot)) return text;
  const RobotGroup& group = engine.roster.group_of(robot);
  const std::size_t m = engine.roster.member_of(robot);
  if (group.program.spec != nullptr && group.program.failed[m] != 0) {
    add(text, "its program has failed");
  }
  for (const ActuatorSlots& slots : group.actuators) {
    if (slots.obeys[m] != 0 && slots.failed[m] != 0) {
      add(text, fmt::format("the driver of `{}` has failed", slots.spec->name));
    }
  }
  const auto& limits = engine.guards[engine.spec.robots[robot.value()].type];
  if (!limits) return text;
  const ReportedPose& pose = engine.reported[robot.value()];
  if (!pose.known || pose.stale) add(text, text_of(GuardLimit::kPoseLost));
  std::vector<GuardSensor> sensors;
  find_watched_sensors(group, static_cast<std::uint32_t>(m), engine.now, sensors);
  for (const GuardSensor& sensor : sensors) {
    if (sensor.age_s <= sensor.max_age_s) continue;
    add(text, sensor_lost_text(group.sensors[sensor.index]));
  }
  const bool stops = limits->world_lost == WorldLostPolicy::kStop;
  if (stops && !(engine.world_age.seconds() <= limits->world_timeout_s)) {
    add(text, text_of(GuardLimit::kWorldLost));
  }
  return text;
}

}  // namespace rave::sim
