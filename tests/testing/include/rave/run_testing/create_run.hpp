// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "rave/live_testing/scenario_run.hpp"

namespace rave::tests {

/// A UDP port of the loopback that nobody has.
inline int free_port() {
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof own;
  EXPECT_EQ(::bind(fd, reinterpret_cast<sockaddr*>(&own), size), 0);
  EXPECT_EQ(::getsockname(fd, reinterpret_cast<sockaddr*>(&own), &size), 0);
  ::close(fd);
  return ntohs(own.sin_port);
}

using testing::RaveRun;

/// Between two looks at a run through a process of `rave`.
inline constexpr std::chrono::milliseconds kAskRave{50};

/// The robot as a peer, and a scenario that it takes part in.
class CreateRun : public testing::ScenarioRun {
 public:
  /// `robot`: create or create-simulated. `others`: more entries of `robots`, and `keys`: more keys
  /// of the scenario, as text. `twin`: the other of the two, or nothing; `entry`: more keys of the
  /// entry of the robot, as lines; `program`: what both drive by in the place of their program.
  CreateRun(const std::string& robot, double duration_s, std::vector<std::string> options = {},
            const std::string& others = "", const std::string& keys = "",
            const std::string& twin = "", const std::string& entry = "",
            const std::string& program = "")
      : ScenarioRun("create_run") {
    write("room", "2 1.5 0 4 3   # all around\n2.9 2.2 30 0.4 0.4\n");
    const std::string port = std::to_string(free_port());
    options.insert(options.end(),
                   {"--link", file("base"), "--laser-link", file("laser"), "--mocap-port", port,
                    "--mocap-body", "create", "--room", file("room"), "--pose", "1,1,0.4",
                    "--mocap-noise-m", "0.001", "--mocap-delay-s", "0.01", "--log", file("log")});
    if (robot == "create" || twin == "create")
      peer = std::make_unique<testing::PeerProcess>("peer_create", options);
    write("world.yaml", kWorld);
    std::ostringstream scenario;
    scenario << "name: create\nduration_s: " << duration_s
             << "\nrobots:\n  - name: rosie\n    file: " << robot_file(robot, program) << "\n"
             << (twin.empty() ? "" : "    twin: " + robot_file(twin, program) + "\n") << entry
             << "    pose: {x_m: 1, y_m: 1, yaw_deg: 22.9}\n    variables: {base: '" << file("base")
             << "', laser: '" << file("laser") << "', mocap_port: " << port
             << ", mocap_body: create}\n"
             << others << "world: world.yaml\n"
             << keys;
    write("scenario.yaml", scenario.str());
  }

  /// `rave WORDS` about this run, with what it says.
  struct Said {
    int exit_code = 0;
    std::string text;
  };
  [[nodiscard]] static Said rave_says(const std::string& words) {
    const std::string line = RAVE_BINARY_DIR "/bin/rave " + words + " 2>&1";
    Said said;
    std::FILE* const pipe = ::popen(line.c_str(), "r");
    if (pipe == nullptr) return {-1, "no shell"};
    char part[512];
    while (std::fgets(part, sizeof part, pipe) != nullptr) said.text += part;
    const int status = ::pclose(pipe);
    said.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return said;
  }
  [[nodiscard]] std::string run_name() const { return std::to_string(rave->pid()); }

 private:
  /// The peer's room as the simulated twin needs it.
  static constexpr const char* kWorld =
      "obstacles:\n"
      "  - {name: south, box_m: [4.2, 0.1], x_m: 2, y_m: -0.05, layer: mapped_real}\n"
      "  - {name: north, box_m: [4.2, 0.1], x_m: 2, y_m: 3.05, layer: mapped_real}\n"
      "  - {name: west, box_m: [0.1, 3], x_m: -0.05, y_m: 1.5, layer: mapped_real}\n"
      "  - {name: east, box_m: [0.1, 3], x_m: 4.05, y_m: 1.5, layer: mapped_real}\n"
      "  - {name: box, box_m: [0.4, 0.4], x_m: 2.9, y_m: 2.2, yaw_deg: 30, layer: mapped_real}\n";

  /// Of the repository, or a copy with another program, which is the last thing in it.
  [[nodiscard]] std::string robot_file(const std::string& robot, const std::string& program) const {
    std::string original = RAVE_SOURCE_DIR "/robots/" + robot + ".yaml";
    if (program.empty()) return original;
    std::ifstream stream(original);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    text.erase(text.rfind("program:"));
    write(robot + ".yaml", text + program);
    return file(robot + ".yaml");
  }
};

}  // namespace rave::tests
