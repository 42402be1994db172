// SPDX-License-Identifier: Apache-2.0
// What a run tells of itself.

#include "rave/base/names.hpp"
#include "rave/bus/sequence.hpp"
#include "stepped_run.hpp"

namespace rave::manager {
namespace {

using Clock = std::chrono::steady_clock;
using config::LostHost;

}  // namespace

std::string SteppedRun::waited_for() const {
  const bool all = options_.on_lost_host == LostHost::kWait;
  const auto names =
      names_of(seats_, [all](const Seat& seat) { return seat.needed(all) && !seat.reported; });
  if (!names.empty() || complete()) return join_names(names);
  return fmt::format("a host with the world of step {}", newest_report_ - 1);
}

void SteppedRun::tell_state(rave_wire_RunPhase phase, std::string_view text) {
  bus::RunState state{};
  bus::put_text(state.scenario, options_.scenario);
  state.phase = phase;
  state.step = step_;
  state.steps = options_.steps;
  state.step_s = authority_->spec().step.seconds();
  const double wall_s = begun_ ? seconds(Clock::now() - began_) : 0;
  const auto done = static_cast<double>(step_ - first_step_);
  state.speed = wall_s > 0 ? done * state.step_s / wall_s : 0;
  bus::put_text(state.text, text);
  std::vector<rave_wire_HostSight> hosts(seats_.size());
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    hosts[i].host = static_cast<std::uint32_t>(i);
    bus::put_text(hosts[i].name, seats_[i].name);
    hosts[i].phase = static_cast<rave_wire_HostPhase>(seats_[i].state);
    hosts[i].robots = seats_[i].robots;
    hosts[i].step = seats_[i].last_step;
    hosts[i].bound_s = -1;  // nobody asks for the time here
  }
  bus::borrow(state.hosts, hosts);
  board_->endpoint().publish(state);
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
