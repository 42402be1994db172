// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "rave/plugin/params.hpp"

namespace rave {

/// The kind of a registered driver. It determines the type of the driver's function table.
enum class DriverKind : std::uint32_t {
  kSensor,           ///< Reads hardware or a recording: rave/robot/hardware_sensor.hpp
  kVirtualSensor,    ///< Reads the virtual world: rave/sim/virtual_sensor.hpp
  kHybridSensor,     ///< Fuses a real and a virtual half: rave/robot/hybrid_sensor.hpp
  kActuator,         ///< Controls hardware, or a recording, which ignores commands:
                     ///< rave/robot/actuator.hpp
  kVirtualActuator,  ///< Dynamics of a simulated robot: rave/robot/actuator.hpp
  kController,       ///< rave/robot/controller.hpp
  kCommunicator,     ///< A message model: rave/robot/communicator.hpp
  kTransmitter,      ///< Carries messages: rave/robot/transmitter.hpp
  kProgram,          ///< A decision process: rave/robot/program.hpp
  kDevice,           ///< Hardware that sensors and actuators share: rave/robot/device.hpp
};
/// The number of kinds.
inline constexpr std::uint32_t kDriverKindCount = 10;

/// The name of a kind, as `rave drivers` prints it.
[[nodiscard]] std::string_view to_string(DriverKind kind) noexcept;

/// The time base of a driver. Stepped: a function of simulation time, so a run can be repeated.
/// Live: the wall clock. Either: its parameter `clock` selects one.
enum class DriverClock : std::uint32_t { kStepped, kLive, kEither };

/// `stepped`, `live` or `either`.
[[nodiscard]] std::string_view to_string(DriverClock clock) noexcept;

/// When a hardware sensor produces samples; determines how a failure is detected. Unknown: at the
/// rate of the device; only `max_age_s` in the robot file limits the age of a sample. Periodic:
/// every HardwareDeclaration::period_s. Events: when something happens; silence is no fault, and
/// only SampleSink::fail() reports that the sensor is lost.
enum class SampleTiming : std::uint32_t { kUnknown, kPeriodic, kEvents };

/// The name of a timing, as `rave describe` prints it.
[[nodiscard]] std::string_view to_string(SampleTiming timing) noexcept;

/// The description of a driver or program by its plug-in. Pointers refer to constants of the
/// plug-in.
struct DriverInfo {
  DriverKind kind = DriverKind::kSensor;
  DriverClock clock = DriverClock::kStepped;
  const char* name = "";     ///< Unique within its kind; lower_snake_case.
  const char* version = "";  ///< `1.0`
  const char* summary = "";  ///< One sentence.
  const ParamSpec* params = nullptr;
  std::uint64_t param_count = 0;
  /// A rave::ReadingKind (sensors) or rave::CommandKind (controllers, actuators); 0 for others.
  std::uint32_t data_kind = 0;
  SampleTiming timing = SampleTiming::kUnknown;  ///< Drivers of kind kSensor.
  /// The name of the driver of kind kDevice, in the same plug-in, whose device this driver needs;
  /// empty: none.
  const char* device = "";

  [[nodiscard]] std::span<const ParamSpec> param_specs() const noexcept {
    return {params, param_count};
  }
};

/// Receives the drivers that a plug-in registers. Owned by the loader; valid during the call of the
/// plug-in's entry function.
class RegistrySink {
 public:
  /// Adds one driver. `ops` is the function table of its kind, a constant of the plug-in.
  virtual void add(const DriverInfo& info, const void* ops) = 0;

 protected:
  ~RegistrySink() = default;
};

}  // namespace rave

/// The name of the exported function: `extern "C" void rave_register_plugin(rave::RegistrySink*)`.
#define RAVE_PLUGIN_ENTRY rave_register_plugin
