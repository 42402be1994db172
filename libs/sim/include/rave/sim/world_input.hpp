// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/request/order.hpp"
#include "rave/request/robot_action.hpp"
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

/// Changes parameters of a robot: all or none.
struct Change {
  std::vector<ParameterChange> changes{};
};

/// What takes effect between two steps, for robots of any host or for obstacles.
struct WorldInput {
  /// An ObstacleChange is handled by the authority and never reaches a host, see
  /// WorldStep::obstacles. An order to place a robot reaches hosts after the authority has done it.
  using Action = std::variant<request::Stop, request::Release, request::Arm, Change, ObstacleChange,
                              request::Order>;

  /// Number of the input in the run, from 1; set by the WorldAuthority.
  std::uint64_t sequence = 0;
  Action action;
  Author author;
  RobotId robot;  ///< None: all robots. Required for a change and for orders except to cancel.

  /// The action if it is this one, which may be a certain order; nullptr for any other.
  template <class One>
  [[nodiscard]] const One* as() const noexcept {
    if constexpr (request::IsOrder<One>) {
      const auto* const order = std::get_if<request::Order>(&action);
      return order != nullptr ? std::get_if<One>(order) : nullptr;
    } else {
      return std::get_if<One>(&action);
    }
  }
  template <class One>
  [[nodiscard]] bool is() const noexcept {
    return as<One>() != nullptr;
  }
  /// Whether it changes what holds a robot: a stop, a release or an arming.
  [[nodiscard]] bool is_hold() const noexcept {
    return is<request::Stop>() || is<request::Release>() || is<request::Arm>();
  }
};

/// Why an input was refused.
struct InputRefusal {
  std::uint64_t sequence = 0;  ///< WorldInput::sequence.
  std::string text;            ///< The reason, for people.
};

}  // namespace rave::sim
