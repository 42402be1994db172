// SPDX-License-Identifier: Apache-2.0
#include "stepped_run.hpp"

#include <algorithm>

#include "rave/base/names.hpp"
#include "rave/base/open_end.hpp"

namespace rave::manager {
namespace {

using Clock = std::chrono::steady_clock;
using config::LostHost;

/// Wall time of a step at this pace; 0: not limited.
Clock::duration period_of(const sim::EngineSpec& spec, double pace) {
  if (pace <= 0) return {};
  return std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(spec.step.seconds() / pace));
}

std::vector<RosterBook::Robot> planned_robots(const sim::EngineSpec& spec) {
  std::vector<RosterBook::Robot> robots;
  for (const sim::RobotSpec& robot : spec.robots) {
    robots.push_back({robot.name, spec.types[robot.type].simulated});
  }
  return robots;
}

}  // namespace

SteppedRun::SteppedRun(const ManagerOptions& options,
                       std::unique_ptr<sim::WorldAuthority> authority,
                       std::unique_ptr<SteppedEndpoint> bus)
    : ManagerRun(options, bus->endpoint()),
      options_(options),
      authority_(std::move(authority)),
      bus_(std::move(bus)),
      slots_(make_slots(options.hosts)),
      requests_(options.control, options.log, options.hosts),
      claims_(static_cast<std::uint32_t>(options.hosts.size())),
      roster_(planned_robots(authority_->spec()), options.hosts),
      lateness_(period_of(authority_->spec(), options.pace)) {
  for (std::size_t h = 0; h < std::min(slots_.size(), options.commands.size()); ++h) {
    slots_[h].command = options.commands[h];
  }
}

bool SteppedRun::complete() const {
  const bool all = options_.on_lost_host == config::LostHost::kWait;
  // Hosts that come from a lost manager hand over its state.
  if (!begun_ && newest_report_ > 0 && (!handed_over_ || world_.step + 1 < newest_report_)) {
    return false;
  }
  return std::all_of(slots_.begin(), slots_.end(),
                     [all](const HostSlot& slot) { return slot.reported || !slot.needed(all); });
}

Result<SteppedRun::Gathered> SteppedRun::gather() {
  const auto since = Clock::now();
  RAVE_TRY(listen());
  while (!complete()) {
    bus_->wait(Duration{std::chrono::nanoseconds(kLook).count()}, asked());
    RAVE_TRY(listen());
    requests_.listen(*authority_);
    if (complete()) break;
    RAVE_TRY(look());
    const auto now = Clock::now();
    // Most steps take less time than anybody could notice.
    if (now - since < kLook) continue;
    look_at_clock(since);
    note_waiting(waited_for());
    if (now >= next_tell_) {
      tell_state(begun_ ? rave_wire_RUN_WAITS : rave_wire_RUN_GATHERING,
                 fmt::format("waiting for {}", waited_for()));
    }
    tell_progress(waited_for());
    requests_.put_off(fmt::format("the run waits for {}", waited_for()));
    if (stopping()) return Gathered::kStopped;
  }
  note_waiting({});
  return Gathered::kAll;
}

/// Begins when all hosts are present. If they come from a lost manager, its world is taken over.
Status SteppedRun::take_over() {
  step_ = newest_report_;
  if (step_ == 0) return {};
  if (!handed_over_ || world_.step + 1 < step_) {
    return fail(ErrorCode::kState,
                "the hosts are already in step {}, and none has sent the world of the previous "
                "step: they belong to another run",
                step_);
  }
  // One host may have received a world that the others have not, and have left since.
  if (world_.step > step_) {
    return fail(ErrorCode::kState,
                "the world of step {} arrived, but no host is beyond step {}: its sender does not "
                "belong to this run",
                world_.step, step_);
  }
  step_ = world_.step + 1;
  RAVE_TRY(authority_->resume(world_, state_));
  log(LogLevel::kWarning, "takes over from a lost manager at step {}", step_);
  for (HostSlot& slot : slots_) {
    // A new process starts from the beginning, although the one before it was in the run.
    if (slot.last_step + 1 < step_) {
      slot.loss = fmt::format("host `{}` was absent from step {} to step {}", slot.name,
                              slot.last_step, step_ - 1);
      miss_steps(slot);
    }
    if (!slot.reported || authority_->check(slot.report)) continue;
    slot.reported = false;
    slot.report = {};
  }
  return bus_->send(world_, state_, slots_);
}

