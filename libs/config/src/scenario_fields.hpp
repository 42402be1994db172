// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui_fields.hpp"
#include "rave/config/scenario_file.hpp"
#include "robot_fields.hpp"
#include "world_fields.hpp"

// How scenario files are read, written and described.
namespace rave::config {

inline constexpr double kMaxRobots = 100000;

template <>
struct Codec<Pace> {
  static void read(const ReadContext& context, const RawNode& node, Pace& value);
  static RawNode write(const Pace& value) { return RawNode::text(to_string(value)); }
  static RawNode schema(const FieldOptions& options);
  static std::string expectation(const FieldOptions& options);
};

template <class V>
void describe(V& v, ScatterFile& c) {
  v.field("count", c.count, {.doc = "How many robots.", .min = 1, .max = kMaxRobots});
  v.required("x_m", c.x_m, length_m("Low and high x."));
  v.required("y_m", c.y_m, length_m("Low and high y."));
  v.field("clearance_m", c.clearance_m,
          {.doc = "Free space around each body.", .min = 0, .max = kFarthest_m, .unit = "m"});
}

void validate(const ScatterFile& c, CheckContext& check);

constexpr auto enum_names(EnumTag<HandOverTo> /*tag*/) {
  return std::array{EnumName{HandOverTo::kReal, "real"},
                    EnumName{HandOverTo::kSimulated, "simulated"},
                    EnumName{HandOverTo::kFirst, "first"}, EnumName{HandOverTo::kTwin, "twin"}};
}

template <class V>
void describe(V& v, HandOverFile& c) {
  v.field("within_m", c.within_m,
          {.doc = "How far its pose may jump.", .min = 0, .max = kFarthest_m, .unit = "m"});
  v.field("within_deg", c.within_deg,
          {.doc = "How far its heading may jump.", .min = 0, .max = 180, .unit = "deg"});
}

template <class V>
void describe(V& v, RobotEntry& c) {
  v.required("name", c.name, {.doc = "With several poses or scattered, -1, -2, ... is added."});
  v.field("file", c.file,
          {.doc = "The robot file, relative to this file; beside `robot` only its origin.",
           .min_items = 1});
  v.field("robot", c.robot, {.doc = "A robot file written out in place."});
  v.field("team", c.team, {.doc = "Robots of one team know one another."});
  v.field("variables", c.variables, {.doc = "Values for the variables of the robot file."});
  v.field("pose", c.pose, {.doc = "Where it starts."});
  v.field("poses", c.poses,
          {.doc = "Where several start, each [x in m, y in m, yaw in deg].",
           .min = -kFarthest_m,
           .max = kFarthest_m,
           .min_items = 1,
           .max_items = static_cast<std::size_t>(kMaxRobots)});
  v.field("scatter", c.scatter, {.doc = "Places at random by the seed."});
  v.field("kind", c.kind, {.doc = "A word for pictures; null: what the drivers say."});
  v.field("twin", c.twin,
          {.doc = "A robot file of the same robot with other drivers, which `rave hand-over` and "
                  "`hand_over` under `changes` give it while the run goes; relative to this file.",
           .min_items = 1});
  v.field("twin_robot", c.twin_robot, {.doc = "The file of `twin` written out in place."});
  v.field("hand_over", c.hand_over,
          {.doc = "What a change of its drivers keeps to; else it is refused."});
  v.field(
      "shadow", c.shadow,
      {.doc = "Whether the simulated twin runs beside the real robot, unseen by all others, and "
              "the difference is told."});
}

void validate(const RobotEntry& c, CheckContext& check);

template <class V>
void describe(V& v, SightingsCheckFile& c) {
  v.required("real", c.real, {.doc = "The sensor that delivers recorded sightings."});
  v.required("twin", c.twin, {.doc = "The virtual camera on the same robot."});
  v.field("range_m", c.range_m,
          {.doc = "Largest difference in range.", .min = 0, .max = kFarthest_m, .unit = "m"});
  v.field("bearing_deg", c.bearing_deg,
          {.doc = "Largest difference in bearing.", .min = 0, .max = 180, .unit = "deg"});
  v.field("min_within_pct", c.min_within_pct,
          {.doc = "Share of the sightings that must lie within both.",
           .min = 0,
           .max = 100,
           .unit = "%"});
  v.field("min_compared", c.min_compared,
          {.doc = "With fewer sightings than this the check fails.", .min = 1});
  v.field("max_unknown", c.max_unknown,
          {.doc = "Sightings of codes that no body carries, taken for misread ones; each beyond "
                  "this counts as one that does not lie within.",
           .min = 0});
}

template <class V>
void describe(V& v, TouchesCheckFile& c) {
  v.required("robots", c.robots,
             {.doc = "Robots, or entries that stand for several, whose touches are added up.",
              .min_items = 1});
  v.field("sensor", c.sensor,
          {.doc = "The contact sensor whose readings count; null: contacts in the run's world."});
  v.field("most", c.most, {.doc = "More touches than this fail.", .min = 0});
  v.field("least", c.least, {.doc = "Fewer touches than this fail.", .min = 0});
}

void validate(const TouchesCheckFile& c, CheckContext& check);

template <class V>
void describe(V& v, ArrivalCheckFile& c) {
  v.required("robot", c.robot, {.doc = "A robot, or an entry whose robots must all arrive."});
  v.required("x_m", c.x_m, length_m("Where, in the world."));
  v.required("y_m", c.y_m, length_m("Where, in the world."));
  v.field("within_m", c.within_m,
          {.doc = "How near it has to come by its reported pose.",
           .min = 0,
           .exclusive_min = true,
           .max = kFarthest_m,
           .unit = "m"});
  v.field(
      "before_s", c.before_s,
      {.doc = "Until when; null: the end of the run.", .min = 0, .max = kLongest_s, .unit = "s"});
}

template <class V>
void describe(V& v, CaptureCheckFile& c) {
  v.required("predator", c.predator, {.doc = "The robot, or the entry of robots, that hunts."});
  v.required("prey", c.prey, {.doc = "The robot, or the entry of robots, that is hunted."});
  v.field("within_m", c.within_m,
          {.doc = "Gap between the outlines that counts as a capture.",
           .min = 0,
           .max = kFarthest_m,
           .unit = "m"});
  v.field("before_s", c.before_s,
          {.doc = "Without a capture by then the check fails; null: it never does.",
           .min = 0,
           .max = 1e9,
           .unit = "s"});
  v.field("end_run", c.end_run, {.doc = "Whether the run ends with the first capture."});
}

template <class V>
void describe(V& v, ChangeFile& c) {
  v.required("at_s", c.at_s,
             {.doc = "When, a multiple of the step.", .min = 0, .max = 1e9, .unit = "s"});
  v.field("robot", c.robot, {.doc = "The robot, or the entry of robots, that changes."});
  v.field("set", c.set,
          {.doc = "New values by key: program.PARAM, controller.NAME.PARAM, "
                  "actuator.NAME.PARAM, body.scale."});
  v.field("hand_over", c.hand_over,
          {.doc = "Gives the robot its other drivers: the real or the simulated ones, or by their "
                  "place in the scenario those of `file` (first) or `twin`."});
  v.field("add_obstacle", c.add_obstacle,
          {.doc = "An obstacle that comes; its name is not that of one that stands then."});
  v.field("move_obstacle", c.move_obstacle, {.doc = "An obstacle that stands elsewhere."});
  v.field("remove_obstacle", c.remove_obstacle, {.doc = "The name of an obstacle that goes."});
}

void validate(const ChangeFile& c, CheckContext& check);

template <class V>
void describe(V& v, ChecksFile& c) {
  v.field("sightings", c.sightings, {.doc = "Compares real sightings with a virtual camera's."});
  v.field("touches", c.touches,
          {.doc = "How often robots may touch something.", .max_items = 1000});
  v.field("arrivals", c.arrivals, {.doc = "Where robots have to come to.", .max_items = 1000});
  v.field("capture", c.capture, {.doc = "Whether one robot catches another."});
}

template <class V>
void describe(V& v, PictureFile& c) {
  v.field("instant_s", c.instant_s,
          {.doc = "The frozen instant; null: the middle.", .min = 0, .max = 1e9, .unit = "s"});
  v.field("title", c.title, {.doc = "Empty: the scenario's name."});
  v.field("odometry_sensor", c.odometry_sensor,
          {.doc = "The sensor whose track is drawn dashed; null: none."});
}

constexpr auto enum_names(EnumTag<LostHost> /*tag*/) {
  return std::array{EnumName{LostHost::kWait, "wait"}, EnumName{LostHost::kDrop, "drop"},
                    EnumName{LostHost::kRestart, "restart"}};
}

constexpr auto enum_names(EnumTag<RunClockMode> /*tag*/) {
  return std::array{EnumName{RunClockMode::kLockStep, "lock_step"},
                    EnumName{RunClockMode::kRealTime, "real_time"}};
}

template <class V>
void describe(V& v, HostFile& c) {
  v.required("name", c.name, {.doc = "Letters, digits, - and _; what `rave robot` is told."});
  v.field("robots", c.robots,
          {.doc = "Robots, or entries of robots; none: all that no other host has.",
           .max_items = static_cast<std::size_t>(kMaxRobots)});
  v.field("elsewhere", c.elsewhere,
          {.doc = "Whether it is started by hand, with `rave robot`; else `rave run` starts it."});
}

void validate(const HostFile& c, CheckContext& check);

template <class V>
void describe_hosts(V& v, ScenarioFile& c) {
  v.field(
      "processes", c.processes,
      {.doc = "Share the robots evenly among so many processes; null: one.", .min = 1, .max = 100});
  v.field("hosts", c.hosts,
          {.doc = "Which robots run in which process, here or elsewhere.", .max_items = 100});
  v.field("on_lost_host", c.on_lost_host,
          {.doc = "What happens when a host is late or gone: wait for it, drop its robots, or drop "
                  "them and let it come back."});
  v.field("host_timeout_s", c.host_timeout_s,
          {.doc = "Wall time after which a host that does not answer counts as late.",
           .min = 0.1,
           .max = 3600,
           .unit = "s"});
  v.field("clock", c.clock,
          {.doc = "Whether hosts wait for one another in each step or keep to the clock on the "
                  "wall; a live driver makes any run one in real time."});
  v.field("world_period_s", c.world_period_s,
          {.doc = "How often hosts are told where all robots are, in real time.",
           .min = 1e-3,
           .max = 10,
           .unit = "s"});
  v.field("max_missed_pct", c.max_missed_pct,
          {.doc = "A live run in which a larger share of the steps is done too late is not whole.",
           .min = 0,
           .max = 100,
           .unit = "%"});
}

constexpr auto enum_names(EnumTag<Ros2Multicast> /*tag*/) {
  return std::array{EnumName{Ros2Multicast::kNone, "none"},
                    EnumName{Ros2Multicast::kDiscovery, "discovery"},
                    EnumName{Ros2Multicast::kData, "data"}};
}

constexpr auto enum_names(EnumTag<Ros2Nodes> /*tag*/) {
  return std::array{EnumName{Ros2Nodes::kNone, "none"}, EnumName{Ros2Nodes::kHumble, "humble"},
                    EnumName{Ros2Nodes::kIron, "iron"}};
}

template <class V>
void describe(V& v, GeoOriginFile& c) {
  v.required("latitude_deg", c.latitude_deg,
             {.doc = "Positive in the north (WGS 84).", .min = -90, .max = 90, .unit = "deg"});
  v.required("longitude_deg", c.longitude_deg,
             {.doc = "Positive in the east.", .min = -180, .max = 180, .unit = "deg"});
  v.field("altitude_m", c.altitude_m,
          {.doc = "Above the ellipsoid, not above the sea.",
           .min = -10'000,
           .max = 100'000,
           .unit = "m"});
  v.field("yaw_deg", c.yaw_deg,
          {.doc = "Of the world's x axis, from east towards north; 0: y is north.",
           .min = -360,
           .max = 360,
           .unit = "deg"});
}

template <class V>
void describe(V& v, Ros2File& c) {
  v.field("domain", c.domain, {.doc = "That of ROS_DOMAIN_ID.", .min = 0, .max = 230});
  v.field("interface", c.interface,
          {.doc = "Network interface, by address or name; the default is this machine.",
           .min_items = 1});
  v.field("peers", c.peers, {.doc = "Addresses to look for others at.", .max_items = 100});
  v.field("multicast", c.multicast,
          {.doc = "What is sent by multicast: nothing, what finds others, or data as well."});
  v.field(
      "nodes", c.nodes,
      {.doc = "How `ros2 node list` learns of the run: as of Iron (2023) and later, as of Humble "
              "and before, or not at all. All of a domain must be of one kind."});
  v.field("period_s", c.period_s,
          {.doc = "Time between two transforms.", .min = 0.001, .max = 60, .unit = "s"});
}

template <class V>
void describe_run(V& v, ScenarioFile& c) {
  v.field("seed", c.seed, {.doc = "Of all chance in the run."});
  v.field("duration_s", c.duration_s,
          {.doc = "Simulated time.", .min = 0, .exclusive_min = true, .max = 1e9, .unit = "s"});
  v.field("step_s", c.step_s, {.doc = "Base period.", .min = 1e-4, .max = 10, .unit = "s"});
  v.field("threads", c.threads, {.doc = "They do not change the result.", .min = 1, .max = 1024});
  v.field("pace", c.pace, {.doc = "max, realtime, or a factor such as 10x."});
  v.field(
      "history_s", c.history_s,
      {.doc = "How far hybrid sensors and checks look back.", .min = 0, .max = 3600, .unit = "s"});
}

template <class V>
void describe(V& v, ScenarioFile& c) {
  v.required("name", c.name, {.doc = "Letters, digits, - and _; names the run's folder."});
  v.field("description", c.description, {.doc = "For people."});
  v.field("world", c.world, {.doc = "The world file, relative to this file; null: an empty one."});
  v.field("obstacles", c.obstacles, obstacle_list());
  v.field("maps", c.maps, map_list());
  describe_run(v, c);
  describe_hosts(v, c);
  v.required(
      "robots", c.robots,
      {.doc = "At least one.", .min_items = 1, .max_items = static_cast<std::size_t>(kMaxRobots)});
  v.field(
      "changes", c.changes,
      {.doc = "Parameters and obstacles that change while the run goes.", .max_items = 100'000});
  v.field("checks", c.checks, {.doc = "What must hold for the run to count as good."});
  v.field("picture", c.picture, {.doc = "Settings of the picture of the run; null: the usual."});
  v.field(
      "geo_origin", c.geo_origin,
      {.doc = "Where the origin of the world lies on the earth, for satellite navigation; null: "
              "nobody knows."});
  v.field("ros2", c.ros2, {.doc = "Where robots with `ros2: true` show themselves."});
  v.field("gui", c.gui, {.doc = "Who may see and do what on the page."});
}

void validate(const ScenarioFile& c, CheckContext& check);

/// Puts the variables of robots that are written out in place into the tree.
void substitute_inline_robots(RawNode& scenario, Diagnostics& diagnostics);

}  // namespace rave::config
