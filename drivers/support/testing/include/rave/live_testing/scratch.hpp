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

/// A folder of this test alone, removed with this object.
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

/// Asks until the answer is as wanted; gives the last one.
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

/// What a peer says of itself.
[[nodiscard]] inline nlohmann::json state_of(PeerProcess& peer) {
  return nlohmann::json::parse(peer.ask("state"));
}
/// The same of one that has two wheels.
[[nodiscard]] inline bool wheels_turn(const nlohmann::json& state) {
  return std::abs(state["left_mps"].get<double>()) > 0.05;
}
[[nodiscard]] inline bool wheels_stand(const nlohmann::json& state) {
  return state["left_mps"] == 0.0 && state["right_mps"] == 0.0;
}

}  // namespace rave::testing
