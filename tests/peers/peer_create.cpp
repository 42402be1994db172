// SPDX-License-Identifier: Apache-2.0
// Stands for a robot with the Open Interface, with a laser on it and a motion capture above it:
// see README.md.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "arguments.hpp"
#include "console.hpp"
#include "faults.hpp"
#include "laser_station.hpp"
#include "mocap_station.hpp"
#include "oi_robot.hpp"
#include "optics.hpp"
#include "own_clock.hpp"
#include "plant.hpp"
#include "wire.hpp"

namespace {

using namespace peer;

constexpr std::int64_t kTick_ns = 2'000'000;
/// A process that got no processor for longer loses the rest: nothing happened to the robot then.
/// So the robot's watchdog and its standstill do not depend on how busy the machine is.
constexpr std::int64_t kMostAtOnce_ns = 50'000'000;
constexpr std::int64_t kPoseEntry_ns = 10'000'000;

struct Pose {
  double x = 0;
  double y = 0;
  double yaw = 0;
};

Pose inverse_times(const std::vector<double>& frame, const Pose& pose) {
  const double dx = pose.x - frame[0];
  const double dy = pose.y - frame[1];
  return {std::cos(frame[2]) * dx + std::sin(frame[2]) * dy,
          -std::sin(frame[2]) * dx + std::cos(frame[2]) * dy,
          std::remainder(pose.yaw - frame[2], 2 * std::numbers::pi)};
}

OwnClock clock_of(const Arguments& given, const std::string& prefix) {
  return {given.number(prefix + "clock-start-s", given.number("clock-start-s", 0)),
          given.number(prefix + "drift-ppm", given.number("drift-ppm", 0))};
}

class CreatePeer {
 public:
  explicit CreatePeer(const Arguments& given)
      : plant_(given),
        robot_(given),
        wire_(given.text("link", ""), static_cast<int>(given.number("port", 0)),
              !given.has("link")),
        log_(given.text("log", "")),
        start_s_(given.number("clock-start-s", 0)),
        rate_(1 + given.number("drift-ppm", 0) * 1e-6),
        latency_ns_(std::llround(given.number("latency-ms", 0) * 1e6)),
        laser_pose_(given.numbers("laser-pose", {0, 0, 0})),
        laser_noise_mm_(given.number("laser-noise-mm", 5)),
        mocap_frame_(given.numbers("mocap-frame", {0, 0, 0})),
        random_(static_cast<std::uint64_t>(given.number("seed", 1))) {
    if (given.has("laser-link") || given.has("laser-port")) {
      laser_.emplace(given, "laser-", clock_of(given, "laser-"));
    }
    if (given.has("mocap-port")) mocap_.emplace(given, "mocap-", clock_of(given, "mocap-"));
    robot_.power_on(plant_);
    console_.say("ready " + wire_.name() + (laser_ ? " " + laser_->wire().name() : ""));
  }

  void run() {
    last_ns_ = true_ns();
    scan_at_ = last_ns_;
    mocap_at_ = last_ns_;
    while (true) {
      const std::string bytes = wire_.exchange(true_ns() + kTick_ns, Console::fd());
      take(bytes);
      if (laser_) laser_->take(laser_->wire().exchange(0, -1));
      for (const auto& command : console_.commands()) {
        if (!obey(command)) return;
      }
      pass_time();
      send_frame();
      serve_laser();
      serve_mocap();
    }
  }

 private:
  /// Of the robot: seconds that its own clock has counted.
  [[nodiscard]] double own_s() const {
    return start_s_ + static_cast<double>(lived_ns_) * 1e-9 * rate_;
  }
  [[nodiscard]] std::string stamp() const {
    return std::to_string(true_ns()) + " " + std::to_string(lived_ns_);
  }

  void take(const std::string& bytes) {
    if (bytes.empty()) return;
    std::string heard = bytes;
    if (deaf_left_ > 0) {
      --deaf_left_;
      heard.clear();
      for (const Chunk& chunk : spoil(bytes, Fault::kTear, random_)) heard += chunk.bytes;
    }
    const std::string before = robot_.mode_name();
    const std::string answer = robot_.take(heard, own_s(), plant_);
    if (!answer.empty()) wire_.send(answer, 0);
    for (const OiRobot::Drive& drive : robot_.drives) {
      log_.write("drive " + stamp() + " " + std::to_string(drive.left_mm) + " " +
                 std::to_string(drive.right_mm));
      last_drive_ns_ = lived_ns_;
      if (drive.left_mm != 0 || drive.right_mm != 0) stood_ = false;
    }
    robot_.drives.clear();
    tell_mode(before);
  }

  void tell_mode(const std::string& before) {
    if (before != robot_.mode_name()) log_.write("mode " + stamp() + " " + robot_.mode_name());
  }

