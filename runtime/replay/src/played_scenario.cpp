// SPDX-License-Identifier: Apache-2.0
#include "rave/replay/played_scenario.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "played_maps.hpp"
#include "played_obstacles.hpp"
#include "rave/base/file.hpp"
#include "rave/base/names.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/config/yaml.hpp"
#include "rave/math/scalar.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/recording/recorded_scenario.hpp"
#include "rave/robot/command.hpp"
#include "rave/robot/reading.hpp"
#include "seen_obstacles.hpp"

namespace rave::replay {
namespace {

namespace fs = std::filesystem;
using codec::RawNode;

constexpr double kProgramPeriod_s = 0.1;

config::PoseFile in_degrees(const Pose2& X) { return {X.x, X.y, rad_to_deg(X.yaw)}; }

RawNode mapping_of(const config::PoseFile& pose) {
  RawNode node = RawNode::mapping();
  node.append("x_m", RawNode::number(pose.x_m));
  node.append("y_m", RawNode::number(pose.y_m));
  node.append("yaw_deg", RawNode::number(pose.yaw_deg));
  return node;
}

/// Turns the robots of one record into recorded ones.
class Playing {
 public:
  Playing(const PlayArguments& arguments, plugin::Catalogue& catalogue,
          const record::McapReader& reader, record::RunInfo run, config::ExpandedScenario original)
      : arguments_(arguments),
        catalogue_(catalogue),
        reader_(reader),
        run_(std::move(run)),
        original_(std::move(original)) {}

  Result<PlayedScenario> make() && {
    played_.name = original_.scenario.name.value + "-played";
    RawNode robots = RawNode::sequence();
    RAVE_TRY_ASSIGN(const auto chosen, chosen_robots());
    for (const record::RecordedRobot* const robot : chosen) {
      RAVE_TRY_ASSIGN(RawNode entry, robot_entry(*robot));
      robots.push_back(std::move(entry));
    }
    // After the robots: only then it is known which sensors were found in any of them.
    RAVE_TRY(check_anew());
    if (!arguments_.world) {
      std::string note = seen_.put_on_layer(original_.world);
      if (!note.empty()) played_.notes.push_back(std::move(note));
    }
    RAVE_TRY_ASSIGN(const std::string scenario, scenario_text(std::move(robots)));
    played_.files.push_back({"scenario.yaml", scenario});
    if (!arguments_.world) RAVE_TRY(write_world());
    return std::move(played_);
  }

 private:
  Result<std::vector<const record::RecordedRobot*>> chosen_robots() const {
    std::vector<const record::RecordedRobot*> chosen;
    for (const std::string& name : arguments_.robots) {
      RAVE_TRY_ASSIGN(const auto* const robot, record::find_robot(run_, name));
      if (std::find(chosen.begin(), chosen.end(), robot) == chosen.end()) chosen.push_back(robot);
    }
    if (arguments_.robots.empty()) {
      for (const record::RecordedRobot& robot : run_.robots) chosen.push_back(&robot);
    }
    for (const record::RecordedRobot* const robot : chosen) {
      if (robot->id.value() >= original_.robots.size()) {
        return fail(ErrorCode::kParse, "the scenario of the recording has no robot `{}`",
                    robot->name);
      }
    }
    return chosen;
  }

  /// The YAML of a robot's entry; its file is added to those to be written.
  Result<RawNode> robot_entry(const record::RecordedRobot& recorded) {
    const config::ExpandedRobot& expanded = original_.robots[recorded.id.value()];
    const config::RobotGroup& group = original_.group_of(expanded);
    config::RobotFile robot = group.robot;
    RAVE_TRY_ASSIGN(const auto track, record::read_poses(reader_, recorded.id));
    // Before place(), which may add a sensor of its own that no recording describes.
    RAVE_TRY(replace_sensors(recorded, robot));
    const auto pose = place(recorded, expanded, track, robot);
    replace_actuators(recorded, robot);
    leave_out_devices(recorded, robot);
    replace_program(robot);
    // Their values were put in when the scenario was expanded.
    robot.variables.clear();
    const fs::path file = fs::path("robots") / (recorded.name + ".yaml");
    played_.files.push_back({file, config::write_robot(robot)});

    RawNode entry = RawNode::mapping();
    entry.append("name", RawNode::text(recorded.name));
    entry.append("file", RawNode::text(file.generic_string()));
    if (!group.team.empty()) entry.append("team", RawNode::text(group.team));
    if (group.kind) entry.append("kind", RawNode::text(*group.kind));
    if (pose) entry.append("pose", mapping_of(*pose));
    return entry;
  }

