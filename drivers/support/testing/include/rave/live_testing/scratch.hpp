// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "rave/live_testing/await.hpp"
#include "rave/live_testing/peer_process.hpp"

namespace rave::testing {

/// A folder for this test, removed by the destructor.
class Scratch {
 public:
  explicit Scratch(const std::string& prefix)
      : folder_(std::filesystem::temp_directory_path() /
                (prefix + "_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string file(const std::string& name) const {
    return (folder_ / name).string();
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
  }

 private:
  std::filesystem::path folder_;
};

/// Repeats `ask` until `wanted(answer)` holds; returns the last answer.
template <class Ask, class Wanted>
nlohmann::json await_answer(Ask&& ask, Wanted&& wanted, std::chrono::milliseconds pause = kOften) {
  nlohmann::json now;
  const bool came = await(
      [&] {
        now = ask();
        return wanted(now);
      },
      pause);
  EXPECT_TRUE(came) << now.dump();
  return now;
}

/// The state that a peer reports.
[[nodiscard]] inline nlohmann::json state_of(PeerProcess& peer) {
  return nlohmann::json::parse(peer.ask("state"));
}
/// Tests of the state of a peer with two wheels.
[[nodiscard]] inline bool wheels_turn(const nlohmann::json& state) {
  return std::abs(state["left_mps"].get<double>()) > 0.05;
}
[[nodiscard]] inline bool wheels_stand(const nlohmann::json& state) {
  return state["left_mps"] == 0.0 && state["right_mps"] == 0.0;
}

}  // namespace rave::testing
