// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::runtime {

/// Sticks that are held although their robot does not follow them: it was refused, or a stop or a
/// silence has ended their drive. Their velocities do not count until they are neutral, so a robot
/// does not leap when it is armed or released, or when its driver is heard again. Uses wall time,
/// passed by the caller. One thread.
class HeldSticks {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// A silence that lasts longer after its notice ends the drive; a shorter one is a slow link.
  static constexpr std::chrono::milliseconds kSlowLink{800};
  /// A sender without a page, such as a script, drives anew after a silence of this duration.
  static constexpr std::chrono::seconds kForgotten{1};

  /// What drives a robot: a page of a person, or a terminal.
  struct Stick {
    std::string robot;
    std::string by;
    std::uint64_t page = 0;  ///< 0: a sender without a page.
    friend bool operator==(const Stick&, const Stick&) = default;
  };
  enum class Use {
    kCounts,  ///< The velocity counts.
    kFreed,   ///< The stick was held and is neutral now; there is nothing more to do.
  };

  /// The robot has not followed the stick, for the reason `why`.
  void hold(Stick stick, std::string why, Time now);
  /// A silence of the stick is noticed. A sender without a page may come and go.
  void silent(Stick stick, Time now);
  /// Its next velocity counts.
  void forget(const Stick& stick);
  /// Judges a velocity of the stick. Error kState: the stick is held.
  Result<Use> use(const Stick& stick, bool neutral, Time now);

 private:
  struct Held {
    Stick stick;
    std::string why;  ///< Empty: it was silent.
    Time heard;       ///< Of a silent one: when the silence was noticed.
  };
  void keep(Held held);

  std::vector<Held> held_;  ///< The oldest first.
};

}  // namespace rave::runtime