  /// A file as those in `below` of the folder name it.
  [[nodiscard]] std::string path_from(const fs::path& below, const fs::path& file) const {
    std::error_code error;
    // Without symbolic links: `..` behind one would lead somewhere else.
    const fs::path whole = fs::weakly_canonical(file, error);
    if (error) return fs::absolute(file, error).lexically_normal();
    if (arguments_.folder.empty()) return whole;
    // Absolute first: weakly_canonical() leaves a path relative of which nothing exists yet, and
    // from a relative path to an absolute one there is no way.
    const fs::path base = fs::weakly_canonical(fs::absolute(arguments_.folder / below), error);
    return error ? whole : whole.lexically_relative(base);
  }

  [[nodiscard]] RawNode player_params(const std::string& robot, const std::string& sensor) const {
    RawNode params = RawNode::mapping();
    params.append("file", RawNode::text(path_from("robots", arguments_.record)));
    params.append("robot", RawNode::text(robot));
    if (!sensor.empty()) params.append("sensor", RawNode::text(sensor));
    if (arguments_.start_s != 0) params.append("start_s", RawNode::number(arguments_.start_s));
    return params;
  }

  [[nodiscard]] const record::RecordedSensor* recorded_sensor(RobotId robot,
                                                              const std::string& name) const {
    const auto found = std::ranges::find_if(run_.sensors, [&](const auto& sensor) {
      return sensor.robot == robot && sensor.name == name;
    });
    return found == run_.sensors.end() ? nullptr : &*found;
  }

  Status replace_sensors(const record::RecordedRobot& recorded, config::RobotFile& robot) {
    for (config::SensorFile& sensor : robot.sensors) {
      const record::RecordedSensor* const found = recorded_sensor(recorded.id, sensor.name.value);
      if (found == nullptr) {
        return fail(ErrorCode::kParse, "the recording does not describe sensor `{}` of robot `{}`",
                    sensor.name.value, recorded.name);
      }
      if (std::ranges::find(arguments_.anew, sensor.name.value) != arguments_.anew.end()) {
        RAVE_TRY(keep_virtual(sensor));
        continue;
      }
      const auto kind = static_cast<ReadingKind>(found->kind);
      const bool was_virtual = is_virtual(sensor);
      if (kind == ReadingKind::kRanges) seen_.note(recorded.name, sensor, was_virtual);
      sensor.driver = codec::Located<std::string>(fmt::format("playback_{}", to_string(kind)));
      sensor.params = player_params(recorded.name, sensor.name.value);
      // Of a virtual camera the newest picture counts; a real one hands over sighting by sighting.
      if (kind == ReadingKind::kSightings && was_virtual) {
        sensor.params.append("collect", RawNode::boolean(false));
      }
      // Both are in the readings already. What delayed them is not: it acts after the stamp.
      sensor.noise = {};
      sensor.filters.clear();
      sensor.senses.reset();
      // The result of a hybrid is played, not fused again.
      sensor.real.reset();
      sensor.imagined.reset();
      sensor.device.reset();
    }
    return {};
  }

  bool is_virtual(const config::SensorFile& sensor) {
    constexpr std::array kVirtual = {DriverKind::kVirtualSensor};
    return catalogue_.find(kVirtual, sensor.driver.value).has_value();
  }

  Status keep_virtual(const config::SensorFile& sensor) {
    if (!is_virtual(sensor)) {
      return fail(ErrorCode::kInvalidArgument, "--anew: sensor `{}` is not virtual (driver `{}`)",
                  sensor.name.value, sensor.driver.value);
    }
    used_anew_.push_back(sensor.name.value);
    return {};
  }

  /// The world and its maps, as the recorded run had them.
  Status write_world() {
    RAVE_TRY_ASSIGN(auto maps, take_maps(original_));
    std::ranges::move(maps, std::back_inserter(played_.files));
    played_.files.push_back({"world.yaml", config::write_world(original_.world)});
    return {};
  }

