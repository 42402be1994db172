// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/robot/interface.hpp"

namespace rave {

/// Passed to a device when it is configured.
struct HardwareDeviceSetup {
  RobotInfo robot;
  HostServices host;
  const ParamValue* params = nullptr;
  std::uint64_t param_count = 0;
  /// Folder of the robot file, the base of relative paths in parameters.
  const char* folder = "";
  std::uint64_t reserved = 0;

  [[nodiscard]] Params parameters() const noexcept {
    return Params(std::span(params, param_count));
  }
};

/// Hardware that several sensors and actuators of one robot share: a serial line, a base with
/// wheels and bumpers, a bus. One object per robot and entry of `devices:`. Sensors and actuators
/// whose `device:` names it get a pointer to it in their setup. The host has checked that it is an
/// object of the driver in their Description::device, from the same plug-in, so they may cast it to
/// its class.
///
/// configure() is called once, before any user of the device is configured. open() is called before
/// that of the first user, close() after that of the last; they alternate (a reset of the run
/// closes and opens again).
class HardwareDevice {
 public:
  virtual ~HardwareDevice() = default;
  virtual Status configure(const HardwareDeviceSetup& setup) = 0;
  /// Starts the device's own thread. An error prevents the start of the run; later failures are
  /// reported by the sensors of the device (SampleSink::fail).
  virtual Status open() = 0;
  /// Brings the hardware to rest, ends the thread and waits for it. Also called after errors.
  virtual void close() = 0;
  /// Statistics of the device for the results of a run, as one JSON object (`{}` if none).
  [[nodiscard]] virtual std::string report() const { return "{}"; }
};

/// The function table of a device, as the host calls it; made by add_device().
struct HardwareDeviceOps {
  InstanceOps instance;
  /// The object as its base class, for sensors and actuators.
  HardwareDevice* (*base)(void* instance) = nullptr;
  int (*configure)(void* instance, const HardwareDeviceSetup* setup, ErrorText* error) = nullptr;
  int (*open)(void* instance, ErrorText* error) = nullptr;
  void (*close)(void* instance) = nullptr;
  /// Calls `take` with the text of the report.
  void (*report)(void* instance, void* context,
                 void (*take)(void* context, const char* text, std::uint64_t size)) = nullptr;
};

namespace detail {
template <class T>
constexpr HardwareDeviceOps hardware_device_ops() noexcept {
  HardwareDeviceOps ops;
  ops.instance = instance_ops<T>();
  ops.base = [](void* instance) -> HardwareDevice* { return static_cast<T*>(instance); };
  ops.configure = [](void* instance, const HardwareDeviceSetup* setup, ErrorText* error) {
    return guarded(error, [&] { return static_cast<T*>(instance)->configure(*setup); });
  };
  ops.open = [](void* instance, ErrorText* error) {
    return guarded(error, [&] { return static_cast<T*>(instance)->open(); });
  };
  ops.close = [](void* instance) { close_quietly<T>(instance); };
  ops.report = [](void* instance, void* context,
                  void (*take)(void* context, const char* text, std::uint64_t size)) {
    hand_over_report<T>(instance, context, take);
  };
  return ops;
}
}  // namespace detail
}  // namespace rave
