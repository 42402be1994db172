// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/math/pose.hpp"
#include "rave/sim/obstacle_change.hpp"
#include "rave/sim/parameter_change.hpp"

namespace rave::sim {

/// The origin of an input to a run.
struct Author {
  bool by_hand = true;  ///< Requested during the run, so the run is no longer the scenario's.
  std::string name{};   ///< If by hand: name of the user; empty: the terminal of the host.

  static const Author kRun;   ///< Part of the run, such as a change in its scenario.
  static const Author kHand;  ///< By hand, without a name.
  friend bool operator==(const Author&, const Author&) = default;
};
inline const Author Author::kRun{false, {}};
inline const Author Author::kHand{true, {}};

/// `by hand`, or with the name of the user: `by hand: anna`.
[[nodiscard]] std::string by_hand_text(const Author& author);
/// Whether the text of an event contains by_hand_text().
[[nodiscard]] bool says_by_hand(std::string_view text) noexcept;

/// The details of an order; the kind of the input determines which members are used.
struct OrderDetails {
  std::vector<Vec2> points_W;     ///< kGoal and kPlace: one. kPath: 2 to kMostOrderPoints. m.
  std::optional<double> yaw_rad;  ///< kGoal, kPlace: heading; empty: any.
  double v_mps = 0;               ///< kDrive: forward speed.
  double w_radps = 0;             ///< kDrive: turning rate, counter-clockwise.
  double speed_mps = 0;           ///< kGoal, kPath: speed limit; 0: the robot decides.
  std::string text;               ///< kText.
  friend bool operator==(const OrderDetails&, const OrderDetails&) = default;
};

/// A request that takes effect between two steps, for robots of any host or for obstacles.
struct WorldInput {
  /// kObstacle is handled by the authority and never reaches a host, see WorldStep::obstacles.
  /// kPlace reaches hosts after the authority has done it.
  enum class Kind : std::uint8_t {
    kStop,
    kRelease,
    kArm,
    kChange,
    kObstacle,
    kDrive,   ///< Drives a robot instead of its program.
    kGoal,    ///< A goal.
    kPath,    ///< A path to follow.
    kCancel,  ///< Cancels orders. Without a robot: all orders.
    kText,    ///< A text for the program.
    kPlace,   ///< Places a simulated robot elsewhere.
  };
  /// Number of the input in the run, from 1; set by the WorldAuthority.
  std::uint64_t sequence = 0;
  Kind kind = Kind::kStop;
  Author author;
  RobotId robot;  ///< None: all robots. Required for kChange and for orders except kCancel.
  std::vector<ParameterChange> changes;    ///< kChange: applied all or none.
  std::optional<ObstacleChange> obstacle;  ///< kObstacle: required.
  OrderDetails order;                      ///< Used for orders.
};

/// Whether an input is an order: kDrive to kPlace.
[[nodiscard]] constexpr bool is_order(WorldInput::Kind kind) noexcept {
  return kind >= WorldInput::Kind::kDrive && kind <= WorldInput::Kind::kPlace;
}

/// Why an input was refused.
struct InputRefusal {
  std::uint64_t sequence = 0;  ///< WorldInput::sequence.
  std::string text;            ///< The reason, for people.
};

}  // namespace rave::sim
