// SPDX-License-Identifier: Apache-2.0
// What the guard of one robot remembers: stopped or armed, how fast it was told to drive, and which
// limits act at present.
#include "robot_guard.hpp"

#include <algorithm>
#include <utility>

namespace rave::sim {

bool RobotGuard::stop() noexcept { return !std::exchange(holds_.stopped, true); }

bool RobotGuard::release(bool armed) noexcept {
  if (!std::exchange(holds_.stopped, false)) return false;
  // A robot that has to be armed has to be armed again after a stop.
  holds_.armed = armed;
  return true;
}

bool RobotGuard::arm() noexcept { return !std::exchange(holds_.armed, true); }

bool RobotGuard::disarm() noexcept { return std::exchange(holds_.armed, false); }

Command RobotGuard::limit(const Command& command, CommandKind expected,
                          const ActuatorDrive& drive) const noexcept {
  return is_free() ? command : drive.standing(expected);
}

GuardOutput RobotGuard::limit(const GuardSpec& limits, GuardInput input) noexcept {
  recall(input);
  input.stopped = holds_.stopped;
  input.armed = holds_.armed;
  const GuardOutput output =
      holds_.held ? GuardOutput{input.drive.standing(input.expected), 0} : guard(limits, input);
  if (input.drive.moves(input.expected)) remember(input.drive.motion(output.command));
  return output;
}

/// What the way since the pose depends on, and whether it still stands where it was stopped by
/// something.
void RobotGuard::recall(GuardInput& input) noexcept {
  // Since a new pose only the last command has been driven; the faster ones before are in the pose.
  if (input.pose_stamp != pose_stamp_) fastest_mps_ = told_mps_;
  pose_stamp_ = input.pose_stamp;
  input.fastest_mps = fastest_mps_;
  touching_ = input.touching || (touching_ && stands_);
  input.touching = touching_;
}

void RobotGuard::remember(const Twist2& told) noexcept {
  told_mps_ = speed_of(told);
  stands_ = told == Twist2{};
  fastest_mps_ = std::max(fastest_mps_, told_mps_);
}

std::uint32_t RobotGuard::begin(std::uint32_t acted, std::int64_t now,
                                std::int64_t quiet) noexcept {
  std::uint32_t beginning = 0;
  for (std::uint32_t i = 0; i < kGuardLimits; ++i) {
    if ((acted >> i & 1U) == 0) continue;
    // Each time counts as the last one, so a limit that flickers is one event until it rests.
    if (now - last_[i] > quiet) beginning |= 1U << i;
    last_[i] = now;
  }
  return beginning;
}

std::string_view text_of(GuardLimit limit) noexcept {
  constexpr std::array<std::string_view, kGuardLimits> kTexts = {
      "stop: it stands until it is released",
      "not armed: it stands until it is armed",
      "pose lost: its pose is not reported",
      "sensor lost: a sensor gives no samples",
      "world lost: no updates of the virtual world",
      "watchdog: its program gives no commands",
      "bad command: not finite, or of a kind that cannot be guarded",
      "speed: above its limit",
      "turn rate: above its limit",
      "fence: it would leave its region",
      "separation: it would come too close to another robot",
      "frozen: a sensor repeats itself although the robot is commanded to move",
      "blind: its range sensors do not see where it would drive",
  };
  return kTexts[static_cast<std::size_t>(limit)];
}

std::string_view to_string(GuardLimit limit) noexcept {
  const std::string_view text = text_of(limit);
  return text.substr(0, text.find(':'));
}

EventKind event_of(GuardLimit limit, const GuardSpec& limits) noexcept {
  const bool slows = !stops(limit) || (limit == GuardLimit::kWorldLost &&
                                       limits.world_lost == WorldLostPolicy::kSlow);
  return slows ? EventKind::kGuardSlowed : EventKind::kGuardStopped;
}

}  // namespace rave::sim
