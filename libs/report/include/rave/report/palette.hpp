// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rave::report {

/// The kind of an object in a picture. It determines colour, drawing order and line of the legend.
enum class Kind : std::uint8_t {
  kMappedWall,       ///< A wall or body of the real floor, from a map.
  kLandmark,         ///< A real tube or post with a barcode.
  kVirtualObstacle,  ///< A body that exists in the virtual world only.
  kRecordedRobot,    ///< A real robot, live or recorded.
  kSimulatedRobot,   ///< A robot that exists in the simulation only.
  kHunter,           ///< A simulated robot that pursues another; drawn in a conspicuous colour.
  kRobotPart,        ///< A further prism of a robot's body.
  kSensor,           ///< The mounting point of a sensor, in drawings of one robot.
  kOther,            ///< Anything else.
};

inline constexpr std::array kAllKinds = {
    Kind::kMappedWall,    Kind::kLandmark,       Kind::kVirtualObstacle,
    Kind::kRecordedRobot, Kind::kSimulatedRobot, Kind::kHunter,
    Kind::kRobotPart,     Kind::kSensor,         Kind::kOther};

/// Colour and names of a kind. All views refer to static text.
struct KindStyle {
  std::string_view colour;    ///< `#rrggbb`, for lines and laser hits.
  std::string_view singular;  ///< "simulated robot"
  std::string_view plural;    ///< "simulated robots"
};

/// The colours of kinds, for all output of RAVE. The hues are those of Okabe and Ito ("Color
/// Universal Design", 2008), which people with any common colour vision deficiency can distinguish;
/// wine of Tol for the hunter; greys and browns for context.
[[nodiscard]] KindStyle palette_for(Kind kind) noexcept;

/// The colour of the recorded robot with this index: five hues of the same set that differ from
/// each other and from the other kinds; they repeat from the sixth robot on.
[[nodiscard]] std::string_view robot_colour(std::size_t index) noexcept;

}  // namespace rave::report
