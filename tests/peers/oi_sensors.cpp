// SPDX-License-Identifier: Apache-2.0
// What the packets of a Create hold.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "oi_robot.hpp"

namespace peer {
namespace {

constexpr double kCountsPerTurn = 508.8;
constexpr double kWheelDiameter_m = 0.072;
constexpr double kCapacity_mah = 2696;

/// First and last packet of each group.
struct Group {
  int id;
  int first;
  int last;
};
constexpr Group kGroups[] = {{0, 7, 26},    {1, 7, 16},    {2, 17, 20},  {3, 21, 26},
                             {4, 27, 34},   {5, 35, 42},   {6, 7, 42},   {100, 7, 58},
                             {101, 43, 58}, {106, 46, 51}, {107, 54, 58}};

int bytes_of(int id) {
  if (id == 19 || id == 20 || id == 22 || id == 23 || (id >= 25 && id <= 31) || id == 33) return 2;
  if ((id >= 39 && id <= 44) || (id >= 46 && id <= 51) || (id >= 54 && id <= 57)) return 2;
  return 1;
}

}  // namespace

std::string OiRobot::packet(unsigned char id, const Plant& plant) {
  int first = id;
  int last = id;
  for (const Group& group : kGroups) {
    if (group.id != id) continue;
    first = group.first;
    last = group.last;
  }
  std::string data;
  for (int i = first; i <= last && i >= 7 && i <= 58; ++i) {
    const int number = value(i, plant);
    if (bytes_of(i) == 2) data += static_cast<char>(static_cast<unsigned>(number) >> 8U & 0xffU);
    data += static_cast<char>(static_cast<unsigned>(number) & 0xffU);
  }
  return data;
}

int OiRobot::value(int id, const Plant& plant) {
  switch (id) {
    case 7:
      return bumps(plant);
    case 8:
      return light(5, plant) > 400 ? 1 : 0;
    case 9:
    case 10:
    case 11:
    case 12:
      return static_cast<int>(cliffs >> static_cast<unsigned>(id - 9) & 1U);
    case 18:
      return static_cast<int>(buttons);
    case 19:
      return travelled_since_read(plant, false);
    case 20:
      return travelled_since_read(plant, true);
    case 22:
      return static_cast<int>(13000 + 3500 * charge_mah_ / kCapacity_mah);
    case 23:
      return static_cast<int>(std::lround(current_ma_));
    case 24:
      return 27;
    case 25:
      return static_cast<int>(std::lround(charge_mah_));
    case 26:
      return static_cast<int>(kCapacity_mah);
    case 27:
      return light(5, plant) / 4;
    case 28:
    case 29:
    case 30:
    case 31:
      return (cliffs >> static_cast<unsigned>(id - 28) & 1U) != 0 ? 20 : 1600;
    default:
      return state(id, plant);
  }
}

int OiRobot::state(int id, const Plant& plant) {
  switch (id) {
    case 35:
      return static_cast<int>(mode_);
    case 36:
      return song_;
    case 38:
      return static_cast<int>(stream_.size());
    case 39:
      return asked_velocity_;
    case 40:
      return asked_radius_;
    case 41:
      return right_mm_;
    case 42:
      return left_mm_;
    case 43:
      return counts(plant.left(), zero_left_m_);
    case 44:
      return counts(plant.right(), zero_right_m_);
    case 45: {
      int bits = 0;
      for (int i = 0; i < 6; ++i) bits |= (light(i, plant) > 200 ? 1 : 0) << i;
      return bits;
    }
    case 46:
    case 47:
    case 48:
    case 49:
    case 50:
    case 51:
      return light(id - 46, plant);
    case 54:
      return static_cast<int>(std::lround(plant.left().speed_mps * 400));
    case 55:
      return static_cast<int>(std::lround(plant.right().speed_mps * 400));
    case 58:
      return left_mm_ + right_mm_ > 0 && plant.touching().empty() ? 1 : 0;
    default:
      return 0;
  }
}

int OiRobot::counts(const Plant::Wheel& wheel, double zero_m) const {
  const double turns = (wheel.travel_m - zero_m) / (std::numbers::pi * kWheelDiameter_m);
  return static_cast<int>(
      static_cast<std::uint16_t>(static_cast<std::int64_t>(std::floor(turns * kCountsPerTurn))));
}

int OiRobot::bumps(const Plant& plant) const {
  constexpr double kMiddle = 10 * std::numbers::pi / 180;
  unsigned bits = wheel_drops << 2U;
  for (const double direction : plant.touching()) {
    if (std::abs(direction) > std::numbers::pi / 2) continue;  // no bumper behind
    if (direction < kMiddle) bits |= 1U;
    if (direction > -kMiddle) bits |= 2U;
  }
  return static_cast<int>(bits);
}

/// Light bumpers from left to right: strong when something is near.
int OiRobot::light(int index, const Plant& plant) const {
  static constexpr double kBearings_deg[] = {64, 37, 12, -12, -37, -64};
  const double direction = plant.yaw() + kBearings_deg[index] * std::numbers::pi / 180;
  const double gap_m = plant.room().distance(plant.x(), plant.y(), direction) - Plant::kRadius_m;
  return static_cast<int>(4095 * std::exp(-std::max(0.0, gap_m) / 0.06));
}

int OiRobot::travelled_since_read(const Plant& plant, bool angle) {
  const double left_mm = (plant.left().travel_m - zero_left_m_) * 1000;
  const double right_mm = (plant.right().travel_m - zero_right_m_) * 1000;
  const double now =
      angle ? (right_mm - left_mm) / (Plant::kWheelBase_m * 1000) * 180 / std::numbers::pi
            : (left_mm + right_mm) / 2;
  double& mark = angle ? marked_angle_deg_ : marked_distance_mm_;
  // What is less than one stays for the next time.
  const int whole = static_cast<int>(std::clamp(now - mark, -32768.0, 32767.0));
  mark += whole;
  return whole;
}

}  // namespace peer
