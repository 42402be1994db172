// SPDX-License-Identifier: Apache-2.0
#include "sighting_check.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"

namespace rave::robot_host {
namespace {

constexpr std::uint32_t kNoSensor = DeviceId::kNone;

std::uint32_t sensor_named(const sim::RobotType& type, const std::string& name) {
  for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
    if (type.sensors[s].name == name && type.sensors[s].kind == ReadingKind::kSightings) return s;
  }
  return kNoSensor;
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

void SightingCheck::after_step(sim::Engine& engine) {
  const auto& added = engine.spec().world.added;
  for (; known_added_ < added.size(); ++known_added_) {
    if (added[known_added_].body.code) known_codes_.insert(*added[known_added_].body.code);
  }
  for (Pair& pair : pairs_) {
    if (!engine.is_local(pair.robot)) continue;
    const sim::SensorSample sample = engine.sensor(pair.robot, pair.real);
    if (sample.header->sequence == pair.seen_sequence) continue;
    pair.seen_sequence = sample.header->sequence;
    const auto* sightings = static_cast<const Sighting*>(sample.records);
    // Records gather until the program has taken them, so old ones may still be there.
    std::int64_t newest_ns = pair.seen_stamp_ns;
    for (std::uint32_t i = 0; i < sample.header->count; ++i) {
      if (sightings[i].stamp_ns <= pair.seen_stamp_ns) continue;
      newest_ns = std::max(newest_ns, sightings[i].stamp_ns);
      compare(engine, pair, sightings[i]);
    }
    pair.seen_stamp_ns = newest_ns;
  }
}

void SightingCheck::compare(sim::Engine& engine, const Pair& pair, const Sighting& sighting) {
  SightingTally& own = facts_.by_robot[engine.spec().robots[pair.robot.value()].name];
  if (!known_codes_.contains(sighting.code)) {
    ++own.unknown;
    ++facts_.unknown_codes[sighting.code];
    return;
  }
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

bool holds(const config::SightingsCheckFile& limits, const SightingTally& all) {
  return all.total > 0 && all.within_pct() >= limits.min_within_pct;
}

}  // namespace rave::robot_host
