// SPDX-License-Identifier: Apache-2.0
#include "replay/recording_cursor.hpp"

#include <algorithm>
#include <cmath>

#include "rave/base/time.hpp"
#include "rave/onlook/reading_rows.hpp"
#include "rave/record/run_messages.hpp"

namespace rave::gui_server {
namespace {

/// Farther ahead than this it is quicker to begin anew than to read what lies between.
constexpr double kFar_s = 3;
/// Sensors that are slower than this are found by reading on, not by looking back.
constexpr double kMostBack_s = 2;

std::uint64_t ns_of(double time_s) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(from_seconds(time_s).ns, 0));
}

}  // namespace

RecordingCursor::RecordingCursor(const record::McapReader& reader, const FlagHistory& flags,
                                 const std::vector<std::uint8_t>& real, const BodyHistory& bodies,
                                 double step_s, double longest_period_s)
    : reader_(reader),
      flags_(flags),
      real_(real),
      bodies_(bodies),
      step_s_(step_s),
      look_back_s_(std::min(longest_period_s, kMostBack_s) + 2 * step_s) {
  if (const auto* const poses = reader.channel(record::topic::kPoses)) poses_channel_ = poses->id;
  if (const auto* const percepts = reader.channel(record::topic::kPercepts)) {
    percepts_channel_ = percepts->id;
  }
  if (const auto* const variances = reader.channel(record::topic::kVariances)) {
    variances_channel_ = variances->id;
  }
  poses_.robots.resize(real.size());
  poses_.truth.resize(real.size());
}

void RecordingCursor::begin_at(double time_s) {
  record::MessageFilter filter;
  filter.channels = {poses_channel_};
  if (percepts_channel_ && reads_percepts_) filter.channels.push_back(*percepts_channel_);
  if (variances_channel_) filter.channels.push_back(*variances_channel_);
  // Poses come each step, but the last sample of a slow sensor may be one period old.
  filter.from_ns = ns_of(time_s - look_back_s_);
  cursor_ = reader_.messages(filter);
  ahead_.reset();
  newest_.clear();
  percepts_.clear();
  variances_.clear();
}

Status RecordingCursor::find_variances(std::uint64_t until_ns) {
  if (!variances_channel_) return {};
  // Of merged recordings each host has steps of its own, so one more may lie between.
  const auto back_ns =
      static_cast<std::uint64_t>(record::kVariancesHold_ns + 100'000'000) + ns_of(2 * step_s_);
  record::MessageFilter filter;
  filter.channels = {*variances_channel_};
  filter.from_ns = until_ns > back_ns ? until_ns - back_ns : 0;
  record::MessageCursor before = reader_.messages(filter);
  while (true) {
    RAVE_TRY_ASSIGN(const auto message, before.next());
    // The last one before the moment counts, so all of them are read up to it.
    if (!message || message->log_time_ns > until_ns) return {};
    variances_.assign(message->bytes.begin(), message->bytes.end());
  }
}

Status RecordingCursor::go_to(double time_s) {
  // Half a step more, since a moment that was named in text is rounded.
  const double until_s = time_s + step_s_ / 2;
  if (!cursor_ || until_s < time_s_ || until_s > time_s_ + kFar_s) {
    begin_at(until_s);
    RAVE_TRY(find_variances(ns_of(until_s)));
  }
  time_s_ = until_s;
  RAVE_TRY(read_until(until_s));
  if (newest_.empty()) return {};
  RAVE_TRY(show(newest_));
  RAVE_TRY(show_variances());
  set_flags();
  return {};
}

Status RecordingCursor::read_until(double time_s) {
  const std::uint64_t until_ns = ns_of(time_s);
  while (true) {
    if (!ahead_) {
      RAVE_TRY_ASSIGN(const auto message, cursor_->next());
      if (!message) break;
      // A copy: the bytes of a message are valid until the next call of the reader only. The first
      // message behind the moment stays here for the next call of go_to().
      ahead_.emplace(message->log_time_ns, message->channel,
                     Bytes(message->bytes.begin(), message->bytes.end()));
    }
    auto& [at_ns, channel, bytes] = *ahead_;
    if (at_ns > until_ns) break;
    if (channel == poses_channel_) {
      newest_ = std::move(bytes);
    } else if (channel == variances_channel_) {
      variances_ = std::move(bytes);
    } else {
      percepts_.emplace_back(static_cast<double>(at_ns) * 1e-9, std::move(bytes));
    }
    ahead_.reset();
  }
  const auto old = std::find_if(percepts_.begin(), percepts_.end(), [&](const auto& entry) {
    return entry.first >= time_s - look_back_s_;
  });
  percepts_.erase(percepts_.begin(), old);
  return {};
}

