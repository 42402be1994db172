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

/// Who asks something of a run.
struct Author {
  bool by_hand = true;  ///< Somebody, while it goes: the run is not the scenario's any more.
  std::string name{};   ///< By hand: of the person; empty: whoever sits at the machine.

  static const Author kRun;   ///< It belongs to the run, as what its scenario says.
  static const Author kHand;  ///< Somebody without a name.
  friend bool operator==(const Author&, const Author&) = default;
};
inline const Author Author::kRun{false, {}};
inline const Author Author::kHand{true, {}};

/// `by hand`, or with the name of the person: `by hand: anna`.
[[nodiscard]] std::string by_hand_text(const Author& author);
/// Whether the text of an event says that somebody asked for it by hand.
[[nodiscard]] bool says_by_hand(std::string_view text) noexcept;

/// The details of an order; which of them count is said by the kind of the input.
struct OrderDetails {
  std::vector<Vec2> points_W;     ///< kGoal and kPlace: one. kPath: 2 to kMostOrderPoints. m.
  std::optional<double> yaw_rad;  ///< kGoal, kPlace; none: as it comes.
  double v_mps = 0;               ///< kDrive: forward.
  double w_radps = 0;             ///< kDrive: to the left.
  double speed_mps = 0;           ///< kGoal, kPath: the largest; 0: as the robot likes.
  std::string text;               ///< kText.
  friend bool operator==(const OrderDetails&, const OrderDetails&) = default;
};

/// Something asked of a run between two steps, of its robots wherever they run or of its obstacles.
struct WorldInput {
  /// kObstacle is the authority's own: it never reaches a host, see WorldStep::obstacles. kPlace
  /// reaches hosts when the authority has done it.
  enum class Kind : std::uint8_t {
    kStop,
    kRelease,
    kArm,
    kChange,
    kObstacle,
    kDrive,   ///< Drives a robot in the place of its program.
    kGoal,    ///< A place to go to.
    kPath,    ///< A line to follow.
    kCancel,  ///< Ends what people have asked. Without a robot: of all.
    kText,    ///< Words for the program.
    kPlace,   ///< Puts a simulated robot elsewhere.
  };
  /// Counts all inputs of a run from 1; given by the WorldAuthority.
  std::uint64_t sequence = 0;
  Kind kind = Kind::kStop;
  Author author;
  RobotId robot;  ///< None: all robots; kChange and orders but kCancel need one.
  std::vector<ParameterChange> changes;    ///< Of kChange: all of them, or none.
  std::optional<ObstacleChange> obstacle;  ///< Of kObstacle, which needs it.
  OrderDetails order;                      ///< Of orders.
};

/// Whether an input is an order: kDrive to kPlace.
[[nodiscard]] constexpr bool is_order(WorldInput::Kind kind) noexcept {
  return kind >= WorldInput::Kind::kDrive && kind <= WorldInput::Kind::kPlace;
}

/// Why an input was not carried out.
struct InputRefusal {
  std::uint64_t sequence = 0;  ///< Of the WorldInput.
  std::string text;            ///< For people.
};

}  // namespace rave::sim