Status SteppedRun::make_step() {
  std::vector<const sim::HostReport*> reports;
  for (std::size_t h = 0; h < slots_.size(); ++h) {
    HostSlot& slot = slots_[h];
    if (!slot.reported) {
      // The robots of a lost host stand still: its report is computed here.
      authority_->speak_for(static_cast<std::uint32_t>(h), slot.report);
      miss_steps(slot);
    }
    reports.push_back(&slot.report);
  }
  const auto begin = Clock::now();
  RAVE_TRY(authority_->step(reports, world_));
  tell_of_the_scenario();
  const auto now = Clock::now();
  resolved_.ns[static_cast<std::size_t>(sim::Phase::kResolve)] +=
      std::chrono::duration_cast<std::chrono::nanoseconds>(now - begin).count();
  lateness_.worked(resolved_, now);
  // Hosts end with the last world. The flag is set before sending, because nothing is sent
  // afterwards.
  world_.last = world_.last || ending_ || step_ >= options_.steps;
  if (options_.on_world && options_.on_world(*authority_)) ending_ = true;
  // A next manager needs this state beside the world, so each host keeps both. Newcomers also need
  // the changes of obstacles since the start.
  RAVE_TRY(bus_->send(world_, authority_->state(std::exchange(newcomer_, false)), slots_));
  // After sending: hosts compute the next step while requests are answered here.
  requests_.after_step(*authority_, world_);
  for (HostSlot& slot : slots_) slot.reported = false;
  ++step_;
  return {};
}

/// What conditions and scripts note: no host knows of it.
void SteppedRun::tell_of_the_scenario() {
  if (!authority_->spec().conductor) return;
  for (const sim::Event& event : authority_->events()) {
    if (event.text.empty()) continue;
    if (event.kind == sim::EventKind::kScenario) log(LogLevel::kInfo, "{}", event.text);
    if (event.kind == sim::EventKind::kTeamGiven) log(LogLevel::kInfo, "team {}", event.text);
  }
}

Clock::time_point SteppedRun::due_of(std::uint64_t step) const {
  // Multiplied, not summed up, so rounding does not accumulate over millions of steps.
  const double due_s =
      static_cast<double>(step - first_step_) * authority_->spec().step.seconds() / options_.pace;
  return began_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due_s));
}

void SteppedRun::wait_for_turn() {
  if (options_.pace <= 0) return;
  const auto due = due_of(step_);
  lateness_.did(runtime::Lateness::Part::kExchange, Clock::now());
  for (auto now = Clock::now(); now < due; now = Clock::now()) {
    const auto left = std::min<Clock::duration>(due - now, kLook);
    bus_->wait(Duration{std::chrono::duration_cast<std::chrono::nanoseconds>(left).count()},
               asked());
    auto status = listen();
    if (status) status = look();
    if (!status) failure_ = std::move(status).error();
    requests_.listen(*authority_);
    if (failure_ || stopping()) return;
  }
  lateness_.woke(due, Clock::now());
}

/// Holds the run while it is paused.
void SteppedRun::hold() {
  constexpr std::chrono::milliseconds kHeld{20};
  const auto since = Clock::now();
  while (!requests_.may_step() && !stopping()) {
    bus_->wait(Duration{std::chrono::nanoseconds(kHeld).count()}, {});
    auto status = listen();
    if (status) status = look();
    if (!status) failure_ = std::move(status).error();
    if (failure_) return;
    requests_.listen(*authority_);
    requests_.put_off("the run is paused");
    // The next step is made without a host that is gone now, and the one after it is not.
    note_waiting(join_names(names_of(slots_, [this](const HostSlot& slot) {
      return slot.state == SlotState::kLost &&
             slot.needed(options_.on_lost_host == LostHost::kWait);
    })));
    if (Clock::now() >= next_tell_) tell_state(rave_wire_RUN_WAITS, "paused");
    tell_progress("`rave resume`");
  }
  // A pause moves the deadlines of all later steps, which would otherwise be made as fast as
  // possible.
  began_ += Clock::now() - since;
}

/// Sends the last world again to hosts that have not received it.
Status SteppedRun::resend() {
  if (!std::exchange(newcomer_, false)) {
    bus_->resend(slots_);
    return {};
  }
  return bus_->send(world_, authority_->state(true), slots_);
}

