// SPDX-License-Identifier: Apache-2.0
#include "oi_robot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace peer {
namespace {

constexpr double kFrame_s = 0.015;
constexpr int kFastest_mm = 500;

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

}  // namespace peer
