// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/agreement.hpp"

#include "rave/base/hash.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/robot/interface_hash.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave::runtime {

std::uint64_t shared_number(const config::ExpandedScenario& scenario) {
  // Settings that cannot change what robots do are set to their defaults before hashing. So a host
  // on a slower machine may use other threads, and the pace and what happens to lost hosts may be
  // set at the manager alone.
  const config::ScenarioFile usual;
  config::ExpandedScenario shared = scenario;
  shared.scenario.pace = usual.pace;
  shared.scenario.threads = usual.threads;
  shared.scenario.description.clear();
  shared.scenario.on_lost_host = usual.on_lost_host;
  shared.scenario.host_timeout_s = usual.host_timeout_s;
  shared.scenario.gui = usual.gui;
  return lock_step::scenario_number(config::write_expanded(shared));
}

std::uint64_t interface_stamp() {
  return mix64(robot_interface_hash() ^ mix64(virtual_interface_hash()));
}

}  // namespace rave::runtime
