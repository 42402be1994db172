// SPDX-License-Identifier: Apache-2.0
// The limits as a pure function of a command and of what is known of the robot: no clock, no
// memory, no allocation. So the same code serves stepped runs and the guard threads. The formulas
// are in docs/explanation/guard.md.
#include "rave/sim/guard.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "guard_fence.hpp"
#include "rave/math/finite.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/world/touching.hpp"

namespace rave::sim {
namespace {

/// No robot on wheels does more; what asks for more is brought down to this before its way is
/// predicted.
constexpr double kSaneTurn_radps = 50;
constexpr double kSaneWay_m = 20;
/// Slower than this, limited, is a stop.
constexpr double kCrawl_mps = 1e-4;
/// A robot that is measured to drive faster than this is not standing.
constexpr double kMoving_mps = 0.02;
/// 2^-16 of any sane speed is near kCrawl_mps: more halvings would find nothing that drives.
constexpr int kHalvings = 16;
/// Spacing at which distances to other robots are looked at.
constexpr double kLook_m = 2e-3;

constexpr std::uint32_t bit(GuardLimit limit) noexcept {
  return 1U << static_cast<std::uint32_t>(limit);
}

Twist2 scaled(const Twist2& drive, double share) noexcept {
  return {share * drive.vx, share * drive.vy, share * drive.wz};
}

/// All scaled until the speed is within `limit`: the curve stays.
bool cap_speed(Twist2& drive, double limit) noexcept {
  const double size = speed_of(drive);
  if (!(size > limit)) return false;
  drive = scaled(drive, limit / size);
  // limit / size * size may exceed the limit by a bit.
  drive.vx = std::clamp(drive.vx, -limit, limit);
  return true;
}

/// The same for the turning rate.
bool cap_turn(Twist2& drive, double limit) noexcept {
  const double size = std::abs(drive.wz);
  if (!(size > limit)) return false;
  drive = scaled(drive, limit / size);
  drive.wz = std::clamp(drive.wz, -limit, limit);
  return true;
}

/// The largest speed from which a robot stands after kSaneWay_m.
double sane_speed_mps(double delay_s, double deceleration_mps2) noexcept {
  const double a = deceleration_mps2;
  // Solves v t + v^2 / (2 a) = s for v.
  return std::sqrt(a * a * delay_s * delay_s + 2 * a * kSaneWay_m) - a * delay_s;
}

/// What decides about motion: fence and separation, for any velocity that might be commanded.
class Motion {
 public:
  Motion(const GuardSpec& spec, const GuardInput& in) : spec_(spec), in_(in) {
    if (!spec.fence_W.empty()) {
      clearance_m_ = inside_distance(spec.fence_W, in.X_WR.position()) - in.radius_m;
    }
  }

  /// The limits that forbid a drive.
  [[nodiscard]] std::uint32_t forbidding(const Twist2& drive) const noexcept {
    const double speed = speed_of(drive);
    const double way_m =
        speed * (in_.dt_s + spec_.reaction_s) + blind_way_m(drive) + braking_way_m(speed);
    std::uint32_t limits = forbidding(drive, way_m);
    if (!in_.drive.is_plain()) limits |= forbidding(lagging(drive), way_m, false);
    return limits;
  }

  /// The limits that the robot would breach if it were not told to brake now.
  [[nodiscard]] std::uint32_t braking_needed() const noexcept {
    const Twist2 now = in_.drive.own(in_.velocity);
    // The measured velocity, whatever was commanded: after a push or a slide it can be higher.
    const double speed = speed_of(now);
    if (!(speed > kMoving_mps)) return 0;
    // A little less than what was allowed, or rounding would make it brake at each limit.
    // Without the step in_.dt_s: the stop would be commanded now, not after one more step.
    const double way = speed * spec_.reaction_s + blind_way_m(now) + braking_way_m(speed);
    return forbidding(now, 0.99 * way - 1e-4, false);
  }

