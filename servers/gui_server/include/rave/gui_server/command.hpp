// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/control/run_control.hpp"
#include "rave/math/pose.hpp"

// What people ask of robots and of obstacles. Plain values; SI units, frame W, angles in radians.
namespace rave::gui_server {

/// So many robots are meant by one message, at most.
inline constexpr std::size_t kMostCommanded = 2000;
/// So long a text to a robot or a person is, bytes of UTF-8.
inline constexpr std::size_t kLongestText = 1000;

/// Who asks, as the run names them.
struct Author {
  std::string name;
  bool overrides = false;  ///< A super-user, who needs no lease.
  std::uint64_t page = 0;  ///< Which of their pages: these do not share leases. Not 0 for a page.
  friend bool operator==(const Author&, const Author&) = default;
};

/// One request of a person. Which members count depends on the kind.
struct CommandMessage {
  enum class Kind : std::uint8_t {
    kDrive,        ///< `v_mps` and `w_radps`, for 250 ms.
    kGoal,         ///< `points`: one for all, or one for each robot; `yaw_rad`, `speed_mps`.
    kPath,         ///< `points`, `speed_mps`.
    kCancel,       ///< What is under way.
    kText,         ///< `value`.
    kPlace,        ///< `points`: one for each robot; `yaw_rad`.
    kTake,         ///< The lease; `value`: empty, or `force`.
    kGive,         ///< The lease; `value`: to whom, or empty: back.
    kSet,          ///< The parameter `key` becomes `value`.
    kAdd,          ///< An obstacle; `value`: YAML.
    kMove,         ///< The same; `key`: its name.
    kRemove,       ///< The obstacle `key`.
    kHandOver,     ///< To the drivers `value`: `real`, `simulated`, `first` or `twin`.
    kResetShadow,  ///< Puts the simulated twin where the robot is.
  };
  Kind kind = Kind::kDrive;
  std::uint32_t request = 0;  ///< The page's number for it, which the answer has.
  std::vector<std::uint32_t>
      slots;  ///< 1 to kMostCommanded, without repetitions; of obstacles none.
  std::vector<Vec2> points;
  std::optional<double> yaw_rad{};
  double v_mps = 0;
  double w_radps = 0;    ///< To the left.
  double speed_mps = 0;  ///< 0: as the robot likes.
  std::string key;
  std::string value;

  [[nodiscard]] bool of_obstacle() const noexcept {
    return kind == Kind::kAdd || kind == Kind::kMove || kind == Kind::kRemove;
  }
  [[nodiscard]] bool stands() const noexcept {
    return kind == Kind::kDrive && v_mps == 0 && w_radps == 0;
  }
  friend bool operator==(const CommandMessage&, const CommandMessage&) = default;
};

/// `drive`, `goal` and so on, as messages and answers say it.
[[nodiscard]] std::string_view to_string(CommandMessage::Kind kind) noexcept;

/// Who drives a robot, and what people may ask of it.
struct DriveState {
  std::uint32_t slot = 0;
  std::string lease;               ///< Who drives it; empty: nobody.
  std::vector<std::string> takes;  ///< Of drive, goal, path, text, place.
  std::string order;       ///< What is under way, such as `goal 1.20, 3.40`; empty: nothing.
  std::uint64_t page = 0;  ///< On which of their pages it is driven; 0: on none in particular.
  /// Of a robot with two sets of drivers: how hand-overs stand, without its place, and whether the
  /// simulated one serves.
  std::optional<runtime::RunStatus::HandOver> hand_over = std::nullopt;
  bool simulated = true;
  std::optional<runtime::RunStatus::Shadow> shadow = std::nullopt;  ///< Rounded.

  /// Whether it is this page that drives it.
  [[nodiscard]] bool is_of(const Author& author) const {
    return !lease.empty() && lease == author.name && (page == 0 || page == author.page);
  }
  friend bool operator==(const DriveState&, const DriveState&) = default;
};

}  // namespace rave::gui_server
