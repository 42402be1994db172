// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/config/robot_file.hpp"
#include "shape_fields.hpp"

// The description of robot files.
namespace rave::config {

inline constexpr double kLongest_s = 1.0e6;

constexpr FieldOptions positive_s(std::string_view doc) {
  return {.doc = doc, .min = 0, .exclusive_min = true, .max = kLongest_s, .unit = "s"};
}
constexpr FieldOptions time_s(std::string_view doc) {
  return {.doc = doc, .min = 0, .max = kLongest_s, .unit = "s"};
}
constexpr FieldOptions at_least_0(std::string_view doc, std::string_view unit) {
  return {.doc = doc, .min = 0, .unit = unit};
}
constexpr FieldOptions driver_name() {
  return {.doc = "Driver; `rave drivers` lists all.", .min_items = 1};
}
constexpr FieldOptions driver_params() {
  return {.doc = "Parameters of the driver; `rave describe DRIVER` lists them."};
}

template <class V>
void describe(V& v, MountFile& c) {
  v.field("x_m", c.x_m, length_m("Forward of the body's origin."));
  v.field("y_m", c.y_m, length_m("To the left of the body's origin."));
  v.field("z_m", c.z_m, length_m("Height above the floor."));
  v.field("yaw_deg", c.yaw_deg, angle_deg("Counter-clockwise from forward."));
  v.field("roll_deg", c.roll_deg, angle_deg("Must be 0, because the world is planar."));
  v.field("pitch_deg", c.pitch_deg, angle_deg("Must be 0, because the world is planar."));
}

void validate(const MountFile& c, CheckContext& check);

template <class V>
void describe(V& v, NoiseFile& c) {
  v.field("length_sigma_m", c.length_sigma_m,
          at_least_0("Standard deviation of lengths and coordinates: of ranges, sightings, poses, "
                     "odometry and neighbours.",
                     "m"));
  v.field("angle_sigma_deg", c.angle_sigma_deg,
          at_least_0("Standard deviation of angles: of sightings, poses, odometry and neighbours.",
                     "deg"));
  v.field("velocity_sigma_mps", c.velocity_sigma_mps,
          at_least_0("Standard deviation of velocities in m/s: of odometry, neighbours and "
                     "velocities. Turning rates are not changed.",
                     "m/s"));
  v.field("length_quantum_m", c.length_quantum_m,
          at_least_0("Step that lengths are rounded to; 0: not rounded.", "m"));
  v.field("angle_quantum_deg", c.angle_quantum_deg,
          at_least_0("Step that angles are rounded to; 0: not rounded.", "deg"));
  v.field("velocity_quantum_mps", c.velocity_quantum_mps,
          at_least_0("Step that velocities are rounded to; 0: not rounded.", "m/s"));
  v.field("dropout_probability", c.dropout_probability,
          {.doc = "Probability that a ray has no return, that a sighting or neighbour is missing, "
                  "or that a sample of another kind is empty.",
           .min = 0,
           .max = 1});
}

template <class V>
void describe(V& v, MedianFilterFile& c) {
  v.field("window", c.window,
          {.doc = "Number of readings in the window, odd.", .min = 1, .max = 99});
}

void validate(const MedianFilterFile& c, CheckContext& check);

template <class V>
void describe(V& v, ExponentialFilterFile& c) {
  v.required(
      "time_constant_s", c.time_constant_s,
      {.doc = "Time to reach 63 % of a step.", .min = 0, .exclusive_min = true, .unit = "s"});
}

template <class V>
void describe(V& v, FilterFile& c) {
  v.field("median", c.median, {.doc = "Median of the last readings."});
  v.field("exponential", c.exponential, {.doc = "First-order low pass."});
}

void validate(const FilterFile& c, CheckContext& check);

inline void validate(const NamedDriverFile& c, CheckContext& check) {
  check_name("name", *c.name, check);
  check_params(c.params, check);
}

constexpr FieldOptions device_name() {
  return {.doc = "Entry of `devices` that it belongs to; null: none."};
}

template <class V>
void describe(V& v, DeviceFile& c) {
  v.required("name", c.name, {.doc = "Name that sensors and actuators use for it."});
  v.required("driver", c.driver, driver_name());
  v.field("params", c.params, driver_params());
}

template <class V>
void describe(V& v, SensorHalfFile& c) {
  v.required("driver", c.driver, driver_name());
  v.field("device", c.device, device_name());
  v.field("senses", c.senses,
          {.doc = "Layers that the virtual half senses; null: those that the real half cannot "
                  "sense (virtual_obstacles, simulated_robots).",
           .min_items = 1});
  v.field("params", c.params, driver_params());
  v.field("noise", c.noise, {.doc = "Noise added to the readings of this half, before fusion."});
}

void validate(const SensorHalfFile& c, CheckContext& check);

template <class V>
void describe(V& v, SensorFile& c) {
  v.required("name", c.name, {.doc = "Name that the program uses for it."});
  v.required("driver", c.driver,
             {.doc = "Driver; for a hybrid sensor, the driver that fuses the halves. `rave "
                     "drivers` lists all.",
              .min_items = 1});
  v.field("device", c.device, device_name());
  v.field("real", c.real, {.doc = "Real half of a hybrid sensor; null: not hybrid."});
  v.field("virtual", c.imagined, {.doc = "Virtual half of a hybrid sensor; null: not hybrid."});
  v.field("mount", c.mount, {.doc = "Pose in the body frame."});
  v.field("period_s", c.period_s,
          positive_s("Time between two samples, a multiple of the step; null: the step."));
  v.field("phase_s", c.phase_s,
          time_s("Time of the first sample, a multiple of the step, less than the period."));
  v.field("senses", c.senses,
          {.doc = "Layers of the world that a virtual sensor senses; null: all.", .min_items = 1});
  v.field("params", c.params, driver_params());
  v.field("noise", c.noise,
          {.doc = "Noise added to the readings. A key without effect on the kind of the sensor is "
                  "refused; contacts and plain values take `dropout_probability` only."});
  v.field("latency_s", c.latency_s, time_s("Delay of the readings."));
  v.field(
      "max_age_s", c.max_age_s,
      positive_s("Age of the newest sample of a real sensor after which the robot is stopped; "
                 "null: three periods of the sensor, at least 0.2 s, and `staleness_s` for the "
                 "sensor of `pose_from`. Required for a range sensor whose driver does not know "
                 "the period."));
  v.field("filters", c.filters,
          {.doc = "Filters, applied in this order; for ranges, poses, odometry, velocities and "
                  "values.",
           .max_items = 16});
}

void validate(const SensorFile& c, CheckContext& check);

template <class V>
void describe(V& v, ActuatorFile& c) {
  v.required("name", c.name, {.doc = "Name that controllers use for it."});
  v.required("driver", c.driver, driver_name());
  v.field("device", c.device, device_name());
  v.field("params", c.params, driver_params());
}

template <class V>
void describe(V& v, ControllerFile& c) {
  v.required("name", c.name, {.doc = "Name that the program uses for it."});
  v.required("driver", c.driver, driver_name());
  v.required("actuator", c.actuator, {.doc = "Actuator that it commands."});
  v.field("params", c.params, driver_params());
}

template <class V>
void describe(V& v, TransmitterFile& c) {
  v.required("name", c.name, {.doc = "Name that communicators use for it."});
  v.required("driver", c.driver, driver_name());
  v.field("device", c.device, device_name());
  v.field("params", c.params, driver_params());
}

template <class V>
void describe(V& v, CommunicatorFile& c) {
  v.required(
      "name", c.name,
      {.doc =
           "Name that the program uses for it; communicators with the same name hear each other."});
  v.required("driver", c.driver, driver_name());
  v.required("transmitter", c.transmitter, {.doc = "Transmitter that carries its messages."});
  v.field("params", c.params, driver_params());
}

constexpr auto enum_names(EnumTag<WorldLost> /*tag*/) {
  return std::array{EnumName{WorldLost::kStop, "stop"}, EnumName{WorldLost::kSlow, "slow"},
                    EnumName{WorldLost::kIgnore, "ignore"}};
}

template <class V>
void describe(V& v, GuardFile& c) {
  v.field("arm", c.arm, {.doc = "Whether a real robot stands until it is armed."});
  v.field("max_speed_mps", c.max_speed_mps,
          at_least_0("Largest speed, forward and backward; null: no limit.", "m/s"));
  v.field("max_turn_dps", c.max_turn_dps,
          at_least_0("Largest turning rate, in both directions; null: no limit.", "deg/s"));
  v.field("fence_m", c.fence_m,
          {.doc = "Corners of the region of the world that its body may not leave; null: none.",
           .unit = "m",
           .min_items = 3,
           .max_items = 1000});
  v.field("separation_m", c.separation_m,
          at_least_0("Least distance to the bodies of other robots; null: no limit.", "m"));
  v.field("world_lost", c.world_lost, {.doc = "Reaction when updates of the virtual world stop."});
  v.field("world_timeout_s", c.world_timeout_s,
          positive_s("Age of the virtual world after which it counts as lost."));
  v.field("slow_speed_mps", c.slow_speed_mps,
          at_least_0("Largest speed while the world is lost, if `world_lost` is slow.", "m/s"));
  v.field(
      "deceleration_mps2", c.deceleration_mps2,
      between(0.01, 100, "m/s^2", "Deceleration that the robot always reaches when it brakes."));
  v.field("reaction_s", c.reaction_s,
          between(0, 10, "s", "Time from a command to the reaction of the robot."));
  v.field("watchdog_s", c.watchdog_s,
          positive_s("Age after which a command of the program expires."));
  v.field(
      "frozen_s", c.frozen_s,
      between(0, 60, "s",
              "Time, beyond `reaction_s`, for which a pose or a scan of a real robot may stay the "
              "same to the bit while it is commanded to move; 0: any time, for sources without "
              "noise."));
  v.field(
      "must_see_deg", c.must_see_deg,
      between(0, 180, "deg",
              "Half of the angle that the range sensors of a real robot must see where it drives, "
              "ahead or back; 0: none."));
}

template <class V>
void describe(V& v, ProgramFile& c) {
  v.required("driver", c.driver, driver_name());
  v.field("period_s", c.period_s,
          positive_s("Time between two decisions, a multiple of the step; null: the step."));
  v.field("phase_s", c.phase_s,
          time_s("Time of the first decision, a multiple of the step, less than the period."));
  v.field("isolate", c.isolate, {.doc = "Whether the program runs in its own process."});
  v.field("params", c.params, driver_params());
}

void validate(const ProgramFile& c, CheckContext& check);

template <class V>
void describe(V& v, BodyFile& c) {
  v.required("shapes", c.shapes,
             {.doc = "Upright prisms that make up the body.", .min_items = 1, .max_items = 64});
  v.field("mass_kg", c.mass_kg,
          {.doc = "Mass.", .min = 0, .exclusive_min = true, .max = 1e6, .unit = "kg"});
  v.field("colour", c.colour,
          {.doc = "Colour in pictures, `#rrggbb`; null: chosen automatically."});
  describe_barcode(v, c.barcode, c.barcode_z_m);
}

void validate(const BodyFile& c, CheckContext& check);

template <class V>
void describe(V& v, RobotFile& c) {
  v.field("description", c.description, {.doc = "Free text."});
  v.field("variables", c.variables,
          {.doc = "Values of $(name) in this file; a scenario can override them."});
  v.required("body", c.body, {.doc = "Outline that others sense and touch."});
  v.field("pose_from", c.pose_from,
          {.doc = "Sensor that reports the pose; null: the true pose (simulated robots only)."});
  v.field("source_frame", c.source_frame,
          {.doc = "Pose in the world of the frame that `pose_from` reports in."});
  v.field(
      "staleness_s", c.staleness_s,
      time_s("Age after which a reported pose counts as lost, also one reported by another host."));
  v.field("pose_max_speed_mps", c.pose_max_speed_mps,
          at_least_0("Speed beyond which a pose of `pose_from` is not believed; null: that of the "
                     "guard, else 10 m/s, or 50 m/s for a robot without actuators.",
                     "m/s"));
  v.field("pose_max_turn_dps", c.pose_max_turn_dps,
          at_least_0("Turning rate beyond which it is not believed; null: that of the guard, else "
                     "360 degrees per second.",
                     "deg/s"));
  v.field(
      "report_period_s", c.report_period_s,
      positive_s("Time between reports of the pose to other hosts, in real time; null: 0.1 s."));
  v.field("ros2", c.ros2,
          {.doc = "Whether to publish readings, transforms and description to ROS 2, on the "
                  "network of the scenario's `ros2`."});
  v.field("devices", c.devices,
          {.doc = "Hardware that several sensors and actuators share.", .max_items = 1000});
  v.field("sensors", c.sensors,
          {.doc = "Sensors, each with its processing chain.", .max_items = 1000});
  v.field("actuators", c.actuators,
          {.doc = "Actuators, which move the robot or parts of it.", .max_items = 1000});
  v.field("controllers", c.controllers,
          {.doc = "Controllers, which turn commands of the program into commands of actuators.",
           .max_items = 1000});
  v.field("transmitters", c.transmitters,
          {.doc = "Transmitters, which carry messages.", .max_items = 100});
  v.field("communicators", c.communicators,
          {.doc = "Communicators, with which the program sends and receives messages.",
           .max_items = 100});
  v.field("guard", c.guard, {.doc = "Limits that no program can exceed; null: none."});
  v.field("program", c.program, {.doc = "The decision process; null: none."});
}

void validate(const RobotFile& c, CheckContext& check);

}  // namespace rave::config