Status RecordingCursor::show(const Bytes& bytes) {
  RAVE_TRY_ASSIGN(const auto step, record::decode_poses(bytes));
  poses_.time_s = step.time.seconds();
  poses_.step = step.step;
  for (std::size_t r = 0; r < poses_.robots.size(); ++r) {
    poses_.robots[r] = {};
    poses_.truth[r] = {};
    if (real_[r] != 0) poses_.robots[r].flags = kReal;
  }
  for (const record::RobotPose& pose : step.items) {
    if (pose.robot.value() >= poses_.robots.size()) continue;
    if (const auto& truth = pose.true_pose) {
      poses_.truth[pose.robot.value()] = {truth->x, truth->y, truth->yaw, 0, kKnown};
    }
    if (!pose.reported_pose) continue;
    RobotState& robot = poses_.robots[pose.robot.value()];
    robot.x_m = pose.reported_pose->x;
    robot.y_m = pose.reported_pose->y;
    robot.yaw_rad = pose.reported_pose->yaw;
    const double ahead =
        pose.velocity_W.vx * std::cos(robot.yaw_rad) + pose.velocity_W.vy * std::sin(robot.yaw_rad);
    robot.speed_mps = std::copysign(std::hypot(pose.velocity_W.vx, pose.velocity_W.vy), ahead);
    robot.set(true, kKnown);
  }
  return {};
}

Status RecordingCursor::show_variances() {
  if (variances_.empty()) return {};
  RAVE_TRY_ASSIGN(const auto told, record::decode_variances(variances_));
  for (const record::PoseVariance& variance : told.items) {
    if (variance.robot.value() >= poses_.robots.size()) continue;
    RobotState& robot = poses_.robots[variance.robot.value()];
    robot.variance_xy_m2 = static_cast<float>(variance.xy_m2);
    robot.variance_yaw_rad2 = static_cast<float>(variance.yaw_rad2);
  }
  return {};
}

void RecordingCursor::set_flags() {
  for (std::size_t r = 0; r < std::min(flags_.size(), poses_.robots.size()); ++r) {
    for (const FlagChange& change : flags_[r]) {
      // The list is in order of time. Flags are set anew for each moment, because a replay also
      // goes back.
      if (change.t_s > poses_.time_s + step_s_ / 2) break;
      poses_.robots[r].set(change.on, change.flag);
    }
  }
}

std::vector<ReadingAt> RecordingCursor::readings(std::span<const LookedAt> sensors, bool parts) {
  if (!reads_percepts_) {
    // They are most of a recording, and most pages look at few.
    reads_percepts_ = true;
    if (!cursor_) return {};
    // The cursor filters by channel while it reads, so it begins again with the percepts.
    begin_at(time_s_);
    if (!find_variances(ns_of(time_s_)) || !read_until(time_s_)) return {};
  }
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t>, ReadingAt> newest;
  for (const auto& [at_s, bytes] : percepts_) {
    const auto step = record::decode_percepts(bytes);
    // `rave verify` reports a damaged piece; here its readings are missing.
    if (!step) continue;
    for (const record::Percept& percept : step->items) {
      const LookedAt key{percept.robot.value(), percept.sensor.value()};
      const auto part = static_cast<std::uint8_t>(percept.part);
      if (part != 0 && !parts) continue;
      if (std::find(sensors.begin(), sensors.end(), key) == sensors.end()) continue;
      ReadingAt& reading = newest[{key.slot, key.sensor, part}];
      reading.slot = key.slot;
      reading.sensor = key.sensor;
      reading.part = part;
      reading.stamp_s = static_cast<double>(percept.header.stamp_ns) * 1e-9;
      const auto kind = static_cast<ReadingKind>(percept.kind);
      // Percepts are in order of time: a later one of the same sensor replaces the earlier.
      reading.values.clear();
      reading.fields = onlook::field_count(kind);
      reading.rows = onlook::add_rows(kind, percept.header.count, percept.records, reading.values);
    }
  }
  std::vector<ReadingAt> readings;
  readings.reserve(newest.size());
  for (auto& [key, reading] : newest) readings.push_back(std::move(reading));
  return readings;
}

}  // namespace rave::gui_server
