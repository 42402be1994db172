// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "change_fields.hpp"
#include "companion_fields.hpp"
#include "gui_fields.hpp"
#include "people_fields.hpp"
#include "rave/config/scenario_file.hpp"
#include "robot_fields.hpp"
#include "world_fields.hpp"

// The description of scenario files.
namespace rave::config {

inline constexpr double kMaxRobots = 100000;

}  // namespace rave::config

template <>
struct rave::codec::Codec<rave::config::Pace> {
  using Pace = config::Pace;
  static void read(const ReadContext& context, const RawNode& node, Pace& value);
  static RawNode write(const Pace& value) { return RawNode::text(to_string(value)); }
  static RawNode schema(const FieldOptions& options);
  static std::string expectation(const FieldOptions& options);
};

template <>
struct rave::codec::Codec<rave::config::RunLength> {
  using RunLength = config::RunLength;
  static void read(const ReadContext& context, const RawNode& node, RunLength& value);
  static RawNode write(const RunLength& value);
  static RawNode schema(const FieldOptions& options);
  static std::string expectation(const FieldOptions& options);
};

namespace rave::config {

template <class V>
void describe(V& v, ScatterFile& c) {
  v.field("count", c.count, {.doc = "Number of robots.", .min = 1, .max = kMaxRobots});
  v.required("x_m", c.x_m, length_m("Lower and upper limit of x."));
  v.required("y_m", c.y_m, length_m("Lower and upper limit of y."));
  v.field("clearance_m", c.clearance_m, distance_m("Free space around each body."));
}

void validate(const ScatterFile& c, CheckContext& check);

constexpr auto enum_names(EnumTag<RingFacing> /*tag*/) {
  return std::array{EnumName{RingFacing::kOut, "out"}, EnumName{RingFacing::kIn, "in"},
                    EnumName{RingFacing::kAlong, "along"}};
}

template <class V>
void describe(V& v, GridFile& c) {
  v.required("count", c.count, {.doc = "Number of robots.", .min = 1, .max = kMaxRobots});
  v.field("columns", c.columns,
          {.doc = "Robots of a row; null: about as many as there are rows.",
           .min = 1,
           .max = kMaxRobots});
  v.field("x_m", c.x_m,
          length_m("Place of the first robot; the others of its row follow along x."));
  v.field("y_m", c.y_m, length_m("Place of the first robot; further rows follow along y."));
  v.required("step_m", c.step_m, distance_m("Distance of neighbours, from centre to centre."));
  v.field("yaw_deg", c.yaw_deg, angle_deg("Direction of all robots."));
}

template <class V>
void describe(V& v, RingFile& c) {
  v.required("count", c.count, {.doc = "Number of robots.", .min = 1, .max = kMaxRobots});
  v.field("x_m", c.x_m, length_m("Centre."));
  v.field("y_m", c.y_m, length_m("Centre."));
  v.required("radius_m", c.radius_m, distance_m("Distance of the robots from the centre."));
  v.field("facing", c.facing,
          {.doc = "Direction of each robot: away from the centre, towards it, or along the ring "
                  "(counter-clockwise)."});
}

template <class V>
void describe(V& v, HandOverFile& c) {
  v.field("within_m", c.within_m, distance_m("Largest jump of the pose."));
  v.field("within_deg", c.within_deg, between(0, 180, "deg", "Largest jump of the heading."));
}

template <class V>
void describe(V& v, RobotEntry& c) {
  v.required(
      "name", c.name,
      {.doc = "Name of the robot; -1, -2, ... is added where several start places are given."});
  v.field(
      "file", c.file,
      {.doc =
           "Robot file, relative to this file; together with `robot`, the file it was read from.",
       .min_items = 1});
  v.field("robot", c.robot, {.doc = "Content of a robot file, in place of `file`."});
  v.field(
      "part_of", c.part_of,
      {.doc = "A name for several entries: checks, changes and hosts that name it mean the robots "
              "of all of them."});
  v.field("team", c.team, {.doc = "Team of the robot; messages can be addressed to a team."});
  v.field("variables", c.variables, {.doc = "Values for the variables of the robot file."});
  v.field("pose", c.pose, {.doc = "Start pose."});
  v.field("poses", c.poses,
          {.doc = "Start poses of several robots, each [x in m, y in m, yaw in deg].",
           .min = -kFarthest_m,
           .max = kFarthest_m,
           .min_items = 1,
           .max_items = static_cast<std::size_t>(kMaxRobots)});
  v.field("grid", c.grid, {.doc = "Start poses of several robots in rows."});
  v.field(
      "ring", c.ring,
      {.doc = "Start poses of several robots on a circle, the first where it meets the direction "
              "of x, the others counter-clockwise."});
  v.field("scatter", c.scatter, {.doc = "Random start poses, determined by the seed."});
  v.field("kind", c.kind,
          {.doc = "Kind of robot as shown in pictures; null: according to its drivers."});
  v.field("twin", c.twin,
          {.doc = "Robot file with the other drivers of the same robot, for `rave hand-over` and "
                  "`hand_over` in `changes`; relative to this file.",
           .min_items = 1});
  v.field("twin_robot", c.twin_robot,
          {.doc = "Content of a robot file, in place of the file of `twin`."});
  v.field(
      "real", c.real,
      {.doc = "Number of robots, the first ones, that use the drivers of `twin`; the others are "
              "only simulated; null: each has both sets of drivers.",
       .min = 0,
       .max = kMaxRobots});
  v.field("hand_over", c.hand_over,
          {.doc = "Limits of a hand-over; a hand-over beyond them is refused."});
  v.field("shadow", c.shadow,
          {.doc = "Whether the simulated twin runs beside the real robot, invisible to others, and "
                  "the difference is reported."});
}

void validate(const RobotEntry& c, CheckContext& check);

template <class V>
void describe(V& v, SightingsCheckFile& c) {
  v.required("real", c.real, {.doc = "Sensor with the recorded sightings."});
  v.required("twin", c.twin, {.doc = "Virtual camera on the same robot."});
  v.field("range_m", c.range_m, distance_m("Largest difference in range."));
  v.field("bearing_deg", c.bearing_deg, between(0, 180, "deg", "Largest difference in bearing."));
  v.field("min_within_pct", c.min_within_pct,
          between(0, 100, "%", "Share of the sightings that must lie within both."));
  v.field("min_compared", c.min_compared,
          {.doc = "Least number of sightings; the check fails with fewer.", .min = 1});
  v.field("max_unknown", c.max_unknown,
          {.doc = "Number of sightings of unknown barcodes that are ignored as misread; each "
                  "further one counts as a mismatch.",
           .min = 0});
}

template <class V>
void describe(V& v, TouchesCheckFile& c) {
  v.required("robots", c.robots,
             {.doc = "Robots, or entries of several robots, whose contacts are counted together; a "
                     "contact with a real robot counts for each of the two robots.",
              .min_items = 1});
  v.field("sensor", c.sensor,
          {.doc = "Contact sensor to count; null: contacts in the world of the run."});
  v.field("most", c.most, {.doc = "Largest number of contacts that passes.", .min = 0});
  v.field("least", c.least, {.doc = "Least number of contacts that passes.", .min = 0});
}

void validate(const TouchesCheckFile& c, CheckContext& check);

template <class V>
void describe(V& v, ArrivalCheckFile& c) {
  v.required("robot", c.robot, {.doc = "Robot, or entry of several robots that must all arrive."});
  v.required("x_m", c.x_m, length_m("Target in the world."));
  v.required("y_m", c.y_m, length_m("Target in the world."));
  v.field("within_m", c.within_m,
          {.doc = "Largest distance of the reported pose to the target.",
           .min = 0,
           .exclusive_min = true,
           .max = kFarthest_m,
           .unit = "m"});
  v.field("before_s", c.before_s, time_s("Time limit; null: the end of the run."));
}

template <class V>
void describe(V& v, CaptureCheckFile& c) {
  v.required("predator", c.predator, {.doc = "Robot, or entry of robots, that hunts."});
  v.required("prey", c.prey, {.doc = "Robot, or entry of robots, that is hunted."});
  v.field("within_m", c.within_m, distance_m("Gap between the outlines that counts as a capture."));
  v.field("before_s", c.before_s,
          instant_s("Time limit of the capture, after which the check fails; null: no limit."));
  v.field("end_run", c.end_run, {.doc = "Whether the run ends with the first capture."});
}

template <class V>
void describe(V& v, ChecksFile& c) {
  v.field("sightings", c.sightings, {.doc = "Compares real sightings with a virtual camera's."});
  v.field("touches", c.touches, {.doc = "Limits of the number of contacts.", .max_items = 1000});
  v.field("arrivals", c.arrivals, {.doc = "Places that robots must reach.", .max_items = 1000});
  v.field("capture", c.capture, {.doc = "Capture of one robot by another."});
}

template <class V>
void describe(V& v, PictureFile& c) {
  v.field("instant_s", c.instant_s,
          instant_s("Time of the drawn instant; null: the middle of the run."));
  v.field("title", c.title, {.doc = "Title; empty: the name of the scenario."});
  v.field("odometry_sensor", c.odometry_sensor,
          {.doc = "Sensor whose track is drawn dashed; null: none."});
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
  v.required("name", c.name, {.doc = "Name for `rave robot --host`: letters, digits, - and _."});
  v.field("robots", c.robots,
          {.doc = "Robots, or entries of robots; empty: all that no other host has.",
           .max_items = static_cast<std::size_t>(kMaxRobots)});
  v.field("elsewhere", c.elsewhere,
          {.doc = "Whether you start the host yourself with `rave robot`; otherwise `rave run` "
                  "starts it."});
}

void validate(const HostFile& c, CheckContext& check);

template <class V>
void describe_hosts(V& v, ScenarioFile& c) {
  v.field("processes", c.processes,
          {.doc = "Number of processes among which the robots are divided evenly; null: one.",
           .min = 1,
           .max = 100});
  v.field("hosts", c.hosts,
          {.doc = "Processes of the run, on this or other machines, with their robots.",
           .max_items = 100});
  v.field("on_lost_host", c.on_lost_host,
          {.doc = "Reaction to a host that is late or gone: wait for it, drop its robots, or drop "
                  "them and let the host come back."});
  v.field(
      "host_timeout_s", c.host_timeout_s,
      between(0.1, 3600, "s", "Wall time after which a host that does not answer counts as late."));
  v.field("clock", c.clock,
          {.doc = "Whether hosts wait for each other in each step or follow the wall clock; with a "
                  "live driver, a run is always in real time."});
  v.field("world_period_s", c.world_period_s,
          between(1e-3, 10, "s", "Time between updates of the world to hosts, in real time."));
  v.field("max_missed_pct", c.max_missed_pct,
          between(0, 100, "%", "Share of late steps above which a live run counts as incomplete."));
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
             between(-90, 90, "deg", "Latitude, positive in the north (WGS 84)."));
  v.required("longitude_deg", c.longitude_deg,
             between(-180, 180, "deg", "Longitude, positive in the east."));
  v.field("altitude_m", c.altitude_m,
          between(-10'000, 100'000, "m", "Height above the ellipsoid (not above sea level)."));
  v.field(
      "yaw_deg", c.yaw_deg,
      {.doc =
           "Direction of the world's x axis, counted from east towards north; 0: y points north.",
       .min = -360,
       .max = 360,
       .unit = "deg"});
}

