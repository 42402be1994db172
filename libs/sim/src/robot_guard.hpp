// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "rave/sim/event.hpp"
#include "rave/sim/guard.hpp"

namespace rave::sim {

/// What makes a robot stand, whatever is commanded.
struct GuardHolds {
  bool stopped = false;  ///< A stop request stopped it; latched.
  bool armed = true;
  bool held = false;  ///< It is being handed over.

  friend bool operator==(const GuardHolds&, const GuardHolds&) = default;
};

/// The guard of one robot: what it remembers from command to command. The limits themselves are
/// those of guard(). Knows no clock: moments are counted by the caller, in steps or nanoseconds.
/// One thread at a time.
class RobotGuard {
 public:
  explicit RobotGuard(GuardHolds holds = {}) noexcept : holds_(holds) { last_.fill(kNever); }

  [[nodiscard]] const GuardHolds& holds() const noexcept { return holds_; }
  void set_holds(const GuardHolds& holds) noexcept { holds_ = holds; }
  /// False: it was stopped already.
  bool stop() noexcept;
  /// Ends a stop; `armed`: it need not be armed anew. False: it was not stopped.
  bool release(bool armed) noexcept;
  /// False: it was armed already.
  bool arm() noexcept;
  /// False: it was not armed.
  bool disarm() noexcept;
  void set_armed(bool armed) noexcept { holds_.armed = armed; }
  void hold(bool held) noexcept { holds_.held = held; }

  /// Whether a robot without limits executes commands.
  [[nodiscard]] bool is_free() const noexcept { return !holds_.held && !holds_.stopped; }
  /// The command that a robot without limits gets.
  [[nodiscard]] Command limit(const Command& command, CommandKind expected,
                              const ActuatorDrive& drive = {}) const noexcept;
  /// The command that a robot with limits gets. `stopped` and `armed` of the input do not count.
  /// `touching` is that of the last motion, `fastest_mps` is known here.
  [[nodiscard]] GuardOutput limit(const GuardSpec& limits, GuardInput input) noexcept;

  /// Takes note of the limits that acted at a moment. Returns those that begin to act: they had
  /// not acted for longer than `quiet`.
  [[nodiscard]] std::uint32_t begin(std::uint32_t acted, std::int64_t now,
                                    std::int64_t quiet) noexcept;

 private:
  void recall(GuardInput& input) noexcept;
  void remember(const Twist2& told) noexcept;

  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min() / 2;

  GuardHolds holds_;
  std::array<std::int64_t, kGuardLimits> last_{};  ///< When each limit acted last.
  SimTime pose_stamp_;
  double fastest_mps_ = 0;  ///< Of what was told since that pose.
  double told_mps_ = 0;     ///< Last, either way.
  bool touching_ = false;
  bool stands_ = true;  ///< As it was told last.
};

/// A limit that has not acted for so long begins anew when it acts again.
inline constexpr double kGuardQuiet_s = 0.5;

/// For people: what a limit does.
[[nodiscard]] std::string_view text_of(GuardLimit limit) noexcept;
/// Which event it is when a limit begins to act.
[[nodiscard]] EventKind event_of(GuardLimit limit, const GuardSpec& limits) noexcept;

}  // namespace rave::sim