runtime::RunStatus SteppedRun::first_status() const {
  runtime::RunStatus status;
  status.scenario = options_.scenario;
  status.run = options_.bus.run.text();
  const double duration_s = static_cast<double>(options_.steps) * authority_->spec().step.seconds();
  status.duration_s = is_open_end(duration_s) ? 0 : duration_s;
  status.pace = options_.pace;
  return status;
}

/// The loop: gather the reports of all hosts for step n, resolve it, begin step n + 1, send its
/// world. Meanwhile hosts wait for that world; those that do not receive it repeat their report,
/// and get the world again. All of it is on one thread, and requests are served between the
/// messages.
Result<ManagerOutcome> SteppedRun::go() {
  tell_state(rave_wire_RUN_GATHERING, fmt::format("waiting for {}", waited_for()));
  // The first reports are those of step 0, or of a later step if these hosts come from a lost
  // manager.
  RAVE_TRY_ASSIGN(Gathered gathered, gather());
  if (gathered == Gathered::kStopped) {
    problems_.push_back(fmt::format("stopped while waiting for {}", waited_for()));
    return outcome();
  }
  RAVE_TRY(take_over());
  begun_ = true;
  requests_.begin(*authority_, first_status());
  began_ = Clock::now();
  first_step_ = step_;
  for (;;) {
    RAVE_TRY_ASSIGN(gathered, gather());
    if (gathered == Gathered::kStopped) {
      problems_.push_back(
          fmt::format("stopped in step {} while waiting for {}", step_, waited_for()));
      break;
    }
    // The order: all reports are here, so a pause holds the run between two steps. Then the pace is
    // waited for, and requests that arrived meanwhile still count for this step.
    hold();
    wait_for_turn();
    requests_.listen(*authority_);
    if (failure_) return tl::unexpected(*failure_);
    if (stopping() && !ending_) {
      ending_ = true;
      ended_by_hand_ = step_ < options_.steps && by_hand();
      if (step_ < options_.steps && !ended_by_hand_) {
        problems_.push_back(fmt::format("stopped in step {}", step_));
      }
    }
    RAVE_TRY(make_step());
    lateness_.done(Clock::now());
    tell_progress({});
    if (Clock::now() >= next_tell_) tell_state(rave_wire_RUN_RUNNING, {});
    if (world_.last) break;
  }
  return outcome();
}

void SteppedRun::give_up(const Error& error) {
  over_ = true;
  // The hosts belong to another manager, or wait for theirs.
  if (endpoint_.is_second() || left_alone_) return;
  tell_state(rave_wire_RUN_FAILED, error.message);
  see_end(false);
}

std::string SteppedRun::why_ended() const {
  if (!ended_by_hand_) return {};
  return by_hand_text(static_cast<double>(authority_->steps_done()) *
                      authority_->spec().step.seconds());
}

ManagerOutcome SteppedRun::outcome() {
  ended_ = Clock::now();
  if (options_.on_end) options_.on_end(*authority_);
  requests_.end();
  ManagerOutcome outcome;
  outcome.steps = authority_->steps_done();
  outcome.wall_s = begun_ ? seconds(ended_ - began_) : 0;
  for (HostSlot& slot : slots_) {
    if (slot.state == SlotState::kLost && begun_) miss_steps(slot);
  }
  if (begun_ && options_.pace > 0) lateness_.end(due_of(options_.steps), ended_);
  outcome.lateness = lateness_.facts();
  if (outcome.lateness.missed > 0) {
    log(LogLevel::kInfo, "deadlines of steps: {}", runtime::lateness_text(outcome.lateness));
  }
  outcome.problems = problems_;
  outcome.whole = begun_ && world_.last && problems_.empty();
  outcome.ended_by_hand = ended_by_hand_;
  // Each item of the run hash was added by one process, so the sum over all is that of a single
  // process. If a host has missed a step the sum would be of another run.
  if (begun_ && world_.last && !lost_any_) {
    RunHash hash = authority_->hash();
    for (const HostSlot& slot : slots_) hash.merge(RunHash::of_value(slot.hash));
    outcome.hash = hash.value();
  }
  over_ = true;
  tell_state(outcome.whole ? rave_wire_RUN_ENDED : rave_wire_RUN_FAILED,
             problems_.empty() ? why_ended() : problems_.back());
  see_end(begun_);
  outcome.host_results = hand_out_host_results(slots_);
  return outcome;
}

}  // namespace rave::manager
