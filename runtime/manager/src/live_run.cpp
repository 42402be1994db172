// SPDX-License-Identifier: Apache-2.0
#include "live_run.hpp"

#include <algorithm>
#include <chrono>

#include "rave/base/names.hpp"

namespace rave::manager {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// Between the decision that a run begins and its time 0: hosts hear of it and start together.
/// Hosts ask for the time every 10 to 100 ms before the start, so all of them know the moment well
/// before it comes.
constexpr milliseconds kLead{300};
constexpr std::size_t kMostNames = 5;
// Hosts end by their own clocks. One that ends this much earlier than the manager is done, not
// lost.
constexpr Duration kDeparture = from_seconds(0.2);

std::int64_t ns_of(Clock::time_point when) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(when.time_since_epoch()).count();
}

}  // namespace

SimTime LiveRun::now() const { return {ns_of(Clock::now()) - zero_ns_}; }

std::string LiveRun::missing() const {
  std::vector<std::string_view> names;
  for (const LiveSlot& slot : hosts_->slots()) {
    if (slot.writer == 0) names.emplace_back(slot.name);
  }
  return names.empty() ? std::string() : join_names(names);
}

void LiveRun::begin_in(std::chrono::nanoseconds lead) {
  begun_ = true;
  zero_ns_ = ns_of(Clock::now() + lead);
  // Worlds begin before time 0: hosts that need the poses of others wait for a first one.
  next_world_ = Clock::now();
  next_tell_ = {};
}

/// Continues a run that began under another manager; its hosts know the time.
void LiveRun::take_over(std::int64_t run_ns) {
  begin_in(-std::chrono::nanoseconds(run_ns));
  edits_->begin(true);
  log(LogLevel::kWarning, "takes over at {:.2f} s of the run", now().seconds());
}

void LiveRun::begin_if_ready() {
  if (begun_) return;
  const bool any = std::any_of(hosts_->slots().begin(), hosts_->slots().end(),
                               [](const LiveSlot& slot) { return slot.writer != 0; });
  if (!any) {
    first_host_ = {};
    return;
  }
  const auto now = Clock::now();
  if (first_host_ == Clock::time_point{}) first_host_ = now;
  const std::string waits_for = missing();
  // The patience for missing hosts counts from the first host, not from the start of this process:
  // people may start the manager long before the hosts. A standstill of this process is not the
  // fault of hosts.
  if (waits_for.empty()) {
    begin_in(kLead);
    edits_->begin(false);
    log(LogLevel::kInfo, "all hosts have joined: the run begins");
  } else if (now - std::max(first_host_, endpoint_.silence_counts_from()) >
             std::chrono::nanoseconds(options_.host_timeout.ns)) {
    begin_in(kLead);
    edits_->begin(false);
    log(LogLevel::kWarning, "the run begins without {}", waits_for);
  }
}

/// Hosts that have lost their manager during a run do not belong to a new one.
void LiveRun::leave_alone(std::int64_t run_ns) {
  left_alone_ = of_another_run(fmt::format("hosts are at {:.1f} s", Duration{run_ns}.seconds()));
}

void LiveRun::hear(const bus::ClockPing& ping) {
  // Read first: the time until the answer is subtracted by the host, so it does not matter how long
  // this process takes.
  const std::int64_t received_ns = ns_of(Clock::now());
  if (!hosts_->claim_slot(ping)) {
    next_look_ = {};  // it may have introduced itself just now
    return;
  }
  // A host that knows a time of the run was in it before this manager.
  if (!begun_ && ping.run_ns >= 0) {
    if (!options_.resume) return leave_alone(ping.run_ns);
    take_over(ping.run_ns);
  }
  bus::ClockPong pong{};
  pong.target = ping.writer;
  pong.ping_sent_ns = ping.sent_ns;
  pong.ping_received_ns = received_ns;
  pong.begun = begun_;
  pong.zero_ns = zero_ns_;
  pong.obstacle_revision = edits_->revision();
  // Read last, for the same reason.
  pong.pong_sent_ns = ns_of(Clock::now());
  hosts_->answer(pong);
}