 private:
  /// The steering of a car takes time, and so does a change of direction. Until then the robot
  /// moves as it does now, though as fast as `drive`, if that is the same way.
  [[nodiscard]] Twist2 lagging(const Twist2& drive) const noexcept {
    const Twist2 now = in_.drive.own(in_.velocity);
    const double speed = speed_of(now);
    if (!(speed > kMoving_mps)) return {};
    const bool same = drive.vx * now.vx + drive.vy * now.vy > 0;
    const double wanted = speed_of(drive);
    return scaled(now, same ? wanted / speed : std::min(wanted / speed, 1.0));
  }
  [[nodiscard]] double braking_way_m(double speed_mps) const noexcept {
    return speed_mps * speed_mps / (2 * spec_.deceleration_mps2);
  }
  /// What it may have gone since its pose was taken.
  [[nodiscard]] double blind_way_m(const Twist2& drive) const noexcept {
    // The speed since the pose is unknown; each of the three is a speed that it may have had.
    return in_.pose_age_s *
           std::max({speed_of(drive), speed_of(in_.drive.own(in_.velocity)), in_.fastest_mps});
  }
  /// Whether a drive takes it away from the fence by half of its way at least.
  [[nodiscard]] bool leads_inward(const GuardPath& path, double way_m) const noexcept {
    const double later_m = inside_distance(spec_.fence_W, path.at(way_m).position());
    return later_m - in_.radius_m >= clearance_m_ + 0.5 * way_m;
  }

  [[nodiscard]] std::uint32_t forbidding(const Twist2& drive, double way_m,
                                         bool commanded = true) const noexcept {
    std::uint32_t limits = 0;
    const GuardPath path{in_.X_WR, drive, std::max(way_m, 0.0)};
    if (!spec_.fence_W.empty()) {
      const double step_m = speed_of(drive) * in_.dt_s;
      // After a contact the body may slide along an obstacle, where no arc leads. So the next step
      // may use up the clearance at most, in any direction.
      const bool slides = commanded && in_.touching && step_m > std::max(clearance_m_, 0.0) &&
                          !leads_inward(path, step_m);
      if (slides || !stays_inside(spec_.fence_W, path, in_.radius_m)) {
        limits |= bit(GuardLimit::kFence);
      }
    }
    if (!in_.neighbours.empty() && !keeps_apart(drive, path.length_m)) {
      limits |= bit(GuardLimit::kSeparation);
    }
    return limits;
  }

  /// The robot may come no nearer to anybody than the limit, or than it would by standing.
  [[nodiscard]] bool keeps_apart(const Twist2& drive, double way_m) const noexcept {
    const double speed = speed_of(drive);
    const double turning = std::abs(drive.wz);
    // A robot that only turns does so until it has obeyed the next command.
    const double time_s = speed > 0 ? way_m / speed : in_.dt_s + spec_.reaction_s;
    for (const GuardNeighbour& other : in_.neighbours) {
      const double other_mps = std::sqrt(other.velocity_W.vx * other.velocity_W.vx +
                                         other.velocity_W.vy * other.velocity_W.vy);
      // No distance shrinks faster than this. So a clearance of c m holds for c / closing_mps, and
      // that time can be left out (conservative advancement).
      const double closing_mps = speed + turning * in_.radius_m + other_mps;
      if (closing_mps <= 0) continue;
      for (double t_s = 0; t_s < time_s;) {
        t_s = std::min(t_s + kLook_m / closing_mps, time_s);
        const double clear_m = worst_m(drive, other, t_s);
        // A distance that is not a number forbids, too.
        if (!(clear_m >= 0)) return false;
        t_s += std::max(0.0, clear_m / closing_mps - kLook_m / closing_mps);
      }
    }
    return true;
  }

