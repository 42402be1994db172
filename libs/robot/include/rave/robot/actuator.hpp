// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>

#include "rave/base/random.hpp"
#include "rave/math/finite.hpp"
#include "rave/robot/controller.hpp"

namespace rave {

/// The input of a virtual actuator in one step.
struct MotionInput {
  Command command;  ///< Command of the controller; kNone before the first.
  Twist2 velocity;  ///< Actual velocity in the last step, as the world permitted it; in the
                    ///< body frame.
  double dt_s = 0;
  std::uint64_t seed = 0;
  std::uint32_t robot = 0;
  std::uint32_t device = 0;
  std::uint32_t step = 0;
  std::uint32_t contact = 0;  ///< 1: a contact limited the last motion.

  [[nodiscard]] RandomStream random() const noexcept { return {seed, robot, device, step}; }
};

/// The body velocity that a velocity command asks for; none for other commands, and if a number is
/// not finite.
[[nodiscard]] inline Twist2 asked_velocity(const Command& command) noexcept {
  const Twist2 asked{command.value[0], command.count > 2 ? command.value[2] : 0, command.value[1]};
  return command.kind == CommandKind::kVelocity && is_finite(asked) ? asked : Twist2{};
}

/// How a drive says what its commands do. An actuator that does more, or less, than go forward and
/// turn as commanded has these two functions, and then takes velocities beside its own kind of
/// commands. Pure functions of the parameters; any thread may call those of hardware at any time.
template <class T>
concept Drive = requires(const T& drive, const Command& command, const Twist2& motion) {
  /// The body velocity that a command leads to once the drive has followed it; finite.
  { drive.motion_of(command) } noexcept -> std::same_as<Twist2>;
  /// The command that leads nearest to a body velocity. Of no velocity: what makes it stand.
  { drive.command_for(motion) } noexcept -> std::same_as<Command>;
};

/// The function table of a drive. Null: it takes velocities, goes forward and turns.
struct DriveOps {
  void (*motion)(const void* instance, const Command* command, Twist2* motion) = nullptr;
  void (*command)(const void* instance, const Twist2* motion, Command* command) = nullptr;
};

/// The dynamics of a simulated robot. It proposes a motion, which the world then limits. One object
/// per robot.
class VirtualActuator {
 public:
  virtual ~VirtualActuator() = default;
  virtual Status start(const DeviceSetup& setup) = 0;
  /// The body velocity for this step, in the body frame. It is held over the step, so the path is
  /// an exact arc.
  virtual Twist2 propose(const MotionInput& input) = 0;
  /// New parameter values while the robot runs, called between two steps with all parameters. An
  /// error refuses the change; the old values remain.
  virtual Status parameters_changed(const Params& /*params*/) {
    return fail(ErrorCode::kInvalidArgument, kTakesNoParameters);
  }
};

/// The function table of a virtual actuator, as the host calls it; made by add_virtual_actuator().
struct VirtualActuatorOps {
  InstanceOps instance;
  int (*start)(void* instance, const DeviceSetup* setup, ErrorText* error) = nullptr;
  void (*propose)(void* first, std::uint64_t stride, const MotionInput* inputs, Twist2* outputs,
                  std::uint64_t count, std::uint8_t* failed, ErrorText* error) = nullptr;
  UpdateFunction update = nullptr;
  DriveOps drive;
};

/// Passes commands to hardware. One object per robot. write() must return at once; a driver with a
/// slow line writes in its own thread. In a live run the thread of the robot's guard calls it.
class HardwareActuator {
 public:
  virtual ~HardwareActuator() = default;
  /// Opens the device. An error prevents the start of the run.
  virtual Status open(const DeviceSetup& setup) = 0;
  virtual Status write(const Command& command, SimTime now) = 0;
  /// Stops the robot and releases the device; also called after errors.
  virtual void close() = 0;
  /// False for a device that cannot execute commands, such as a recording; the summary of the run
  /// mentions it.
  [[nodiscard]] virtual bool obeys() const { return true; }
};

/// The function table of a real actuator, as the host calls it; made by add_actuator().
struct HardwareActuatorOps {
  InstanceOps instance;
  int (*open)(void* instance, const DeviceSetup* setup, ErrorText* error) = nullptr;
  int (*write)(void* instance, const Command* command, std::int64_t now_ns,
               ErrorText* error) = nullptr;
  void (*close)(void* instance) = nullptr;
  int (*obeys)(void* instance) = nullptr;
  DriveOps drive;
};

namespace detail {
template <class T>
constexpr DriveOps drive_ops() noexcept {
  DriveOps ops;
  if constexpr (Drive<T>) {
    ops.motion = [](const void* instance, const Command* command, Twist2* motion) {
      *motion = static_cast<const T*>(instance)->motion_of(*command);
    };
    ops.command = [](const void* instance, const Twist2* motion, Command* command) {
      *command = static_cast<const T*>(instance)->command_for(*motion);
    };
  } else {
    static_assert(
        !requires { &T::motion_of; } && !requires { &T::command_for; },
        "a drive has both functions, const and noexcept: see rave::Drive");
  }
  return ops;
}

template <class T>
constexpr VirtualActuatorOps virtual_actuator_ops() noexcept {
  VirtualActuatorOps ops;
  ops.instance = instance_ops<T>();
  ops.start = [](void* instance, const DeviceSetup* setup, ErrorText* error) {
    return guarded(error, [&] { return static_cast<T*>(instance)->start(*setup); });
  };
  ops.update = update_function<T>();
  ops.drive = drive_ops<T>();
  ops.propose = [](void* first, std::uint64_t stride, const MotionInput* inputs, Twist2* outputs,
                   std::uint64_t count, std::uint8_t* failed, ErrorText* error) {
    for (std::size_t i = 0; i < count; ++i) {
      if (failed[i] != 0) continue;
      guarded_slot(i, failed, error,
                   [&] { outputs[i] = instance_at<T>(first, stride, i).T::propose(inputs[i]); });
    }
  };
  return ops;
}

template <class T>
constexpr HardwareActuatorOps hardware_actuator_ops() noexcept {
  HardwareActuatorOps ops;
  ops.instance = instance_ops<T>();
  ops.open = [](void* instance, const DeviceSetup* setup, ErrorText* error) {
    return guarded(error, [&] { return static_cast<T*>(instance)->open(*setup); });
  };
  ops.write = [](void* instance, const Command* command, std::int64_t now_ns, ErrorText* error) {
    return guarded(error, [&] { return static_cast<T*>(instance)->write(*command, {now_ns}); });
  };
  ops.close = [](void* instance) { close_quietly<T>(instance); };
  ops.obeys = [](void* instance) { return static_cast<T*>(instance)->obeys() ? 1 : 0; };
  ops.drive = drive_ops<T>();
  return ops;
}
}  // namespace detail
}  // namespace rave
