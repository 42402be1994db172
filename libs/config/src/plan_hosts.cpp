// SPDX-License-Identifier: Apache-2.0
// Which host runs which robots. All processes of a run compute it from the same scenario, so they
// agree without a message.
#include <algorithm>
#include <optional>

#include "rave/base/names.hpp"
#include "rave/base/time.hpp"
#include "rave/config/described.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::config {
namespace {

constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

Result<std::vector<PlannedHost>> equal_parts(const ExpandedScenario& scenario) {
  const Located<int>& processes = *scenario.scenario.processes;
  const auto count = static_cast<std::size_t>(processes.value);
  const std::size_t robots = scenario.robots.size();
  if (count > robots) {
    return fail_at(processes.where, ErrorCode::kParse,
                   "`processes`: found {}, expected at most one per robot, of which there are {}",
                   count, robots);
  }
  std::vector<PlannedHost> hosts(count);
  for (std::size_t h = 0; h < count; ++h) {
    hosts[h].name = fmt::format("host-{}", h + 1);
    // Neighbours stay together, and the sizes differ by one at most.
    for (std::size_t r = robots * h / count; r < robots * (h + 1) / count; ++r) {
      hosts[h].robots.push_back(r);
    }
  }
  return hosts;
}

/// Assigns the robots that a host names to it.
Status claim(const ExpandedScenario& scenario, const HostFile& file, std::size_t host,
             std::vector<std::size_t>& host_of) {
  for (const Located<std::string>& name : file.robots) {
    const std::vector<std::size_t> robots = robots_named(scenario, name.value);
    if (robots.empty()) {
      return fail_at(name.where, ErrorCode::kParse, "there is no robot `{}`{}", name.value,
                     robot_suggestion(scenario, name.value));
    }
    for (const std::size_t robot : robots) {
      if (host_of[robot] != kNobody) {
        return fail_at(name.where, ErrorCode::kParse,
                       "robot `{}` is given to host `{}`, but `{}` already has it",
                       scenario.robots[robot].name, file.name.value,
                       scenario.scenario.hosts[host_of[robot]].name.value);
      }
      host_of[robot] = host;
    }
  }
  return {};
}

/// The host of each robot; unnamed robots go to the host that names none.
Result<std::vector<std::size_t>> share(const ExpandedScenario& scenario) {
  const std::vector<HostFile>& files = scenario.scenario.hosts;
  std::vector<std::size_t> host_of(scenario.robots.size(), kNobody);
  std::optional<std::size_t> rest;
  for (std::size_t h = 0; h < files.size(); ++h) {
    if (files[h].robots.empty() && rest) {
      return fail_at(
          files[h].name.where, ErrorCode::kParse,
          "the hosts `{}` and `{}` name no robots; only one host may do so, and gets the rest",
          files[*rest].name.value, files[h].name.value);
    }
    if (files[h].robots.empty()) rest = h;
    RAVE_TRY(claim(scenario, files[h], h, host_of));
  }
  for (std::size_t r = 0; r < host_of.size(); ++r) {
    if (host_of[r] != kNobody) continue;
    if (!rest) {
      return fail_at(files.front().name.where, ErrorCode::kParse,
                     "no host has robot `{}`; a host without `robots` gets all that no other has",
                     scenario.robots[r].name);
    }
    host_of[r] = *rest;
  }
  return host_of;
}

}  // namespace

std::uint32_t report_period_steps(const ExpandedScenario& scenario, const ExpandedRobot& robot) {
  constexpr double kUsual_s = 0.1;
  const auto& period_s = scenario.group_of(robot).robot.report_period_s;
  const std::int64_t step_ns = from_seconds(*scenario.scenario.step_s).ns;
  const std::int64_t period_ns = from_seconds(period_s ? **period_s : kUsual_s).ns;
  return static_cast<std::uint32_t>(std::max<std::int64_t>(1, (period_ns + step_ns - 1) / step_ns));
}

Result<std::vector<PlannedHost>> plan_hosts(const ExpandedScenario& scenario) {
  if (scenario.scenario.processes) return equal_parts(scenario);
  const std::vector<HostFile>& files = scenario.scenario.hosts;
  std::vector<PlannedHost> hosts;
  if (files.empty()) return hosts;
  RAVE_TRY_ASSIGN(const auto host_of, share(scenario));
  for (const HostFile& file : files) hosts.push_back({file.name.value, {}, file.elsewhere});
  for (std::size_t r = 0; r < host_of.size(); ++r) hosts[host_of[r]].robots.push_back(r);
  for (std::size_t h = 0; h < hosts.size(); ++h) {
    if (!hosts[h].robots.empty()) continue;
    return fail_at(files[h].name.where, ErrorCode::kParse,
                   "host `{}` has no robot: the other hosts have all", hosts[h].name);
  }
  return hosts;
}

}  // namespace rave::config
