// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>

#include "create_run.hpp"

namespace rave::tests {

/// Tests of several processes at once must not meet; there is no tag in ROS 2.
inline int ros2_domain() { return 1 + static_cast<int>(::getpid()) % 90; }

/// A peer of ROS 2, a scenario, and a folder for its files.
class Ros2Run {
 public:
  Ros2Run()
      : folder_(std::filesystem::temp_directory_path() /
                ("ros2_run_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  Ros2Run(const Ros2Run&) = delete;
  Ros2Run& operator=(const Ros2Run&) = delete;
  ~Ros2Run() {
    rave.reset();
    peer.reset();
    std::filesystem::remove_all(folder_);
  }

  void start_peer(const std::string& program, std::vector<std::string> options) {
    options.insert(options.end(), {"--domain", std::to_string(ros2_domain())});
    peer = std::make_unique<testing::PeerProcess>(program, options);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
  }
  void start(const std::string& scenario) {
    write("scenario.yaml", scenario);
    rave = std::make_unique<RaveRun>(file("scenario.yaml"), file("out"));
  }
  [[nodiscard]] nlohmann::json result() const {
    std::ifstream stream(file("out/result.json"));
    return nlohmann::json::parse(stream, nullptr, false);
  }
  template <class Wanted>
  nlohmann::json await_state(Wanted wanted) {
    const auto end = std::chrono::steady_clock::now() + testing::kLong;
    nlohmann::json now = nlohmann::json::parse(peer->ask("state"));
    while (!wanted(now) && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      now = nlohmann::json::parse(peer->ask("state"));
    }
    EXPECT_TRUE(wanted(now)) << now.dump();
    return now;
  }
  /// Until the console has said something so many times.
  void await_console(const std::string& text, int times) const {
    const auto end = std::chrono::steady_clock::now() + testing::kLong;
    while (said(text) < times && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_GE(said(text), times) << text;
  }
  [[nodiscard]] std::string file(const std::string& name) const {
    return (folder_ / name).string();
  }

  std::unique_ptr<testing::PeerProcess> peer;
  std::unique_ptr<RaveRun> rave;

 private:
  [[nodiscard]] int said(const std::string& text) const {
    std::ifstream stream(file("out/console.log"));
    const std::string log{std::istreambuf_iterator<char>(stream), {}};
    int times = 0;
    for (auto at = log.find(text); at != std::string::npos; at = log.find(text, at + 1)) ++times;
    return times;
  }

  std::filesystem::path folder_;
};

}  // namespace rave::tests
