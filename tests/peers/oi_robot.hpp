// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "plant.hpp"

namespace peer {

/// The inside of a robot like the Create 2: what it answers to the Open Interface, and what it
/// wants of its wheels. Source: iRobot, "Create 2 Open Interface (OI) Specification based on the
/// iRobot Roomba 600", 2016.
///
/// Not of the original: a watchdog. It stands for a small controller between host and robot that
/// stops the wheels when no drive command has come for a while.
class OiRobot {
 public:
  enum class Mode { kOff, kPassive, kSafe, kFull };

  /// Options: watchdog-ms (0: none), command-delay-ms, battery-mah.
  explicit OiRobot(const Arguments& given);

  /// As after the battery was put in: off, counters at zero.
  void power_on(const Plant& plant);
  /// Takes bytes of the host that came at `now_s` of the robot's own clock; gives the answer.
  [[nodiscard]] std::string take(const std::string& bytes, double now_s, const Plant& plant);
  /// Goes on to `now_s`: commands that are due, watchdog, safety, battery.
  void advance(double now_s, double dt_s, const Plant& plant);
  /// A frame of the stream if one is due.
  [[nodiscard]] std::string frame(double now_s, const Plant& plant);

  [[nodiscard]] double left_mps() const { return left_mm_ * 1e-3; }
  [[nodiscard]] double right_mps() const { return right_mm_ * 1e-3; }
  [[nodiscard]] Mode mode() const { return mode_; }
  [[nodiscard]] const char* mode_name() const;

  /// Drive commands that were obeyed: when, and what. Emptied by whoever reads them.
  struct Drive {
    double at_s = 0;
    int left_mm = 0;
    int right_mm = 0;
  };
  std::vector<Drive> drives;
  /// When the last drive command came; and how often the watchdog stopped the wheels.
  double last_drive_s = -1e9;
  std::int64_t watchdog_stops = 0;
  std::int64_t ignored_drives = 0;  ///< In a mode that does not drive.
  std::int64_t unknown_bytes = 0;
  std::int64_t frames = 0;

  // What hands do to it: bits as in packets 7, 9 to 12 and 18.
  unsigned wheel_drops = 0;  ///< Bit 0 right, 1 left.
  unsigned cliffs = 0;       ///< Bit 0 left, 1 front left, 2 front right, 3 right.
  unsigned buttons = 0;

 private:
  [[nodiscard]] std::string obey(double now_s, const Plant& plant);
  void mode_command(unsigned char opcode);
  void drive_command(double now_s);
  void set_wheels(double now_s, double left_mm, double right_mm);
  void stop_wheels();
  /// The data of packet or group `id`; reading distance and angle sets them back.
  [[nodiscard]] std::string packet(unsigned char id, const Plant& plant);
  [[nodiscard]] int value(int id, const Plant& plant);
  [[nodiscard]] int state(int id, const Plant& plant);  ///< Of packets from 35 on.
  [[nodiscard]] int bumps(const Plant& plant) const;
  [[nodiscard]] int light(int index, const Plant& plant) const;
  [[nodiscard]] int travelled_since_read(const Plant& plant, bool angle);
  [[nodiscard]] int counts(const Plant::Wheel& wheel, double zero_m) const;

  double watchdog_s_;
  double delay_s_;
  double charge_mah_;
  Mode mode_ = Mode::kOff;
  std::string pending_;  // a command that is not whole yet
  std::deque<Drive> on_the_way_;
  int left_mm_ = 0;
  int right_mm_ = 0;
  int asked_velocity_ = 0;
  int asked_radius_ = 0;
  int song_ = 0;
  std::vector<unsigned char> stream_;
  bool streaming_ = false;
  double next_frame_s_ = 0;
  double zero_left_m_ = 0;
  double zero_right_m_ = 0;
  // Read marks of distance and angle: travel of both wheels, millimetres, and what was not
  // reported.
  double marked_distance_mm_ = 0;
  double marked_angle_deg_ = 0;
  double current_ma_ = 0;
};

}  // namespace peer
