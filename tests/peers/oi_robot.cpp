// SPDX-License-Identifier: Apache-2.0
#include "oi_robot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace peer {
namespace {

constexpr double kFrame_s = 0.015;
constexpr double kCountsPerTurn = 508.8;
constexpr double kWheelDiameter_m = 0.072;
constexpr int kFastest_mm = 500;
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

unsigned char at(const std::string& text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

int word(const std::string& text, std::size_t i) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(at(text, i) << 8U | at(text, i + 1)));
}

/// How long the command is that begins so; 0: no command begins so.
std::size_t length_of(const std::string& text) {
  const unsigned char opcode = at(text, 0);
  switch (opcode) {
    case 7:
    case 128:
    case 130:
    case 131:
    case 132:
    case 133:
    case 134:
    case 135:
    case 136:
    case 143:
    case 173:
      return 1;
    case 129:
    case 138:
    case 141:
    case 142:
    case 150:
    case 165:
      return 2;
    case 162:
      return 3;
    case 139:
    case 144:
    case 168:
      return 4;
    case 137:
    case 145:
    case 146:
    case 163:
    case 164:
      return 5;
    case 167:
      return 16;
    case 140:
      return text.size() < 3 ? 3 : 3 + std::size_t{2} * at(text, 2);
    case 148:
    case 149:
      return text.size() < 2 ? 2 : 2 + std::size_t{at(text, 1)};
    default:
      return 0;
  }
}

}  // namespace

OiRobot::OiRobot(const Arguments& given)
    : watchdog_s_(given.number("watchdog-ms", 200) * 1e-3),
      delay_s_(given.number("command-delay-ms", 0) * 1e-3),
      charge_mah_(given.number("battery-mah", 2200)) {}

const char* OiRobot::mode_name() const {
  static constexpr const char* kNames[] = {"off", "passive", "safe", "full"};
  return kNames[static_cast<int>(mode_)];
}

void OiRobot::power_on(const Plant& plant) {
  mode_ = Mode::kOff;
  stop_wheels();
  pending_.clear();
  streaming_ = false;
  stream_.clear();
  zero_left_m_ = plant.left().travel_m;
  zero_right_m_ = plant.right().travel_m;
  marked_distance_mm_ = 0;
  marked_angle_deg_ = 0;
  asked_velocity_ = 0;
  asked_radius_ = 0;
}

void OiRobot::stop_wheels() {
  left_mm_ = 0;
  right_mm_ = 0;
  on_the_way_.clear();
}

std::string OiRobot::take(const std::string& bytes, double now_s, const Plant& plant) {
  std::string answer;
  for (const char byte : bytes) {
    pending_ += byte;
    const std::size_t length = length_of(pending_);
    if (length == 0) {
      ++unknown_bytes;
      pending_.clear();
    } else if (pending_.size() >= length) {
      answer += obey(now_s, plant);
      pending_.clear();
    }
  }
  return answer;
}

void OiRobot::mode_command(unsigned char opcode) {
  if (opcode != 132) stop_wheels();
  switch (opcode) {
    case 173:
      mode_ = Mode::kOff;
      streaming_ = false;
      break;
    case 130:
    case 131:
      mode_ = Mode::kSafe;
      break;
    case 132:
      mode_ = Mode::kFull;
      break;
    default:  // Start, Power, and the cleaning commands
      mode_ = Mode::kPassive;
  }
}

std::string OiRobot::obey(double now_s, const Plant& plant) {
  const unsigned char opcode = at(pending_, 0);
  if (opcode == 7) {
    power_on(plant);
    return "peer of a robot\r\nwoke up\r\n";
  }
  if (mode_ == Mode::kOff && opcode != 128) return {};
  std::string answer;
  switch (opcode) {
    case 128:
    case 130:
    case 131:
    case 132:
    case 133:
    case 134:
    case 135:
    case 136:
    case 143:
    case 173:
      mode_command(opcode);
      break;
    case 137:
    case 145:
    case 146:
      drive_command(now_s);
      break;
    case 141:
      song_ = at(pending_, 1);
      break;
    case 142:
      return packet(at(pending_, 1), plant);
    case 149:
      for (std::size_t i = 2; i < pending_.size(); ++i) answer += packet(at(pending_, i), plant);
      return answer;
    case 148:
      stream_.assign(pending_.begin() + 2, pending_.end());
      streaming_ = true;
      next_frame_s_ = now_s + kFrame_s;
      break;
    case 150:
      streaming_ = at(pending_, 1) == 1;
      next_frame_s_ = now_s + kFrame_s;
      break;
    default:  // baud, lights, songs, brushes: consumed
      break;
  }
  return {};
}

