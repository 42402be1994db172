// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

// What concerns robots and is no order.
namespace rave::request {

/// The robot stands until it is released. Without a robot: all.
struct Stop {
  static constexpr std::string_view kName = "stop";
  friend bool operator==(const Stop&, const Stop&) = default;
};

/// Ends a stop. Without a robot: of all.
struct Release {
  static constexpr std::string_view kName = "release";
  friend bool operator==(const Release&, const Release&) = default;
};

/// A real robot may move. Without a robot: all.
struct Arm {
  static constexpr std::string_view kName = "arm";
  friend bool operator==(const Arm&, const Arm&) = default;
};

/// Changes a parameter of a robot.
struct Set {
  static constexpr std::string_view kName = "set";
  std::string key{};    ///< Such as `program.max_speed_mps`.
  std::string value{};  ///< As in a file.
  friend bool operator==(const Set&, const Set&) = default;
};

/// Changes the drivers of a robot.
struct HandOver {
  static constexpr std::string_view kName = "hand_over";
  std::string to{};  ///< `real`, `simulated`, `first` or `twin`.
  friend bool operator==(const HandOver&, const HandOver&) = default;
};

/// Puts a shadow where its robot is. Without a robot: all.
struct ResetShadow {
  static constexpr std::string_view kName = "reset_shadow";
  friend bool operator==(const ResetShadow&, const ResetShadow&) = default;
};

/// Takes the lease of a robot.
struct Take {
  static constexpr std::string_view kName = "take";
  bool force = false;  ///< Takes it over from another person.
  /// Refused also while the stick of this page is held: for ways on which a drive has no answer.
  bool drives = false;
  friend bool operator==(const Take&, const Take&) = default;
};

/// Gives the lease of a robot to another person, or back.
struct Give {
  static constexpr std::string_view kName = "give";
  std::string to{};  ///< Empty: back.
  friend bool operator==(const Give&, const Give&) = default;
};

}  // namespace rave::request
