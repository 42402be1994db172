// SPDX-License-Identifier: Apache-2.0
#include "rave/watch/lone_run.hpp"

#include <charconv>

#include "rave/base/wall_clock.hpp"
#include "rave/control/client.hpp"

namespace rave::watch {
namespace {

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
  if (status.duration_s > 0) view.duration_s = status.duration_s;
  for (std::size_t i = 0; with_robots && i < status.robots.size(); ++i) {
    const auto& robot = status.robots[i];
    RobotView& seen = view.robots.emplace_back();
    seen.number = static_cast<std::uint32_t>(i);
    seen.name = robot.name;
    seen.simulated = robot.simulated;
  }
  return view;
}

}  // namespace

HostView LoneRun::process_row(const runtime::RunStatus& status) {
  // The name of a control socket ends with the number of its process.
  const std::size_t dash = name_.rfind('-');
  const std::string_view digits = std::string_view(name_).substr(dash + 1);
  std::uint32_t process = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), process);
  return row_.row(name_.substr(0, dash), process, status);
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
  time_.add(steady_ns(), answer->status.sim_s);
  last_.speed = time_.at(steady_ns());
  last_.hosts.push_back(process_row(answer->status));
  return last_;
}

}  // namespace rave::watch
