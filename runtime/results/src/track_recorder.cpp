// SPDX-License-Identifier: Apache-2.0
#include "rave/results/track_recorder.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/transform.hpp"

namespace rave::runtime {
namespace {

constexpr double kLeastInterval_s = 0.1;
/// While steps are late, this many times fewer points are kept.
constexpr std::uint64_t kLateFactor = 10;
/// More points than a picture can show. The tracks are the main part of the memory that grows
/// during a long run.
constexpr double kMostPoints = 2000;
/// A pose source that is silent for longer than this share of the robot's staleness limit has a gap
/// to show. The limit accounts for the different rates of sources.
constexpr double kGapShare = 0.3;

}  // namespace

TrackRecorder::TrackRecorder(const BodyKinds& kinds, const sim::EngineSpec& spec,
                             const Options& options)
    : wanted_(options.tracks) {
  const double interval_s = std::max(kLeastInterval_s, options.duration_s / kMostPoints);
  every_ = std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(std::llround(interval_s / spec.step.seconds())));
  const std::size_t count = spec.robots.size();
  poses_.resize(count);
  odometry_tracks_.resize(count);
  odometry_.resize(count);
  last_.resize(count);
  way_m_.resize(count);
  last_stamp_ns_.resize(count);
  here_.assign(count, spec.local ? 0 : 1);
  if (spec.local) {
    for (const RobotId robot : *spec.local) here_[robot.value()] = 1;
  }
  reported_.resize(count);
  for (std::uint32_t r = 0; r < count; ++r) {
    told_.push_back(here_[r] != 0 && spec.types[spec.robots[r].type].pose_from ? 1 : 0);
    const std::uint32_t body = kinds.body_of(RobotId(r));
    poses_[r].label = spec.robots[r].name;
    poses_[r].kind = kinds.kind(body);
    poses_[r].colour = kinds.colour(body);
    // Reserve all memory at once: a growing vector leaves an unused block of half its size.
    const double points = std::min(kMostPoints, options.duration_s / interval_s);
    if (wanted_ && here_[r] != 0) poses_[r].points.reserve(static_cast<std::size_t>(points) + 2);
    odometry_tracks_[r] = poses_[r];
    odometry_tracks_[r].odometry_only = true;
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
      if (wanted_ && type.sensors[s].name == options.odometry_sensor &&
          type.sensors[s].kind == ReadingKind::kVelocity) {
        odometry_[r] = Odometry{s, std::nullopt};
      }
    }
  }
}

void TrackRecorder::after_step(const StepView& step) {
  const sim::Engine& engine = step.engine;
  const std::uint64_t every = step.late ? kLateFactor * every_ : every_;
  const bool keep = wanted_ && (engine.steps_done() - 1) % every == 0;
  for (std::uint32_t r = 0; r < poses_.size(); ++r) {
    if (told_[r] != 0) reported_[r] = engine.reported(RobotId(r));
    if (here_[r] == 0 || !engine.snapshot().robot(RobotId(r)).present) continue;
    follow_pose(engine, r, keep);
    if (odometry_[r]) follow_odometry(engine, r, keep);
  }
}

void TrackRecorder::follow_pose(const sim::Engine& engine, std::uint32_t robot, bool keep) {
  const Pose2 X_WR = engine.snapshot().pose(RobotId(robot));
  const double now_s = engine.time().seconds();
  if (last_[robot]) {
    // In each step, also where no point of the track is kept, so that thinning does not shorten the
    // way.
    way_m_[robot] += std::sqrt(squared_norm(X_WR.position() - last_[robot]->position()));
  }
  last_[robot] = X_WR;
  if (!wanted_) return;
  report::PictureTrack& track = poses_[robot];
  const sim::ReportedPose& reported = engine.reported(RobotId(robot));
  const std::int64_t stamp_ns = reported.stamp.ns;
  if (stamp_ns != last_stamp_ns_[robot]) {
    const double silent_s = static_cast<double>(stamp_ns - last_stamp_ns_[robot]) * 1e-9;
    const sim::EngineSpec& spec = engine.spec();
    const double limit_s = kGapShare * spec.types[spec.robots[robot].type].staleness.seconds();
    if (silent_s > limit_s && !track.points.empty()) {
      track.gaps.push_back({now_s - silent_s, now_s});
    }
    last_stamp_ns_[robot] = stamp_ns;
    track.pose_lost_t_s.reset();
  }
  if (reported.stale && !track.pose_lost_t_s) track.pose_lost_t_s = reported.stamp.seconds();
  if (keep) track.points.push_back({now_s, X_WR});
}

void TrackRecorder::follow_odometry(const sim::Engine& engine, std::uint32_t robot, bool keep) {
  Odometry& odometry = *odometry_[robot];
  // The track of odometry begins where the robot stands and then follows the velocities alone, so
  // the picture shows how far they drift.
  if (!odometry.X_WR) {
    odometry.X_WR = engine.snapshot().pose(RobotId(robot));
  } else {
    const sim::SensorSample sample = engine.sensor(RobotId(robot), odometry.sensor);
    if (sample.header->count > 0) {
      const auto* velocity = static_cast<const VelocityReading*>(sample.records);
      odometry.X_WR = integrate(*odometry.X_WR, {velocity->v_mps, 0, velocity->w_radps},
                                engine.spec().step.seconds());
    }
  }
  if (keep) odometry_tracks_[robot].points.push_back({engine.time().seconds(), *odometry.X_WR});
}

std::vector<TrackFacts> TrackRecorder::facts() const {
  std::vector<TrackFacts> all;
  if (!wanted_) return all;
  for (std::uint32_t r = 0; r < poses_.size(); ++r) {
    if (here_[r] != 0) all.push_back({r, poses_[r]});
  }
  for (std::uint32_t r = 0; r < poses_.size(); ++r) {
    if (here_[r] != 0 && odometry_[r]) all.push_back({r, odometry_tracks_[r]});
  }
  return all;
}

}  // namespace rave::runtime
