// SPDX-License-Identifier: Apache-2.0
#include "rave/results/observers.hpp"

#include <algorithm>

#include "rave/maps/local_map.hpp"

namespace rave::runtime {
namespace {

std::string odometry_sensor(const config::ScenarioFile& scenario) {
  if (!scenario.picture || !scenario.picture->odometry_sensor) return {};
  return scenario.picture->odometry_sensor->value;
}

RobotFacts robot_facts(const Observers& observers, const sim::Engine& engine, RobotId robot) {
  const sim::RobotType& type = engine.spec().types[engine.spec().robots[robot.value()].type];
  // In the step in progress a host may already have read its hardware, so use the poses noted
  // before.
  const sim::ReportedPose* const told = observers.tracks.reported(robot);
  const sim::ReportedPose& reported = told != nullptr ? *told : engine.reported(robot);
  RobotFacts facts;
  facts.robot = robot.value();
  if (type.program) facts.program = type.program->driver;
  facts.commands = engine.commands_given(robot);
  facts.obeys = engine.obeys(robot);
  facts.known = reported.known;
  facts.stale = reported.stale;
  facts.x_m = reported.pose.x_m;
  facts.y_m = reported.pose.y_m;
  facts.yaw_rad = reported.pose.yaw_rad;
  facts.stamp_ns = reported.stamp.ns;
  facts.way_m = observers.tracks.way_m()[robot.value()];
  return facts;
}

void add_instruments(const sim::Engine& engine, RobotId robot, RunFacts& facts) {
  const sim::RobotType& type = engine.spec().types[engine.spec().robots[robot.value()].type];
  for (std::uint32_t d = 0; d < type.devices.size(); ++d) {
    facts.devices.push_back({robot.value(), type.devices[d].name, type.devices[d].driver,
                             engine.device_report(robot, d)});
  }
  for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
    if (type.sensors[s].hardware_ops == nullptr) continue;
    facts.streams.push_back({robot.value(), type.sensors[s].name, type.sensors[s].driver,
                             engine.sensor_report(robot, s)});
  }
  for (std::uint32_t t = 0; t < type.transmitters.size(); ++t) {
    facts.transmitters.push_back({robot.value(), type.transmitters[t].name,
                                  type.transmitters[t].driver,
                                  engine.transmitter_report(robot, t)});
  }
}

/// What the program of a robot knows as a map, if it keeps one.
void add_map(const sim::Engine& engine, RobotId robot, RunFacts& facts) {
  if (engine.program_map(robot).log_odds == nullptr) return;
  maps::LocalMap map(engine, robot);
  std::vector<maps::MapTile> tiles;
  map.put_changed(engine, tiles);
  for (maps::MapTile& tile : tiles) {
    facts.maps.push_back({robot.value(), tile.frame.resolution_m, tile.frame.origin_W,
                          tile.frame.columns, tile.frame.rows, tile.column, tile.row, tile.stamp.ns,
                          std::move(tile.cells)});
  }
}

/// The duration for which tracks have their finest points; the end of an open run is not known.
double track_length_s(config::RunLength length) {
  constexpr double kHour_s = 3600;
  return length.is_open() ? kHour_s : length.seconds;
}

}  // namespace

void keep_history_for_observers(config::ScenarioFile& scenario) {
  // The check and the frozen instant look back in time; one second is enough for both, except with
  // long steps.
  if (scenario.checks.sightings || scenario.picture) {
    const double wait_s = kLongestWaitForPoses.seconds() + 2 * scenario.step_s.value;
    scenario.history_s = std::max({scenario.history_s, 1.0, wait_s});
  }
}

Observers::Observers(const config::ExpandedScenario& scenario,
                     const std::vector<std::string>& robot_kinds, const sim::EngineSpec& spec,
                     bool with_tracks)
    : kinds(spec, robot_kinds),
      tracks(kinds, spec,
             {track_length_s(scenario.scenario.duration_s), odometry_sensor(scenario.scenario),
              with_tracks}),
      encounters(kinds, spec),
      hits(kinds),
      goals(scenario, spec) {
  const config::ScenarioFile& file = scenario.scenario;
  if (file.checks.sightings) sightings.emplace(*file.checks.sightings, spec);
  // Over several hosts the manager watches captures, because it has the poses of all robots.
  if (file.checks.capture && !spec.local) capture.emplace(*file.checks.capture, scenario);
  if (file.picture && (file.picture->instant_s || !file.duration_s.is_open())) {
    instant.emplace(kinds, file.picture->instant_s.value_or(file.duration_s / 2));
  }
}

void Observers::after_step(const StepView& step) {
  // First, because all others ask for the kinds of bodies, also of those added in this step.
  kinds.learn(step.engine.spec().world);
  kinds.follow(step.engine);
  tracks.after_step(step);
  encounters.after_step(step);
  hits.after_step(step);
  goals.after_step(step);
  if (sightings) sightings->after_step(step);
  if (instant) instant->after_step(step);
  if (capture) capture->after_step(step);
}

RunFacts gather(const Observers& observers, const sim::Engine& engine) {
  RunFacts facts;
  facts.steps = engine.steps_done();
  facts.has_world = !engine.spec().local;
  for (std::uint32_t r = 0; r < engine.spec().robots.size(); ++r) {
    if (!engine.is_local(RobotId(r))) continue;
    facts.robots.push_back(robot_facts(observers, engine, RobotId(r)));
    add_instruments(engine, RobotId(r), facts);
    add_map(engine, RobotId(r), facts);
  }
  facts.radio = engine.radio_counts();
  facts.inputs_by_hand = engine.inputs_by_hand();
  facts.hits = observers.hits.counts();
  facts.closest = observers.encounters.closest();
  if (observers.sightings) facts.sightings = observers.sightings->facts();
  facts.goals = observers.goals.facts();
  if (observers.capture) facts.capture = observers.capture->facts();
  if (observers.instant) facts.instant = observers.instant->facts();
  facts.tracks = observers.tracks.facts();
  return facts;
}

}  // namespace rave::runtime
