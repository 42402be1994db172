// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>

#include "rave/bus/run_id.hpp"
#include "shared_world.hpp"

namespace rave::cli_test {

/// How often each kind of process is killed: RAVE_KILL_ROUNDS, or 5.
[[nodiscard]] int kill_rounds();

/// The chance of one round of a test: the same for the same seed, name and round, whatever other
/// rounds there are. The seed is RAVE_TEST_SEED, or another each time; it is printed.
class RoundChance {
 public:
  RoundChance(std::string_view test, int round);

  /// 0 to `end` - 1.
  [[nodiscard]] std::uint64_t below(std::uint64_t end) { return engine_() % end; }
  [[nodiscard]] bool one_in(std::uint64_t many) { return below(many) == 0; }
  [[nodiscard]] std::chrono::microseconds up_to(std::chrono::microseconds longest) {
    return std::chrono::microseconds(below(static_cast<std::uint64_t>(longest.count()) + 1));
  }

 private:
  std::mt19937_64 engine_;
};

/// A round in which processes are killed; the parameter of the test is its number.
class KillRound : public SharedWorld, public ::testing::WithParamInterface<int> {
 protected:
  /// The words that name the run of this round.
  [[nodiscard]] std::vector<std::string> of_run(std::vector<std::string> more) const;
  /// `kill -9`; fails if the process had ended before.
  void kill_process(const std::string& name);
  /// The record of a process that ended in order can be read and is whole.
  void expect_whole_record(const std::string& name);
  /// The record of one that was killed can be read, with all that is before `least_s` of the run.
  void expect_readable_record(const std::string& name, double least_s);

  bus::RunId run_ = bus::RunId::random();
  RoundChance chance_{::testing::UnitTest::GetInstance()->current_test_info()->test_suite_name(),
                      GetParam()};
};

}  // namespace rave::cli_test
