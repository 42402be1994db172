// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/introduction.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <span>
#include <tuple>

#include "rave/base/hash.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::lock_step {

std::uint64_t scenario_number(std::string_view expanded) noexcept {
  return content_hash(std::as_bytes(std::span(expanded.data(), expanded.size())));
}

bus::HostInfo introduction(const Identity& self) {
  bus::HostInfo info{};
  info.host = self.host;
  bus::put_text(info.name, self.name);
  std::array<char, sizeof info.machine> machine{};
  if (::gethostname(machine.data(), machine.size() - 1) == 0) {
    bus::put_text(info.machine, machine.data());
  }
  bus::put_text(info.version, RAVE_VERSION);
  info.interface_stamp = self.interface_stamp;
  info.scenario = self.scenario;
  info.clock = self.real_time ? rave_wire_CLOCK_REAL_TIME : rave_wire_CLOCK_LOCK_STEP;
  info.robots = self.robots;
  const auto today = std::chrono::system_clock::now().time_since_epoch();
  info.started_ns = self.started_ns != 0
                        ? self.started_ns
                        : std::chrono::duration_cast<std::chrono::nanoseconds>(today).count();
  bus::put_text(info.folder, self.folder);
  return info;
}

bool gives_way(const bus::HostInfo& self, const bus::HostInfo& other) noexcept {
  // Both processes compare the same two pairs, so exactly one of them gives way. Start times are
  // wall-clock times of possibly two machines and may be wrong or equal; the random writer number
  // decides the rest.
  return std::tie(self.started_ns, self.writer) > std::tie(other.started_ns, other.writer);
}

Status check_fits(const Identity& self, const bus::HostInfo& other) {
  // The build first: another build may also hash the same scenario differently, and that message
  // would mislead.
  if (other.interface_stamp != self.interface_stamp) {
    return fail(ErrorCode::kState,
                "`{}` is another build of RAVE (version {}, here {}): all processes of a run need "
                "the same",
                other.name, other.version, RAVE_VERSION);
  }
  if (other.scenario != self.scenario) {
    return fail(ErrorCode::kState,
                "`{}` has another scenario: its files and options (seed, duration) must be the "
                "same as here",
                other.name);
  }
  if ((other.clock == rave_wire_CLOCK_REAL_TIME) != self.real_time) {
    return fail(
        ErrorCode::kState,
        "`{}` runs {}, and this process {}: one of them has a driver that follows the wall clock",
        other.name, self.real_time ? "in lock-step" : "in real time",
        self.real_time ? "in real time" : "in lock-step");
  }
  return {};
}

}  // namespace rave::lock_step