  void pass_time() {
    const std::int64_t now = true_ns();
    std::int64_t left = std::min(now - last_ns_, kMostAtOnce_ns);
    last_ns_ = now;
    while (left > 0) {
      const std::int64_t part = std::min(left, kTick_ns);
      left -= part;
      lived_ns_ += part;
      tick(static_cast<double>(part) * 1e-9);
    }
  }

  void tick(double dt_s) {
    const std::string before = robot_.mode_name();
    const std::int64_t stops = robot_.watchdog_stops;
    const std::int64_t touches = plant_.touches();
    robot_.advance(own_s(), dt_s, plant_);
    plant_.advance(dt_s, robot_.left_mps(), robot_.right_mps(), random_);
    tell_mode(before);
    if (robot_.watchdog_stops != stops) {
      stopping_ = true;
      log_.write("watchdog " + stamp());
    }
    if (plant_.touches() != touches) log_.write("touch " + stamp());
    if (plant_.still() && !stood_ && robot_.left_mps() == 0 && robot_.right_mps() == 0) {
      stood_ = true;
      still_after_ms_ = static_cast<double>(lived_ns_ - last_drive_ns_) * 1e-6;
      log_.write("still " + stamp() + " " + std::to_string(still_after_ms_) +
                 (stopping_ ? " watchdog" : ""));
      if (stopping_) watchdog_still_ms_ = std::max(watchdog_still_ms_, still_after_ms_);
      stopping_ = false;
    }
    if (lived_ns_ < pose_entry_at_) return;
    pose_entry_at_ = lived_ns_ + kPoseEntry_ns;
    char entry[200];
    std::snprintf(entry, sizeof entry, "pose %s %.6f %.6f %.6f %.5f %.5f", stamp().c_str(),
                  plant_.x(), plant_.y(), plant_.yaw(), plant_.left().speed_mps,
                  plant_.right().speed_mps);
    log_.write(entry);
  }

  void send_frame() {
    const std::string bytes = robot_.frame(own_s(), plant_);
    if (bytes.empty() || mute_) return;
    const bool spoilt = spoilt_left_ > 0 && robot_.frames % 2 == 0;
    const Fault fault = spoilt ? fault_ : Fault::kNone;
    const std::int64_t now = true_ns();
    log_.write("frame " + std::to_string(now) + " " + std::to_string(lived_ns_) + " " +
               std::to_string(robot_.frames) + " " + to_string(fault));
    std::int64_t at = now + latency_ns_;
    for (const Chunk& chunk : spoil(bytes, fault, random_)) {
      at += chunk.pause_ns;
      wire_.send(chunk.bytes, at);
    }
    if (fault != Fault::kNone && --spoilt_left_ == 0) console_.say("spoilt");
  }

  void serve_laser() {
    if (!laser_ || true_ns() < scan_at_) return;
    const double turn = plant_.yaw();
    laser_->scanned(
        scan_room(plant_.room(),
                  plant_.x() + std::cos(turn) * laser_pose_[0] - std::sin(turn) * laser_pose_[1],
                  plant_.y() + std::sin(turn) * laser_pose_[0] + std::cos(turn) * laser_pose_[1],
                  turn + laser_pose_[2], laser_noise_mm_, random_),
        console_, random_);
    scan_at_ = std::max(scan_at_ + laser_->period_ns(), true_ns() - laser_->period_ns());
  }

  void serve_mocap() {
    if (!mocap_) return;
    mocap_->send_due();
    if (true_ns() < mocap_at_) return;
    const Pose seen = inverse_times(mocap_frame_, {plant_.x(), plant_.y(), plant_.yaw()});
    mocap_->sample(true_ns(), seen.x, seen.y, seen.yaw, random_);
    mocap_at_ = std::max(mocap_at_ + mocap_->period_ns(), true_ns() - mocap_->period_ns());
  }

  [[nodiscard]] std::string state() const {
    char text[900];
    std::snprintf(
        text, sizeof text,
        "{\"t_s\":%.3f,\"own_s\":%.3f,\"x\":%.4f,\"y\":%.4f,\"yaw\":%.4f,\"left_mps\":%.4f,"
        "\"right_mps\":%.4f,\"path_m\":%.4f,\"wheel_left_m\":%.4f,\"wheel_right_m\":%.4f,"
        "\"touches\":%lld,\"touching\":%s,\"closest_m\":%.4f,\"slips\":%lld,\"mode\":\"%s\","
        "\"frames\":%lld,\"watchdog_stops\":%lld,\"watchdog_still_ms\":%.1f,"
        "\"ignored_drives\":%lld,\"unknown_bytes\":%lld,\"deaf\":%d}",
        static_cast<double>(lived_ns_) * 1e-9, own_s(), plant_.x(), plant_.y(), plant_.yaw(),
        plant_.left().speed_mps, plant_.right().speed_mps, plant_.path_m(), plant_.left().travel_m,
        plant_.right().travel_m, static_cast<long long>(plant_.touches()),
        plant_.touching().empty() ? "false" : "true", plant_.closest_m(),
        static_cast<long long>(plant_.slips()), robot_.mode_name(),
        static_cast<long long>(robot_.frames), static_cast<long long>(robot_.watchdog_stops),
        watchdog_still_ms_, static_cast<long long>(robot_.ignored_drives),
        static_cast<long long>(robot_.unknown_bytes), deaf_left_);
    return text;
  }

