// SPDX-License-Identifier: Apache-2.0
#include "plant.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace peer {
namespace {

constexpr double kTouch_m = 0.5e-3;
constexpr double kApart_m = 3e-3;  // so far it must go before a touch counts anew

}  // namespace

Plant::Plant(const Arguments& given)
    : room_(given.has("room") ? Room(given.text("room", "")) : Room()),
      lag_s_(given.number("lag-s", 0.05)),
      friction_mps2_(given.number("friction", 2)) {
  const std::vector<double> pose = given.numbers("pose", {1.2, 0.9, 0.3});
  x_ = pose[0];
  y_ = pose[1];
  yaw_ = pose[2];
  const std::vector<double> slip = given.numbers("slip", {0, 0});
  wheels_[0].slip = slip[0];
  wheels_[1].slip = slip[1];
  const std::vector<double> slips = given.numbers("slips", {0, 0, 0});
  slip_rate_hz_ = slips[0];
  slip_share_ = slips[1];
  slip_duration_s_ = slips[2];
  if (room_.clearance(x_, y_) < kRadius_m) give_up("--pose is inside a wall");
}

void Plant::turn_wheel(Wheel& wheel, double wanted_mps, double dt_s) const {
  const double gap = wanted_mps - wheel.speed_mps;
  const double share = lag_s_ > 0 ? -std::expm1(-dt_s / lag_s_) : 1;
  const double change = gap * share + std::copysign(friction_mps2_ * dt_s, gap);
  wheel.speed_mps = std::abs(change) >= std::abs(gap) ? wanted_mps : wheel.speed_mps + change;
  wheel.travel_m += wheel.speed_mps * dt_s;
}

void Plant::advance(double dt_s, double left_mps, double right_mps, std::mt19937_64& random) {
  turn_wheel(wheels_[0], left_mps, dt_s);
  turn_wheel(wheels_[1], right_mps, dt_s);
  std::uniform_real_distribution<double> chance(0, 1);
  double ground_mps[2];
  for (std::size_t i = 0; i < 2; ++i) {
    Wheel& wheel = wheels_[i];
    wheel.slipping_s = std::max(0.0, wheel.slipping_s - dt_s);
    if (slip_rate_hz_ > 0 && wheel.speed_mps != 0 && chance(random) < slip_rate_hz_ * dt_s) {
      wheel.slipping_s = slip_duration_s_;
      ++slips_;
    }
    ground_mps[i] =
        wheel.speed_mps * (1 - wheel.slip) * (wheel.slipping_s > 0 ? 1 - slip_share_ : 1);
  }
  move((ground_mps[0] + ground_mps[1]) / 2 * dt_s,
       (ground_mps[1] - ground_mps[0]) / kWheelBase_m * dt_s);
  feel();
}

void Plant::move(double forward_m, double turn_rad) {
  const double direction = yaw_ + turn_rad / 2;
  yaw_ = std::remainder(yaw_ + turn_rad, 2 * std::numbers::pi);
  const double dx = forward_m * std::cos(direction);
  const double dy = forward_m * std::sin(direction);
  // The largest part of the step that does not enter a wall: steps are short against the body.
  const auto free = [&](double part) {
    return room_.within(x_ + part * dx, y_ + part * dy, kRadius_m).empty();
  };
  double part = 1;
  if (!free(1)) {
    double most = 1;
    part = 0;
    for (int i = 0; i < 20; ++i) {
      const double middle = (part + most) / 2;
      (free(middle) ? part : most) = middle;
    }
  }
  x_ += part * dx;
  y_ += part * dy;
  path_m_ += part * std::abs(forward_m);
}

void Plant::feel() {
  touching_.clear();
  const double clear_m = room_.clearance(x_, y_) - kRadius_m;
  closest_m_ = std::min(closest_m_, std::max(0.0, clear_m));
  if (clear_m > kApart_m) was_touching_ = false;
  if (clear_m > kTouch_m) return;
  closest_m_ = 0;
  if (!was_touching_) ++touches_;
  was_touching_ = true;
  for (const Room::Near& near : room_.within(x_, y_, kRadius_m + kTouch_m)) {
    touching_.push_back(std::remainder(near.direction - yaw_, 2 * std::numbers::pi));
  }
}

}  // namespace peer
