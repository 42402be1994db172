// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "robot_fields.hpp"

namespace rave::config {
namespace {

void check_level(std::string_view key, double angle_deg, CheckContext& check) {
  if (angle_deg == 0) return;
  check.error(key,
              "`{}`: found {}, expected 0: anything else needs the 3-D world, which does not exist "
              "yet",
              key, angle_deg);
}

/// Reports a device that does not exist.
template <class Item>
void check_device(const Item& item, const RobotFile& robot, CheckContext& check) {
  if (item.device) {
    check_reference("device", "device", *item.device, names_of(robot.devices), check);
  }
}

void check_layers(const std::optional<Located<std::vector<SensedLayer>>>& senses,
                  CheckContext& check) {
  if (!senses) return;
  std::vector<SensedLayer> layers = **senses;
  // A copy is sorted; the order in the file has no meaning.
  std::sort(layers.begin(), layers.end());
  if (std::adjacent_find(layers.begin(), layers.end()) != layers.end()) {
    check.error("senses", "`senses` names a layer twice");
  }
}

void check_phase(const std::optional<Located<double>>& period_s, const Located<double>& phase_s,
                 CheckContext& check) {
  if (!period_s || *phase_s < **period_s) return;
  check.error("phase_s", "`phase_s`: found {}, expected less than `period_s` ({})", *phase_s,
              **period_s);
}

}  // namespace

void validate(const MountFile& c, CheckContext& check) {
  check_level("roll_deg", c.roll_deg, check);
  check_level("pitch_deg", c.pitch_deg, check);
}

void validate(const MedianFilterFile& c, CheckContext& check) {
  // An even number of readings has no middle.
  if (c.window % 2 == 0) {
    check.error("window", "`window`: found {}, expected an odd number", c.window);
  }
}

void validate(const FilterFile& c, CheckContext& check) {
  const int count = int{c.median.has_value()} + int{c.exponential.has_value()};
  if (count == 1) return;
  check.error("", "expected exactly one of `median` and `exponential`, found {}",
              count == 0 ? "none" : "two");
}

void validate(const SensorFile& c, CheckContext& check) {
  check_name("name", *c.name, check);
  check_params(c.params, check);
  check_phase(c.period_s, c.phase_s, check);
  check_layers(c.senses, check);
  // Each key of a hybrid sensor belongs to one half; a key in the wrong place would be ignored
  // without a word.
  if (c.real.has_value() != c.imagined.has_value()) {
    check.error(c.real ? "real" : "virtual",
                "found `{}` without `{}`: a hybrid sensor needs both halves",
                c.real ? "real" : "virtual", c.real ? "virtual" : "real");
  }
  if (c.real && c.device) {
    check.error("device", "`device` belongs to the real half of a hybrid sensor");
  }
  if (c.real && c.senses) {
    check.error("senses", "`senses` belongs to the virtual half of a hybrid sensor");
  }
  if (c.real && c.real->senses) {
    check.error_at(c.real->senses->where,
                   "`senses` belongs to the virtual half, this is the real one");
  }
  if (c.imagined && c.imagined->device) {
    check.error_at(c.imagined->device->where,
                   "`device` belongs to the real half, this is the virtual one");
  }
}

void validate(const SensorHalfFile& c, CheckContext& check) {
  check_params(c.params, check);
  check_layers(c.senses, check);
}

void validate(const ProgramFile& c, CheckContext& check) {
  check_params(c.params, check);
  check_phase(c.period_s, c.phase_s, check);
}

void validate(const BodyFile& c, CheckContext& check) {
  check_colour(c.colour, check);
  check_barcode(c.barcode, c.barcode_z_m, check);
}

void validate(const RobotFile& c, CheckContext& check) {
  check_unique("device", c.devices, check);
  check_unique("sensor", c.sensors, check);
  check_unique("actuator", c.actuators, check);
  check_unique("controller", c.controllers, check);
  // References between parts of a file are checked here, so that an error names a line and not a
  // driver.
  if (c.pose_from) {
    check_reference("pose_from", "sensor", *c.pose_from, names_of(c.sensors), check);
  }
  check_unique("transmitter", c.transmitters, check);
  check_unique("communicator", c.communicators, check);
  for (const ControllerFile& controller : c.controllers) {
    check_reference("actuator", "actuator", controller.actuator, names_of(c.actuators), check);
  }
  for (const CommunicatorFile& communicator : c.communicators) {
    check_reference("transmitter", "transmitter", communicator.transmitter,
                    names_of(c.transmitters), check);
  }
  for (const SensorFile& sensor : c.sensors) {
    check_device(sensor, c, check);
    if (sensor.real) check_device(*sensor.real, c, check);
  }
  for (const ActuatorFile& actuator : c.actuators) check_device(actuator, c, check);
  for (const TransmitterFile& transmitter : c.transmitters) check_device(transmitter, c, check);
}

}  // namespace rave::config
