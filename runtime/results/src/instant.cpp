// SPDX-License-Identifier: Apache-2.0
#include "rave/results/instant.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/transform.hpp"

namespace rave::runtime {
namespace {

/// Cameras deliver a few images per second: sightings within this time belong to the instant.
constexpr double kSightingWindow_s = 0.5;
constexpr int kDiscCorners = 32;

/// The pose of the landmark with this code in the world.
std::optional<Landmark> landmark_of(const world::Snapshot& world, std::int32_t code) {
  for (const Landmark& landmark : world.landmarks()) {
    if (landmark.code == code) return landmark;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Vec2> outline_of(const world::Shape& shape, const Pose2& X_WB) {
  std::vector<Vec2> outline;
  for (const Vec2 v : shape.vertices()) outline.push_back(transform(X_WB, v));
  if (!shape.polygon) {
    for (int k = 0; k < kDiscCorners; ++k) {
      const SinCos turn = sincos(2 * kPi * k / kDiscCorners);
      outline.push_back(transform(X_WB, shape.centre + shape.radius_m * Vec2{turn.cos, turn.sin}));
    }
  }
  return outline;
}

void InstantKeeper::after_step(const StepView& step) {
  sim::Engine& engine = step.engine;
  if (instant_) return;
  const double now_s = engine.time().seconds();
  if (now_s >= instant_s_ - kSightingWindow_s) remember_sightings(engine);
  // The tolerance is for rounding of the time of the scenario; it is far below a step.
  if (now_s >= instant_s_ - 1e-9) freeze(engine);
}

void InstantKeeper::remember_sightings(sim::Engine& engine) {
  const sim::EngineSpec& spec = engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    if (!engine.is_local(RobotId(r))) continue;
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
      const sim::SensorSpec& sensor = type.sensors[s];
      if (sensor.kind != ReadingKind::kSightings || sensor.hardware_ops == nullptr) continue;
      const sim::SensorSample sample = engine.sensor(RobotId(r), s);
      const auto* sightings = static_cast<const Sighting*>(sample.records);
      for (std::uint32_t i = 0; i < sample.header->count; ++i) {
        // At the stamp of the image, since the robot has moved on since then.
        const auto pose = engine.pose_at(RobotId(r), SimTime{sightings[i].stamp_ns});
        if (!pose) continue;
        const Pose2 X_WS = compose(*pose, sensor.X_RS);
        const SinCos bearing = sincos(double{sightings[i].bearing_rad});
        report::PictureSighting shown;
        shown.from_W = X_WS.position();
        shown.to_W = transform(X_WS, double{sightings[i].range_m} * Vec2{bearing.cos, bearing.sin});
        const auto landmark = landmark_of(engine.snapshot(), sightings[i].code);
        if (landmark) shown.tube_W = landmark->p_WL;
        shown.colour = kinds_->colour(kinds_->body_of(RobotId(r)));
        const std::pair<std::uint32_t, std::int32_t> key{r, sightings[i].code};
        // Of each robot and code the newest sighting before the instant is shown.
        const auto known = std::find(seen_.begin(), seen_.end(), key);
        if (known != seen_.end()) {
          sightings_[static_cast<std::size_t>(known - seen_.begin())].shown = std::move(shown);
        } else {
          seen_.push_back(key);
          sightings_.push_back({engine.steps_done() - 1, r, std::move(shown)});
        }
      }
    }
  }
}

void InstantKeeper::freeze(const sim::Engine& engine) {
  instant_.emplace();
  instant_->t_s = engine.time().seconds();
  instant_->sightings = std::move(sightings_);
  const sim::EngineSpec& spec = engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    if (!engine.is_local(RobotId(r)) || !engine.snapshot().robot(RobotId(r)).present) continue;
    InstantRobot& shown = instant_->robots.emplace_back();
    shown.robot = r;
    add_bodies(engine, RobotId(r), shown);
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    for (std::uint32_t s = 0; s < type.sensors.size(); ++s) add_hits(engine, RobotId(r), s, shown);
  }
}

void InstantKeeper::add_bodies(const sim::Engine& engine, RobotId robot, InstantRobot& into) const {
  const std::uint32_t body = kinds_->body_of(robot);
  const world::Body& description = engine.spec().world.robots[robot.value()];
  const Pose2 X_WR = engine.snapshot().pose(robot);
  for (std::size_t i = 0; i < description.shapes.size(); ++i) {
    report::PictureRobot shown;
    shown.outline_W = outline_of(description.shapes[i], X_WR);
    shown.X_WB = X_WR;
    shown.kind = kinds_->kind(body);
    if (i == 0) shown.label = engine.spec().robots[robot.value()].name;
    shown.colour = kinds_->colour(body);
    into.bodies.push_back(std::move(shown));
  }
}

void InstantKeeper::add_hits(const sim::Engine& engine, RobotId robot, std::uint32_t sensor,
                             InstantRobot& into) const {
  const sim::SensorSample sample = engine.sensor(robot, sensor);
  const sim::SensorParts parts = engine.sensor_parts(robot, sensor);
  const auto bodies = parts.real != nullptr ? parts.bodies : sample.bodies;
  if (bodies.empty() || sample.info->bearings_rad == nullptr || sample.header->sequence == 0) {
    return;
  }
  // What a real ray hit is unknown: it shapes the fan of a hybrid sensor but gets no dot.
  const auto* const virtual_m = static_cast<const float*>(parts.imagined_records);
  // The newest scan may be some steps old, so it is drawn from the pose at its stamp.
  const Pose2 X_WR = engine.pose_at(robot, SimTime{sample.header->stamp_ns})
                         .value_or(engine.snapshot().pose(robot));
  const Pose2 X_WS = compose(X_WR, sample.info->X_RS);
  const auto* ranges = static_cast<const float*>(sample.records);
  for (std::uint32_t i = 0; i < sample.header->count; ++i) {
    const bool met = std::isfinite(ranges[i]);
    const double range_m = met ? double{ranges[i]} : sample.info->range_max_m;
    const SinCos bearing = sincos(sample.info->bearings_rad[i]);
    report::PictureHit hit;
    hit.from_W = X_WS.position();
    hit.to_W = transform(X_WS, range_m * Vec2{bearing.cos, bearing.sin});
    const bool is_virtual = virtual_m == nullptr || ranges[i] == virtual_m[i];
    if (met && is_virtual && bodies[i] != BodyId::kNone) hit.kind = kinds_->kind(bodies[i]);
    into.hits.push_back(hit);
  }
}

}  // namespace rave::runtime
