// SPDX-License-Identifier: Apache-2.0
// Stands for a laser that speaks SCIP 2.0: see README.md.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "arguments.hpp"
#include "console.hpp"
#include "faults.hpp"
#include "own_clock.hpp"
#include "room.hpp"
#include "scip_device.hpp"
#include "wire.hpp"

namespace {

using namespace peer;

/// The optics: where they are, and what they measure there.
class Optics {
 public:
  explicit Optics(const Arguments& given)
      : room_(given.has("room") ? Room(given.text("room", "")) : Room()),
        pose_(given.numbers("pose", {1.2, 0.9, 0.3})),
        circle_(given.numbers("circle", {0, 0, 0, 0})),
        noise_mm_(given.number("noise-mm", 5)) {}

  /// One scan, as if all of it was measured at once. Too far away: error code 0.
  std::vector<int> measure(double t_s, std::mt19937_64& random) {
    std::normal_distribution<double> noise(0, noise_mm_);
    std::vector<double> at = pose_;
    if (circle_[3] > 0) {
      const double turn = 2 * std::numbers::pi * t_s / circle_[3];
      at = {circle_[0] + circle_[2] * std::cos(turn), circle_[1] + circle_[2] * std::sin(turn),
            turn + std::numbers::pi / 2};
    }
    std::vector<int> ranges_mm;
    for (int step = ScipDevice::kFirstStep; step <= ScipDevice::kLastStep; ++step) {
      const double bearing =
          2 * std::numbers::pi * (step - ScipDevice::kFrontStep) / ScipDevice::kStepsPerTurn;
      const double mm = room_.distance(at[0], at[1], at[2] + bearing) * 1000 + noise(random);
      ranges_mm.push_back(mm <= ScipDevice::kMost_mm
                              ? std::max(static_cast<int>(std::lround(mm)), ScipDevice::kLeast_mm)
                              : 0);
    }
    return ranges_mm;
  }

 private:
  Room room_;
  std::vector<double> pose_;    // x, y, yaw
  std::vector<double> circle_;  // centre x, y, radius, period in seconds; period 0: stands
  double noise_mm_;
};

class ScipPeer {
 public:
  explicit ScipPeer(const Arguments& given)
      : optics_(given),
        device_(static_cast<int>(given.number("rpm", 600)),
                OwnClock(given.number("clock-start-s", 0), given.number("drift-ppm", 0))),
        wire_(given.text("link", ""), static_cast<int>(given.number("port", 0)),
              !given.has("link")),
        log_(given.text("log", "")),
        period_ns_(std::llround(60e9 / given.number("rpm", 600))),
        latency_ns_(std::llround(given.number("latency-ms", 0) * 1e6)),
        random_(static_cast<std::uint64_t>(given.number("seed", 1))) {
    console_.say("ready " + wire_.name());
  }

  void run() {
    const std::int64_t began = true_ns();
    std::int64_t scan_at = began;
    while (true) {
      take_bytes(wire_.exchange(scan_at, Console::fd()));
      for (const auto& command : console_.commands()) {
        if (!obey(command)) return;
      }
      const std::int64_t now = true_ns();
      if (now < scan_at) continue;
      scan(static_cast<double>(scan_at - began) * 1e-9);
      // After a pause that somebody forced on the process scans go on from now.
      scan_at = std::max(scan_at + period_ns_, now - period_ns_);
    }
  }

 private:
  void take_bytes(const std::string& bytes) {
    for (const char byte : bytes) {
      if (byte != '\n' && byte != '\r') {
        if (command_.size() < 64) command_ += byte;
        continue;
      }
      if (command_.substr(0, 2) == "QT" || command_.substr(0, 2) == "RS") wire_.flush();
      wire_.send(device_.answer(command_), 0);
      command_.clear();
    }
  }

  void scan(double t_s) {
    const std::vector<int> ranges_mm = optics_.measure(t_s, random_);
    const std::int64_t measured_ns = true_ns();
    const std::string bytes = device_.scanned(ranges_mm, measured_ns);
    // With polling the answers are sent elsewhere; what they hold is logged all the same.
    // Every other one, so that there are good ones to find between the bad.
    const bool spoilt = !bytes.empty() && spoilt_left_ > 0 && count_ % 2 == 0;
    const Fault fault = spoilt ? fault_ : Fault::kNone;
    std::string entry = std::to_string(++count_) + " " + std::to_string(measured_ns) + " " +
                        std::to_string(device_.timer_ms()) + " " + to_string(fault);
    for (const int mm : ranges_mm) entry += " " + std::to_string(mm);
    log_.write(entry);
    if (bytes.empty() || mute_) return;
    std::int64_t at = measured_ns + latency_ns_;
    for (const Chunk& chunk : spoil(bytes, fault, random_)) {
      at += chunk.pause_ns;
      wire_.send(chunk.bytes, at);
    }
    if (fault != Fault::kNone && --spoilt_left_ == 0) console_.say("spoilt");
  }

  /// False: the end.
  bool obey(const std::vector<std::string>& command) {
    const std::string& name = command.front();
    if (name == "quit") return false;
    for (const Fault fault : {Fault::kGarble, Fault::kTear, Fault::kRepeat, Fault::kDelay}) {
      if (name != to_string(fault)) continue;
      fault_ = fault;
      spoilt_left_ = command.size() > 1 ? std::atoi(command[1].c_str()) : 1;
    }
    if (name == "mute") mute_ = true;
    if (name == "speak") mute_ = false;
    if (name == "vanish") wire_.vanish();
    if (name == "return") {
      command_.clear();
      device_.power_on();
      wire_.come_back();
    }
    console_.say("ok " + name);
    return true;
  }

  Console console_;
  Optics optics_;
  ScipDevice device_;
  Wire wire_;
  Log log_;
  std::int64_t period_ns_;
  std::int64_t latency_ns_;
  std::mt19937_64 random_;
  std::string command_;
  Fault fault_ = Fault::kNone;
  int spoilt_left_ = 0;
  bool mute_ = false;
  std::int64_t count_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const peer::Arguments given(argc, argv,
                              {"link", "port", "room", "pose", "circle", "noise-mm", "rpm",
                               "clock-start-s", "drift-ppm", "latency-ms", "seed", "log"});
  ScipPeer(given).run();
}
