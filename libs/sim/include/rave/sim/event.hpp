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
  kPoseBack = 4,        ///< ... and came again.
  kProgramFailed = 5,   ///< A program threw, crashed or hung; its robot stops.
  kDriverFailed = 6,    ///< A driver threw or lost its device.
  kDriverBack = 7,      ///< ... and its device works again.
  kGuardSlowed = 20,    ///< The guard began to slow a robot down.
  kGuardStopped = 21,   ///< The guard began to make a robot stand that was told to move.
  kStopped = 22,        ///< Somebody stopped a robot; latched.
  kReleased = 23,       ///< ... and let it go again.
  kArmed = 24,          ///< Somebody armed a robot.
  kChanged = 25,        ///< Parameters of a robot were changed.
  kChangeRefused = 26,  ///< A change of the scenario that could not be made.
  kObstacleAdded = 27,  ///< `other` has come; no robot is concerned.
  kObstacleMoved = 28,
  kObstacleRemoved = 29,
  kCaptured = 30,         ///< The host saw that a robot caught another; no part of the hash.
  kHandedOver = 31,       ///< A robot has its other set of drivers from this step on.
  kHandOverRefused = 32,  ///< ... or could not be given it; everything is as it was.
  kShadowReset = 33,      ///< The host put a shadow where its robot is; no part of the hash.
  kOrdered = 34,          ///< Somebody gave a robot an order, or it is done with one.
  kSaid = 35,             ///< A program said something to people.
  kPlaced = 36,           ///< Somebody put a simulated robot elsewhere.
  kLease = 37,            ///< Who may give a robot orders now; by the host, no part of the hash.
};
[[nodiscard]] std::string_view to_string(EventKind kind) noexcept;

/// Whether events of this kind are of an obstacle and of no robot.
[[nodiscard]] constexpr bool is_of_obstacle(EventKind kind) noexcept {
  return kind == EventKind::kObstacleAdded || kind == EventKind::kObstacleMoved ||
         kind == EventKind::kObstacleRemoved;
}

/// Something that happened to a robot in one step, or to the world.
struct Event {
  std::uint64_t step = 0;
  RobotId robot;  ///< None: it concerns the world.
  EventKind kind = EventKind::kContact;
  BodyId other;      ///< Contacts and pins: with whom. Of obstacles: which one.
  std::string text;  ///< For people. Not part of the run hash.
  /// Guard: the GuardLimit. Of obstacles in real time over several hosts: which change it was, of
  /// all in the run, as its manager counts them; 0: not known.
  std::uint32_t detail = 0;
};

}  // namespace rave::sim
