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

/// One request of a user to the run, for several robots at once: an order, a lease, kSet, kEdit,
/// kHandOver or kResetShadow. `robot`, `by`, `overrides` and `page` are left to the server. kPlace
/// has one point for each robot, kGoal too or one for all.
struct CommandMessage : runtime::RunRequest {
  std::uint32_t request = 0;  ///< Number chosen by the page; repeated in the answer.
  std::vector<std::uint32_t>
      slots;  ///< Robots: 1 to kMostCommanded, without duplicates; empty for obstacles.

  [[nodiscard]] bool of_obstacle() const noexcept { return kind == Kind::kEdit; }
  [[nodiscard]] bool stands() const noexcept {
    return kind == Kind::kDrive && v_mps == 0 && w_radps == 0;
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
