// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/time.hpp"
#include "rave/plugin/registry.hpp"
#include "rave/robot/controller.hpp"
#include "rave/robot/device.hpp"

namespace rave {

/// Receives the samples of a hardware sensor. Owned by the host; written by one thread of the
/// driver; valid from open() until close() has returned.
class SampleSink {
 public:
  /// Waits until simulation time `t`: returns at once in a stepped run, follows the wall clock in a
  /// live one. False: the sensor is being closed, the thread must end.
  virtual bool wait_until(SimTime t) noexcept = 0;
  /// Passes on `count` records that were true at `stamp`, which must not decrease. In a stepped run
  /// it waits for room. False: the sensor is being closed.
  virtual bool publish(SimTime stamp, const void* records, std::uint32_t count) noexcept = 0;
  /// Promises that no sample with a stamp up to `t` will follow. Stepped drivers must call it; at
  /// the end of a recording with the largest `SimTime`.
  virtual void complete_up_to(SimTime t) noexcept = 0;
  /// Reports that the device is lost; copies `text`.
  virtual void fail(const char* text, std::uint64_t size) noexcept = 0;
  /// Revokes fail(): the device is available again. Live runs only: a stepped driver runs ahead of
  /// the run, so its fail() is final.
  virtual void recover() noexcept = 0;
  /// Says that samples from now on do not continue those before, and why: the clock of the device
  /// was set, or another device has taken its place. A real robot that drives by this sensor has to
  /// be armed again. Copies `text`. Live runs only.
  virtual void begin_anew(const char* text, std::uint64_t size) noexcept = 0;
  /// The current time of a live run, for drivers that convert their own clock to stamps. In a
  /// stepped run it is the smallest SimTime, because stamps come from the data.
  [[nodiscard]] virtual SimTime now() const noexcept = 0;

 protected:
  ~SampleSink() = default;
};

/// Passed to a hardware sensor when it is configured.
struct HardwareSetup {
  RobotInfo robot;
  HostServices host;
  const ParamValue* params = nullptr;
  std::uint64_t param_count = 0;
  /// Folder of the robot file, the base of relative paths in parameters.
  const char* folder = "";
  /// The device that `device:` in the robot file names, or null. Outlives the instance.
  HardwareDevice* device = nullptr;

  [[nodiscard]] Params parameters() const noexcept {
    return Params(std::span(params, param_count));
  }
};

/// Properties of a hardware sensor that follow from its parameters. Pointers must be valid as long
/// as the instance.
struct HardwareDeclaration {
  std::uint32_t capacity = 1;  ///< Largest number of records in one step.
  DriverClock clock = DriverClock::kStepped;
  /// 1: all records of a step are collected (events); 0: the newest sample replaces older ones
  /// (states).
  std::uint32_t collect = 0;
  std::uint32_t reserved = 0;
  /// With SampleTiming::kPeriodic: time between two samples of a working device; above 0.
  double period_s = 0;
  double range_min_m = 0;  ///< Ranges only, as in SensorInfo.
  double range_max_m = 0;
  const double* bearings_rad = nullptr;
  double cone_rad = 0;
};

/// A sensor of the real world, or a recording of one. One object per robot and sensor. configure()
/// is called once; open() and close() alternate (a reset of the run closes and opens again).
class HardwareSensor {
 public:
  virtual ~HardwareSensor() = default;
  virtual Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) = 0;
  /// Starts the driver's own thread, which writes to `sink`.
  virtual Status open(SampleSink& sink) = 0;
  /// Ends the thread and waits for it.
  virtual void close() = 0;
  /// Statistics of the samples for the results of a run, as one JSON object (`{}` if none).
  [[nodiscard]] virtual std::string report() const { return "{}"; }
};

/// The function table of a real sensor, as the host calls it; made by add_sensor().
struct HardwareSensorOps {
  InstanceOps instance;
  int (*configure)(void* instance, const HardwareSetup* setup, HardwareDeclaration* declaration,
                   ErrorText* error) = nullptr;
  int (*open)(void* instance, SampleSink* sink, ErrorText* error) = nullptr;
  void (*close)(void* instance) = nullptr;
  /// Calls `take` with the text of the report.
  void (*report)(void* instance, void* context,
                 void (*take)(void* context, const char* text, std::uint64_t size)) = nullptr;
};

namespace detail {
template <class T>
constexpr HardwareSensorOps hardware_sensor_ops() noexcept {
  HardwareSensorOps ops;
  ops.instance = instance_ops<T>();
  ops.configure = [](void* instance, const HardwareSetup* setup, HardwareDeclaration* declaration,
                     ErrorText* error) {
    return guarded(error,
                   [&] { return static_cast<T*>(instance)->configure(*setup, *declaration); });
  };
  ops.open = [](void* instance, SampleSink* sink, ErrorText* error) {
    return guarded(error, [&] { return static_cast<T*>(instance)->open(*sink); });
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