void OiRobot::drive_command(double now_s) {
  if (mode_ != Mode::kSafe && mode_ != Mode::kFull) {
    ++ignored_drives;
    return;
  }
  const int first = word(pending_, 1);
  const int second = word(pending_, 3);
  switch (at(pending_, 0)) {
    case 145:
      set_wheels(now_s, second, first);
      break;
    case 146:  // of 255 steps
      set_wheels(now_s, second * kFastest_mm / 255.0, first * kFastest_mm / 255.0);
      break;
    default: {
      asked_velocity_ = std::clamp(first, -kFastest_mm, kFastest_mm);
      asked_radius_ = second;
      const double half_mm = Plant::kWheelBase_m * 500;
      const bool straight = second == 32767 || second == -32768 || second == 0;
      if (second == 1 || second == -1) {
        set_wheels(now_s, -second * asked_velocity_, second * asked_velocity_);
      } else {
        const double bend = straight ? 0 : half_mm / second;
        set_wheels(now_s, asked_velocity_ * (1 - bend), asked_velocity_ * (1 + bend));
      }
    }
  }
}

void OiRobot::set_wheels(double now_s, double left_mm, double right_mm) {
  const auto limited = [](double mm) {
    return static_cast<int>(std::lround(std::clamp<double>(mm, -kFastest_mm, kFastest_mm)));
  };
  last_drive_s = now_s;
  const Drive drive{now_s + delay_s_, limited(left_mm), limited(right_mm)};
  drives.push_back({now_s, drive.left_mm, drive.right_mm});
  on_the_way_.push_back(drive);
}

void OiRobot::advance(double now_s, double dt_s, const Plant& plant) {
  while (!on_the_way_.empty() && on_the_way_.front().at_s <= now_s) {
    left_mm_ = on_the_way_.front().left_mm;
    right_mm_ = on_the_way_.front().right_mm;
    on_the_way_.pop_front();
  }
  const bool driving = left_mm_ != 0 || right_mm_ != 0 || !on_the_way_.empty();
  if (driving && watchdog_s_ > 0 && now_s - last_drive_s > watchdog_s_) {
    stop_wheels();
    ++watchdog_stops;
  }
  // A cliff counts while it goes forward; lifted wheels always.
  const bool forward = left_mm_ + right_mm_ > 0;
  if (mode_ == Mode::kSafe && (wheel_drops != 0 || (cliffs != 0 && forward))) {
    stop_wheels();
    mode_ = Mode::kPassive;
  }
  current_ma_ =
      -(250 + 800 * (std::abs(plant.left().speed_mps) + std::abs(plant.right().speed_mps)));
  charge_mah_ = std::max(0.0, charge_mah_ + current_ma_ * dt_s / 3600);
}

std::string OiRobot::frame(double now_s, const Plant& plant) {
  if (!streaming_ || stream_.empty() || now_s < next_frame_s_) return {};
  next_frame_s_ += kFrame_s;
  if (next_frame_s_ < now_s) next_frame_s_ = now_s + kFrame_s;
  ++frames;
  std::string body;
  for (const unsigned char id : stream_) {
    body += static_cast<char>(id);
    body += packet(id, plant);
  }
  std::string text = "\x13";
  text += static_cast<char>(body.size());
  text += body;
  unsigned sum = 0;
  for (std::size_t i = 0; i < text.size(); ++i) sum += at(text, i);
  return text + static_cast<char>(256 - sum % 256);
}

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
