// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/time.hpp"
#include "rave/plugin/registry.hpp"
#include "rave/robot/controller.hpp"
#include "rave/robot/device.hpp"

namespace rave {

/// Where the thread of a hardware sensor puts its samples. Belongs to the host; one thread of the
/// driver writes; valid from open() until close() has returned.
class SampleSink {
 public:
  /// Waits until simulation time `t` is due: at once in a stepped run, by the wall clock in a live
  /// one. False: the sensor is being closed, end the thread.
  virtual bool wait_until(SimTime t) noexcept = 0;
  /// Hands over `count` records that were true at `stamp`, which must not step back. In a stepped
  /// run it waits for room; false: the sensor is being closed.
  virtual bool publish(SimTime stamp, const void* records, std::uint32_t count) noexcept = 0;
  /// Promises that nothing with a stamp up to `t` will come any more. Stepped drivers must call it;
  /// the end of a recording is `SimTime` of the largest value.
  virtual void complete_up_to(SimTime t) noexcept = 0;
  /// Reports that the device is gone; `text` is copied.
  virtual void fail(const char* text, std::uint64_t size) noexcept = 0;
  /// Takes fail() back: the device is there again and samples will come. Live runs only: a stepped
  /// driver runs ahead, so what it says of a loss is final.
  virtual void recover() noexcept = 0;
  /// The present moment of a live run, which a driver needs to turn its own clock into stamps. In a
  /// stepped run it says nothing (the smallest SimTime): stamps come from the data there.
  [[nodiscard]] virtual SimTime now() const noexcept = 0;

 protected:
  ~SampleSink() = default;
};

/// What a hardware sensor is given when it is configured.
struct HardwareSetup {
  RobotInfo robot;
  HostServices host;
  const ParamValue* params = nullptr;
  std::uint64_t param_count = 0;
  /// Folder of the robot file: relative paths in parameters start there.
  const char* folder = "";
  /// What `device:` in the robot file names; null if it names nothing. Lives longer than the
  /// instance.
  HardwareDevice* device = nullptr;

  [[nodiscard]] Params parameters() const noexcept {
    return Params(std::span(params, param_count));
  }
};

/// What a hardware sensor says of itself once it knows its parameters. Pointers live as long as
/// the instance.
struct HardwareDeclaration {
  std::uint32_t capacity = 1;  ///< Records of one step at most.
  DriverClock clock = DriverClock::kStepped;
  /// 1: records of one step are put together (events); 0: the newest sample counts (states).
  std::uint32_t collect = 0;
  std::uint32_t reserved = 0;
  /// SampleTiming::kPeriodic: time between two samples while the device works; above 0.
  double period_s = 0;
  double range_min_m = 0;  ///< Ranges only, as in SensorInfo.
  double range_max_m = 0;
  const double* bearings_rad = nullptr;
  double cone_rad = 0;
};

/// A sensor of the real world, or a recording of one. One object per robot and sensor. configure()
/// comes once; open() and close() alternate (a reset of the run closes and opens again).
class HardwareSensor {
 public:
  virtual ~HardwareSensor() = default;
  virtual Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) = 0;
  /// Starts the driver's own thread, which writes to `sink`.
  virtual Status open(SampleSink& sink) = 0;
  /// Ends the thread and waits for it.
  virtual void close() = 0;
  /// What an experimenter should know of the stream, as one JSON object (`{}` if nothing).
  [[nodiscard]] virtual std::string report() const { return "{}"; }
};

/// The functions of a real sensor as the host calls them; made by add_sensor().
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
