// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/pace/lateness.hpp"
#include "rave/results/run_outcome.hpp"
#include "rave/sim/world_authority.hpp"

namespace rave::runtime {

struct RunRequest;

/// What is known of a host when a run of several is over.
struct SharedHost {
  std::string name;
  /// Where it left what it knows, in the order in which it was started; empty: it is elsewhere.
  std::vector<std::filesystem::path> folders;
  /// What its processes have sent of what they know: the same bytes as lie in its folders, wherever
  /// these are.
  std::vector<std::vector<std::byte>> findings;
  bool awaited = false;  ///< They were waited for.
  // Of a run in real time:
  std::optional<double> offset_s;  ///< Of its clock against that of the manager.
  std::optional<double> bound_s;
  std::optional<bool> heard;  ///< It was there at some time.
  std::optional<std::uint64_t> losses;
};

/// Obstacles that were changed by hand in real time, and how soon all hosts had them.
struct SharedEdits {
  std::uint64_t made = 0;
  std::uint64_t confirmed = 0;  ///< By all hosts that were there.
  double slowest_s = 0;         ///< Of those; from the request to the last answer.
  double sum_s = 0;
};

/// How a run of several hosts ended.
struct SharedEnd {
  std::optional<std::uint64_t> hash;
  std::uint64_t steps = 0;
  double wall_s = 0;
  std::vector<std::string> problems;
  LatenessFacts lateness;         ///< Of its manager, in lock-step.
  std::vector<SharedHost> hosts;  ///< As planned; all of them.
  // Of a run in real time: what the manager sent and got.
  std::optional<std::uint64_t> worlds;
  std::optional<std::uint64_t> states;
  std::optional<SharedEdits> edits;
  std::vector<sim::Event> events;  ///< What it saw and no host did.
};

/// Makes of what the hosts of a run left, and of what its manager saw, the results that the run has
/// in one process: result.json, summary.txt, events.log, the pictures and the verdicts of its
/// checks. What needs a host that left nothing is said to be not made. Belongs to one thread.
class SharedResults {
 public:
  struct Options {
    std::filesystem::path folder;  ///< There; files of an earlier run are replaced.
    bool picture = true;
    bool record = true;      ///< Of a run in lock-step: write world.mcap.
    LogSink* log = nullptr;  ///< Not owned; outlives this.
  };
  /// `built`: the whole world; copied. Errors: those of the record.
  [[nodiscard]] static Result<std::unique_ptr<SharedResults>> begin(
      const config::ExpandedScenario& scenario, const BuiltScenario& built, Options options);
  SharedResults(const SharedResults&) = delete;
  SharedResults& operator=(const SharedResults&) = delete;
  ~SharedResults();

  /// In lock-step: the authority has made another world. True: a check ends the run with it.
  bool after_step(const sim::WorldAuthority& authority);
  /// What people said since the last step; a kChat. For the record.
  void say(const RunRequest& chat);
  /// ... and makes none any more.
  void at_end(const sim::WorldAuthority& authority);

  /// In real time: the world that the manager had at the end.
  void learn(const world::WorldModel& world);

  /// Once, when all hosts that will have ended. Errors: kIo.
  [[nodiscard]] Result<RunOutcome> write(const SharedEnd& end);

 private:
  struct Impl;
  explicit SharedResults(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::runtime
