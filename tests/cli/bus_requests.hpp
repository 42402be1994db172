// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <string>
#include <vector>

#include "shared_world.hpp"

namespace rave::cli_test {

using Words = std::vector<std::string>;

/// Runs that are asked from beside their processes, and from a machine that shares the bus alone.
class BusRequests : public SharedWorld {
 protected:
  /// `rave` on a machine without runs.
  [[nodiscard]] Ended far(Words words) const {
    for (const std::string& word : apart()) words.push_back(word);
    return run_rave(words, {"XDG_RUNTIME_DIR=" + elsewhere_.path().string()});
  }
  /// `rave` beside the processes of the run.
  [[nodiscard]] Ended near(const Words& words) const {
    return run_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()});
  }
  void start_all(const std::string& scenario, const Words& more) {
    start("env", "env", scenario, more);
    start_host("one", scenario, more);
    start_host("two", scenario, more);
    wait_until([this] { return far({"edit", "list"}).exit_code == 0; }, "it runs");
  }
  void refused(const Words& words, const std::string& why) const {
    const Ended ended = far(words);
    EXPECT_EQ(ended.exit_code, 1) << ended.out;
    EXPECT_NE(ended.err.find(why), std::string::npos) << ended.err;
  }
  /// Asked again, a few times, until it says so: what is on the bus may be seen late.
  [[nodiscard]] Ended far_until(const Words& words, const std::string& said) const {
    Ended ended = far(words);
    for (int i = 0; i < 9 && ended.err.find(said) == std::string::npos; ++i) ended = far(words);
    return ended;
  }
  /// Whether it has seen a process of some other run; of that of this number.
  [[nodiscard]] bool logged_foreign(const std::string& who, const std::string& run = {}) const {
    return console(who).find("a process of run " + run) != std::string::npos;
  }
  [[nodiscard]] bool logged(const std::string& who, const std::string& line) const {
    const std::string log = console(who);
    return log.find("over the bus: " + line) != std::string::npos;
  }
};

}  // namespace rave::cli_test
