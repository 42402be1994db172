// SPDX-License-Identifier: Apache-2.0
#include "rave/watch/lone_run.hpp"

#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>

#include "process_usage.hpp"
#include "rave/control/client.hpp"

namespace rave::watch {
namespace {

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::string this_machine() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

RunView view_of(const std::string& name, const runtime::RunStatus& status, bool with_robots) {
  RunView view;
  view.run = name;
  view.scenario = status.scenario;
  view.timing = Timing::kAlone;
  // Before the run begins the process answers without a scenario.
  view.phase = status.scenario.empty() ? Phase::kUnknown
               : status.paused         ? Phase::kPaused
                                       : Phase::kRunning;
  view.time_s = status.sim_s;
  view.duration_s = status.duration_s;
  HostView& host = view.hosts.emplace_back();
  host.name = name.substr(0, name.rfind('-'));
  host.machine = this_machine();
  host.standing = Standing::kHere;
  host.robots = static_cast<std::uint32_t>(status.robots.size());
  host.real_robots = 0;
  if (status.lateness && status.lateness->deadlines > 0) {
    const runtime::RunStatus::Lateness& late = *status.lateness;
    host.missed_pct =
        100.0 * static_cast<double>(late.missed) / static_cast<double>(late.deadlines);
    host.worst_late_s = late.worst_s;
    host.behind_s = late.behind_s;
    host.late_phase = late.phase;
  }
  for (std::size_t i = 0; i < status.robots.size(); ++i) {
    const auto& robot = status.robots[i];
    *host.real_robots += robot.simulated ? 0U : 1U;
    if (!with_robots) continue;
    RobotView& seen = view.robots.emplace_back();
    seen.number = static_cast<std::uint32_t>(i);
    seen.name = robot.name;
    seen.simulated = robot.simulated;
  }
  return view;
}

}  // namespace

void LoneRun::tell_process(HostView& host) {
  // The name of a control socket ends with the number of its process.
  const std::string_view digits = std::string_view(name_).substr(name_.rfind('-') + 1);
  std::uint32_t process = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), process);
  const auto usage = usage_of(process);
  if (!usage) return;
  host.process = process;
  host.memory_mb = usage->memory_mb;
  cpu_.add(now_ns(), usage->cpu_s);
  host.cores = cpu_.at(now_ns());
}

Result<RunView> LoneRun::look(bool with_robots) {
  const auto answer = control::ask(name_, {});
  if (!answer) {
    // Without its socket the run has ended; its last state stays on the page.
    if (answer.error().code != ErrorCode::kNotFound) return tl::unexpected(answer.error());
    if (!seen_)
      return fail(ErrorCode::kState, "the run `{}` ended before it could be queried", name_);
    last_.phase = Phase::kEnded;
    last_.speed.reset();
    for (HostView& host : last_.hosts) host.standing = Standing::kGone;
    return last_;
  }
  last_ = view_of(name_, answer->status, with_robots);
  seen_ = true;
  time_.add(now_ns(), answer->status.sim_s);
  last_.speed = time_.at(now_ns());
  tell_process(last_.hosts.front());
  return last_;
}

}  // namespace rave::watch
