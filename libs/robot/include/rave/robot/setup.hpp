// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/plugin/params.hpp"
#include "rave/robot/handles.hpp"
#include "rave/robot/interface.hpp"

namespace rave {

/// The data for starting a program in the plug-in interface. Programs use Setup.
struct ProgramSetup {
  RobotInfo robot;
  HostServices host;
  const SensorInfo* sensors = nullptr;
  std::uint64_t sensor_count = 0;
  const ControllerInfo* controllers = nullptr;
  std::uint64_t controller_count = 0;
  const ParamValue* params = nullptr;
  std::uint64_t param_count = 0;
  double period_s = 0;
  const CommunicatorInfo* communicators = nullptr;
  std::uint64_t communicator_count = 0;
  /// Names of all robots of the scenario, by RobotId.
  const char* const* robot_names = nullptr;
  std::uint64_t robot_count = 0;
};

/// Access to a robot's sensors, controllers and parameters for the start of its program. The
/// argument of start() is valid during that call only, so do not keep its address; a copy is valid
/// during the whole run.
class Setup {
 public:
  explicit Setup(const ProgramSetup& raw) noexcept : raw_(&raw) {}

  [[nodiscard]] std::string_view robot_name() const noexcept { return raw_->robot.name; }
  [[nodiscard]] std::string_view team() const noexcept { return raw_->robot.team; }
  [[nodiscard]] double robot_radius_m() const noexcept { return raw_->robot.radius_m; }
  /// Time between two decisions.
  [[nodiscard]] double period_s() const noexcept { return raw_->period_s; }
  [[nodiscard]] Params params() const noexcept {
    return Params(std::span(raw_->params, raw_->param_count));
  }
  [[nodiscard]] std::span<const SensorInfo> sensors() const noexcept {
    return {raw_->sensors, raw_->sensor_count};
  }

  /// The sensor `name` whose records are of type `Record` (float for ranges, Sighting, PoseReading,
  /// ...); with an empty name the first such sensor. Error kNotFound lists the existing ones.
  template <detail::ReadingRecord Record>
  [[nodiscard]] Result<SensorHandle<Record>> sensor(std::string_view name = {}) const {
    auto index = find_sensor(detail::kKindOf<Record>, name);
    if (!index) return tl::unexpected(index.error());
    return SensorHandle<Record>(*index, &raw_->sensors[*index]);
  }
  /// All sensors whose records are of type `Record`, possibly none; for programs that work with any
  /// set of sensors.
  template <detail::ReadingRecord Record>
  [[nodiscard]] std::vector<SensorHandle<Record>> all_sensors() const {
    std::vector<SensorHandle<Record>> found;
    for (std::uint32_t i = 0; i < raw_->sensor_count; ++i) {
      if (raw_->sensors[i].kind == detail::kKindOf<Record>) {
        found.emplace_back(i, &raw_->sensors[i]);
      }
    }
    return found;
  }
  /// The controller `name` that accepts `kind`; with an empty name the first one. Error kNotFound.
  [[nodiscard]] Result<ControllerHandle> controller(CommandKind kind,
                                                    std::string_view name = {}) const;

  /// The communicator `name`; with an empty name the first one. Error kNotFound.
  [[nodiscard]] Result<CommunicatorHandle> communicator(std::string_view name = {}) const;
  /// The RobotId of a robot, to address messages to it. Error: kNotFound.
  [[nodiscard]] Result<std::uint32_t> robot_id(std::string_view name) const;
  [[nodiscard]] std::uint32_t own_id() const noexcept { return raw_->robot.id; }
  /// The number of robots in the scenario.
  [[nodiscard]] std::uint64_t robot_count() const noexcept { return raw_->robot_count; }

  /// Writes a line to the log of the run, marked with the robot's name. May be called at any time.
  void log(std::string_view text) const noexcept { raw_->host.write(LogLevel::kInfo, text); }

 private:
  [[nodiscard]] Result<std::uint32_t> find_sensor(ReadingKind kind, std::string_view name) const;
  const ProgramSetup* raw_;
};

}  // namespace rave