  /// Distance above what is allowed after `t_s`, whether the other one stands or continues for as
  /// long as it takes to obey.
  [[nodiscard]] double worst_m(const Twist2& drive, const GuardNeighbour& other,
                               double t_s) const noexcept {
    const Pose2 X_later = integrate(in_.X_WR, drive, t_s);
    Pose2 X_WB = other.X_WB;
    double worst = above_limit(X_later, other, X_WB);
    // The other is extrapolated for as long as this robot needs to obey, not longer: the guard
    // looks again before that.
    const double ahead_s = std::min(t_s, in_.dt_s + spec_.reaction_s);
    X_WB.x += ahead_s * other.velocity_W.vx;
    X_WB.y += ahead_s * other.velocity_W.vy;
    return std::min(worst, above_limit(X_later, other, X_WB));
  }

  [[nodiscard]] double above_limit(const Pose2& X_later, const GuardNeighbour& other,
                                   const Pose2& X_WB) const noexcept {
    const auto apart_m = [&](const Pose2& X_WR) {
      return world::separation(*in_.body, X_WR, *other.body, X_WB).distance_m;
    };
    const double later_m = apart_m(X_later);
    if (later_m >= spec_.separation_m) return later_m - spec_.separation_m;
    // Nearer than allowed: only what takes it no nearer than it is now.
    return later_m - std::min(apart_m(in_.X_WR), spec_.separation_m);
  }

  const GuardSpec& spec_;
  const GuardInput& in_;
  double clearance_m_ = 0;
};

/// The fastest drive between standing and `wanted` that is allowed: slower with the turning kept,
/// so that the robot can turn away, or if turning is what is forbidden, slower on the same curve.
Twist2 slowed(const Motion& motion, const ActuatorDrive& by, const Twist2& wanted) noexcept {
  const Twist2 turn{0, 0, wanted.wz};
  // A car does not turn on the spot.
  const bool turns = by.is_plain() || by.motion(by.command(turn)) == turn;
  const bool may_turn = turns && motion.forbidding(turn) == 0;
  const auto at = [&](double share) {
    return may_turn ? Twist2{share * wanted.vx, share * wanted.vy, wanted.wz}
                    : scaled(wanted, share);
  };
  // Slower is safer along the same curve, so the allowed shares are an interval from 0.
  double low = 0;
  double high = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (motion.forbidding(at(middle)) == 0 ? low : high) = middle;
  }
  Twist2 drive = at(low);
  if (speed_of(drive) < kCrawl_mps) drive = may_turn ? at(0) : Twist2{};
  return drive;
}

std::uint32_t limit_motion(const GuardSpec& spec, const GuardInput& in, Twist2& drive) noexcept {
  const bool fenced = !spec.fence_W.empty();
  if ((!fenced && in.neighbours.empty()) || drive == Twist2{}) return 0;
  std::uint32_t acted = 0;
  // Commands far beyond any robot would make the predicted way, and so this function, too long.
  const double delay_s = in.dt_s + spec.reaction_s + in.pose_age_s;
  if (cap_speed(drive, sane_speed_mps(delay_s, spec.deceleration_mps2))) {
    acted |= bit(GuardLimit::kSpeed);
  }
  if (cap_turn(drive, kSaneTurn_radps)) acted |= bit(GuardLimit::kTurn);
  const Motion motion(spec, in);
  const std::uint32_t braking = motion.braking_needed();
  // A command to stand or to drive back brakes by itself and may lead away from the limit.
  const Twist2 now = in.drive.own(in.velocity);
  if (braking != 0 && drive.vx * now.vx + drive.vy * now.vy > 0) {
    drive = {};
    return acted | braking;
  }
  const std::uint32_t forbidding = motion.forbidding(drive);
  if (forbidding == 0) return acted;
  drive = slowed(motion, in.drive, drive);
  return acted | forbidding;
}

/// The first sensor that is older than it may be; the end of `in.sensors` if there is none.
auto first_lost(const GuardInput& in) noexcept {
  return std::find_if(in.sensors.begin(), in.sensors.end(), [](const GuardSensor& sensor) {
    return !(sensor.age_s <= sensor.max_age_s);
  });
}

/// Why the robot has to stand; empty: it need not.
std::optional<GuardLimit> hold_reason(const GuardSpec& spec, const GuardInput& in) noexcept {
  // The order decides which reason is reported: first what people did, then what the robot lacks.
  // Comparisons are negated so that an age that is not a number counts as too old.
  if (in.stopped) return GuardLimit::kStopped;
  if (!in.armed) return GuardLimit::kUnarmed;
  if (!in.pose_known) return GuardLimit::kPoseLost;
  if (first_lost(in) != in.sensors.end()) return GuardLimit::kSensorLost;
  if (in.frozen_sensor) return GuardLimit::kFrozen;
  if (spec.world_lost == WorldLostPolicy::kStop && !(in.world_age_s <= spec.world_timeout_s)) {
    return GuardLimit::kWorldLost;
  }
  if (!(in.command_age_s <= spec.watchdog_s)) return GuardLimit::kWatchdog;
  if (in.command.kind != CommandKind::kNone &&
      (in.command.kind != in.expected || in.command.kind == CommandKind::kGoal ||
       !is_finite(in.command.value))) {
    return GuardLimit::kBadCommand;
  }
  return std::nullopt;
}

}  // namespace

