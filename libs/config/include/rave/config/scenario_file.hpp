// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/companion_file.hpp"
#include "rave/config/described.hpp"
#include "rave/config/gui_file.hpp"
#include "rave/config/pace.hpp"
#include "rave/config/people_file.hpp"
#include "rave/config/robot_file.hpp"
#include "rave/config/run_length.hpp"
#include "rave/config/world_file.hpp"

namespace rave::config {

/// A rectangle of the world in which robots are placed at random by the seed.
struct ScatterFile {
  int count = 1;                ///< 1 to 100000.
  std::array<double, 2> x_m{};  ///< Lowest and highest value.
  std::array<double, 2> y_m{};
  double clearance_m = 0.1;  ///< Free space around each body, at least 0.
  bool operator==(const ScatterFile&) const = default;
};

/// Robots in rows: the first at (x_m, y_m), the next ones along x, each further row along y.
struct GridFile {
  int count = 1;               ///< 1 to 100000.
  std::optional<int> columns;  ///< Robots of a row; unset: as many as there are rows.
  double x_m = 0;
  double y_m = 0;
  double step_m = 1;  ///< Between neighbours.
  double yaw_deg = 0;
  bool operator==(const GridFile&) const = default;
};

/// The direction of a robot on a ring.
enum class RingFacing : std::uint8_t { kOut, kIn, kAlong };

/// Robots on a circle, the first where it meets the direction of x, the next ones
/// counter-clockwise.
struct RingFile {
  int count = 1;  ///< 1 to 100000.
  double x_m = 0;
  double y_m = 0;
  double radius_m = 1;
  RingFacing facing = RingFacing::kOut;
  bool operator==(const RingFile&) const = default;
};

/// The largest difference between the poses of both sets of drivers at which a hand-over is
/// accepted.
struct HandOverFile {
  double within_m = 0.25;
  double within_deg = 20;
  bool operator==(const HandOverFile&) const = default;
};

/// The set of drivers that a robot with a twin uses.
enum class HandOverTo : std::uint8_t {
  kReal,
  kSimulated,
  kFirst,  ///< Those of `file`.
  kTwin,
};

/// One entry of `robots:`. It stands for one robot or for several that differ in their poses only.
struct RobotEntry {
  /// Name of the robot; if there are several, a prefix to which `-1`, `-2`, … is appended.
  Located<std::string> name;
  /// The robot file. If `robot` is also set, the file is not opened and only records its origin.
  std::optional<Located<std::string>> file;
  std::optional<RobotFile> robot;  ///< Written inline; its variables are already substituted.
  /// The name of an entry of several robots that this one belongs to; empty: none.
  std::string part_of;
  std::string team;
  Variables variables;
  std::optional<PoseFile> pose;  ///< At most one of pose, poses, grid, ring and scatter is set.
  std::optional<std::vector<std::array<double, 3>>> poses;  ///< Each x [m], y [m], yaw [deg].
  std::optional<GridFile> grid;
  std::optional<RingFile> ring;
  std::optional<ScatterFile> scatter;
  std::optional<std::string> kind;  ///< A label for pictures.
  /// Another robot file for the same robot, with the second set of drivers; like `file` and
  /// `robot`. Only if the entry is one robot.
  std::optional<Located<std::string>> twin;
  std::optional<RobotFile> twin_robot;
  /// This many robots, the first ones, use the drivers of the twin; the others have no twin. Unset
  /// after reading a scenario, which makes one entry of each robot then.
  std::optional<int> real;
  HandOverFile hand_over;
  bool shadow = false;  ///< While the robot is real, its simulated twin runs in parallel.
  bool operator==(const RobotEntry&) const = default;
};

/// Compares real barcode sightings with those of a virtual camera on the same robot.
struct SightingsCheckFile {
  Located<std::string> real;  ///< Names of two sensors; at least one robot has both.
  Located<std::string> twin;
  double range_m = 0.5;
  double bearing_deg = 5;
  double min_within_pct = 99;
  int min_compared = 100;  ///< The check fails with fewer sightings than this.
  int max_unknown = 10;    ///< Codes that no body has: up to this many count as misread ones.
  bool operator==(const SightingsCheckFile&) const = default;
};

/// Counts the contacts of robots.
struct TouchesCheckFile {
  std::vector<Located<std::string>> robots;  ///< Names of robots, or of entries with several.
  /// A contact sensor whose readings count; unset: contacts in the world of the run.
  std::optional<Located<std::string>> sensor;
  int most = 0;
  int least = 0;
  bool operator==(const TouchesCheckFile&) const = default;
};

/// Requires that a robot reaches a place.
struct ArrivalCheckFile {
  Located<std::string> robot;  ///< Name of a robot, or of an entry: each of its robots must arrive.
  double x_m = 0;
  double y_m = 0;
  double within_m = 0.25;
  std::optional<double> before_s;  ///< Unset: the end of the run.
  bool operator==(const ArrivalCheckFile&) const = default;
};

/// Requires that one robot catches another: the distance of their outlines falls below a limit.
struct CaptureCheckFile {
  Located<std::string> predator;  ///< Robots, or entries of `robots:` with several.
  Located<std::string> prey;
  double within_m = 0.1;  ///< Between the outlines.
  /// A later capture fails the check. Unset: a capture is not required.
  std::optional<double> before_s;
  bool end_run = false;  ///< The first capture ends the run.
  bool operator==(const CaptureCheckFile&) const = default;
};

/// `checks:` of a scenario: what must hold at the end of a run.
struct ChecksFile {
  std::optional<SightingsCheckFile> sightings;
  std::vector<TouchesCheckFile> touches;
  std::vector<ArrivalCheckFile> arrivals;
  std::optional<CaptureCheckFile> capture;
  bool operator==(const ChecksFile&) const = default;
};

/// How a run ends that its scenario ends.
enum class RunVerdict : std::uint8_t { kSuccess, kFailure };

/// Something that happens in a run. It is part of the run, as if the programs had known it. Exactly
/// one of `at_s`, `when`, `every_s` and `after` is set. Of what happens, either `robot` with `set`
/// or `hand_over` is set, or exactly one of the others.
struct ChangeFile {
  std::string name;                     ///< For `after` and for people; empty: none.
  std::optional<Located<double>> at_s;  ///< A multiple of the step.
  /// An expression in Lua: the entry happens when it begins to hold.
  std::optional<Located<std::string>> when;
  std::optional<Located<double>> every_s;     ///< Again and again, first after this time.
  std::optional<Located<std::string>> after;  ///< Name of another entry, after which it happens.
  Located<double> delay_s = 0.0;   ///< With `when` and `after`: so much later. Whole steps.
  bool repeat = false;             ///< With `when`: each time that it begins to hold.
  std::optional<RawNode> request;  ///< Of a person, such as `{do: goal, robot: r1, point: [1, 2]}`.
  std::optional<std::string> mark;  ///< A text in the events of the run.
  std::optional<RunVerdict> end;    ///< Ends the run.
  std::optional<TeamGift> give;     ///< Another user commands a team.
  /// A robot, or an entry of `robots:` with several.
  std::optional<Located<std::string>> robot;
  std::optional<RawNode> set;  ///< A mapping from keys such as `program.speed_mps` to values.
  std::optional<HandOverTo> hand_over;
  ObstacleEdit obstacle;  ///< Its keys are those of this entry.
  bool operator==(const ChangeFile&) const = default;

