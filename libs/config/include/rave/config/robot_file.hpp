// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/located.hpp"
#include "rave/config/robot_devices.hpp"
#include "rave/config/shape_file.hpp"
#include "rave/config/variables.hpp"

namespace rave::config {

/// `body:` of a robot file.
struct BodyFile {
  std::vector<ShapeFile> shapes;  ///< 1 to 64.
  double mass_kg = 1;
  std::optional<std::string> colour;  ///< `#rrggbb`; unset: pictures choose.
  std::optional<int> barcode;         ///< What landmark cameras read on it; 0 to 65535.
  /// Heights that the barcode covers; unset: the lowest to the highest of the shapes.
  std::optional<HeightRange> barcode_z_m;
  bool operator==(const BodyFile&) const = default;
};

/// A robot file after its variables were put in; also what may stand inline in a scenario.
/// Devices, sensors, actuators, controllers, transmitters and communicators have names of their own
/// kind that are unique; whatever names another of them names an existing one.
struct RobotFile {
  std::string description;
  Variables variables;  ///< The values in force.
  Located<BodyFile> body;
  std::optional<Located<std::string>> pose_from;  ///< A sensor; unset: the truth.
  PoseFile source_frame;  ///< X_WM: pose in the world of the frame that pose_from reports in.
  double staleness_s = 0.5;
  bool ros2 = false;  ///< It shows itself to ROS 2; ScenarioFile::ros2 says where.
  /// How often its host says where it is, in real time; a multiple of the step. Unset: 0.1 s, or
  /// the next multiple.
  std::optional<Located<double>> report_period_s;
  std::vector<DeviceFile> devices;
  std::vector<SensorFile> sensors;
  std::vector<ActuatorFile> actuators;
  std::vector<ControllerFile> controllers;
  std::vector<TransmitterFile> transmitters;
  std::vector<CommunicatorFile> communicators;
  std::optional<GuardFile> guard;
  std::optional<ProgramFile> program;
  bool operator==(const RobotFile&) const = default;
};

/// Reads a robot file; `given` overrides the defaults of its variables. Errors: those of
/// rave::read_file, and kParse with file:line:column for what is wrong in it.
[[nodiscard]] Result<RobotFile> read_robot_file(const std::filesystem::path& path,
                                                const Variables& given = {});
/// The same for a text; `file_name` is for messages.
[[nodiscard]] Result<RobotFile> read_robot_text(std::string_view text, std::string_view file_name,
                                                const Variables& given = {});

/// YAML with all defaults that read_robot_text reads back as an equal value.
[[nodiscard]] std::string write_robot(const RobotFile& robot);

/// The JSON Schema (draft 07) of robot files.
[[nodiscard]] std::string robot_schema();

}  // namespace rave::config
