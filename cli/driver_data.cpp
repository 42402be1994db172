// SPDX-License-Identifier: Apache-2.0
#include "driver_data.hpp"

#include <fmt/format.h>

#include "rave/robot/command.hpp"

namespace rave::cli {

std::string_view record_type(ReadingKind kind) noexcept {
  switch (kind) {
    case ReadingKind::kNone:
      break;
    case ReadingKind::kRanges:
      return "float";
    case ReadingKind::kSightings:
      return "Sighting";
    case ReadingKind::kPose:
      return "PoseReading";
    case ReadingKind::kOdometry:
      return "OdometryReading";
    case ReadingKind::kNeighbours:
      return "NeighbourReading";
    case ReadingKind::kContact:
      return "ContactReading";
    case ReadingKind::kVelocity:
      return "VelocityReading";
    case ReadingKind::kValues:
      return "double";
  }
  return "";
}

std::vector<plugin::DriverFact> data_facts(const DriverInfo& info) {
  std::vector<plugin::DriverFact> facts;
  switch (info.kind) {
    case DriverKind::kSensor:
    case DriverKind::kVirtualSensor:
    case DriverKind::kHybridSensor: {
      const auto kind = static_cast<ReadingKind>(info.data_kind);
      facts.push_back(
          {"gives", fmt::format("{} (C++ type {})", to_string(kind), record_type(kind))});
      break;
    }
    case DriverKind::kActuator:
    case DriverKind::kVirtualActuator:
    case DriverKind::kController:
      facts.push_back(
          {"accepts", std::string(to_string(static_cast<CommandKind>(info.data_kind)))});
      break;
    case DriverKind::kCommunicator:
    case DriverKind::kTransmitter:
    case DriverKind::kProgram:
    case DriverKind::kDevice:
      break;
  }
  // Of other kinds it is the robot file that says when there are samples.
  if (info.kind == DriverKind::kSensor && info.timing != SampleTiming::kUnknown) {
    facts.push_back({"samples", std::string(to_string(info.timing))});
  }
  return facts;
}

}  // namespace rave::cli