template <class V>
void describe(V& v, Ros2File& c) {
  v.field("domain", c.domain, {.doc = "DDS domain, as in ROS_DOMAIN_ID.", .min = 0, .max = 230});
  v.field("interface", c.interface,
          {.doc = "Network interface, by address or name; the default is this machine.",
           .min_items = 1});
  v.field("peers", c.peers, {.doc = "Addresses of other machines.", .max_items = 100});
  v.field("multicast", c.multicast,
          {.doc = "Use of multicast: off, for discovery only, or also for data."});
  v.field("nodes", c.nodes,
          {.doc = "Format in which `ros2 node list` sees the run: Iron (2023) and later, Humble "
                  "and earlier, or none. All participants of a domain must use the same."});
  v.field("period_s", c.period_s, between(0.001, 60, "s", "Time between two transforms."));
}

template <class V>
void describe_run(V& v, ScenarioFile& c) {
  v.field("seed", c.seed, {.doc = "Random seed of the run."});
  v.field("duration_s", c.duration_s,
          {.doc = "Simulated time; `none`: until the run is ended by hand.",
           .min = 0,
           .exclusive_min = true,
           .max = kOpenEnd_s,
           .unit = "s"});
  v.field("step_s", c.step_s, between(1e-4, 10, "s", "Length of a step."));
  v.field("threads", c.threads,
          {.doc = "Number of threads; the result does not depend on it.", .min = 1, .max = 1024});
  v.field("pace", c.pace, {.doc = "Largest speed: max, realtime, or a factor such as 10x."});
  v.field("history_s", c.history_s,
          between(0, 3600, "s", "Length of the history for hybrid sensors and checks."));
}