Status LiveRun::listen() {
  // Pings first, because their time of reception is measured when they are taken.
  hosts_->take_pings([this](const bus::ClockPing& ping) { hear(ping); });
  if (left_alone_) return tl::unexpected(*left_alone_);
  hosts_->take_states();
  take_host_results(hosts_->slots());
  endpoint_.serve_requests();
  // The rest is not urgent, and in a large run it costs more than a world.
  if (Clock::now() < next_look_) return {};
  next_look_ = Clock::now() + kLook;
  // Near the end hosts leave one by one as they finish; that is no loss.
  const bool over = ended_ || (begun_ && options_.duration - Duration{now().ns} < kDeparture);
  RAVE_TRY(hosts_->look_at_processes(begun_ && !over));
  hosts_->take_roster(begun_ && !ended_ ? options_.control : nullptr);
  if (hosts_->take_news()) next_tell_ = {};
  return {};
}

void LiveRun::tell_silence(const std::vector<std::string_view>& names, std::string_view what) {
  // A lost host of a swarm would otherwise log one line for each robot.
  const std::size_t told = names.size() <= kMostNames ? names.size() : kMostNames - 1;
  for (std::size_t i = 0; i < told; ++i) log(LogLevel::kWarning, "robot `{}` {}", names[i], what);
  if (told < names.size()) {
    log(LogLevel::kWarning, "and {} other robots: {}", names.size() - told, what);
  }
}

void LiveRun::look_for_stale(SimTime now) {
  std::vector<std::string_view> silent;
  std::vector<std::string_view> back;
  stale_.resize(options_.robots.size());
  for (std::size_t r = 0; r < stale_.size(); ++r) {
    const auto stamp = hosts_->stamp_of(r);
    if (!stamp) continue;
    const bool stale = now - *stamp > hosts_->staleness(r);
    if (stale == (stale_[r] != 0)) continue;
    stale_[r] = stale ? 1 : 0;
    (stale ? silent : back).push_back(options_.robots[r].name);
  }
  tell_silence(silent, "is stale: its host has not reported its pose for too long");
  tell_silence(back, "is back");
}

void LiveRun::send_world() {
  const SimTime time = now();
  look_for_stale(time);
  hosts_->send_world(++worlds_, time, stale_);
  // On a grid of deadlines, so that lateness does not add up; what was missed is left out.
  const auto period = std::chrono::nanoseconds(options_.world_period.ns);
  const auto late = std::max<std::int64_t>(0, (Clock::now() - next_world_) / period);
  next_world_ += period * (late + 1);
}

void LiveRun::tell_state(rave_wire_RunPhase phase, const std::string& text) {
  const std::int64_t now_ns = begun_ ? std::max<std::int64_t>(0, now().ns) : 0;
  // The time of the run follows the clock; the steps of its robots may fall behind.
  hosts_->publish({options_.scenario, phase, static_cast<std::uint64_t>(now_ns / options_.step.ns),
                   static_cast<std::uint64_t>(options_.duration.ns / options_.step.ns),
                   options_.step.seconds(), begun_ ? hosts_->slowest_speed() : 0, text});
  next_tell_ = Clock::now() + kTell;
}

void LiveRun::tell_progress() {
  if (!options_.on_progress) return;
  options_.on_progress(begun_ ? now() : SimTime{}, hosts_->slowest_speed(), missing());
}