  Status check_anew() const {
    for (const std::string& name : arguments_.anew) {
      if (std::ranges::find(used_anew_, name) != used_anew_.end()) continue;
      std::vector<std::string_view> names;
      for (const record::RecordedSensor& sensor : run_.sensors) {
        if (std::ranges::find(names, sensor.name) == names.end()) names.push_back(sensor.name);
      }
      return fail(ErrorCode::kNotFound, "no played robot has a sensor `{}`{}", name,
                  suggestion(name, names));
    }
    return {};
  }

  /// Says where the robot's pose comes from, and where it starts.
  std::optional<config::PoseFile> place(const record::RecordedRobot& recorded,
                                        const config::ExpandedRobot& expanded,
                                        const std::vector<record::PoseTrackPoint>& track,
                                        config::RobotFile& robot) const {
    std::optional<config::PoseFile> origin = expanded.pose;
    std::optional<config::PoseFile> start;
    for (const record::PoseTrackPoint& point : track) {
      const auto& known = point.true_pose ? point.true_pose : point.reported_pose;
      if (!origin && known) origin = in_degrees(*known);
      // The newest pose up to the start, or the first one if there is none before it.
      if (point.reported_pose && (!start || point.time.seconds() <= arguments_.start_s)) {
        start = in_degrees(*point.reported_pose);
      }
      if (point.time.seconds() > arguments_.start_s && start && origin) break;
    }
    if (!robot.pose_from) {
      add_reported_pose(recorded, robot);
      return start;
    }
    const auto* const source = recorded_sensor(recorded.id, robot.pose_from->value);
    const bool odometry =
        source != nullptr && static_cast<ReadingKind>(source->kind) == ReadingKind::kOdometry;
    // Odometry counts from where the recorded run began.
    if (odometry && robot.source_frame == config::PoseFile{} && origin) {
      robot.source_frame = *origin;
      return origin;
    }
    return start ? start : origin;
  }

  void add_reported_pose(const record::RecordedRobot& recorded, config::RobotFile& robot) const {
    std::string name = "reported_pose";
    while (
        std::ranges::any_of(robot.sensors, [&](const auto& s) { return s.name.value == name; })) {
      // The recorded robot may have a sensor of that name.
      name += "_";
    }
    config::SensorFile sensor;
    sensor.name = codec::Located<std::string>(name);
    sensor.driver = codec::Located<std::string>("playback_pose");
    sensor.params = player_params(recorded.name, "");
    robot.sensors.push_back(std::move(sensor));
    robot.pose_from = codec::Located<std::string>(name);
  }

  void replace_actuators(const record::RecordedRobot& recorded, config::RobotFile& robot) {
    constexpr std::array kKinds = {DriverKind::kActuator, DriverKind::kVirtualActuator};
    std::erase_if(robot.actuators, [&](config::ActuatorFile& actuator) {
      const auto driver = catalogue_.find(kKinds, actuator.driver.value);
      const bool velocity =
          driver && static_cast<CommandKind>((*driver)->info.data_kind) == CommandKind::kVelocity;
      if (velocity) {
        actuator.driver = codec::Located<std::string>("replay_ignored");
        actuator.params = RawNode();
        actuator.device.reset();
        return false;
      }
      std::erase_if(robot.controllers,
                    [&](const auto& c) { return c.actuator.value == actuator.name.value; });
      played_.notes.push_back(fmt::format(
          "robot `{}`: actuator `{}` is left out, because no driver ignores its kind of command",
          recorded.name, actuator.name.value));
      return true;
    });
  }

  /// Hardware that was shared must not be opened, nor moved, by a run that plays its readings.
  void leave_out_devices(const record::RecordedRobot& recorded, config::RobotFile& robot) {
    robot.devices.clear();
    std::erase_if(robot.transmitters, [&](const config::TransmitterFile& transmitter) {
      if (!transmitter.device) return false;
      std::erase_if(robot.communicators,
                    [&](const auto& c) { return c.transmitter.value == transmitter.name.value; });
      played_.notes.push_back(
          fmt::format("robot `{}`: transmitter `{}` is left out, because it is a part of a device",
                      recorded.name, transmitter.name.value));
      return true;
    });
  }

