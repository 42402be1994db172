// SPDX-License-Identifier: Apache-2.0
#include "robot_guard.hpp"

#include <utility>

namespace rave::sim {

bool RobotGuard::stop() noexcept { return !std::exchange(holds_.stopped, true); }

bool RobotGuard::release(bool armed) noexcept {
  if (!std::exchange(holds_.stopped, false)) return false;
  holds_.armed = armed;
  return true;
}

bool RobotGuard::arm() noexcept { return !std::exchange(holds_.armed, true); }

Command RobotGuard::limit(const Command& command, CommandKind expected) const noexcept {
  return is_free() ? command : standing(expected);
}

GuardOutput RobotGuard::limit(const GuardSpec& limits, GuardInput input) const noexcept {
  if (holds_.held) return {standing(input.expected), 0};
  input.stopped = holds_.stopped;
  input.armed = holds_.armed;
  return guard(limits, input);
}

std::uint32_t RobotGuard::begin(std::uint32_t acted, std::int64_t now,
                                std::int64_t quiet) noexcept {
  std::uint32_t beginning = 0;
  for (std::uint32_t i = 0; i < kGuardLimits; ++i) {
    if ((acted >> i & 1U) == 0) continue;
    if (now - last_[i] > quiet) beginning |= 1U << i;
    last_[i] = now;
  }
  return beginning;
}

Command standing(CommandKind kind) noexcept {
  return kind == CommandKind::kVelocity ? velocity_command(0, 0) : Command{};
}

std::string_view text_of(GuardLimit limit) noexcept {
  switch (limit) {
    case GuardLimit::kStopped:
      return "stop: it was told to stand until it is released";
    case GuardLimit::kUnarmed:
      return "not armed: it stands until somebody arms it";
    case GuardLimit::kPoseLost:
      return "pose lost: nobody says where it is";
    case GuardLimit::kSensorLost:
      return "sensor lost: a sensor gives nothing any more";
    case GuardLimit::kWorldLost:
      return "world lost: the virtual world does not come any more";
    case GuardLimit::kWatchdog:
      return "watchdog: its program gives no commands any more";
    case GuardLimit::kBadCommand:
      return "bad command: not a number, or of a kind that cannot be guarded";
    case GuardLimit::kSpeed:
      return "speed: faster than it may";
    case GuardLimit::kTurn:
      return "turn rate: turns faster than it may";
    case GuardLimit::kFence:
      return "fence: it would leave its region";
    case GuardLimit::kSeparation:
      return "separation: it would come too near to another robot";
  }
  return "unknown";
}

EventKind event_of(GuardLimit limit, const GuardSpec& limits) noexcept {
  const bool slows = !stops(limit) || (limit == GuardLimit::kWorldLost &&
                                       limits.world_lost == WorldLostPolicy::kSlow);
  return slows ? EventKind::kGuardSlowed : EventKind::kGuardStopped;
}

}  // namespace rave::sim
