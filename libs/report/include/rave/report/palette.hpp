// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rave::report {

/// What a thing in a picture is. Decides its colour, its place in the drawing order and its line
/// of the legend.
enum class Kind : std::uint8_t {
  kMappedWall,       ///< A wall or body of the real floor, known from a map.
  kLandmark,         ///< A real tube or post that carries an id.
  kVirtualObstacle,  ///< A body that exists in the virtual world only.
  kRecordedRobot,    ///< A robot that really drove (or drives now).
  kSimulatedRobot,   ///< A robot that exists in the simulation only.
  kHunter,           ///< A simulated robot that pursues another; drawn to stand out.
  kRobotPart,        ///< A further prism of a robot's body.
  kSensor,           ///< The mounting point of a sensor, in drawings of one robot.
  kOther,            ///< Anything else.
};

inline constexpr std::array kAllKinds = {
    Kind::kMappedWall,    Kind::kLandmark,       Kind::kVirtualObstacle,
    Kind::kRecordedRobot, Kind::kSimulatedRobot, Kind::kHunter,
    Kind::kRobotPart,     Kind::kSensor,         Kind::kOther};

/// How a kind looks and what it is called. All views refer to static text.
struct KindStyle {
  std::string_view colour;    ///< `#rrggbb`, of lines and laser hits.
  std::string_view singular;  ///< "simulated robot"
  std::string_view plural;    ///< "simulated robots"
};

/// The one source of colours for kinds, for every output of RAVE. The hues are those of Okabe and
/// Ito ("Color Universal Design", 2008), which people with any common colour blindness can tell
/// apart, with Tol's wine for the hunter and greys and browns for what is only context.
[[nodiscard]] KindStyle palette_for(Kind kind) noexcept;

/// The colour of the index-th of several recorded robots: five hues of the same set that differ
/// from each other and from those of the other kinds; they repeat from the sixth robot on.
[[nodiscard]] std::string_view robot_colour(std::size_t index) noexcept;

}  // namespace rave::report
