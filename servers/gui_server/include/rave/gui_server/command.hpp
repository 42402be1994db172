// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rave/control/run_control.hpp"
#include "rave/math/pose.hpp"

// Requests of users for robots and obstacles. Plain values; SI units, frame W, angles in radians.
namespace rave::gui_server {

/// Largest number of robots in one message.
inline constexpr std::size_t kMostCommanded = 2000;

/// The sender of a request, as the run names it.
struct Author {
  std::string name;
  bool overrides = false;  ///< A super-user, who needs no lease.
  std::uint64_t page = 0;  ///< Id of the sender's page, because pages of a user do not share
                           ///< leases; not 0 for a page.
  friend bool operator==(const Author&, const Author&) = default;
};

/// One request of a user to the run, for several robots at once: an order, or one about leases,
/// parameters, obstacles, hand-overs or shadows.
struct CommandMessage {
  request::Action action;
  /// Of a goal or a place, if each robot has its own: the points, in the order of `slots`.
  std::vector<Vec2> points = {};
  std::uint32_t request = 0;  ///< Number chosen by the page; repeated in the answer.
  std::vector<std::uint32_t>
      slots;  ///< Robots: 1 to kMostCommanded, without duplicates; empty for obstacles.

  /// The action if it is this one; nullptr for any other.
  template <class One>
  [[nodiscard]] const One* as() const noexcept {
    return std::get_if<One>(&action);
  }
  template <class... One>
  [[nodiscard]] bool is() const noexcept {
    return (std::holds_alternative<One>(action) || ...);
  }
  /// What is asked of the robot at place `i` of `slots`.
  [[nodiscard]] request::Action action_for(std::size_t i) const;
  [[nodiscard]] std::string_view name() const noexcept { return request::name_of(action); }
  [[nodiscard]] bool of_obstacle() const noexcept { return is<request::Edit>(); }
  [[nodiscard]] bool stands() const noexcept {
    const auto* const drive = as<request::Drive>();
    return drive != nullptr && drive->stands();
  }
  friend bool operator==(const CommandMessage&, const CommandMessage&) = default;
};

/// The lease of a robot, and the orders that it takes.
struct DriveState {
  std::uint32_t slot = 0;
  std::string lease;               ///< Holder of the lease; empty: none.
  std::vector<std::string> takes;  ///< Some of drive, goal, path, text, place.
  std::string order;               ///< The current order, such as `goal 1.20, 3.40`; empty: none.
  std::uint64_t page = 0;          ///< Page of the holder; 0: no particular one.
  /// For a robot with two sets of drivers: the state of hand-overs, without the pose, and whether
  /// the simulated set is active.
  std::optional<runtime::RunStatus::HandOver> hand_over = std::nullopt;
  bool simulated = true;
  std::optional<runtime::RunStatus::Shadow> shadow = std::nullopt;  ///< Rounded.
  /// Parameters that were changed during the run: values by key, as JSON.
  std::map<std::string, std::string> values = {};

  /// Whether the lease belongs to this author's page.
  [[nodiscard]] bool is_of(const Author& author) const {
    return !lease.empty() && lease == author.name && (page == 0 || page == author.page);
  }
  friend bool operator==(const DriveState&, const DriveState&) = default;
};

}  // namespace rave::gui_server