double guard_reach_m(const GuardSpec& spec, const GuardInput& input) noexcept {
  const double delay_s = input.dt_s + spec.reaction_s + input.pose_age_s;
  const double sane_mps = sane_speed_mps(delay_s, spec.deceleration_mps2);
  const double speed_mps =
      std::clamp(std::max({speed_of(input.drive.motion(input.command)),
                           speed_of(input.drive.own(input.velocity)), input.fastest_mps}),
                 0.0, sane_mps);
  // NaN is clamped to itself; such a command goes nowhere.
  const double way_m =
      std::isfinite(speed_mps)
          ? speed_mps * delay_s + speed_mps * speed_mps / (2 * spec.deceleration_mps2)
          : 0;
  return std::max(spec.separation_m, 0.0) + way_m;
}

GuardOutput guard(const GuardSpec& spec, const GuardInput& input) noexcept {
  const bool moves_robot = input.drive.moves(input.expected);
  GuardOutput output;
  if (const auto reason = hold_reason(spec, input)) {
    output.command = input.drive.standing(input.expected);
    const auto asks = [](double value) { return value != 0; };
    // A limit acts, and is an event, only if it changes something: not for a robot that stands
    // anyway.
    const bool moves =
        input.command.kind != CommandKind::kNone &&
        std::any_of(std::begin(input.command.value), std::end(input.command.value), asks);
    if (moves) output.acted = bit(*reason);
    const auto lost = first_lost(input);
    if (lost != input.sensors.end()) output.lost_sensor = lost->index;
    return output;
  }
  output.command = input.command;
  if (!moves_robot || input.command.kind == CommandKind::kNone) return output;
  const Twist2 wanted = input.drive.motion(input.command);
  // Plain caps first: what fence and separation have to predict is then already slower.
  Twist2 drive = wanted;
  if (cap_speed(drive, spec.max_speed_mps)) output.acted |= bit(GuardLimit::kSpeed);
  if (cap_turn(drive, spec.max_turn_radps)) output.acted |= bit(GuardLimit::kTurn);
  const bool slow =
      spec.world_lost == WorldLostPolicy::kSlow && !(input.world_age_s <= spec.world_timeout_s);
  if (slow && cap_speed(drive, spec.slow_speed_mps)) {
    output.acted |= bit(GuardLimit::kWorldLost);
  }
  // It may turn, and then it sees.
  if (drive.vx > 0 ? input.is_blind_ahead : drive.vx < 0 && input.is_blind_behind) {
    drive.vx = 0;
    output.acted |= bit(GuardLimit::kBlind);
  }
  output.acted |= limit_motion(spec, input, drive);
  // Not the way there and back if nothing was limited: that of a car rounds.
  if (input.drive.is_plain() || drive != wanted) output.command = input.drive.command(drive);
  return output;
}

}  // namespace rave::sim
