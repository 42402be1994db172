// SPDX-License-Identifier: Apache-2.0
// How old samples are, and when that is too old.
#include "sensor_age.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace rave::sim {
namespace {

/// This number of periods without a sample is no accident of a line.
constexpr double kPeriods = 3;
/// A computer that is busy delays a sample by so much.
constexpr double kLeast_s = 0.2;
constexpr double kInfinite_s = std::numeric_limits<double>::infinity();

}  // namespace

bool is_judged_by_link(const SensorSpec& sensor) noexcept {
  return sensor.timing == SampleTiming::kEvents && !sensor.max_age_s;
}

Result<std::optional<double>> max_age_s(const SensorSpec& sensor,
                                        const HardwareDeclaration& declaration,
                                        std::optional<Duration> staleness) {
  if (sensor.max_age_s) return sensor.max_age_s;
  const double period_s = declaration.period_s;
  if (sensor.timing == SampleTiming::kPeriodic && !(period_s > 0 && std::isfinite(period_s))) {
    return fail(ErrorCode::kPlugin, "is periodic, but declared a period of {} s", period_s);
  }
  if (staleness) {
    // A recording follows the run: its samples are as old as its stamps say, which is judged there.
    return declaration.clock == DriverClock::kLive ? std::optional(staleness->seconds())
                                                   : std::nullopt;
  }
  if (sensor.timing == SampleTiming::kUnknown) return std::optional<double>();
  return std::max(kPeriods * period_s, kLeast_s);
}

double live_age_s(const SampleQueue& queue, bool judged_by_link) {
  if (judged_by_link) return queue.failed() ? kInfinite_s : 0;
  // What arrives late is old when it arrives.
  const auto moment = queue.newest_moment();
  if (!moment) return kInfinite_s;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - *moment).count();
}

double told_max_age_s(const SensorSlots& slots) noexcept {
  constexpr double kLater = 1.5;
  if (!slots.max_age_s || is_judged_by_link(*slots.spec)) return kInfinite_s;
  return kLater * *slots.max_age_s + slots.spec->processing.latency_s;
}

double sensor_age_s(const SensorSlots& slots, std::size_t member, SimTime now) {
  const bool by_link = is_judged_by_link(*slots.spec);
  if (slots.live) return live_age_s(*slots.queues[member], by_link);
  if (by_link) return slots.failed[member] != 0 ? kInfinite_s : 0;
  const std::int64_t heard_ns = slots.heard_ns[member];
  return heard_ns == kNeverHeard_ns ? kInfinite_s : Duration{now.ns - heard_ns}.seconds();
}

void find_watched_sensors(const RobotGroup& group, std::size_t member, SimTime now,
                          std::vector<GuardSensor>& sensors) {
  sensors.clear();
  for (std::uint32_t s = 0; s < group.sensors.size(); ++s) {
    const SensorSlots& slots = group.sensors[s];
    if (!slots.max_age_s) continue;
    sensors.push_back({s, sensor_age_s(slots, member, now), *slots.max_age_s});
  }
}

std::string sensor_lost_text(const SensorSlots& slots, std::size_t member) {
  if (is_judged_by_link(*slots.spec)) {
    return fmt::format("sensor lost: the driver of `{}` has failed", slots.spec->name);
  }
  const double lag_s = slots.live ? slots.queues[member]->newest_lag().seconds() : 0;
  if (lag_s > *slots.max_age_s) {
    return fmt::format("sensor lost: the samples of `{}` come {:.1f} s late, more than {:g} s",
                       slots.spec->name, lag_s, *slots.max_age_s);
  }
  return fmt::format("sensor lost: `{}` has given no sample for more than {:g} s", slots.spec->name,
                     *slots.max_age_s);
}

std::string sensor_frozen_text(const RobotGroup& group, std::uint32_t sensor) {
  const std::string& name = group.sensors[sensor].spec->name;
  if (group.type->pose_from == sensor) {
    return fmt::format(
        "frozen: the pose of `{}` stays the same to the bit although the robot is commanded to "
        "move: "
        "the "
        "sensor repeats itself, or something holds the robot",
        name);
  }
  return fmt::format(
      "frozen: `{}` repeats the same scan to the bit although the robot is commanded to move",
      name);
}

}  // namespace rave::sim
