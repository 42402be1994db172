// SPDX-License-Identifier: Apache-2.0
#include "rave/plugin/registry.hpp"

namespace rave {

std::string_view to_string(DriverKind kind) noexcept {
  switch (kind) {
    case DriverKind::kSensor:
      return "sensor";
    case DriverKind::kVirtualSensor:
      return "virtual sensor";
    case DriverKind::kHybridSensor:
      return "hybrid sensor";
    case DriverKind::kActuator:
      return "actuator";
    case DriverKind::kVirtualActuator:
      return "virtual actuator";
    case DriverKind::kController:
      return "controller";
    case DriverKind::kCommunicator:
      return "communicator";
    case DriverKind::kTransmitter:
      return "transmitter";
    case DriverKind::kProgram:
      return "program";
    case DriverKind::kDevice:
      return "device";
  }
  return "unknown";
}

std::string_view to_string(DriverClock clock) noexcept {
  switch (clock) {
    case DriverClock::kStepped:
      return "stepped";
    case DriverClock::kLive:
      return "live";
    case DriverClock::kEither:
      return "stepped or live";
  }
  return "unknown";
}

std::string_view to_string(SampleTiming timing) noexcept {
  switch (timing) {
    case SampleTiming::kUnknown:
      return "at the pace of the device";
    case SampleTiming::kPeriodic:
      return "periodic";
    case SampleTiming::kEvents:
      return "when something happens";
  }
  return "unknown";
}

}  // namespace rave