Result<LiveManagerOutcome> LiveRun::go() {
  auto next_ask = Clock::now();
  while (!(begun_ && now().ns >= options_.duration.ns)) {
    auto wake = Clock::now() + kLook;
    if (begun_) wake = std::min(wake, next_world_);
    const auto left =
        std::chrono::duration_cast<std::chrono::nanoseconds>(wake - Clock::now()).count();
    // A message of a host or a request ends the wait; otherwise it ends for the next world or the
    // next look.
    hosts_->wait(Duration{std::max<std::int64_t>(0, left)}, asked());
    RAVE_TRY(listen());
    begin_if_ready();
    // Edits come before the world of the same turn, so a host receives both with one wake.
    if (begun_) RAVE_TRY(edits_->look(now()));
    if (begun_ && Clock::now() >= next_world_) send_world();
    if (Clock::now() >= next_tell_) {
      const std::string waits_for = missing();
      tell_state(begun_ ? rave_wire_RUN_RUNNING : rave_wire_RUN_GATHERING,
                 waits_for.empty() ? waits_for : fmt::format("waiting for {}", waits_for));
    }
    if (Clock::now() < next_ask) continue;
    next_ask = Clock::now() + kLook;
    tell_progress();
    if (!stopping()) continue;
    ended_by_hand_ = begun_ && by_hand() && ends_hosts();
    if (!ended_by_hand_) {
      problems_.push_back(begun_ ? fmt::format("stopped at {:.2f} s", now().seconds())
                                 : fmt::format("stopped while waiting for {}", missing()));
    }
    break;
  }
  return outcome();
}

// A manager that only stops managing leaves the hosts running.
bool LiveRun::ends_hosts() const {
  return options_.ends_hosts || (options_.control != nullptr && options_.control->ends_everybody());
}

LiveManagerOutcome LiveRun::outcome() {
  ended_ = true;
  edits_->end();
  if (options_.on_end) options_.on_end(edits_->world());
  LiveManagerOutcome outcome;
  outcome.edits = edits_->edits();
  outcome.refused = edits_->refused();
  if (begun_) outcome.end = now();
  outcome.worlds = worlds_;
  outcome.states = hosts_->states();
  for (const LiveSlot& slot : hosts_->slots()) {
    outcome.hosts.push_back({slot.name, slot.heard, static_cast<double>(slot.offset_ns) * 1e-9,
                             slot.bound_ns < 0 ? -1 : static_cast<double>(slot.bound_ns) * 1e-9,
                             slot.losses});
    if (!slot.heard && begun_)
      problems_.push_back(fmt::format("host `{}` never joined", slot.name));
    if (slot.losses > 0) {
      problems_.push_back(
          fmt::format("host `{}` was lost {}", slot.name,
                      slot.losses == 1 ? "once" : fmt::format("{} times", slot.losses)));
    }
  }
  if (endpoint_.standstills() > 0) {
    problems_.push_back(fmt::format(
        "the environment manager stood still for so long that hosts may have "
        "considered it lost{}: it sent no worlds meanwhile",
        endpoint_.standstills() == 1 ? "" : fmt::format(" ({} times)", endpoint_.standstills())));
  }
  // The run is judged before the farewell, during which time passes, too.
  const bool over = begun_ && now().ns >= options_.duration.ns;
  outcome.problems = problems_;
  outcome.ended_by_hand = ended_by_hand_;
  outcome.whole = (over || ended_by_hand_) && problems_.empty() && outcome.refused.empty();
  if (!over && !ends_hosts()) {
    take_host_results(hosts_->slots());
    outcome.host_results = hand_out_host_results(hosts_->slots());
    return outcome;
  }
  const bool good = over || ended_by_hand_;
  std::string why = good || problems_.empty() ? std::string() : problems_.front();
  if (ended_by_hand_) why = by_hand_text(outcome.end.seconds());
  tell_state(good ? rave_wire_RUN_ENDED : rave_wire_RUN_FAILED, why);
  // Hosts learn of the end before this process leaves.
  drain_hosts(hosts_->slots(), begun_, [this] {
    hosts_->wait(Duration{std::chrono::nanoseconds(kLook).count()});
    return listen().has_value();
  });
  outcome.drained = true;
  outcome.host_results = hand_out_host_results(hosts_->slots());
  return outcome;
}

}  // namespace rave::manager
