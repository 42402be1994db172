// SPDX-License-Identifier: Apache-2.0
#include "driver_data.hpp"

#include <fmt/format.h>

#include "rave/base/word_table.hpp"
#include "rave/robot/command.hpp"

namespace rave::cli {

std::string_view record_type(ReadingKind kind) noexcept {
  constexpr WordTable<ReadingKind, 8> kTypes = {{{"float", ReadingKind::kRanges},
                                                 {"Sighting", ReadingKind::kSightings},
                                                 {"PoseReading", ReadingKind::kPose},
                                                 {"OdometryReading", ReadingKind::kOdometry},
                                                 {"NeighbourReading", ReadingKind::kNeighbours},
                                                 {"ContactReading", ReadingKind::kContact},
                                                 {"VelocityReading", ReadingKind::kVelocity},
                                                 {"double", ReadingKind::kValues}}};
  return kTypes.of(kind);
}

std::vector<plugin::DriverFact> data_facts(const DriverInfo& info) {
  using enum DriverKind;
  std::vector<plugin::DriverFact> facts;
  if (info.kind == kSensor || info.kind == kVirtualSensor || info.kind == kHybridSensor) {
    const auto kind = static_cast<ReadingKind>(info.data_kind);
    facts.push_back({"gives", fmt::format("{} (C++ type {})", to_string(kind), record_type(kind))});
  } else if (info.kind == kActuator || info.kind == kVirtualActuator || info.kind == kController) {
    const auto kind = static_cast<CommandKind>(info.data_kind);
    facts.push_back({"accepts", std::string(to_string(kind))});
  }
  // Of other kinds it is the robot file that says when there are samples.
  if (info.kind == kSensor && info.timing != SampleTiming::kUnknown) {
    facts.push_back({"samples", std::string(to_string(info.timing))});
  }
  return facts;
}

}  // namespace rave::cli
