// SPDX-License-Identifier: Apache-2.0
// When in a step messages are delivered and collected; what happens to them in between is in
// radio.cpp.
#include "engine_impl.hpp"
#include "radio.hpp"

namespace rave::sim {

RadioMoment Engine::Impl::radio_moment() {
  return {step, now, reported, &truth.snapshot, &hash, &events};
}

void Engine::Impl::deliver_messages() {
  if (!radio->empty()) radio->deliver(radio_moment());
}

void Engine::Impl::carry_messages() {
  if (radio->empty()) return;
  const RadioMoment moment = radio_moment();
  // By robot and not by group: the order of the messages must not depend on types or hosts.
  for (std::uint32_t r = 0; r < truth.movers.size(); ++r) {
    if (!roster.is_local(RobotId(r))) continue;
    const ProgramSlots& program = roster.group_of(RobotId(r)).program;
    if (program.spec == nullptr) {
      // Nothing reads its mailbox.
      radio->collect(moment, RobotId(r), false);
    } else if (due(program.spec->period_steps, program.spec->phase_steps)) {
      radio->collect(moment, RobotId(r), program.failed[roster.member_of(RobotId(r))] == 0);
    }
  }
  if (!host) {
    radio->carry(moment);
    return;
  }
  radio->send(moment, host->sent);
  // Who hears what is found out when the messages of all hosts are known; by then these have
  // changed.
  host->reported_at_sending.resize(reported.size());
  for (const RobotId robot : host->robots) {
    host->reported_at_sending[robot.value()] = reported[robot.value()];
  }
}

const RadioCounts& Engine::radio_counts() const noexcept { return impl_->radio->counts(); }
std::span<const RadioTrace> Engine::radio() const noexcept { return impl_->radio->traces(); }

std::string Engine::transmitter_report(RobotId robot, std::uint32_t index) const {
  return impl_->radio->report(robot, index);
}

}  // namespace rave::sim
