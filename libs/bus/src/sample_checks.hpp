// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "rave/base/control_characters.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/validate.hpp"

/// Checks used by several topics.
namespace rave::bus {

/// Half a century: an upper bound of run times and uptimes.
inline constexpr std::int64_t kMaxTime_ns = 1'577'880'000'000'000'000;

/// A bound of accumulated angles.
inline constexpr double kMaxAngle_rad = 2e6 * std::numbers::pi;

template <class... Args>
tl::unexpected<Error> invalid(fmt::format_string<Args...> format, Args&&... args) {
  return fail(ErrorCode::kInvalidArgument, format, std::forward<Args>(args)...);
}

inline Status check_number(std::string_view field, double value, double limit) {
  // NaN fails this condition.
  if (std::fabs(value) <= limit) return {};
  return invalid("{} is {}, not within +-{}", field, value, limit);
}

/// Checks the range of a message.
inline Status check_range(std::string_view field, double range_m) {
  if (range_m >= 0 && range_m <= kMaxPosition_m) return {};
  return invalid("{} is {}, not within 0 and {}", field, range_m, kMaxPosition_m);
}

inline Status check_pedals(const rave_wire_Pedals& pedals) {
  RAVE_TRY(check_number("pedals.steering", pedals.steering, 1));
  RAVE_TRY(check_number("pedals.throttle", pedals.throttle, 1));
  RAVE_TRY(check_number("pedals.brake", pedals.brake, 1));
  return check_number("pedals.gear", pedals.gear, 1);
}

template <class Sequence>
Status check_numbers(std::string_view list, std::string_view field, const Sequence& numbers,
                     std::size_t size, double limit) {
  const auto values = elements(numbers);
  if (values.size() != size) {
    return invalid("{}.{} has {} entries for {} robots", list, field, values.size(), size);
  }
  // One pass that the compiler can vectorise; the faulty element is searched only on failure.
  bool good = true;
  for (const double value : values) good &= std::fabs(value) <= limit;
  for (std::size_t i = 0; !good; ++i) {
    Status status = check_number(fmt::format("{}.{}[{}]", list, field, i), values[i], limit);
    if (!status) return status;
  }
  return {};
}

/// Checks that ids of robots ascend; `entries` is their name in `list`.
template <class Sequence>
Status check_robot_numbers(std::string_view list, std::string_view entries, const Sequence& ids) {
  const auto values = elements(ids);
  if (values.size() > rave_wire_kMaxRobots) {
    return invalid("{} has {} robots, more than {}", list, values.size(), rave_wire_kMaxRobots);
  }
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i - 1] >= values[i]) {
      return invalid("{}[{}] is {} after {}; ids ascend", entries, i, values[i], values[i - 1]);
    }
  }
  if (!values.empty() && values.back() == rave_wire_kNone) {
    return invalid("{}: a robot without a number", entries);
  }
  return {};
}
template <class Sequence>
Status check_ids(std::string_view list, const Sequence& ids) {
  return check_robot_numbers(list, std::string(list) + ".id", ids);
}

/// Checks the columns of poses.
template <class Columns>
Status check_pose_columns(std::string_view list, const Columns& columns, std::size_t size) {
  RAVE_TRY(check_numbers(list, "x_m", columns.x_m, size, kMaxPosition_m));
  RAVE_TRY(check_numbers(list, "y_m", columns.y_m, size, kMaxPosition_m));
  return check_numbers(list, "yaw_rad", columns.yaw_rad, size, kMaxAngle_rad);
}

/// Checks the columns of velocities.
template <class Columns>
Status check_twist_columns(std::string_view list, const Columns& columns, std::size_t size) {
  RAVE_TRY(check_numbers(list, "vx_mps", columns.vx_mps, size, kMaxSpeed_mps));
  RAVE_TRY(check_numbers(list, "vy_mps", columns.vy_mps, size, kMaxSpeed_mps));
  return check_numbers(list, "wz_radps", columns.wz_radps, size, kMaxTurn_radps);
}

/// Sums and differences of times of a run must not overflow.
inline bool usable(std::int64_t time_ns) {
  return time_ns >= -kMaxTime_ns && time_ns <= kMaxTime_ns;
}

inline Status check_time(std::string_view field, std::int64_t time_ns) {
  if (usable(time_ns)) return {};
  return invalid("{} is {}, not within +-{}", field, time_ns, kMaxTime_ns);
}

/// Names appear in logs and on terminals.
inline Status check_label(std::string_view field, std::string_view text, bool needed) {
  if (needed && text.empty()) return invalid("{} is empty", field);
  if (!has_control_characters(text)) return {};
  return invalid("{} has control characters", field);
}

inline Status check_id(std::string_view field, std::uint32_t id) {
  if (id == rave_wire_kNone) return invalid("{} is none", field);
  return {};
}

/// Checks an obstacle change of an authority, except the convexity of its polygons, which is
/// checked when shapes are made. `field`: its place in the message.
[[nodiscard]] Status check_obstacle_change(const std::string& field,
                                           const rave_wire_ObstacleChange& change);

template <class Sequence>
Status check_obstacle_changes(std::string_view list, const Sequence& sequence) {
  const auto changes = elements(sequence);
  if (changes.size() > rave_wire_kMaxObstacleChanges) {
    return invalid("{} has {} entries, more than {}", list, changes.size(),
                   rave_wire_kMaxObstacleChanges);
  }
  for (std::size_t i = 0; i < changes.size(); ++i) {
    RAVE_TRY(check_obstacle_change(fmt::format("{}[{}]", list, i), changes[i]));
  }
  return {};
}

template <class Sample>
Status check_writer(const Sample& sample) {
  if (sample.writer == 0) return invalid("writer is 0");
  return {};
}

}  // namespace rave::bus