  void replace_program(config::RobotFile& robot) const {
    if (!arguments_.program) {
      robot.program.reset();
      return;
    }
    config::ProgramFile program;
    program.driver = codec::Located<std::string>(*arguments_.program);
    program.period_s = codec::Located<double>(kProgramPeriod_s);
    if (robot.program && robot.program->period_s) {
      program.period_s = robot.program->period_s;
      program.phase_s = robot.program->phase_s;
    }
    // The same program keeps what it was told; another one knows other parameters.
    if (robot.program && robot.program->driver.value == *arguments_.program) {
      program.params = robot.program->params;
    }
    robot.program = std::move(program);
  }

  Result<std::string> scenario_text(RawNode robots) const {
    const double step_s = original_.scenario.step_s.value;
    const auto end = record::read_run_end(reader_);
    const auto last_s = static_cast<double>(reader_.statistics().end_ns) * 1e-9;
    // A recording that broke off has no end; its last message says how far it goes.
    const double steps = end ? static_cast<double>(end->steps) : std::floor(last_s / step_s) + 1;
    const double duration_s = steps * step_s - arguments_.start_s;
    // Written so that NaN is refused, too.
    if (!(duration_s >= step_s)) {
      return fail(ErrorCode::kInvalidArgument,
                  "the recording is {} s long; expected an earlier start than {} s", steps * step_s,
                  arguments_.start_s);
    }
    RawNode root = RawNode::mapping();
    root.append("name", RawNode::text(played_.name));
    root.append("description", RawNode::text(fmt::format("Robots of the run {} of {}, played",
                                                         run_.scenario, run_.started)));
    const std::string world =
        arguments_.world ? path_from("", *arguments_.world) : std::string("world.yaml");
    root.append("world", RawNode::text(world));
    // To nanoseconds, the resolution of times: the file shows 12.3 and not 12.299999999999999.
    root.append("duration_s", RawNode::number(std::round(duration_s * 1e9) / 1e9));
    root.append("step_s", RawNode::number(step_s));
    root.append("seed", RawNode::unsigned_integer(run_.seed));
    root.append("robots", std::move(robots));
    if (!arguments_.world) {
      RAVE_TRY_ASSIGN(RawNode changes, played_obstacles(reader_, run_, arguments_.start_s));
      seen_.put_on_layer(changes);
      if (changes.size() > 0) root.append("changes", std::move(changes));
    }
    RawNode picture = RawNode::mapping();
    picture.append("title", RawNode::text(played_.name));
    root.append("picture", std::move(picture));
    return "# Recorded robots, made by `rave play`. Simulated ones can be added to `robots`.\n" +
           codec::to_yaml(root);
  }

  const PlayArguments& arguments_;
  plugin::Catalogue& catalogue_;
  const record::McapReader& reader_;
  record::RunInfo run_;
  config::ExpandedScenario original_;
  PlayedScenario played_;
  std::vector<std::string> used_anew_;
  SeenObstacles seen_;
};

}  // namespace

Result<PlayedScenario> played_scenario(const PlayArguments& arguments,
                                       plugin::Catalogue& catalogue) {
  RAVE_TRY_ASSIGN(const auto reader, record::McapReader::open(arguments.record));
  RAVE_TRY_ASSIGN(auto run, record::read_run_info(reader));
  if (arguments.world) RAVE_TRY(config::read_world_file(*arguments.world));
  RAVE_TRY_ASSIGN(auto recorded, runtime::recorded_scenario(reader, run, arguments.record));
  // With another world the maps of the recorded one do not matter.
  if (arguments.world) recorded.notes.clear();
  RAVE_TRY_ASSIGN(
      auto played,
      Playing(arguments, catalogue, reader, std::move(run), std::move(recorded.scenario)).make());
  played.notes.insert(played.notes.begin(), recorded.notes.begin(), recorded.notes.end());
  return played;
}

Status write_played(const PlayedScenario& played, const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "scenario.yaml", error)) {
    return fail(ErrorCode::kInvalidArgument,
                "`{}` already contains a scenario; give another folder", folder.string());
  }
  for (const PlayedScenario::File& file : played.files) {
    const fs::path path = folder / file.path;
    RAVE_TRY(create_folder(path.parent_path()));
    RAVE_TRY(write_private_file_atomically(path, file.text));
  }
  return {};
}

}  // namespace rave::replay
