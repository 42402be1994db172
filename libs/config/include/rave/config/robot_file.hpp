// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/described.hpp"
#include "rave/config/robot_devices.hpp"
#include "rave/config/shape_file.hpp"
#include "rave/config/variables.hpp"

namespace rave::config {

/// `body:` of a robot file.
struct BodyFile {
  std::vector<ShapeFile> shapes;  ///< 1 to 64.
  double mass_kg = 1;
  std::optional<std::string> colour;  ///< `#rrggbb`; unset: chosen by the renderer.
  std::optional<int> barcode;  ///< The code that landmark cameras read on the body; 0 to 65535.
  /// Heights that the barcode covers; unset: from the lowest to the highest of the shapes.
  std::optional<HeightRange> barcode_z_m;
  bool operator==(const BodyFile&) const = default;
};

/// A robot file after substitution of its variables; a scenario may also contain one inline. Names
/// are unique among devices, among sensors, and so on; every name that refers to another entry
/// exists.
struct RobotFile {
  std::string description;
  Variables variables;  ///< The values used.
  Located<BodyFile> body;
  std::optional<Located<std::string>> pose_from;  ///< Name of a sensor; unset: the true pose.
  PoseFile source_frame;  ///< X_WM: pose in the world of the frame M that pose_from reports in.
  double staleness_s = 0.5;
  std::optional<double> pose_max_speed_mps;  ///< Faster, and a pose is not believed.
  std::optional<double> pose_max_turn_dps;
  bool ros2 = false;  ///< Whether it is visible on ROS 2; ScenarioFile::ros2 gives the network.
  /// Real time only: the period at which its host publishes its state; a multiple of the step.
  /// Unset: 0.1 s, rounded up to a multiple.
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
/// rave::read_file, and kParse with file:line:column for errors in its content.
[[nodiscard]] Result<RobotFile> read_robot_file(const std::filesystem::path& path,
                                                const Variables& given = {});
/// Like read_robot_file(), for a text; `file_name` is used in messages.
[[nodiscard]] Result<RobotFile> read_robot_text(std::string_view text, std::string_view file_name,
                                                const Variables& given = {});

/// The robot as YAML with all defaults. read_robot_text gives an equal value.
[[nodiscard]] std::string write_robot(const RobotFile& robot);

/// The JSON Schema (draft 07) of robot files.
[[nodiscard]] std::string robot_schema();

}  // namespace rave::config
