// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "rave/math/scalar.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "rave/robot/sight.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("cruise_mps", "m/s", 0.4, 0, 10, "Speed while nothing is near."),
    number_param("avoid_m", "m", 0.7, 0, 100, "Distance ahead below which it turns."),
    number_param("stop_m", "m", 0.35, 0, 100, "Distance ahead below which it turns on the spot."),
    number_param("creep_mps", "m/s", 0.05, 0, 10, "Speed while it turns."),
    number_param("turn_radps", "rad/s", 0.8, 0.01, 10, "Turning rate while avoiding."),
    number_param("front_deg", "deg", 50, 1, 180, "Half of the angle that counts as ahead."),
    integer_param("turn_decisions_min", 5, 1, 10'000, "Shortest turn, in decisions."),
    integer_param("turn_decisions_max", 14, 1, 10'000, "Longest turn, in decisions."),
};

/// The rays of a sensor that point ahead, as one row of ascending bearings: [first, right_end) to
/// the right, [right_end, left_begin) straight ahead, [left_begin, end) to the left.
struct FrontRays {
  std::uint32_t first = 0;
  std::uint32_t right_end = 0;
  std::uint32_t left_begin = 0;
  std::uint32_t end = 0;
};

// The rays ahead must be one ascending row, so that left, middle and right are three spans of the
// reading. Then a decision is three minima without a comparison of angles per ray.
Result<FrontRays> front_rays_of(const SensorInfo& sensor, double front_rad) {
  FrontRays rays;
  std::optional<double> last_rad;
  const std::uint32_t count = sensor.bearings_rad == nullptr ? 0 : sensor.capacity;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double bearing_rad = wrap_angle(sensor.X_RS.yaw + sensor.bearings_rad[i]);
    if (std::abs(bearing_rad) > front_rad) continue;
    if (!last_rad) rays = {i, i, i, i};
    if (i != rays.end || (last_rad && bearing_rad <= *last_rad)) {
      return fail(ErrorCode::kInvalidArgument,
                  "the rays of sensor `{}` within {:g} deg of the front are not one row from right "
                  "to left",
                  sensor.name, rad_to_deg(front_rad));
    }
    rays.end = i + 1;
    if (bearing_rad < 0) rays.right_end = rays.end;
    if (bearing_rad <= 0) rays.left_begin = rays.end;
    last_rad = bearing_rad;
  }
  if (last_rad) return rays;
  return fail(ErrorCode::kInvalidArgument,
              "no ray of sensor `{}` points within {:g} deg of the front", sensor.name,
              rad_to_deg(front_rad));
}

/// The least of the ranges; infinity if there are none. What is not a number does not count.
float nearest_of(std::span<const float> ranges_m) noexcept {
  constexpr float kNone_m = std::numeric_limits<float>::infinity();
  float nearest_m = kNone_m;
  std::size_t i = 0;
  // Of many several at a time, so that no comparison waits for the one before.
  constexpr std::size_t kLanes = 8;
  if (ranges_m.size() >= 2 * kLanes) {
    float least_m[kLanes];
    std::fill(std::begin(least_m), std::end(least_m), kNone_m);
    for (; i + kLanes <= ranges_m.size(); i += kLanes) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        // The comparison with NaN is false, so NaN keeps what was there.
        least_m[k] = ranges_m[i + k] < least_m[k] ? ranges_m[i + k] : least_m[k];
      }
    }
    nearest_m = *std::min_element(std::begin(least_m), std::end(least_m));
  }
  for (; i < ranges_m.size(); ++i) nearest_m = ranges_m[i] < nearest_m ? ranges_m[i] : nearest_m;
  return nearest_m;
}

/// Whether any of them is NaN.
bool any_unknown(std::span<const float> ranges_m) noexcept {
  unsigned unknown = 0;
  for (const float range_m : ranges_m) unknown |= std::isnan(range_m) ? 1U : 0U;
  return unknown != 0;
}

