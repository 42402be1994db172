// SPDX-License-Identifier: Apache-2.0
// Stands for nodes of ROS 2 that look at a robot and command it, on another vendor's DDS: see
// ../README.md.
#include <poll.h>

#include <cstdlib>

#include "console.hpp"
#include "ros2/listener.hpp"

namespace {

using namespace peer;

/// Velocities are repeated as a joystick does it.
struct Joystick {
  bool held = false;
  double v_mps = 0;
  double w_radps = 0;
};

double number(const std::vector<std::string>& command, std::size_t place) {
  return place < command.size() ? std::atof(command[place].c_str()) : 0;
}

/// False: the peer is to end.
bool obey(const std::vector<std::string>& command, Console& console, Ros2Listener& listener,
          Joystick& joystick) {
  const std::string& name = command.front();
  if (name == "quit") return false;
  if (name == "state") console.say("state " + listener.state());
  if (name == "drive") joystick = {true, number(command, 1), number(command, 2)};
  if (name == "release") joystick = {};
  if (name == "goal") listener.go_to(number(command, 1), number(command, 2));
  console.say("ok " + name);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments given(argc, argv, {"domain", "namespace", "stamped", "gid-bytes"});
  Console console;
  Ros2Listener listener(given);
  Joystick joystick;
  console.say("ready");
  while (true) {
    pollfd wanted{Console::fd(), POLLIN, 0};
    (void)::poll(&wanted, 1, 50);
    for (const auto& command : console.commands()) {
      if (!obey(command, console, listener, joystick)) return 0;
    }
    if (joystick.held) listener.drive(joystick.v_mps, joystick.w_radps);
  }
}
