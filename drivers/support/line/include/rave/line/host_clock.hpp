// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

#include "rave/base/hash.hpp"
#include "rave/robot/hardware_sensor.hpp"

namespace rave::line {

/// The clock for times of arrival: monotonic, and equal in all processes of a machine.
using HostClock = std::chrono::steady_clock;
using HostTime = HostClock::time_point;
using Wait = std::chrono::milliseconds;

[[nodiscard]] inline HostTime host_now() noexcept { return HostClock::now(); }

/// A number that differs for each start of a program, for TransmitterDeclaration::boot.
[[nodiscard]] inline std::uint32_t boot_number() noexcept {
  const auto ticks = host_now().time_since_epoch().count();
  return static_cast<std::uint32_t>(mix64(static_cast<std::uint64_t>(ticks)));
}

/// Seconds since the clock's epoch.
[[nodiscard]] inline double host_seconds(HostTime t) noexcept {
  return std::chrono::duration<double>(t.time_since_epoch()).count();
}

[[nodiscard]] inline HostTime after_seconds(HostTime t, double seconds) noexcept {
  return t + std::chrono::nanoseconds(from_seconds(seconds).ns);
}

/// The time until `t`; at least 0, rounded up so that a wait does not end early.
[[nodiscard]] inline Wait until(HostTime t) noexcept {
  const auto left = std::chrono::ceil<Wait>(t - host_now());
  return left > Wait::zero() ? left : Wait::zero();
}

/// The time of the run at which the host's clock showed `host_s`; never later than now. The age is
/// counted in seconds of the run: exact at pace 1; at another pace it is wrong by a fraction of the
/// age.
[[nodiscard]] inline SimTime run_stamp(const SampleSink& sink, double host_s) noexcept {
  const double age_s = host_seconds(host_now()) - host_s;
  return sink.now() - (age_s > 0 ? from_seconds(age_s) : Duration{});
}

}  // namespace rave::line
