// SPDX-License-Identifier: Apache-2.0
// Stands for a laser that speaks SCIP 2.0: see README.md.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "arguments.hpp"
#include "console.hpp"
#include "laser_station.hpp"
#include "optics.hpp"
#include "own_clock.hpp"

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

  std::vector<int> measure(double t_s, std::mt19937_64& random) {
    std::vector<double> at = pose_;
    if (circle_[3] > 0) {
      const double turn = 2 * std::numbers::pi * t_s / circle_[3];
      at = {circle_[0] + circle_[2] * std::cos(turn), circle_[1] + circle_[2] * std::sin(turn),
            turn + std::numbers::pi / 2};
    }
    return scan_room(room_, at[0], at[1], at[2], noise_mm_, random);
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
        laser_(given, "", OwnClock(given.number("clock-start-s", 0), given.number("drift-ppm", 0))),
        random_(static_cast<std::uint64_t>(given.number("seed", 1))) {
    console_.say("ready " + laser_.wire().name());
  }

  void run() {
    const std::int64_t began = true_ns();
    std::int64_t scan_at = began;
    while (true) {
      laser_.take(laser_.wire().exchange(scan_at, Console::fd()));
      for (const auto& command : console_.commands()) {
        if (!obey(command)) return;
      }
      const std::int64_t now = true_ns();
      if (now < scan_at) continue;
      laser_.scanned(optics_.measure(static_cast<double>(scan_at - began) * 1e-9, random_),
                     console_, random_);
      // After a pause that somebody forced on the process scans go on from now.
      scan_at = std::max(scan_at + laser_.period_ns(), now - laser_.period_ns());
    }
  }

 private:
  /// False: the end.
  bool obey(const std::vector<std::string>& command) {
    const std::string& name = command.front();
    if (name == "quit") return false;
    if (const Fault fault = fault_named(name); fault != Fault::kNone) {
      laser_.spoil_next(fault, command.size() > 1 ? std::atoi(command[1].c_str()) : 1);
    }
    laser_.obey(command);
    if (name == "mute") laser_.set_mute(true);
    if (name == "speak") laser_.set_mute(false);
    if (name == "vanish") laser_.vanish();
    if (name == "return") laser_.come_back();
    console_.say("ok " + name);
    return true;
  }

  Console console_;
  Optics optics_;
  LaserStation laser_;
  std::mt19937_64 random_;
};

}  // namespace

int main(int argc, char** argv) {
  const peer::Arguments given(argc, argv,
                              {"link", "port", "model", "room", "pose", "circle", "noise-mm", "rpm",
                               "clock-start-s", "drift-ppm", "latency-ms", "seed", "log"});
  ScipPeer(given).run();
}
