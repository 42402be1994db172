// SPDX-License-Identifier: Apache-2.0
#include "rave/report/palette.hpp"

namespace rave::report {

KindStyle palette_for(Kind kind) noexcept {
  switch (kind) {
    case Kind::kMappedWall:
      return {"#8c7a66", "mapped wall", "mapped walls"};
    case Kind::kLandmark:
      return {"#2b2b2b", "tube", "tubes"};
    case Kind::kVirtualObstacle:
      return {"#56b4e9", "virtual obstacle", "virtual obstacles"};
    case Kind::kRecordedRobot:
      return {"#0072b2", "real robot", "real robots"};
    case Kind::kSimulatedRobot:
      return {"#8a93a3", "simulated robot", "simulated robots"};
    case Kind::kHunter:
      return {"#882255", "hunter", "hunters"};
    case Kind::kRobotPart:
      return {"#98a0ae", "part of a robot", "parts of robots"};
    case Kind::kSensor:
      return {"#009e73", "sensor", "sensors"};
    case Kind::kOther:
      break;
  }
  return {"#a8a8a8", "other body", "other bodies"};
}

std::string_view robot_colour(std::size_t index) noexcept {
  static constexpr std::array<std::string_view, 5> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                               "#cc79a7", "#e69f00"};
  return kColours[index % kColours.size()];
}

}  // namespace rave::report
