// SPDX-License-Identifier: Apache-2.0
#include "rave/watch/process_row.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>

#include "process_usage.hpp"
#include "rave/base/wall_clock.hpp"
#include "rave/control/run_control.hpp"

namespace rave::watch {
namespace {

std::string this_machine() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

void tell_lateness(const runtime::RunStatus::Lateness& late, HostView& host) {
  if (late.deadlines == 0) return;
  host.missed_pct = 100.0 * static_cast<double>(late.missed) / static_cast<double>(late.deadlines);
  host.worst_late_s = late.worst_s;
  host.behind_s = late.behind_s;
  host.late_phase = late.phase;
}

}  // namespace

HostView ProcessRow::row(std::string name, std::uint32_t process,
                         const runtime::RunStatus& status) {
  HostView host;
  host.name = std::move(name);
  host.machine = this_machine();
  host.standing = Standing::kHere;
  host.robots = static_cast<std::uint32_t>(status.robots.size());
  host.real_robots = static_cast<std::uint32_t>(
      std::ranges::count(status.robots, false, &runtime::RunStatus::Robot::simulated));
  if (status.lateness) tell_lateness(*status.lateness, host);
  if (const auto usage = usage_of(process)) {
    host.process = process;
    host.memory_mb = usage->memory_mb;
    const std::int64_t now_ns = steady_ns();
    cpu_.add(now_ns, usage->cpu_s);
    host.cores = cpu_.at(now_ns);
  }
  return host;
}

}  // namespace rave::watch
