// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/config/robot_file.hpp"
#include "shape_fields.hpp"

// How robot files are read, written and described.
namespace rave::config {

inline constexpr double kLongest_s = 1.0e6;

constexpr FieldOptions period_s() {
  return {.doc = "Time between two samples, a multiple of the step; null: the step.",
          .min = 0,
          .exclusive_min = true,
          .max = kLongest_s,
          .unit = "s"};
}
constexpr FieldOptions phase_s() {
  return {.doc = "Time of the first sample, a multiple of the step, less than the period.",
          .min = 0,
          .max = kLongest_s,
          .unit = "s"};
}
constexpr FieldOptions error_size(std::string_view doc, std::string_view unit) {
  return {.doc = doc, .min = 0, .unit = unit};
}
constexpr FieldOptions driver_name() {
  return {.doc = "The driver that serves it; `rave drivers` lists them.", .min_items = 1};
}
constexpr FieldOptions driver_params() {
  return {.doc = "What the driver takes; `rave describe DRIVER` lists it."};
}

template <class V>
void describe(V& v, MountFile& c) {
  v.field("x_m", c.x_m, length_m("Forward of the body's origin."));
  v.field("y_m", c.y_m, length_m("To the left of the body's origin."));
  v.field("z_m", c.z_m, length_m("Height above the floor."));
  v.field("yaw_deg", c.yaw_deg, angle_deg("Counter-clockwise from ahead."));
  v.field("roll_deg", c.roll_deg, angle_deg("0; anything else needs the 3-D world."));
  v.field("pitch_deg", c.pitch_deg, angle_deg("0; anything else needs the 3-D world."));
}

void validate(const MountFile& c, CheckContext& check);

template <class V>
void describe(V& v, NoiseFile& c) {
  v.field("length_sigma_m", c.length_sigma_m,
          error_size("Standard deviation of lengths and coordinates.", "m"));
  v.field("angle_sigma_deg", c.angle_sigma_deg, error_size("Standard deviation of angles.", "deg"));
  v.field("velocity_sigma_mps", c.velocity_sigma_mps,
          error_size("Standard deviation of velocities.", "m/s"));
  v.field("length_quantum_m", c.length_quantum_m,
          error_size("Step that lengths are rounded to; 0: not rounded.", "m"));
  v.field("angle_quantum_deg", c.angle_quantum_deg,
          error_size("Step that angles are rounded to; 0: not rounded.", "deg"));
  v.field("velocity_quantum_mps", c.velocity_quantum_mps,
          error_size("Step that velocities are rounded to; 0: not rounded.", "m/s"));
  v.field("dropout_probability", c.dropout_probability,
          {.doc = "That a reading is lost.", .min = 0, .max = 1});
}

template <class V>
void describe(V& v, MedianFilterFile& c) {
  v.field("window", c.window,
          {.doc = "Readings that it looks at, an odd number.", .min = 1, .max = 99});
}

void validate(const MedianFilterFile& c, CheckContext& check);

template <class V>
void describe(V& v, ExponentialFilterFile& c) {
  v.required("time_constant_s", c.time_constant_s,
             {.doc = "After which a step has been followed to 63 per cent.",
              .min = 0,
              .exclusive_min = true,
              .unit = "s"});
}

template <class V>
void describe(V& v, FilterFile& c) {
  v.field("median", c.median, {.doc = "The median of the last readings."});
  v.field("exponential", c.exponential, {.doc = "First-order low pass."});
}

void validate(const FilterFile& c, CheckContext& check);

constexpr FieldOptions device_name() {
  return {.doc = "The entry of `devices` that it is a part of; null: none."};
}

template <class V>
void describe(V& v, DeviceFile& c) {
  v.required("name", c.name, {.doc = "By which sensors and actuators refer to it."});
  v.required("driver", c.driver, driver_name());
  v.field("params", c.params, driver_params());
}

void validate(const DeviceFile& c, CheckContext& check);

template <class V>
void describe(V& v, SensorHalfFile& c) {
  v.required("driver", c.driver, driver_name());
  v.field("device", c.device, device_name());
  v.field("senses", c.senses,
          {.doc = "Layers that a virtual half senses; null: what the real half cannot see "
                  "(virtual_obstacles, simulated_robots).",
           .min_items = 1});
  v.field("params", c.params, driver_params());
  v.field("noise", c.noise, {.doc = "Errors put on the readings of this half, before fusion."});
}

void validate(const SensorHalfFile& c, CheckContext& check);

template <class V>
void describe(V& v, SensorFile& c) {
  v.required("name", c.name, {.doc = "By which the program asks for it."});
  v.required("driver", c.driver,
             {.doc = "The driver that serves it, of a hybrid sensor the one that fuses its halves; "
                     "`rave drivers` lists them.",
              .min_items = 1});
  v.field("device", c.device, device_name());
  v.field("real", c.real, {.doc = "The real half of a hybrid sensor; null: not hybrid."});
  v.field("virtual", c.imagined, {.doc = "The virtual half of a hybrid sensor; null: not hybrid."});
  v.field("mount", c.mount, {.doc = "Pose in the body frame."});
  v.field("period_s", c.period_s, period_s());
  v.field("phase_s", c.phase_s, phase_s());
  v.field("senses", c.senses,
          {.doc = "Layers of the world that a virtual sensor senses; null: all.", .min_items = 1});
  v.field("params", c.params, driver_params());
  v.field("noise", c.noise, {.doc = "Errors put on every reading."});
  v.field("latency_s", c.latency_s,
          {.doc = "By which readings arrive late.", .min = 0, .max = kLongest_s, .unit = "s"});
  v.field("max_age_s", c.max_age_s,
          {.doc = "Age of the newest sample of a real sensor after which the robot is stopped; "
                  "null: three periods of the sensor, at least 0.2 s. A range sensor whose driver "
                  "does not know the period needs it.",
           .min = 0,
           .exclusive_min = true,
           .max = kLongest_s,
           .unit = "s"});
  v.field("filters", c.filters, {.doc = "Applied in this order.", .max_items = 16});
}

void validate(const SensorFile& c, CheckContext& check);

template <class V>
void describe(V& v, ActuatorFile& c) {
  v.required("name", c.name, {.doc = "By which controllers refer to it."});
  v.required("driver", c.driver, driver_name());
  v.field("device", c.device, device_name());
  v.field("params", c.params, driver_params());
}

void validate(const ActuatorFile& c, CheckContext& check);

template <class V>
void describe(V& v, ControllerFile& c) {
  v.required("name", c.name, {.doc = "By which the program asks for it."});
  v.required("driver", c.driver, driver_name());
  v.required("actuator", c.actuator, {.doc = "The actuator that it drives."});
  v.field("params", c.params, driver_params());
}

void validate(const ControllerFile& c, CheckContext& check);

template <class V>
void describe(V& v, TransmitterFile& c) {
  v.required("name", c.name, {.doc = "By which communicators refer to it."});
  v.required("driver", c.driver, driver_name());
  v.field("device", c.device, device_name());
  v.field("params", c.params, driver_params());
}

void validate(const TransmitterFile& c, CheckContext& check);

template <class V>
void describe(V& v, CommunicatorFile& c) {
  v.required("name", c.name,
             {.doc = "By which the program asks for it; those of the same name hear each other."});
  v.required("driver", c.driver, driver_name());
  v.required("transmitter", c.transmitter, {.doc = "The transmitter that carries its messages."});
  v.field("params", c.params, driver_params());
}

void validate(const CommunicatorFile& c, CheckContext& check);

constexpr auto enum_names(EnumTag<WorldLost> /*tag*/) {
  return std::array{EnumName{WorldLost::kStop, "stop"}, EnumName{WorldLost::kSlow, "slow"},
                    EnumName{WorldLost::kIgnore, "ignore"}};
}

template <class V>
void describe(V& v, GuardFile& c) {
  v.field("arm", c.arm, {.doc = "Whether a real robot stands until somebody arms it."});
  v.field("max_speed_mps", c.max_speed_mps,
          {.doc = "Largest speed, either way; null: not limited.", .min = 0, .unit = "m/s"});
  v.field(
      "max_turn_dps", c.max_turn_dps,
      {.doc = "Largest turning rate, either way; null: not limited.", .min = 0, .unit = "deg/s"});
  v.field("fence_m", c.fence_m,
          {.doc = "Corners of the region of the world that its body may not leave; null: none.",
           .unit = "m",
           .min_items = 3,
           .max_items = 1000});
  v.field("separation_m", c.separation_m,
          {.doc = "Least distance to the bodies of other robots; null: not kept.",
           .min = 0,
           .unit = "m"});
  v.field("world_lost", c.world_lost, {.doc = "What it does when the virtual world stops coming."});
  v.field("world_timeout_s", c.world_timeout_s,
          {.doc = "Age of the virtual world after which it counts as lost.",
           .min = 0,
           .exclusive_min = true,
           .max = kLongest_s,
           .unit = "s"});
  v.field("slow_speed_mps", c.slow_speed_mps,
          {.doc = "Largest speed while the world is lost, if `world_lost` is slow.",
           .min = 0,
           .unit = "m/s"});
  v.field("deceleration_mps2", c.deceleration_mps2,
          {.doc = "What the robot surely brakes with.", .min = 0.01, .max = 100, .unit = "m/s^2"});
  v.field("reaction_s", c.reaction_s,
          {.doc = "From a command until the robot obeys.", .min = 0, .max = 10, .unit = "s"});
  v.field("watchdog_s", c.watchdog_s,
          {.doc = "Age after which a command of the program is none.",
           .min = 0,
           .exclusive_min = true,
           .max = kLongest_s,
           .unit = "s"});
}

template <class V>
void describe(V& v, ProgramFile& c) {
  v.required("driver", c.driver, driver_name());
  v.field("period_s", c.period_s, period_s());
  v.field("phase_s", c.phase_s, phase_s());
  v.field("isolate", c.isolate, {.doc = "Whether it runs in a process of its own."});
  v.field("params", c.params, driver_params());
}

void validate(const ProgramFile& c, CheckContext& check);

template <class V>
void describe(V& v, BodyFile& c) {
  v.required("shapes", c.shapes,
             {.doc = "Upright prisms that make up the body.", .min_items = 1, .max_items = 64});
  v.field("mass_kg", c.mass_kg,
          {.doc = "Mass.", .min = 0, .exclusive_min = true, .max = 1e6, .unit = "kg"});
  v.field("colour", c.colour, {.doc = "`#rrggbb`; null: pictures choose."});
  describe_barcode(v, c.barcode, c.barcode_z_m);
}

void validate(const BodyFile& c, CheckContext& check);

template <class V>
void describe(V& v, RobotFile& c) {
  v.field("description", c.description, {.doc = "For people."});
  v.field("variables", c.variables,
          {.doc = "Values that stand as $(name) in this file; a scenario may set others."});
  v.required("body", c.body, {.doc = "What others sense and touch."});
  v.field("pose_from", c.pose_from,
          {.doc = "The sensor that says where it is; null: the truth (simulated robots only)."});
  v.field("source_frame", c.source_frame,
          {.doc = "Pose in the world of the frame that pose_from reports in."});
  v.field(
      "staleness_s", c.staleness_s,
      {.doc = "Age after which a reported pose, or what another host says of it, counts as lost.",
       .min = 0,
       .max = kLongest_s,
       .unit = "s"});
  v.field("report_period_s", c.report_period_s,
          {.doc = "How often its host tells others where it is, in real time; null: every 0.1 s.",
           .min = 0,
           .exclusive_min = true,
           .max = kLongest_s,
           .unit = "s"});
  v.field("ros2", c.ros2,
          {.doc = "Whether ROS 2 sees it: its readings, transforms and description; the scenario's "
                  "`ros2` says on which network."});
  v.field("devices", c.devices,
          {.doc = "Hardware that several sensors and actuators share.", .max_items = 1000});
  v.field("sensors", c.sensors, {.doc = "Each with its processing chain.", .max_items = 1000});
  v.field("actuators", c.actuators, {.doc = "What moves it.", .max_items = 1000});
  v.field("controllers", c.controllers, {.doc = "What takes commands.", .max_items = 1000});
  v.field("transmitters", c.transmitters, {.doc = "What carries messages.", .max_items = 100});
  v.field("communicators", c.communicators,
          {.doc = "Through which the program talks.", .max_items = 100});
  v.field("guard", c.guard, {.doc = "Limits that no program can pass; null: none."});
  v.field("program", c.program, {.doc = "The decision process; null: none."});
}

void validate(const RobotFile& c, CheckContext& check);

}  // namespace rave::config
