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
#include "rave/config/gui_file.hpp"
#include "rave/config/located.hpp"
#include "rave/config/pace.hpp"
#include "rave/config/robot_file.hpp"
#include "rave/config/world_file.hpp"

namespace rave::config {

/// A rectangle of the world in which robots are placed at random by the seed.
struct ScatterFile {
  int count = 1;                ///< 1 to 100000.
  std::array<double, 2> x_m{};  ///< Low, high; low <= high.
  std::array<double, 2> y_m{};
  double clearance_m = 0.1;  ///< Free space around each body, at least 0.
  bool operator==(const ScatterFile&) const = default;
};

/// How far the pose of a robot may jump when its drivers change; farther, and that is refused.
struct HandOverFile {
  double within_m = 0.25;
  double within_deg = 20;
  bool operator==(const HandOverFile&) const = default;
};

/// Which drivers a robot with a twin is given.
enum class HandOverTo : std::uint8_t {
  kReal,
  kSimulated,
  kFirst,  ///< Those of `file`.
  kTwin,
};

/// One entry of `robots:`, which stands for one robot or several equal ones.
struct RobotEntry {
  /// Of the robot, or with several of them what `-1`, `-2`, … is put behind.
  Located<std::string> name;
  /// The robot file. With `robot` given too it is not opened and only says where that came from.
  std::optional<Located<std::string>> file;
  std::optional<RobotFile> robot;  ///< Written out in place; its variables are already put in.
  std::string team;
  Variables variables;
  std::optional<PoseFile> pose;  ///< At most one of pose, poses and scatter is set.
  std::optional<std::vector<std::array<double, 3>>> poses;  ///< Each x [m], y [m], yaw [deg].
  std::optional<ScatterFile> scatter;
  std::optional<std::string> kind;  ///< A free word for pictures.
  /// Another robot file of the same robot, with drivers that may serve it instead; as `file` and
  /// `robot`. Of one robot only.
  std::optional<Located<std::string>> twin;
  std::optional<RobotFile> twin_robot;
  HandOverFile hand_over;
  bool shadow = false;  ///< While it is real, its simulated twin runs beside it.
  bool operator==(const RobotEntry&) const = default;
};

/// Compares real barcode sightings with those of a virtual camera on the same robot.
struct SightingsCheckFile {
  Located<std::string> real;  ///< Names of sensors that at least one robot has both of.
  Located<std::string> twin;
  double range_m = 0.5;
  double bearing_deg = 5;
  double min_within_pct = 99;
  int min_compared = 100;  ///< Fewer sightings than this are not enough to judge by.
  int max_unknown = 10;    ///< Codes that nobody carries: so many are taken for misread ones.
  bool operator==(const SightingsCheckFile&) const = default;
};

/// Counts how often robots begin to touch something.
struct TouchesCheckFile {
  std::vector<Located<std::string>>
      robots;  ///< Of a robot, or of an entry that stands for several.
  /// A contact sensor whose readings count; unset: contacts in the world of the run.
  std::optional<Located<std::string>> sensor;
  int most = 0;
  int least = 0;
  bool operator==(const TouchesCheckFile&) const = default;
};

/// Wants a robot to come to a place.
struct ArrivalCheckFile {
  Located<std::string> robot;  ///< Of a robot, or of an entry: each of its robots must arrive.
  double x_m = 0;
  double y_m = 0;
  double within_m = 0.25;
  std::optional<double> before_s;  ///< Unset: by the end of the run.
  bool operator==(const ArrivalCheckFile&) const = default;
};

/// One robot has to catch another: their outlines come that near.
struct CaptureCheckFile {
  Located<std::string> predator;  ///< Robots, or entries of `robots:` that stand for several.
  Located<std::string> prey;
  double within_m = 0.1;           ///< Between the outlines.
  std::optional<double> before_s;  ///< Later is a failure; unset: it need not happen at all.
  bool end_run = false;            ///< The run ends with the first capture.
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

/// What changes while the run goes; part of the run, as if the programs had known. Either `robot`
/// and `set` or `hand_over`, or one of the others is given.
struct ChangeFile {
  Located<double> at_s = 0.0;  ///< A multiple of the step.
  /// A robot, or an entry of `robots:` that stands for several.
  std::optional<Located<std::string>> robot;
  std::optional<RawNode> set;  ///< A mapping from keys such as `program.speed_mps` to values.
  std::optional<HandOverTo> hand_over;
  std::optional<ObstacleFile> add_obstacle;
  std::optional<MoveObstacleFile> move_obstacle;
  std::optional<Located<std::string>> remove_obstacle;
  bool operator==(const ChangeFile&) const = default;
};

/// `picture:` of a scenario.
struct PictureFile {
  std::optional<double> instant_s;  ///< The frozen instant; unset: the middle of the run.
  std::string title;                ///< Empty: the scenario's name.
  std::optional<Located<std::string>> odometry_sensor;  ///< Whose track is drawn dashed.
  bool operator==(const PictureFile&) const = default;
};

/// One host of robots: a process, on this machine or another.
struct HostFile {
  Located<std::string> name;
  /// Robots, or entries of `robots:` that stand for several. Empty: all that no other host has, and
  /// at most one host may be so.
  std::vector<Located<std::string>> robots;
  /// It is started by hand, with `rave robot`; otherwise `rave run` starts it.
  bool elsewhere = false;
  bool operator==(const HostFile&) const = default;
};

/// What happens to a run in lock-step when one of its hosts does not answer, or is gone.
enum class LostHost : std::uint8_t {
  kWait,     ///< All wait until it is back, and say for whom.
  kDrop,     ///< Its robots stand from then on, and the others go on.
  kRestart,  ///< The same, and it may come back: its robots go on from where they stand.
};

/// Where the origin of the world lies on the earth (WGS 84).
struct GeoOriginFile {
  double latitude_deg = 0;   ///< -90 to 90, positive in the north.
  double longitude_deg = 0;  ///< -180 to 180, positive in the east.
  double altitude_m = 0;     ///< Above the ellipsoid.
  double yaw_deg = 0;        ///< Of the world's x axis, from east towards north.
  bool operator==(const GeoOriginFile&) const = default;
};

enum class Ros2Multicast { kNone, kDiscovery, kData };
/// The form in which nodes are announced: as of Iron (2023) and later, or of Humble and before.
enum class Ros2Nodes { kNone, kHumble, kIron };

/// Where robots with `ros2: true` show themselves.
struct Ros2File {
  int domain = 0;                       ///< ROS_DOMAIN_ID, 0 to 230.
  std::string interface = "127.0.0.1";  ///< By address or name.
  std::vector<std::string> peers;       ///< Addresses to look for others at.
  Ros2Multicast multicast = Ros2Multicast::kNone;
  Ros2Nodes nodes = Ros2Nodes::kIron;
  double period_s = 0.05;  ///< Of transforms, and of poses that no odometry gives.
  bool operator==(const Ros2File&) const = default;
};

/// What a run keeps to.
enum class RunClockMode : std::uint8_t {
  kLockStep,  ///< Steps, of which each waits for all; in real time all the same if a driver is
              ///< live.
  kRealTime,  ///< The clock on the wall.
};

/// A scenario file as it was written, with its defaults.
struct ScenarioFile {
  Located<std::string> name;
  std::string description;
  std::optional<Located<std::string>> world;  ///< As written: relative to the scenario file.
  std::vector<ObstacleFile> obstacles;        ///< Added to those of the world.
  std::vector<MapFile> maps;                  ///< Added to those of the world.
  std::uint64_t seed = 1;
  double duration_s = 60;
  Located<double> step_s = 0.01;
  int threads = 1;
  Pace pace;
  double history_s = 0;
  /// The robots are shared evenly among so many processes; unset: one, unless there are hosts.
  std::optional<Located<int>> processes;
  std::vector<HostFile> hosts;
  LostHost on_lost_host = LostHost::kWait;
  double host_timeout_s = 10;  ///< A host that has not answered for so long counts as late.
  RunClockMode clock = RunClockMode::kLockStep;
  double world_period_s = 0.1;  ///< At which hosts are told where all robots are, in real time.
  double max_missed_pct = 1;    ///< A live run that misses more of its deadlines is not whole.
  std::vector<RobotEntry> robots;
  std::vector<ChangeFile> changes;
  ChecksFile checks;
  std::optional<PictureFile> picture;
  std::optional<GeoOriginFile> geo_origin;  ///< Unset: nobody knows where the world lies.
  Ros2File ros2;
  GuiFile gui;
  bool operator==(const ScenarioFile&) const = default;
};

/// Reads a scenario file without opening the files it names. Errors: those of rave::read_file, and
/// kParse with file:line:column for what is wrong in it.
[[nodiscard]] Result<ScenarioFile> read_scenario_file(const std::filesystem::path& path);
/// The same for a text; `file_name` is for messages.
[[nodiscard]] Result<ScenarioFile> read_scenario_text(std::string_view text,
                                                      std::string_view file_name);

/// The JSON Schema (draft 07) of scenario files.
[[nodiscard]] std::string scenario_schema();

}  // namespace rave::config
