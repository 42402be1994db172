// SPDX-License-Identifier: Apache-2.0
// The second report of the authority in real time: what all other hosts did, as far as this one
// has heard of it.
#include <algorithm>
#include <numeric>
#include <tuple>

#include "rave/math/transform.hpp"
#include "rave/protocol/live_world.hpp"

namespace rave::real_time {

void LiveWorld::note_delay(Other& other, Duration age) {
  if (other.last.stamp > other.shown) {
    const Duration delay{std::max<std::int64_t>(age.ns, 0)};
    ++pose_delays_.count;
    pose_delays_.slowest = std::max(pose_delays_.slowest, delay);
    pose_delays_.sum = pose_delays_.sum + delay;
  }
  other.shown = other.last.stamp;
}

void LiveWorld::report_place(Other& other, std::uint64_t step) {
  const SimTime now = time_of(step);
  const RobotSight& last = other.last;
  const Duration age = now - last.stamp;
  // A robot without any message is absent, which is not stale.
  const bool stale = other.known && age > other.staleness;
  if (stale != other.stale) {
    const std::string text =
        stale ? fmt::format("the last message of its host about it is from {:.2f} s",
                            last.stamp.seconds())
              : fmt::format("its host reports it again, from {:.2f} s", last.stamp.seconds());
    events_.push_back({step, last.robot,
                       stale ? sim::EventKind::kPoseStale : sim::EventKind::kPoseBack, BodyId(),
                       text});
    other.stale = stale;
  }
  sim::PoseReport& report = others_report_.poses.emplace_back();
  report.robot = last.robot;
  if (!other.known) return;
  note_delay(other, age);
  // Clocks agree only approximately, so a pose may have a stamp that is still in the future here.
  // The pose is extrapolated for the limit of staleness at most. After that the robot stands where
  // it would have been then.
  const std::int64_t carried_ns = std::clamp<std::int64_t>(age.ns, 0, other.staleness.ns);
  const Pose2 X_WR = integrate(last.X_WR, last.velocity, Duration{carried_ns}.seconds());
  sim::ReportedPose& reported = report.reported;
  reported.pose = {X_WR.x, X_WR.y, X_WR.yaw, 0, 0};
  if (!stale) reported.velocity = last.velocity;
  reported.stamp = std::min(last.stamp, now);
  reported.known = true;
  reported.stale = stale;
}

/// The poses that real robots reported with their times, for checks that look back.
void LiveWorld::report_samples(SimTime now) {
  const auto key = [](const sim::PoseSample& sample) {
    return std::tie(sample.robot, sample.stamp);
  };
  std::stable_sort(samples_.begin(), samples_.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  std::size_t kept = 0;
  for (const sim::PoseSample& sample : samples_) {
    Other& other = others_[other_of_[sample.robot.value()]];
    // A stamp in the future waits for its step. Of one robot only increasing stamps pass, so its
    // track is in order.
    if (sample.stamp > now) {
      samples_[kept++] = sample;
    } else if (sample.stamp.ns > other.sample_ns) {
      other.sample_ns = sample.stamp.ns;
      others_report_.samples.push_back(sample);
    }
  }
  samples_.resize(kept);
}

/// Treats all received packets as if their robots had sent them in the step that has just ended.
void LiveWorld::report_packets(std::uint64_t step) {
  const std::int64_t begin_ns = time_of(step).ns - authority_->spec().step.ns;
  order_.resize(heard_.packets.size());
  std::iota(order_.begin(), order_.end(), 0U);
  const auto key = [this](std::uint32_t i) {
    const sim::SentPacket& packet = heard_.packets[i];
    return std::tie(packet.robot, packet.communicator, packet.sequence);
  };
  // Of two packets with the same number, from two starts of a host, the later one is omitted.
  std::stable_sort(order_.begin(), order_.end(), [&](auto a, auto b) { return key(a) < key(b); });
  const auto end =
      std::unique(order_.begin(), order_.end(), [&](auto a, auto b) { return key(a) == key(b); });
  for (auto it = order_.begin(); it != end; ++it) {
    sim::SentPacket packet = heard_.packets[*it];
    const std::span<const std::byte> bytes = heard_.bytes_of(packet);
    // The authority refuses messages from the future, and clocks agree only approximately.
    packet.stamp_ns = std::min(packet.stamp_ns, begin_ns);
    packet.complete_ns = begin_ns;
    others_report_.sent.add(packet, bytes);
  }
  heard_.clear();
  for (Other& other : others_) other.talk.step();
}

void LiveWorld::report_others(std::uint64_t step) {
  others_report_.begin(step);
  for (Other& other : others_) report_place(other, step);
  report_samples(time_of(step));
  if (step > 0) report_packets(step);
}

}  // namespace rave::real_time
