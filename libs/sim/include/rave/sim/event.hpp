// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rave/base/ids.hpp"
#include "rave/world/world_view.hpp"

namespace rave::sim {

enum class EventKind : std::uint32_t {
  kContact = 1,         ///< A robot began to touch something.
  kPinned = 2,          ///< A simulated robot cannot get out of a real robot's way.
  kPoseStale = 3,       ///< A reported pose is older than its limit.
  kPoseBack = 4,        ///< A pose arrived again after kPoseStale.
  kProgramFailed = 5,   ///< A program threw, crashed or hung; its robot stops.
  kDriverFailed = 6,    ///< A driver threw or lost its device.
  kDriverBack = 7,      ///< A device works again after kDriverFailed.
  kGuardSlowed = 20,    ///< The guard began to slow a robot down.
  kGuardStopped = 21,   ///< The guard stopped a robot that was commanded to move.
  kStopped = 22,        ///< A stop request; latched.
  kReleased = 23,       ///< A stop was released.
  kArmed = 24,          ///< A robot was armed.
  kChanged = 25,        ///< Parameters of a robot were changed.
  kChangeRefused = 26,  ///< A change of the scenario failed.
  kObstacleAdded = 27,  ///< `other` was added; `robot` is none.
  kObstacleMoved = 28,
  kObstacleRemoved = 29,
  kCaptured = 30,         ///< The host found that a robot caught another; not part of the hash.
  kHandedOver = 31,       ///< The other set of drivers is active from this step on.
  kHandOverRefused = 32,  ///< A hand-over was refused; nothing has changed.
  kShadowReset = 33,      ///< The host moved a shadow to its robot; not part of the hash.
  kOrdered = 34,          ///< A robot received an order, or completed one.
  kSaid = 35,             ///< A program sent a text to users.
  kPlaced = 36,           ///< A simulated robot was placed elsewhere.
  kLease = 37,  ///< The holder of a command lease changed; made by the host, not part of the hash.
  kPoseRefused = 38,      ///< A reported pose is not believed: the robot cannot be there.
  kSensorRestarted = 39,  ///< Samples of a sensor do not continue those before.
  kDisarmed = 40,         ///< The same of a real robot that drives by it: it has to be armed again.
  kScenario = 41,         ///< Something that the scenario notes: a condition, a mark, an error.
  kTeamGiven = 42,  ///< The scenario gives a team to a user; the GUI Server sees to it. The text is
                    ///< team_given_text().
};
/// All kinds are below this number; to_string() of one that does not exist is "unknown".
inline constexpr std::uint32_t kEventKindEnd =
    static_cast<std::uint32_t>(EventKind::kTeamGiven) + 1;
[[nodiscard]] std::string_view to_string(EventKind kind) noexcept;

/// Whether events of this kind concern an obstacle instead of a robot.
[[nodiscard]] constexpr bool is_of_obstacle(EventKind kind) noexcept {
  return kind == EventKind::kObstacleAdded || kind == EventKind::kObstacleMoved ||
         kind == EventKind::kObstacleRemoved;
}

/// An event of one step: something happened to a robot or to the world.
struct Event {
  std::uint64_t step = 0;
  RobotId robot;  ///< None: the event concerns the world.
  EventKind kind = EventKind::kContact;
  BodyId other;      ///< Contacts and pins: the other body. Obstacle events: the obstacle.
  std::string text;  ///< Description for people. Not part of the run hash.
  /// Guard: the GuardLimit. Obstacle events in real time with several hosts: number of the change
  /// in the run, as the manager counts it; 0: unknown.
  std::uint32_t detail = 0;
};

}  // namespace rave::sim
