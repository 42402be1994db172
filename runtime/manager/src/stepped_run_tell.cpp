// SPDX-License-Identifier: Apache-2.0
// What a run publishes about itself.

#include "rave/base/names.hpp"
#include "rave/protocol/run_state.hpp"
#include "stepped_run.hpp"

namespace rave::manager {
namespace {

using Clock = std::chrono::steady_clock;
using config::LostHost;

}  // namespace

std::string SteppedRun::waited_for() const {
  const bool all = options_.on_lost_host == LostHost::kWait;
  const auto names =
      names_of(slots_, [all](const HostSlot& slot) { return slot.needed(all) && !slot.reported; });
  if (!names.empty() || complete()) return join_names(names);
  return fmt::format("a host with the world of step {}", newest_report_ - 1);
}

void SteppedRun::tell_state(rave_wire_RunPhase phase, std::string_view text) {
  const double step_s = authority_->spec().step.seconds();
  const double wall_s = begun_ ? seconds(Clock::now() - began_) : 0;
  const double speed = wall_s > 0 ? static_cast<double>(step_ - first_step_) * step_s / wall_s : 0;
  std::vector<rave_wire_HostSight> hosts;
  for (const HostSlot& slot : slots_) {
    // The time of the run is not requested here.
    hosts.push_back(lock_step::process_sight(static_cast<std::uint32_t>(hosts.size()), slot.name,
                                             static_cast<rave_wire_HostPhase>(slot.state),
                                             slot.last_step, slot.robots));
  }
  bus::RunState state{};
  lock_step::fill(state, {options_.scenario, phase, step_, options_.steps, step_s, speed, text},
                  hosts);
  endpoint_.publish(state);
  next_tell_ = Clock::now() + kTell;
}

/// Tells those who ask for the status.
void SteppedRun::note_waiting(std::string hosts) {
  if (hosts == waits_for_) return;
  waits_for_ = std::move(hosts);
  if (options_.control != nullptr && begun_) options_.control->set_waits_for(waits_for_);
}

void SteppedRun::tell_progress(std::string waiting) {
  const auto now = Clock::now();
  if (!options_.on_progress || now < next_progress_) return;
  next_progress_ = now + kLook;
  const double wall_s = begun_ ? seconds(now - began_) : 0;
  const double sim_s = static_cast<double>(step_ - first_step_) * authority_->spec().step.seconds();
  options_.on_progress({step_, wall_s > 0 ? sim_s / wall_s : 0, std::move(waiting)});
}

}  // namespace rave::manager
