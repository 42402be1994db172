// SPDX-License-Identifier: Apache-2.0
// Samples come from other processes and machines. What passes here has finite numbers, existing
// kinds and texts that may be shown; whether it makes sense in the run is checked by its reader.
#include "rave/bus/validate.hpp"

#include <algorithm>

#include "sample_checks.hpp"

namespace rave::bus {
namespace {

Status check_robots(std::string_view list, const rave_wire_PlanarRobots& robots) {
  RAVE_TRY(check_ids(list, robots.id));
  const std::size_t size = robots.id._length;
  RAVE_TRY(check_pose_columns(list, robots, size));
  RAVE_TRY(check_twist_columns(list, robots, size));
  // Columns of different lengths would shift the fields of all robots behind the gap.
  const auto stamps = elements(robots.stamp_ns);
  if (stamps.size() != size) {
    return invalid("{}.stamp_ns has {} entries for {} robots", list, stamps.size(), size);
  }
  const auto wrong = std::find_if_not(stamps.begin(), stamps.end(), usable);
  if (wrong == stamps.end()) return {};
  return check_time(fmt::format("{}.stamp_ns[{}]", list, wrong - stamps.begin()), *wrong);
}

Status check_reports(std::string_view list, const rave_wire_RobotReports& reports) {
  RAVE_TRY(check_ids(list, reports.id));
  const std::size_t size = reports.id._length;
  constexpr double kMaxVariance = kMaxPosition_m * kMaxPosition_m;
  RAVE_TRY(check_pose_columns(list, reports, size));
  RAVE_TRY(check_numbers(list, "variance_xy_m2", reports.variance_xy_m2, size, kMaxVariance));
  RAVE_TRY(check_numbers(list, "variance_yaw_rad2", reports.variance_yaw_rad2, size, kMaxVariance));
  if (reports.flags._length == size) return {};
  return invalid("{}.flags has {} entries for {} robots", list, reports.flags._length, size);
}

/// Checks the address of a request or answer.
template <class Message>
Status check_address(const Message& sample) {
  RAVE_TRY(check_writer(sample));
  // 0 is no process: such a message would have no receiver, or all of them by mistake.
  if (sample.target == 0) return invalid("target is 0");
  if (sample.number == 0) return invalid("number is 0");
  return {};
}

/// Checks text that appears in logs and on terminals.
template <class Sequence>
Status check_line(const Sequence& sequence, std::size_t most) {
  const std::string_view text = text_of(sequence);
  if (text.empty()) return invalid("text is empty");
  if (text.size() > most) {
    return invalid("text has {} bytes, more than {}", text.size(), most);
  }
  if (!has_control_characters(text)) return {};
  return invalid("text has control characters");
}

/// A path has its own number of points, every other kind exactly one or none.
Status check_points(const Command& sample) {
  const auto points = elements(sample.points);
  const bool has_one =
      sample.kind == rave_wire_COMMAND_GOAL || sample.kind == rave_wire_COMMAND_PLACE;
  const bool path = sample.kind == rave_wire_COMMAND_PATH;
  const std::size_t expected = has_one ? 1 : 0;
  if (!path && points.size() != expected) {
    return invalid("points has {} entries, not {}", points.size(), expected);
  }
  for (const auto& point : points) {
    RAVE_TRY(check_number("points.x_m", point.x_m, kMaxPosition_m));
    RAVE_TRY(check_number("points.y_m", point.y_m, kMaxPosition_m));
  }
  return {};
}

}  // namespace

Status validate(const HostState& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_id("host", sample.host));
  RAVE_TRY(check_robots("resolved", sample.resolved));
  return check_reports("reports", sample.reports);
}

Status validate(const World& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_time("time_ns", sample.time_ns));
  RAVE_TRY(check_robots("robots", sample.robots));
  return check_robot_numbers("stale", "stale", sample.stale);
}

Status validate(const RosterEntry& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_id("robot", sample.robot));
  RAVE_TRY(check_id("host", sample.host));
  RAVE_TRY(check_label("name", sample.name, true));
  RAVE_TRY(check_label("team", sample.team, false));
  RAVE_TRY(check_label("driver", sample.driver, false));
  if (sample.kind > rave_wire_ROBOT_SHADOW) return invalid("kind is unknown");
  return {};
}

Status validate(const Command& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_id("robot", sample.robot));
  if (sample.kind > rave_wire_COMMAND_ARM) return invalid("kind is unknown");
  if (sample.number == 0) return invalid("number is 0");
  RAVE_TRY(check_label("author", sample.author, true));
  RAVE_TRY(check_label("text", sample.text, sample.kind == rave_wire_COMMAND_TEXT));
  RAVE_TRY(check_points(sample));
  RAVE_TRY(check_number("yaw_rad", sample.yaw_rad, kMaxAngle_rad));
  RAVE_TRY(check_number("v_mps", sample.v_mps, kMaxSpeed_mps));
  RAVE_TRY(check_number("w_radps", sample.w_radps, kMaxTurn_radps));
  RAVE_TRY(check_number("vy_mps", sample.vy_mps, kMaxSpeed_mps));
  RAVE_TRY(check_pedals(sample.pedals));
  return check_number("speed_mps", sample.speed_mps, kMaxSpeed_mps);
}

