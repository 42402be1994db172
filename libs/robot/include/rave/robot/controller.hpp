// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/robot/command.hpp"
#include "rave/robot/interface.hpp"
#include "rave/robot/reading.hpp"

namespace rave {

class HardwareDevice;

/// Passed to a controller or actuator when it starts.
struct DeviceSetup {
  RobotInfo robot;
  HostServices host;
  const ParamValue* params = nullptr;
  std::uint64_t param_count = 0;
  double step_s = 0;  ///< Base period: control() and propose() are called once per step.
  /// Actuators only: the device that `device:` in the robot file names, or null. Outlives the
  /// instance.
  HardwareDevice* device = nullptr;

  [[nodiscard]] Params parameters() const noexcept {
    return Params(std::span(params, param_count));
  }
};

/// The input of a controller in one step.
struct ControlInput {
  Command command;           ///< Last command of the program; kNone before the first.
  double command_age_s = 0;  ///< Age of the command in simulation time.
  PoseReading pose;          ///< Reported pose, world frame.
  Twist2 velocity;           ///< Reported velocity, body frame.
  double dt_s = 0;
};

/// Converts commands of a program to commands of an actuator, once per step. One object per robot.
/// It sees abstract interfaces only, so it is the same for real and simulated robots.
class Controller {
 public:
  virtual ~Controller() = default;
  virtual Status start(const DeviceSetup& setup) = 0;
  /// The command for the actuator. Must be a stop command once `command_age_s` exceeds the
  /// controller's watchdog.
  virtual Command control(const ControlInput& input) = 0;
  /// New parameter values while the robot runs, called between two steps with all parameters. An
  /// error refuses the change; the old values remain.
  virtual Status parameters_changed(const Params& /*params*/) {
    return fail(ErrorCode::kInvalidArgument, kTakesNoParameters);
  }
};

/// The function table of a controller, as the host calls it; made by add_controller().
struct ControllerOps {
  InstanceOps instance;
  int (*start)(void* instance, const DeviceSetup* setup, ErrorText* error) = nullptr;
  void (*control)(void* first, std::uint64_t stride, const ControlInput* inputs, Command* outputs,
                  std::uint64_t count, std::uint8_t* failed, ErrorText* error) = nullptr;
  CommandKind gives = CommandKind::kVelocity;  ///< The kind that the actuator must accept.
  std::uint32_t reserved = 0;
  UpdateFunction update = nullptr;
};

namespace detail {
template <class T>
constexpr ControllerOps controller_ops() noexcept {
  ControllerOps ops;
  ops.instance = instance_ops<T>();
  ops.gives = T::kGives;
  ops.start = [](void* instance, const DeviceSetup* setup, ErrorText* error) {
    return guarded(error, [&] { return static_cast<T*>(instance)->start(*setup); });
  };
  ops.update = update_function<T>();
  ops.control = [](void* first, std::uint64_t stride, const ControlInput* inputs, Command* outputs,
                   std::uint64_t count, std::uint8_t* failed, ErrorText* error) {
    for (std::size_t i = 0; i < count; ++i) {
      if (failed[i] != 0) continue;
      guarded_slot(i, failed, error,
                   [&] { outputs[i] = instance_at<T>(first, stride, i).T::control(inputs[i]); });
    }
  };
  return ops;
}
}  // namespace detail
}  // namespace rave