/// Drives straight on; turns to the freer side for a random time when something is near ahead.
class Cruise final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    RAVE_TRY_ASSIGN(laser_, setup.sensor<float>());
    return parameters_changed(setup.params());
  }

  Status parameters_changed(const Params& params) override {
    const std::int64_t shortest = params.integer("turn_decisions_min");
    const std::int64_t longest = params.integer("turn_decisions_max");
    if (longest < shortest) {
      return fail(ErrorCode::kInvalidArgument,
                  "`turn_decisions_max` ({}) must be at least `turn_decisions_min` ({})", longest,
                  shortest);
    }
    RAVE_TRY_ASSIGN(rays_, front_rays_of(laser_.info(), deg_to_rad(params.number("front_deg"))));
    cruise_mps_ = params.number("cruise_mps");
    avoid_m_ = static_cast<float>(params.number("avoid_m"));
    stop_m_ = static_cast<float>(params.number("stop_m"));
    creep_mps_ = params.number("creep_mps");
    turn_radps_ = params.number("turn_radps");
    shortest_turn_ = static_cast<std::int32_t>(shortest);
    turn_choices_ = static_cast<std::int32_t>(longest - shortest + 1);
    return {};
  }

  void decide(const Percepts& percepts, Commands& commands) override {
    if (percepts.is_old(laser_)) {
      commands.velocity(drive_, 0, 0);  // What was free then need not be free now.
      return;
    }
    const std::span<const float> ranges_m = percepts[laser_];
    const float right_m = nearest_of(part(ranges_m, rays_.first, rays_.right_end));
    const float ahead_m = nearest_of(part(ranges_m, rays_.right_end, rays_.left_begin));
    const float left_m = nearest_of(part(ranges_m, rays_.left_begin, rays_.end));
    float nearest_m = std::min({right_m, ahead_m, left_m});
    if (is_blind(part(ranges_m, rays_.first, rays_.end))) nearest_m = 0;
    if (turns_left_ == 0 && nearest_m < avoid_m_) begin_turn(left_m, right_m, percepts.random());
    if (turns_left_ == 0) {
      commands.velocity(drive_, cruise_mps_, 0);
      return;
    }
    --turns_left_;
    // A turn is completed even if the way is free earlier. Otherwise a robot in a corner would
    // swing between two walls.
    commands.velocity(drive_, nearest_m < stop_m_ ? 0 : creep_mps_, side_ * turn_radps_);
  }

 private:
  /// Whether it cannot see where it would drive; given its rays ahead.
  [[nodiscard]] bool is_blind(std::span<const float> ahead_m) const noexcept {
    // Most scans have no such ray, and then it need not be known where they look.
    if (!any_unknown(ahead_m)) return false;
    const SensorInfo& sensor = laser_.info();
    const double spread_rad = 0.5 * sensor.cone_rad;
    Sight sight;
    for (std::size_t i = 0; i < ahead_m.size(); ++i) {
      const double axis_rad = sensor.X_RS.yaw + sensor.bearings_rad[rays_.first + i];
      sight.add(Sectors::between(axis_rad - spread_rad, axis_rad + spread_rad), ahead_m[i]);
    }
    return (sight.blind() & Sectors::ahead(kMustSee_rad)).any();
  }

  /// The ranges [begin, end), as far as the sample has them.
  static std::span<const float> part(std::span<const float> ranges_m, std::uint32_t begin,
                                     std::uint32_t end) noexcept {
    const std::size_t last = std::min<std::size_t>(end, ranges_m.size());
    return begin < last ? ranges_m.subspan(begin, last - begin) : std::span<const float>();
  }

  void begin_turn(float left_m, float right_m, RandomStream random) noexcept {
    turns_left_ = shortest_turn_ + static_cast<std::int32_t>(random.uniform(0, turn_choices_));
    // Both infinite: the obstacle is straight ahead. A fixed side would send all robots the same
    // way round.
    if (left_m == right_m) {
      side_ = random.bits() % 2 == 0 ? 1 : -1;
    } else {
      side_ = left_m > right_m ? 1 : -1;
    }
  }

  RangesHandle laser_;
  ControllerHandle drive_;
  FrontRays rays_;
  float avoid_m_ = 0;
  float stop_m_ = 0;
  double cruise_mps_ = 0;
  double creep_mps_ = 0;
  double turn_radps_ = 0;
  std::int32_t shortest_turn_ = 0;
  std::int32_t turn_choices_ = 0;
  std::int32_t turns_left_ = 0;
  std::int32_t side_ = 1;  ///< 1: turns left, -1: right.
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("cruise") {
  rave::add_program<rave::Cruise>(
      registry, {.name = "cruise",
                 .summary = "Drives straight on and turns away from near obstacles ahead.",
                 .params = rave::kParams});
}
