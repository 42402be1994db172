// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <signal.h>
#include <sys/socket.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "rave/live_testing/peer_process.hpp"

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

/// `rave run` as a process.
class RaveRun {
 public:
  RaveRun(const std::string& scenario, const std::string& output) {
    std::string path = RAVE_BINARY_DIR "/bin/rave";
    std::vector<std::string> texts{path,   "run",          scenario, "--output",
                                   output, "--no-picture", "--quiet"};
    std::vector<char*> arguments;
    for (std::string& text : texts) arguments.push_back(text.data());
    arguments.push_back(nullptr);
    EXPECT_EQ(::posix_spawn(&pid_, path.c_str(), nullptr, nullptr, arguments.data(), environ), 0);
  }
  RaveRun(const RaveRun&) = delete;
  RaveRun& operator=(const RaveRun&) = delete;
  ~RaveRun() {
    if (pid_ > 0) kill();
  }

  /// The exit code.
  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// As a crash or the kernel does it: nothing of the process runs any more.
  void kill() {
    ::kill(pid_, SIGKILL);
    (void)wait();
  }
  /// Ends it as a user does.
  void interrupt() const { ::kill(pid_, SIGINT); }

 private:
  pid_t pid_ = -1;
};

/// The robot as a peer, and a scenario that it takes part in.
class CreateRun {
 public:
  /// `robot`: create or create-simulated. `others`: more entries of `robots`, and `keys`: more keys
  /// of the scenario, as text.
  CreateRun(const std::string& robot, double duration_s, std::vector<std::string> options = {},
            const std::string& others = "", const std::string& keys = "")
      : folder_(std::filesystem::temp_directory_path() /
                ("create_run_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
    std::ofstream(file("room")) << "2 1.5 0 4 3   # all around\n2.9 2.2 30 0.4 0.4\n";
    const std::string port = std::to_string(free_port());
    options.insert(options.end(),
                   {"--link", file("base"), "--laser-link", file("laser"), "--mocap-port", port,
                    "--mocap-body", "create", "--room", file("room"), "--pose", "1,1,0.4",
                    "--mocap-noise-m", "0.001", "--mocap-delay-s", "0.01", "--log", file("log")});
    if (robot == "create") peer = std::make_unique<testing::PeerProcess>("peer_create", options);
    std::ofstream(file("world.yaml")) << kWorld;
    std::ofstream(file("scenario.yaml"))
        << "name: create\nduration_s: " << duration_s
        << "\nrobots:\n  - name: rosie\n    file: " RAVE_SOURCE_DIR "/robots/" << robot
        << ".yaml\n    pose: {x_m: 1, y_m: 1, yaw_deg: 22.9}\n    variables: {base: '"
        << file("base") << "', laser: '" << file("laser") << "', mocap_port: " << port
        << ", mocap_body: create}\n"
        << others << "world: world.yaml\n"
        << keys;
  }
  ~CreateRun() {
    rave.reset();
    peer.reset();
    std::filesystem::remove_all(folder_);
  }

  void start() { rave = std::make_unique<RaveRun>(file("scenario.yaml"), file("out")); }
  [[nodiscard]] nlohmann::json result() const {
    std::ifstream stream(file("out/result.json"));
    return nlohmann::json::parse(stream, nullptr, false);
  }
  [[nodiscard]] nlohmann::json state() { return nlohmann::json::parse(peer->ask("state")); }
  template <class Wanted>
  nlohmann::json await_state(Wanted wanted) {
    const auto end = std::chrono::steady_clock::now() + testing::kLong;
    nlohmann::json now = state();
    while (!wanted(now) && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      now = state();
    }
    EXPECT_TRUE(wanted(now)) << now.dump();
    return now;
  }

  [[nodiscard]] std::string file(const std::string& name) const {
    return (folder_ / name).string();
  }

  std::unique_ptr<testing::PeerProcess> peer;
  std::unique_ptr<RaveRun> rave;

 private:
  /// The peer's room as the simulated twin needs it.
  static constexpr const char* kWorld =
      "obstacles:\n"
      "  - {name: south, box_m: [4.2, 0.1], x_m: 2, y_m: -0.05, layer: mapped_real}\n"
      "  - {name: north, box_m: [4.2, 0.1], x_m: 2, y_m: 3.05, layer: mapped_real}\n"
      "  - {name: west, box_m: [0.1, 3], x_m: -0.05, y_m: 1.5, layer: mapped_real}\n"
      "  - {name: east, box_m: [0.1, 3], x_m: 4.05, y_m: 1.5, layer: mapped_real}\n"
      "  - {name: box, box_m: [0.4, 0.4], x_m: 2.9, y_m: 2.2, yaw_deg: 30, layer: mapped_real}\n";

  std::filesystem::path folder_;
};

}  // namespace rave::tests