template <class V>
void describe(V& v, ScenarioFile& c) {
  v.required("name", c.name,
             {.doc = "Name of the scenario and of folders of runs: letters, digits, - and _."});
  v.field("description", c.description, {.doc = "Free text."});
  v.field("world", c.world, {.doc = "World file, relative to this file; null: an empty world."});
  v.field("obstacles", c.obstacles, obstacle_list());
  v.field("maps", c.maps, map_list());
  describe_run(v, c);
  describe_hosts(v, c);
  v.required("robots", c.robots,
             {.doc = "Robots, at least one entry.",
              .min_items = 1,
              .max_items = static_cast<std::size_t>(kMaxRobots)});
  v.field(
      "changes", c.changes,
      {.doc = "What happens during the run, at a time or on a condition.", .max_items = 100'000});
  v.field("script", c.script,
          {.doc = "Lua 5.4 file with on_start() and on_step(), which conducts the run."});
  v.field("script_source", c.script_source, {.doc = "Text of the script, instead of its file."});
  v.field("checks", c.checks, {.doc = "Conditions that must hold at the end of the run."});
  v.field(
      "picture", c.picture,
      {.doc = "Settings of the picture of the run; null: only the tracks, without an instant."});
  v.field("geo_origin", c.geo_origin,
          {.doc = "Position of the origin of the world on the earth, for satellite navigation; "
                  "null: unknown."});
  v.field("ros2", c.ros2, {.doc = "Network on which robots with `ros2: true` are published."});
  v.field("gui", c.gui, {.doc = "Rights of users on the page."});
  v.field("companions", c.companions,
          {.doc = "Other programs that `rave run` starts before the hosts and ends with the run.",
           .max_items = 100});
  v.field(
      "users", c.users,
      {.doc = "People of the run, whom `rave run --gui` gives a link each.", .max_items = 1000});
  v.field("teams", c.teams,
          {.doc = "Teams of robots, with who commands them; empty: those that robots name.",
           .max_items = 1000});
}

void validate(const ScenarioFile& c, CheckContext& check);

/// Makes of an entry whose variables are lists one entry per robot, each with its own values.
void split_entries(RawNode& scenario, Diagnostics& diagnostics);
/// What comes before a scenario is read: split_entries(), and the variables of robots that are
/// defined inline.
void prepare_robots(RawNode& scenario, Diagnostics& diagnostics);

}  // namespace rave::config
