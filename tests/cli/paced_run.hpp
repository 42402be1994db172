// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <thread>

#include "process.hpp"

namespace rave::cli_test {

/// A run at the pace of the clock, in a process of its own, ended with the test.
class PacedRun : public ::testing::Test {
 protected:
  void TearDown() override {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    static_cast<void>(wait_for(process_));
  }

  void start(const std::string& scenario, const std::vector<std::string>& more = {},
             const std::string& pace = "realtime") {
    std::vector<std::string> words = {"run",    scenario, "--output",   output(),
                                      "--pace", pace,     "--duration", "100000"};
    words.insert(words.end(), more.begin(), more.end());
    process_ = start_rave(words, {setting_});
    ASSERT_GT(process_, 0);
    wait_until([&] {
      const std::string out = rave({"ps"}).out;
      return out.find("running") != std::string::npos || out.find("paused") != std::string::npos;
    });
  }
  /// Gives up only when something is broken.
  template <class Holds>
  void wait_until(Holds&& holds) {
    for (int i = 0; i < 3000; ++i) {
      if (holds()) return;
      ASSERT_EQ(::waitpid(process_, nullptr, WNOHANG), 0) << "the run has ended";
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    FAIL() << "never";
  }
  [[nodiscard]] Ended rave(const std::vector<std::string>& words) const {
    return run_rave(words, {setting_});
  }
  void end() {
    ASSERT_EQ(::kill(process_, SIGINT), 0);
    EXPECT_EQ(wait_for(process_), 0);
    process_ = -1;
  }
  [[nodiscard]] std::string output() const { return folder_.path() / "results"; }
  [[nodiscard]] std::string events() const { return content_of(output() + "/events.log"); }

  TemporaryFolder folder_;
  const std::string setting_ = "XDG_RUNTIME_DIR=" + folder_.path().string();
  pid_t process_ = -1;
};

}  // namespace rave::cli_test
