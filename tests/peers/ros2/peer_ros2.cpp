// SPDX-License-Identifier: Apache-2.0
// Stands for a robot whose nodes speak ROS 2, on another vendor's DDS: see ../README.md.
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "console.hpp"
#include "own_clock.hpp"
#include "ros2/robot.hpp"

namespace {

using namespace peer;

/// False: the peer is to end.
bool obey(const std::vector<std::string>& command, Console& console, Ros2Robot& robot) {
  const std::string& name = command.front();
  if (name == "quit") return false;
  if (name == "state") console.say("state " + robot.state());
  if (name == "mute") robot.set_mute(true);
  if (name == "speak") robot.set_mute(false);
  if (name == "lose-fix") robot.set_fix(false);
  if (name == "find-fix") robot.set_fix(true);
  if (name == "blind") robot.set_laser(Ros2Robot::Laser::kSilent);
  if (name == "invert") robot.set_laser(Ros2Robot::Laser::kNegative);
  if (name == "see") robot.set_laser(Ros2Robot::Laser::kWorks);
  if (name == "lose-odometry") robot.set_wheels(Ros2Robot::Wheels::kSilent);
  if (name == "spoil-odometry") robot.set_wheels(Ros2Robot::Wheels::kNan);
  if (name == "find-odometry") robot.set_wheels(Ros2Robot::Wheels::kWork);
  if (name == "pattern") robot.set_pattern(true);
  if (name == "garbage" && command.size() > 1) robot.write_garbage(std::atoi(command[1].c_str()));
  console.say("ok " + name);
  // Without a farewell to anybody.
  if (name == "die") (void)::kill(::getpid(), SIGKILL);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments given(argc, argv,
                        {"domain",
                         "namespace",
                         "pose",
                         "room",
                         "lag-s",
                         "friction",
                         "slip",
                         "slips",
                         "seed",
                         "rays",
                         "watchdog-ms",
                         "stamped",
                         "reliable-sensors",
                         "forgets-static",
                         "odom-hz",
                         "scan-hz",
                         "range-hz",
                         "imu-hz",
                         "battery-hz",
                         "fix-hz",
                         "origin",
                         "pose-hz",
                         "map-hz"});
  Console console;
  Ros2Robot robot(given);
  console.say("ready");
  while (true) {
    const std::int64_t left = std::clamp<std::int64_t>(robot.attend() - true_ns(), 0, 100'000'000);
    pollfd wanted{Console::fd(), POLLIN, 0};
    const timespec limit{0, left};
    (void)::ppoll(&wanted, 1, &limit, nullptr);
    for (const auto& command : console.commands()) {
      if (!obey(command, console, robot)) return 0;
    }
  }
}
