// SPDX-License-Identifier: Apache-2.0
// Stands for a motion capture that watches a body go round a circle: see README.md.
#include <poll.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "mocap_station.hpp"

namespace {

using namespace peer;

class MocapPeer {
 public:
  explicit MocapPeer(const Arguments& given)
      : circle_(given.numbers("circle", {1, 2, 0.5, 8})),
        mocap_(given, "", OwnClock(given.number("clock-start-s", 0), given.number("drift-ppm", 0))),
        random_(static_cast<std::uint64_t>(given.number("seed", 1))) {
    console_.say("ready");
  }

  void run() {
    const std::int64_t began = true_ns();
    std::int64_t sample_at = began;
    while (true) {
      const std::int64_t next = std::min(sample_at, mocap_.due_ns());
      const std::int64_t left = std::clamp<std::int64_t>(next - true_ns(), 0, 1'000'000'000);
      pollfd wanted{Console::fd(), POLLIN, 0};
      const timespec limit{left / 1'000'000'000, left % 1'000'000'000};
      (void)::ppoll(&wanted, 1, &limit, nullptr);
      for (const auto& command : console_.commands()) {
        if (!obey(command)) return;
      }
      mocap_.send_due();
      if (true_ns() < sample_at) continue;
      sample(sample_at, static_cast<double>(sample_at - began) * 1e-9);
      sample_at = std::max(sample_at + mocap_.period_ns(), true_ns() - mocap_.period_ns());
    }
  }

 private:
  void sample(std::int64_t at_ns, double t_s) {
    const double turn = 2 * std::numbers::pi * t_s / circle_[3];
    mocap_.sample(at_ns, circle_[0] + circle_[2] * std::cos(turn),
                  circle_[1] + circle_[2] * std::sin(turn),
                  std::remainder(turn + std::numbers::pi / 2, 2 * std::numbers::pi), random_);
  }

  bool obey(const std::vector<std::string>& command) {
    const std::string& name = command.front();
    if (name == "quit") return false;
    if (name == "mute") mocap_.set_mute(true);
    if (name == "speak") mocap_.set_mute(false);
    if (name == "delay" && command.size() > 1) mocap_.set_delay(std::atof(command[1].c_str()));
    if (name == "restart") mocap_.restart();
    if (name == "raw") {
      std::string text;
      for (std::size_t i = 1; i < command.size(); ++i) text += (i > 1 ? " " : "") + command[i];
      mocap_.send(text);
    }
    console_.say("ok " + name);
    return true;
  }

  Console console_;
  std::vector<double> circle_;  // centre x, y, radius, period in seconds
  MocapStation mocap_;
  std::mt19937_64 random_;
};

}  // namespace

int main(int argc, char** argv) {
  const peer::Arguments given(
      argc, argv,
      {"port", "body", "circle", "rate-hz", "noise-m", "delay-s", "jitter-s", "loss", "twice",
       "clock-start-s", "drift-ppm", "seed", "log"});
  MocapPeer(given).run();
}
