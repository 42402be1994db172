// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "rave/plugin/params.hpp"

namespace rave {

/// What a registered driver serves; decides which table of functions it comes with.
enum class DriverKind : std::uint32_t {
  kSensor,           ///< Hardware or a recording: rave/robot/hardware_sensor.hpp
  kVirtualSensor,    ///< Reads the virtual world: rave/sim/virtual_sensor.hpp
  kHybridSensor,     ///< Fuses a real and a virtual half: rave/robot/hybrid_sensor.hpp
  kActuator,         ///< Hardware, or a recording that cannot obey: rave/robot/actuator.hpp
  kVirtualActuator,  ///< Dynamics of a simulated robot: rave/robot/actuator.hpp
  kController,       ///< rave/robot/controller.hpp
  kCommunicator,     ///< A message model: rave/robot/communicator.hpp
  kTransmitter,      ///< Carries messages: rave/robot/transmitter.hpp
  kProgram,          ///< A decision process: rave/robot/program.hpp
  kDevice,           ///< Hardware that sensors and actuators share: rave/robot/device.hpp
};
/// How many kinds of drivers there are.
inline constexpr std::uint32_t kDriverKindCount = 10;

/// The name of a kind, as `rave drivers` prints it.
[[nodiscard]] std::string_view to_string(DriverKind kind) noexcept;

/// How a driver's time runs. Stepped: as a function of simulation time, so a run can be repeated.
/// Live: by the clock on the wall. Either: a parameter `clock` chooses.
enum class DriverClock : std::uint32_t { kStepped, kLive, kEither };

/// `stepped`, `live` or `either`.
[[nodiscard]] std::string_view to_string(DriverClock clock) noexcept;

/// When the samples of a hardware sensor come, which decides how a dead one is noticed. Unknown: at
/// the pace of the device; only `max_age_s` in the robot file says how old a sample may be.
/// Periodic: HardwareDeclaration::period_s says how often. Events: when something happens, so that
/// silence is no fault, and SampleSink::fail() alone says that the sensor is lost.
enum class SampleTiming : std::uint32_t { kUnknown, kPeriodic, kEvents };

/// The name of a timing, as `rave describe` prints it.
[[nodiscard]] std::string_view to_string(SampleTiming timing) noexcept;

/// A driver or program as it describes itself. Pointers are to constants of the plug-in.
struct DriverInfo {
  DriverKind kind = DriverKind::kSensor;
  DriverClock clock = DriverClock::kStepped;
  const char* name = "";     ///< Unique among those of its kind; lower_snake_case.
  const char* version = "";  ///< `1.0`
  const char* summary = "";  ///< One sentence.
  const ParamSpec* params = nullptr;
  std::uint64_t param_count = 0;
  /// A rave::ReadingKind (sensors) or rave::CommandKind (controllers, actuators); 0 for others.
  std::uint32_t data_kind = 0;
  SampleTiming timing = SampleTiming::kUnknown;  ///< Drivers of kind kSensor.
  /// The driver of kind kDevice, of the same plug-in, that it must be given; empty: none.
  const char* device = "";

  [[nodiscard]] std::span<const ParamSpec> param_specs() const noexcept {
    return {params, param_count};
  }
};

/// Filled by a plug-in's one exported function; belongs to the loader.
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