  /// Whether the entry is made at a time by who has the robot or the obstacle; conditions are asked
  /// for all others.
  [[nodiscard]] bool is_scheduled() const { return at_s && !request && !mark && !end && !give; }
  [[nodiscard]] bool changes_obstacle() const { return !obstacle.empty(); }
};

/// `picture:` of a scenario.
struct PictureFile {
  /// The time that the picture shows; unset: the middle of the run.
  std::optional<double> instant_s;
  std::string title;                                    ///< Empty: the scenario's name.
  std::optional<Located<std::string>> odometry_sensor;  ///< The sensor whose track is drawn dashed.
  bool operator==(const PictureFile&) const = default;
};

/// One host: a process that runs robots, on this machine or another.
struct HostFile {
  Located<std::string> name;
  /// Robots, or entries of `robots:` with several. Empty: all robots without another host; at most
  /// one host may be empty.
  std::vector<Located<std::string>> robots;
  /// Whether it is started by hand, with `rave robot`; otherwise `rave run` starts it.
  bool elsewhere = false;
  bool operator==(const HostFile&) const = default;
};

/// What a lock-step run does when a host does not answer or is lost.
enum class LostHost : std::uint8_t {
  kWait,     ///< All hosts wait until it is back, and report which one they wait for.
  kDrop,     ///< Its robots stand still from then on; the other hosts continue.
  kRestart,  ///< Like kDrop, but it may return; its robots continue from where they stand.
};

/// The position of the world's origin on the earth (WGS 84).
struct GeoOriginFile {
  double latitude_deg = 0;   ///< -90 to 90, positive in the north.
  double longitude_deg = 0;  ///< -180 to 180, positive in the east.
  double altitude_m = 0;     ///< Above the ellipsoid.
  double yaw_deg = 0;        ///< Direction of the world's x axis, from east towards north.
  bool operator==(const GeoOriginFile&) const = default;
};

enum class Ros2Multicast { kNone, kDiscovery, kData };
/// How ROS 2 nodes are announced: the format of Iron (2023) and later, or that of Humble and
/// before.
enum class Ros2Nodes { kNone, kHumble, kIron };

/// The ROS 2 network on which robots with `ros2: true` are visible.
struct Ros2File {
  int domain = 0;                       ///< ROS_DOMAIN_ID, 0 to 230.
  std::string interface = "127.0.0.1";  ///< Address or name.
  std::vector<std::string> peers;       ///< Addresses at which other participants are looked for.
  Ros2Multicast multicast = Ros2Multicast::kNone;
  Ros2Nodes nodes = Ros2Nodes::kIron;
  double period_s = 0.05;  ///< Period of transforms, and of poses that no odometry gives.
  bool operator==(const Ros2File&) const = default;
};

/// The clock that a run follows.
enum class RunClockMode : std::uint8_t {
  kLockStep,  ///< All hosts compute a step before any begins the next; if a driver is live, steps
              ///< also follow the wall clock.
  kRealTime,  ///< Each host follows the wall clock.
};

/// A scenario file as written, with defaults added.
struct ScenarioFile {
  Located<std::string> name;
  std::string description;
  std::optional<Located<std::string>> world;  ///< As written: relative to the scenario file.
  std::vector<ObstacleFile> obstacles;        ///< Added to those of the world.
  std::vector<MapFile> maps;                  ///< Added to those of the world.
  std::uint64_t seed = 1;
  RunLength duration_s;
  Located<double> step_s = 0.01;
  int threads = 1;
  Pace pace;
  double history_s = 0;
  /// The number of processes with equal shares of the robots; unset: one, unless `hosts` is set.
  std::optional<Located<int>> processes;
  std::vector<HostFile> hosts;
  LostHost on_lost_host = LostHost::kWait;
  double host_timeout_s = 10;  ///< A host without an answer for this long counts as late.
  RunClockMode clock = RunClockMode::kLockStep;
  /// Real time only: the period at which hosts receive the poses of all robots.
  double world_period_s = 0.1;
  /// A live run that misses more of its deadlines (percent) is not complete.
  double max_missed_pct = 1;
  std::vector<RobotEntry> robots;
  std::vector<ChangeFile> changes;
  /// A Lua file with on_start() and on_step(); in an expanded scenario its name, for messages.
  std::optional<Located<std::string>> script;
  std::optional<std::string> script_source;  ///< The text of that file, or written here.
  ChecksFile checks;
  std::optional<PictureFile> picture;
  std::optional<GeoOriginFile> geo_origin;  ///< Unset: the position on the earth is unknown.
  Ros2File ros2;
  GuiFile gui;
  std::vector<CompanionFile> companions;
  std::vector<UserFile> users;
  std::vector<TeamFile> teams;
  bool operator==(const ScenarioFile&) const = default;
};

/// Reads the text of a scenario file without opening the files it names. `file_name` is used in
/// messages. Errors: kParse with file:line:column.
[[nodiscard]] Result<ScenarioFile> read_scenario_text(std::string_view text,
                                                      std::string_view file_name);

/// The JSON Schema (draft 07) of scenario files.
[[nodiscard]] std::string scenario_schema();

}  // namespace rave::config
