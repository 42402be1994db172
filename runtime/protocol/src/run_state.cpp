// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/run_state.hpp"

#include "rave/bus/sequence.hpp"

namespace rave::lock_step {

rave_wire_HostSight process_sight(std::uint32_t host, std::string_view name,
                                  rave_wire_HostPhase phase, std::uint64_t step,
                                  std::uint32_t robots) {
  rave_wire_HostSight sight{};
  sight.host = host;
  bus::put_text(sight.name, name);
  sight.phase = phase;
  sight.robots = robots;
  sight.step = step;
  // -1: the clock of this process is unknown, as always in lock-step.
  sight.bound_s = -1;
  return sight;
}

void fill(rave_wire_RunState& message, const RunReport& report,
          std::span<rave_wire_HostSight> hosts) {
  bus::put_text(message.scenario, report.scenario);
  message.phase = report.phase;
  message.step = report.step;
  message.steps = report.steps;
  message.step_s = report.step_s;
  message.speed = report.speed;
  bus::put_text(message.text, report.text);
  bus::borrow(message.hosts, hosts);
}

}  // namespace rave::lock_step
