// SPDX-License-Identifier: Apache-2.0
#include "rave/results/sighting_check.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"

namespace rave::runtime {
namespace {

constexpr std::uint32_t kNoSensor = DeviceId::kNone;

std::uint32_t sensor_named(const sim::RobotType& type, const std::string& name) {
  for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
    if (type.sensors[s].name == name && type.sensors[s].kind == ReadingKind::kSightings) return s;
  }
  return kNoSensor;
}

/// The time until which the positions of all real robots are known. A robot whose poses have
/// stopped is ignored.
SimTime poses_known_until(const sim::Engine& engine) {
  const sim::EngineSpec& spec = engine.spec();
  SimTime until = engine.snapshot().time();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    if (spec.types[spec.robots[r].type].simulated) continue;
    const sim::ReportedPose& pose = engine.reported(RobotId(r));
    if (pose.known && !pose.stale) until = std::min(until, pose.stamp);
  }
  return until;
}

}  // namespace

SightingCheck::SightingCheck(const config::SightingsCheckFile& file, const sim::EngineSpec& spec)
    : limits_(file) {
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    const std::uint32_t real = sensor_named(type, file.real.value);
    const std::uint32_t twin = sensor_named(type, file.twin.value);
    if (real != kNoSensor && twin != kNoSensor) pairs_.push_back({RobotId(r), real, twin});
  }
  for (const world::Obstacle& obstacle : spec.world.obstacles) {
    if (obstacle.body.code) known_codes_.insert(*obstacle.body.code);
  }
  for (const world::Body& body : spec.world.robots) {
    if (body.code) known_codes_.insert(*body.code);
  }
}

void SightingCheck::after_step(const StepView& step) {
  sim::Engine& engine = step.engine;
  learn(engine);
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    if (engine.is_local(pairs_[p].robot)) gather(engine, p);
  }
  if (waiting_.empty()) return;
  const SimTime known = poses_known_until(engine);
  const SimTime too_old = engine.snapshot().time() - kLongestWaitForPoses;
  std::size_t kept = 0;
  for (const Waiting& one : waiting_) {
    const SimTime stamp{one.sighting.stamp_ns};
    // A sighting waits until the poses around its stamp are known, since they arrive later than the
    // image. It does not wait forever for a robot that is lost.
    if (stamp <= known || stamp <= too_old) {
      compare(engine, pairs_[one.pair], one.sighting);
    } else {
      waiting_[kept++] = one;
    }
  }
  waiting_.resize(kept);
}

void SightingCheck::learn(const sim::Engine& engine) {
  const auto& added = engine.spec().world.added;
  for (; known_added_ < added.size(); ++known_added_) {
    if (added[known_added_].body.code) known_codes_.insert(*added[known_added_].body.code);
  }
}

void SightingCheck::gather(const sim::Engine& engine, std::size_t p) {
  Pair& pair = pairs_[p];
  // A robot that sees nothing has an entry in the result, too.
  if (pair.seen_stamp_ns < 0) facts_.by_robot[engine.spec().robots[pair.robot.value()].name];
  const sim::SensorSample sample = engine.sensor(pair.robot, pair.real);
  if (sample.header->sequence == pair.seen_sequence) return;
  pair.seen_sequence = sample.header->sequence;
  const auto* sightings = static_cast<const Sighting*>(sample.records);
  // Records accumulate until the program takes them, so old ones may still be present.
  std::int64_t newest_ns = pair.seen_stamp_ns;
  for (std::uint32_t i = 0; i < sample.header->count; ++i) {
    if (sightings[i].stamp_ns <= pair.seen_stamp_ns) continue;
    newest_ns = std::max(newest_ns, sightings[i].stamp_ns);
    waiting_.push_back({p, sightings[i]});
  }
  pair.seen_stamp_ns = newest_ns;
}

void SightingCheck::compare(sim::Engine& engine, const Pair& pair, const Sighting& sighting) {
  SightingTally& own = facts_.by_robot[engine.spec().robots[pair.robot.value()].name];
  if (!known_codes_.contains(sighting.code)) {
    ++own.unknown;
    ++facts_.unknown_codes[sighting.code];
    return;
  }
  // Counted before the comparison: a real sighting that the virtual camera does not have is a
  // disagreement.
  ++own.total;
  twin_.resize(engine.sensor(pair.robot, pair.twin).info->capacity);
  const auto header =
      engine.sample_at(pair.robot, pair.twin, SimTime{sighting.stamp_ns}, twin_.data());
  if (!header) return;
  for (std::uint32_t i = 0; i < header->count; ++i) {
    if (twin_[i].code != sighting.code) continue;
    const double range_error_m = std::abs(double{twin_[i].range_m} - double{sighting.range_m});
    const double bearing_error_rad =
        std::abs(wrap_angle(double{twin_[i].bearing_rad} - double{sighting.bearing_rad}));
    if (range_error_m > limits_.range_m || rad_to_deg(bearing_error_rad) > limits_.bearing_deg) {
      continue;
    }
    ++own.within;
    return;
  }
}

// Cameras misread a code now and then. The first `max_unknown` unknown codes are taken for
// misreadings; the others count as disagreements.
std::uint64_t counted(const config::SightingsCheckFile& limits, const SightingTally& all) {
  const auto misread = static_cast<std::uint64_t>(limits.max_unknown);
  return all.total + (all.unknown > misread ? all.unknown - misread : 0);
}

double within_pct(const config::SightingsCheckFile& limits, const SightingTally& all) {
  const std::uint64_t count = counted(limits, all);
  return count == 0 ? 0 : 100.0 * static_cast<double>(all.within) / static_cast<double>(count);
}

bool holds(const config::SightingsCheckFile& limits, const SightingTally& all) {
  return all.total >= static_cast<std::uint64_t>(limits.min_compared) &&
         within_pct(limits, all) >= limits.min_within_pct;
}

}  // namespace rave::runtime
