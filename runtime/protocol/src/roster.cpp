// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/roster.hpp"

#include "rave/base/control_characters.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/sim/orders.hpp"

namespace rave::lock_step {
// The roster describes each robot once. A late reader receives the last entry of each robot. Long
// names are cut off rather than refused, because nothing in the run depends on it.

bus::RosterEntry describe(const sim::EngineSpec& spec, RobotId robot) {
  const sim::RobotSpec& its = spec.robots[robot.value()];
  const sim::RobotType& type = spec.types[its.type];
  bus::RosterEntry entry{};
  entry.robot = robot.value();
  bus::put_text(entry.name, its.name);
  bus::put_text(entry.team, its.team);
  entry.kind = type.simulated ? rave_wire_ROBOT_SIMULATED : rave_wire_ROBOT_REAL;
  entry.takes = sim::declared_orders(type);
  return entry;
}

Status Roster::tell(const sim::EngineSpec& spec, const std::function<Driver(RobotId)>& driver_of) {
  Status wrong;
  while (!due_.empty()) {
    const RobotId robot(*due_.begin());
    bus::RosterEntry entry = describe(spec, robot);
    entry.host = host_;
    if (driver_of) {
      const Driver driver = driver_of(robot);
      bus::put_text(entry.driver, without_control_characters(driver.name, " "));
      entry.driver_page = driver.page;
    }
    const Status written = writer_.write(entry);
    // A slow reader blocks the writer. The rest stays due and is tried in a later step, so the run
    // never waits.
    if (!written && written.error().code == ErrorCode::kTimeout) break;
    // An entry that cannot be sent at all is not tried again; the others are.
    if (!written) wrong = written;
    due_.erase(due_.begin());
  }
  return wrong;
}

}  // namespace rave::lock_step
