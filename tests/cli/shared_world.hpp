// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "process.hpp"

namespace rave::cli_test {

/// Processes that share a world, in a folder and on a bus of their own; all ended with the test.
class SharedWorld : public ::testing::Test {
 public:
  ~SharedWorld() override;

 protected:
  SharedWorld();

  /// Starts `rave WHAT SCENARIO` with what keeps tests apart, under a name of the test's choice.
  /// The results of an earlier process of that name go.
  void start(const std::string& name, const std::string& what, const std::string& scenario,
             std::vector<std::string> more = {});
  /// The same of `rave robot` for the host `name`.
  void start_host(const std::string& host, const std::string& scenario,
                  std::vector<std::string> more = {});
  /// Starts `rave` with these words as they are; only the folder of its results is added.
  void start_as_told(const std::string& name, std::vector<std::string> words);
  /// The same as start_host() on another machine: none of its sockets is seen beside the others.
  void start_elsewhere(const std::string& host, const std::string& scenario);
  /// A copy of the scenario `crowd.yaml` that does this about lost hosts; its file.
  [[nodiscard]] std::string crowd_with_policy(const std::string& policy, double timeout_s) const;
  /// Its exit code; -1 if a signal ended it.
  int end_of(const std::string& name);
  /// Interrupts the process of a manager. `code`: 1 if hosts were lost, and in real time, where
  /// they continue without it.
  void end_by_hand(const std::string& manager, int code = 0);
  void signal(const std::string& name, int number);
  [[nodiscard]] pid_t id_of(const std::string& name) const { return processes_.at(name); }
  [[nodiscard]] bool runs(const std::string& name);

  /// The words that keep this test's run apart from others on this machine.
  [[nodiscard]] std::vector<std::string> apart() const;
  [[nodiscard]] std::string folder(const std::string& name) const;
  [[nodiscard]] nlohmann::json result(const std::string& name) const;
  [[nodiscard]] std::string console(const std::string& name) const;
  /// Gives up only when something is broken.
  void wait_until(const std::function<bool()>& holds, const std::string& what);
  void wait_for_line(const std::string& name, const std::string& text);

  TemporaryFolder folder_;
  TemporaryFolder elsewhere_;  ///< The sockets of another machine.

 private:
  void start_in(const std::string& runtime, const std::string& name,
                std::vector<std::string> words);
  void start_words(const std::string& runtime, const std::string& name,
                   std::vector<std::string> words);
  std::string tag_;
  int domain_ = 0;
  std::map<std::string, pid_t> processes_;
};

/// The hash of the same run in one process.
[[nodiscard]] std::string hash_alone(const std::string& scenario,
                                     const std::vector<std::string>& more);

}  // namespace rave::cli_test
