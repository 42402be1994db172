// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/pulse.hpp"

#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <memory>

#include "rave/bus/sequence.hpp"

namespace rave::lock_step {
namespace {

/// The CPU time that this process has used.
std::int64_t cpu_ns() {
  std::timespec used{};
  if (::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used) != 0) return 0;
  return std::int64_t{used.tv_sec} * 1'000'000'000 + used.tv_nsec;
}

struct Close {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

/// Resident memory of this process: the second number of /proc/self/statm, in pages (proc(5)).
std::uint64_t memory_bytes() {
  const std::unique_ptr<std::FILE, Close> file(std::fopen("/proc/self/statm", "re"));
  unsigned long long pages = 0;
  if (!file || std::fscanf(file.get(), "%*u %llu", &pages) != 1) return 0;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

Status Pulse::open(bus::Bus& bus, const Identity& self, std::chrono::nanoseconds period) {
  bus_ = &bus;
  period_ = period;
  state_.host = self.host;
  state_.robots = self.robots;
  state_.real_robots = self.real_robots;
  state_.process = static_cast<std::uint32_t>(::getpid());
  return writer_.open(bus);
}

void Pulse::count_real(std::uint32_t robots) noexcept {
  if (state_.real_robots == robots) return;
  state_.real_robots = robots;
  // Monitors see a hand-over at once and not with the next beat.
  next_ = {};
}

void Pulse::beat(const Facts& facts) {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + period_;
  ++state_.number;
  state_.step = facts.step;
  state_.missed = facts.missed;
  state_.round_trip_ns = facts.round_trip_ns;
  state_.deadlines = facts.lateness.deadlines;
  state_.missed_deadlines = facts.lateness.missed;
  state_.worst_late_ns = facts.lateness.worst_ns;
  state_.behind_ns = facts.lateness.behind_ns;
  bus::put_text(state_.late_phase, facts.lateness.phase);
  state_.refused = bus_->refused_samples();
  state_.cpu_ns = cpu_ns();
  state_.memory_bytes = memory_bytes();
  // The next period replaces a beat that was lost.
  static_cast<void>(writer_.write(state_));
}

}  // namespace rave::lock_step
