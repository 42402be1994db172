// SPDX-License-Identifier: Apache-2.0
// The processes that serve the hosts, and their reports.

#include <algorithm>

#include "stepped_run.hpp"

namespace rave::manager {
namespace {

using Clock = std::chrono::steady_clock;
using config::LostHost;

/// A step is sent again to a host that has not received it, but not more often than this.
constexpr std::chrono::milliseconds kAgain{20};

}  // namespace

void SteppedRun::lose(HostSlot& slot, std::string_view why) {
  const bool for_good = options_.on_lost_host == LostHost::kDrop;
  slot.state = for_good ? SlotState::kDropped : SlotState::kLost;
  claims_.release(slot.writer);
  slot.last_writer = slot.writer;
  slot.writer = 0;
  roster_.stir();
  constexpr std::string_view kThen[] = {"all hosts wait until it is back",
                                        "its robots stop from this step on",
                                        "its robots stop until it is back"};
  std::string text = fmt::format("host `{}` {} in step {}; {}", slot.name, why, step_,
                                 kThen[static_cast<std::size_t>(options_.on_lost_host)]);
  const bool again = !for_good && !slot.command.empty();
  log(LogLevel::kError, "{}{}{}", text, again ? "; start it again with: " : "",
      again ? slot.command : "");
  slot.loss = std::move(text);
  next_tell_ = {};
}

/// Notes the loss of a host: the run differs from one in which it took part all the time.
void SteppedRun::miss_steps(HostSlot& slot) {
  lost_any_ = true;
  if (!slot.loss.empty()) problems_.push_back(std::exchange(slot.loss, {}));
}

/// Handles a report of the process that serves this slot, or of one that wants to.
Status SteppedRun::claim_slot(HostSlot& slot, const bus::HostReport& message) {
  if (slot.writer == message.writer && slot.state != SlotState::kLost) {
    if (slot.state == SlotState::kLate) {
      log(LogLevel::kInfo, "host `{}` answers again, in step {}", slot.name, step_);
      slot.state = SlotState::kRuns;
      next_tell_ = {};
    }
    return {};
  }
  if (slot.state == SlotState::kDropped) {
    return fail(ErrorCode::kState, "host `{}` was dropped from this run", slot.name);
  }
  RAVE_TRY(claims_.claim(message.host, message.writer));
  // A process that was cut off and is still in its step has missed nothing.
  const bool same = slot.last_writer == message.writer && message.step + 1 >= step_;
  if (begun_ && !same) miss_steps(slot);
  newcomer_ = newcomer_ || (begun_ && !same);
  log(LogLevel::kInfo, "host `{}` is {}, with {} robots", slot.name,
      slot.state == SlotState::kLost ? fmt::format("back in step {}", step_) : "here", slot.robots);
  slot.writer = message.writer;
  slot.last_step = 0;
  roster_.stir();
  note_service(slot.served_by, message.writer);
  slot.state = SlotState::kRuns;
  slot.reported = false;
  next_tell_ = {};
  return {};
}

/// Refuses a report of a step that no host can be in. It must not count as the last one of its
/// host, or all later reports of this process would seem outdated.
Status SteppedRun::refuse_ahead(const HostSlot& slot, const bus::HostReport& message) {
  std::string why = fmt::format("it is of step {}, but step {} comes next", message.step, step_);
  if (!over_ && options_.on_lost_host == LostHost::kWait) {
    // It would never be answered, and all would wait for ever.
    return fail(ErrorCode::kState,
                "invalid report of host `{}`: {}; either the host received a world that this "
                "manager did not send, or another process sent the report",
                slot.name, why);
  }
  // The others continue without it after it has been silent for long enough.
  bus_->refuse(message, why);
  return {};
}

/// A host that has lost its manager during a run does not belong to a new one.
Status SteppedRun::leave_alone(const bus::HostReport& message) {
  // A process with a manager, or one that has not noticed its loss yet, is not such a host.
  if (begun_ || options_.resume || message.step == 0 || message.epoch != 0) return {};
  left_alone_ = true;
  return tl::unexpected(of_another_run(
      fmt::format("host `{}` is in step {}", slots_[message.host].name, message.step)));
}

Status SteppedRun::hear(const bus::HostReport& message) {
  if (message.host >= slots_.size() || !bus_->knows(message.writer)) return {};
  RAVE_TRY(leave_alone(message));
  HostSlot& slot = slots_[message.host];
  if (const Status claimed = claim_slot(slot, message); !claimed) {
    bus_->refuse(message, claimed.error().message);
    return {};
  }
  if (begun_ && message.writer == slot.writer && message.step < slot.last_step) {
    return {};  // a later one has overtaken it
  }
  if (message.step > step_ && begun_) return refuse_ahead(slot, message);
  slot.last_step = message.step;
  if (!begun_) count_newest();
  if (message.state == rave_wire_REPORT_FAILED) {
    if (over_) return {};  // nothing depends on it any more, and it still says what it knows
    if (options_.on_lost_host == LostHost::kWait) {
      return fail(ErrorCode::kState, "host `{}` cannot continue: {}", slot.name, message.text);
    }
    lose(slot, fmt::format("cannot continue ({})", message.text));
    return {};
  }
  if (message.step < step_) {
    if (begun_ && !slot.reported) {
      asked_again_ = true;  // it has not got the step that it needs
      newcomer_ = newcomer_ || message.step + 1 < step_;
    }
    return {};
  }
  // It was sent twice, or once more with requests that the host received since.
  const bool again = slot.reported && begun_;
  if (again && message.inputs._length <= slot.report.inputs.size()) return {};
  if (const Status was_read = lock_step::read(message, heard_); !was_read) {
    bus_->refuse(message, was_read.error().message);
    return {};
  }
  // What the authority cannot use is no reason to end the run of the others. Before the run begins
  // it does not know yet which step comes next.
  if (const Status usable = begun_ || message.step == 0 ? authority_->check(heard_) : Status{};
      !usable) {
    bus_->refuse(message, usable.error().text());
    return {};
  }
  if (again) {
    std::swap(slot.report.inputs, heard_.inputs);
    return {};
  }
  std::swap(slot.report, heard_);
  slot.hash = message.hash;
  slot.reported = true;
  return {};
}

Status SteppedRun::listen() {
  Status status;
  bus_->take_reports([&](const bus::HostReport& message) {
    if (status) status = hear(message);
  });
  endpoint_.serve_requests();
  return status;
}

/// A process is gone.
void SteppedRun::miss(std::uint64_t writer) {
  for (HostSlot& slot : slots_) {
    if (slot.writer != writer) continue;
    if (begun_ && !over_) {
      lose(slot, "is gone");
      continue;
    }
    if (!begun_) {
      log(LogLevel::kWarning, "host `{}` was lost before the run began{}{}", slot.name,
          slot.command.empty() ? "" : "; start it again with: ", slot.command);
    }
    claims_.release(writer);
    slot.writer = 0;
    slot.state = SlotState::kMissing;
    slot.reported = false;
    slot.last_step = 0;
  }
  if (!begun_) count_newest();
}

/// Of what hosts say now: no process waits for a step that a host reported before and does not
/// report any more.
void SteppedRun::count_newest() {
  newest_report_ = 0;
  for (const HostSlot& slot : slots_) newest_report_ = std::max(newest_report_, slot.last_step);
}

/// What can wait until nothing else is to be done.
Status SteppedRun::look() {
  take_host_results(slots_);
  RAVE_TRY_ASSIGN(const auto gone, endpoint_.look_at_processes(begun_));
  if (!begun_) handed_over_ = bus_->take_last_world(world_, state_, handed_over_) || handed_over_;
  for (const std::uint64_t writer : gone) {
    miss(writer);
    roster_.lose(writer);
  }
  look_at_roster();
  if (asked_again_ && Clock::now() >= resend_at_) {
    asked_again_ = false;
    resend_at_ = Clock::now() + kAgain;
    RAVE_TRY(resend());
  }
  return {};
}

void SteppedRun::look_at_roster() {
  const auto now = Clock::now();
  if (now < next_roster_) return;
  next_roster_ = now + kLook;
  const auto serving = [this](std::uint32_t host) {
    return host < slots_.size() ? slots_[host].writer : 0;
  };
  endpoint_.take_roster(roster_, serving);
  if (begun_ && !over_) show_kinds(roster_, serving, options_.control);
}

/// Who has not answered for too long.
void SteppedRun::look_at_clock(Clock::time_point since) {
  const auto patience = std::chrono::nanoseconds(options_.host_timeout.ns);
  // They may have answered while this process stood still, which it may also do between these
  // lines: the time is older than what is known of standstills.
  const auto now = Clock::now();
  since = std::max(since, endpoint_.silence_counts_from());
  if (!begun_ || now - since < patience) return;
  for (HostSlot& slot : slots_) {
    if (slot.reported || slot.state != SlotState::kRuns) continue;
    if (options_.on_lost_host != LostHost::kWait) {
      lose(slot, fmt::format("has not answered for {:.1f} s", options_.host_timeout.seconds()));
      continue;
    }
    slot.state = SlotState::kLate;
    next_tell_ = {};
    log(LogLevel::kWarning,
        "host `{}` has not answered for {:.1f} s in step {}; all hosts wait for it", slot.name,
        options_.host_timeout.seconds(), step_);
  }
}

/// The last step reaches everybody before this process goes.
void SteppedRun::see_end(bool awaits_host_results) {
  drain_hosts(slots_, awaits_host_results, [this] {
    bus_->wait(Duration{std::chrono::nanoseconds(kLook).count()}, {});
    return listen() && look();
  });
}

}  // namespace rave::manager
