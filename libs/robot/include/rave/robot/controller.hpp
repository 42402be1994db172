// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/robot/command.hpp"
#include "rave/robot/interface.hpp"
#include "rave/robot/reading.hpp"

namespace rave {

class HardwareDevice;

/// What a controller or actuator is given when it starts.
struct DeviceSetup {
  RobotInfo robot;
  HostServices host;
  const ParamValue* params = nullptr;
  std::uint64_t param_count = 0;
  double step_s = 0;  ///< Base period: control() and propose() come once a step.
  /// Actuators: what `device:` in the robot file names; null if it names nothing. Lives longer
  /// than the instance.
  HardwareDevice* device = nullptr;

  [[nodiscard]] Params parameters() const noexcept {
    return Params(std::span(params, param_count));
  }
};

/// What a controller knows in one step.
struct ControlInput {
  Command command;           ///< The last one that the program gave; kNone before the first.
  double command_age_s = 0;  ///< Simulation time since it was given.
  PoseReading pose;          ///< Reported pose in the world frame.
  Twist2 velocity;           ///< Reported velocity, body frame.
  double dt_s = 0;
};

/// Turns what a program wants into what an actuator understands, each step. One object per robot;
/// it deals with two abstract interfaces, so it is the same for a real and a simulated robot.
class Controller {
 public:
  virtual ~Controller() = default;
  virtual Status start(const DeviceSetup& setup) = 0;
  /// Must return a stop (not nothing) once the command is older than its watchdog allows.
  virtual Command control(const ControlInput& input) = 0;
  /// Somebody changed parameters while the robot runs; comes between two steps, with all of them.
  /// An error refuses the change: it goes on with the old ones.
  virtual Status parameters_changed(const Params& /*params*/) {
    return fail(ErrorCode::kInvalidArgument, "it takes no new parameters while it runs");
  }
};

/// The functions of a controller as the host calls them; made by add_controller().
struct ControllerOps {
  InstanceOps instance;
  int (*start)(void* instance, const DeviceSetup* setup, ErrorText* error) = nullptr;
  void (*control)(void* first, std::uint64_t stride, const ControlInput* inputs, Command* outputs,
                  std::uint64_t count, std::uint8_t* failed, ErrorText* error) = nullptr;
  CommandKind gives = CommandKind::kVelocity;  ///< What the actuator must accept.
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
      const int status = guarded(error, [&]() -> Status {
        outputs[i] = instance_at<T>(first, stride, i).T::control(inputs[i]);
        return {};
      });
      if (status != 0) {
        failed[i] = 1;
        error->slot = static_cast<std::uint32_t>(i);
      }
    }
  };
  return ops;
}
}  // namespace detail
}  // namespace rave
