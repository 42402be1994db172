// SPDX-License-Identifier: Apache-2.0
#include "driver_data.hpp"

#include <fmt/format.h>

#include "rave/robot/command.hpp"
#include "rave/robot/reading_type.hpp"

namespace rave::cli {

std::vector<plugin::DriverFact> data_facts(const DriverInfo& info) {
  using enum DriverKind;
  std::vector<plugin::DriverFact> facts;
  if (info.kind == kSensor || info.kind == kVirtualSensor || info.kind == kHybridSensor) {
    const auto kind = static_cast<ReadingKind>(info.data_kind);
    facts.push_back(
        {"gives", fmt::format("{} (C++ type {})", to_string(kind), reading_type(kind).record)});
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
