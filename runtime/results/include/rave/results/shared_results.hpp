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

namespace rave::request {
struct Request;
}  // namespace rave::request

namespace rave::runtime {

/// A host at the end of a run with several; all but the name in real time only.
struct HostState {
  std::string name;
  std::optional<double> offset_s;  ///< Offset of its clock relative to the manager's.
  std::optional<double> bound_s;   ///< Bound of the error of offset_s.
  std::optional<bool> heard;       ///< It was present at some time.
  std::optional<std::uint64_t> losses;
};

/// What is known of one host after a run with several.
struct SharedHost : HostState {
  /// Its result folders, one per start; empty: it runs on another machine.
  std::vector<std::filesystem::path> folders;
  /// The facts that its processes have sent: the same bytes as in its folders.
  std::vector<std::vector<std::byte>> results;
  bool awaited = false;  ///< The run has waited for its facts.
};

/// Obstacle changes by hand in real time, and their delay until all hosts had them.
struct SharedEdits {
  std::uint64_t made = 0;
  std::uint64_t confirmed = 0;  ///< Confirmed by all present hosts.
  /// Longest delay of a confirmed change, from the request to the last confirmation.
  double slowest_s = 0;
  double sum_s = 0;
};

/// The end of a run with several hosts.
struct SharedEnd {
  std::optional<std::uint64_t> hash;
  std::uint64_t steps = 0;
  double wall_s = 0;
  bool ended_by_hand = false;  ///< The run, not only one of its hosts.
  std::vector<std::string> problems;
  LatenessFacts lateness;         ///< Of the manager, in lock-step.
  std::vector<SharedHost> hosts;  ///< All planned hosts, in order.
  // In real time: numbers of worlds sent and states received by the manager.
  std::optional<std::uint64_t> worlds;
  std::optional<std::uint64_t> states;
  std::optional<SharedEdits> edits;
  std::vector<sim::Event> events;  ///< Events that only the manager has.
};

/// Computes the results of a run with several hosts from the facts of its hosts and the data of its
/// manager. They equal those of a run in one process: result.json, summary.txt, events.log, the
/// pictures and the verdicts of its checks. Checks that need a host without facts are reported as
/// not evaluated. Belongs to one thread.
class SharedResults {
 public:
  struct Options {
    std::filesystem::path folder;  ///< Must exist; files of an earlier run are replaced.
    bool picture = true;
    bool record = true;      ///< In lock-step: write world.mcap.
    LogSink* log = nullptr;  ///< Not owned; must outlive this object.
  };
  /// `built`: the whole world; copied. Errors: those of creating the recording.
  [[nodiscard]] static Result<std::unique_ptr<SharedResults>> begin(
      const config::ExpandedScenario& scenario, const BuiltScenario& built, Options options);
  SharedResults(const SharedResults&) = delete;
  SharedResults& operator=(const SharedResults&) = delete;
  ~SharedResults();

  /// In lock-step: call it when the authority has made a world. Returns true if a check ends the
  /// run.
  bool after_step(const sim::WorldAuthority& authority);
  /// Records a chat message (kChat) since the last step.
  void say(const request::Request& chat);
  /// In lock-step: call it after the last world.
  void at_end(const sim::WorldAuthority& authority);

  /// In real time: sets the manager's world at the end.
  void learn(const world::WorldModel& world);

  /// Writes the results. Call it once, when all hosts have ended or are given up. Errors: those of
  /// config::plan_hosts().
  [[nodiscard]] Result<RunOutcome> write(const SharedEnd& end);

 private:
  struct Impl;
  explicit SharedResults(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::runtime