  /// False: the end.
  bool obey(const std::vector<std::string>& command) {
    const std::string& name = command.front();
    const std::string what = command.size() > 1 ? command[1] : "";
    const int number = std::atoi(what.c_str());
    if (const Fault fault = fault_named(name); fault != Fault::kNone) {
      fault_ = fault;
      spoilt_left_ = std::max(1, number);
    }
    if (name == "deafen") deaf_left_ = std::max(1, number);
    if (name == "mute") mute_ = true;
    if (name == "speak") mute_ = false;
    if (name == "place" && command.size() == 4) {
      plant_.place(std::atof(what.c_str()), std::atof(command[2].c_str()),
                   std::atof(command[3].c_str()));
    }
    if (name == "vanish") wire_.vanish();
    if (name == "return") wire_.come_back();
    if (name == "reboot") robot_.power_on(plant_);
    if (name == "drop") robot_.wheel_drops = static_cast<unsigned>(number) & 3U;
    if (name == "cliff") robot_.cliffs = static_cast<unsigned>(number) & 15U;
    if (name == "button") robot_.buttons = static_cast<unsigned>(number) & 255U;
    if (name == "laser" && laser_) obey_laser(what, command);
    if (name == "mocap" && mocap_) obey_mocap(what, command);
    if (name == "state" || name == "quit") console_.say("state " + state());
    if (name == "quit") return false;
    console_.say("ok " + name);
    return true;
  }

  void obey_mocap(const std::string& what, const std::vector<std::string>& command) {
    const auto number = [&](std::size_t i) {
      return command.size() > i ? std::atof(command[i].c_str()) : 0.0;
    };
    if (what == "mute" || what == "speak") mocap_->set_mute(what == "mute");
    if (what == "lag") mocap_->set_lag(number(2), number(3));
    if (what == "turn") mocap_->turn_every(static_cast<int>(number(2)));
    if (what == "far") mocap_->send_far(static_cast<int>(number(2)));
  }

  void obey_laser(const std::string& what, const std::vector<std::string>& command) {
    if (const Fault fault = fault_named(what); fault != Fault::kNone) {
      laser_->spoil_next(fault, command.size() > 2 ? std::atoi(command[2].c_str()) : 1);
    }
    laser_->obey({command.begin() + 1, command.end()});
    if (what == "mute" || what == "speak") laser_->set_mute(what == "mute");
    if (what == "vanish") laser_->vanish();
    if (what == "return") laser_->come_back();
  }

  Console console_;
  Plant plant_;
  OiRobot robot_;
  Wire wire_;
  Log log_;
  double start_s_;
  double rate_;
  std::int64_t latency_ns_;
  std::vector<double> laser_pose_;
  double laser_noise_mm_;
  std::vector<double> mocap_frame_;
  std::mt19937_64 random_;
  std::optional<LaserStation> laser_;
  std::optional<MocapStation> mocap_;

  std::int64_t last_ns_ = 0;   // CLOCK_MONOTONIC of the last passing of time
  std::int64_t lived_ns_ = 0;  // time of the robot's world
  std::int64_t last_drive_ns_ = 0;
  std::int64_t pose_entry_at_ = 0;
  std::int64_t scan_at_ = 0;
  std::int64_t mocap_at_ = 0;
  Fault fault_ = Fault::kNone;
  int spoilt_left_ = 0;
  int deaf_left_ = 0;
  bool mute_ = false;
  bool stood_ = true;
  bool stopping_ = false;
  double still_after_ms_ = 0;
  double watchdog_still_ms_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const peer::Arguments given(argc, argv,
                              {"link",
                               "port",
                               "room",
                               "pose",
                               "seed",
                               "log",
                               "clock-start-s",
                               "drift-ppm",
                               "latency-ms",
                               "lag-s",
                               "friction",
                               "slip",
                               "slips",
                               "watchdog-ms",
                               "command-delay-ms",
                               "battery-mah",
                               "laser-link",
                               "laser-port",
                               "laser-pose",
                               "laser-noise-mm",
                               "laser-model",
                               "laser-rpm",
                               "laser-latency-ms",
                               "laser-log",
                               "laser-clock-start-s",
                               "laser-drift-ppm",
                               "mocap-port",
                               "mocap-body",
                               "mocap-frame",
                               "mocap-rate-hz",
                               "mocap-noise-m",
                               "mocap-delay-s",
                               "mocap-jitter-s",
                               "mocap-loss",
                               "mocap-twice",
                               "mocap-log",
                               "mocap-clock-start-s",
                               "mocap-drift-ppm"});
  CreatePeer(given).run();
}