Status validate(const CommandAnswer& sample) {
  RAVE_TRY(check_address(sample));
  RAVE_TRY(check_id("robot", sample.robot));
  return check_line(sample.text, rave_wire_kMaxCommandAnswerBytes);
}

Status validate(const Packet& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_id("from_robot", sample.from_robot));
  if (sample.to_kind > rave_wire_TO_TEAM) return invalid("to_kind is unknown");
  if (sample.to_kind == rave_wire_TO_ROBOT) RAVE_TRY(check_id("to_robot", sample.to_robot));
  RAVE_TRY(check_time("sent_ns", sample.sent_ns));
  RAVE_TRY(check_number("x_m", sample.x_m, kMaxPosition_m));
  RAVE_TRY(check_number("y_m", sample.y_m, kMaxPosition_m));
  RAVE_TRY(check_number("antenna_z_m", sample.antenna_z_m, kMaxPosition_m));
  return check_range("range_m", sample.range_m);
}

Status validate(const HostInfo& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_label("name", sample.name, true));
  RAVE_TRY(check_label("machine", sample.machine, false));
  RAVE_TRY(check_label("version", sample.version, false));
  if (sample.clock > rave_wire_CLOCK_REAL_TIME) return invalid("clock is unknown");
  if (sample.robots > rave_wire_kMaxRobots) {
    return invalid("robots is {}, more than {}", sample.robots, rave_wire_kMaxRobots);
  }
  return {};
}

Status validate(const LineInfo& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_label("host", sample.host, true));
  const std::string_view url = sample.url;
  RAVE_TRY(check_label("url", url, true));
  if (!url.starts_with("ws://") && !url.starts_with("wss://")) {
    return invalid("url: expected ws:// or wss://");
  }
  // The URL is inserted into a header of the page, where these characters are separators.
  if (url.find_first_of(" ;,'\"<>") != std::string_view::npos) {
    return invalid("url has an invalid character");
  }
  return {};
}

Status validate(const LineWithdrawal& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_label("user", sample.user, true));
  return check_label("text", sample.text, true);
}

Status validate(const ProcessState& sample) {
  RAVE_TRY(check_writer(sample));
  if (sample.number == 0) return invalid("number is 0");
  if (sample.robots > rave_wire_kMaxRobots) {
    return invalid("robots is {}, more than {}", sample.robots, rave_wire_kMaxRobots);
  }
  if (sample.real_robots > sample.robots) {
    return invalid("real_robots is {}, of {} robots", sample.real_robots, sample.robots);
  }
  RAVE_TRY(check_time("cpu_ns", sample.cpu_ns));
  if (sample.missed_deadlines > sample.deadlines) {
    return invalid("missed_deadlines is {}, of {} deadlines", sample.missed_deadlines,
                   sample.deadlines);
  }
  RAVE_TRY(check_time("worst_late_ns", sample.worst_late_ns));
  RAVE_TRY(check_time("behind_ns", sample.behind_ns));
  RAVE_TRY(check_label("late_phase", sample.late_phase, false));
  return check_time("round_trip_ns", sample.round_trip_ns);
}

Status validate(const ClockPing& sample) {
  RAVE_TRY(check_writer(sample));
  if (sample.target == 0) return invalid("target is 0");
  RAVE_TRY(check_time("run_ns", sample.run_ns));
  RAVE_TRY(check_time("obstacles_ns", sample.obstacles_ns));
  RAVE_TRY(check_time("offset_ns", sample.offset_ns));
  return check_time("bound_ns", sample.bound_ns);
}

Status validate(const ClockPong& sample) {
  RAVE_TRY(check_writer(sample));
  if (sample.target == 0) return invalid("target is 0");
  if (sample.pong_sent_ns < sample.ping_received_ns) {
    return invalid("a pong was sent before its ping");
  }
  RAVE_TRY(check_time("ping_sent_ns", sample.ping_sent_ns));
  RAVE_TRY(check_time("ping_received_ns", sample.ping_received_ns));
  RAVE_TRY(check_time("pong_sent_ns", sample.pong_sent_ns));
  return check_time("zero_ns", sample.zero_ns);
}

Status validate(const HostResultsPart& sample) {
  constexpr std::uint64_t kPart = rave_wire_kMaxHostResultsPart;
  constexpr std::uint64_t kMost = kPart * rave_wire_kMaxHostResultsParts;
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_id("host", sample.host));
  if (sample.size == 0 || sample.size > kMost) {
    return invalid("size is {}, not within 1 and {}", sample.size, kMost);
  }
  // Sizes follow from each other, so every part but the last is full; anything else is refused.
  const std::uint64_t parts = (sample.size + kPart - 1) / kPart;
  if (sample.part >= parts) {
    return invalid("part is {}, but {} bytes have {} parts", sample.part, sample.size, parts);
  }
  const std::uint64_t expected = std::min(kPart, sample.size - sample.part * kPart);
  if (sample.bytes._length == expected) return {};
  return invalid("bytes has {} entries in part {}, not {}", sample.bytes._length, sample.part,
                 expected);
}

Status validate(const Request& sample) {
  RAVE_TRY(check_address(sample));
  RAVE_TRY(check_label("from", sample.from, true));
  return check_line(sample.text, rave_wire_kMaxRequestBytes);
}

Status validate(const RequestAnswer& sample) {
  RAVE_TRY(check_address(sample));
  return check_line(sample.text, rave_wire_kMaxRequestAnswerBytes);
}

}  // namespace rave::bus
