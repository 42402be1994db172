// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rave/base/descriptor.hpp"
#include "rave/observe/kinds.hpp"
#include "rave/results/facts.hpp"
#include "rave/results/goal_checks.hpp"
#include "rave/results/run_outcome.hpp"
#include "rave/results/shared_results.hpp"

namespace rave::runtime {

/// The origin of the facts of one host.
struct HostShare : HostState {
  /// One per start of the host; empty: it runs on another machine.
  std::vector<std::string> folders;
  bool found = false;  ///< Its facts were found.
};

/// All inputs of the results of a run after its end.
struct RunResults {
  const config::ExpandedScenario& scenario;
  const sim::EngineSpec& spec;  ///< Its world is that at the end.
  const BodyKinds& kinds;
  const std::string& live_reason;
  const RunFacts& facts;
  double wall_s = 0;
  std::optional<std::uint64_t> hash{};
  bool ended_by_hand = false;  ///< By a person or a signal, before its duration.
  /// By robot, 1: no facts. Empty: facts of all robots are known.
  std::vector<std::uint8_t> lost{};
  std::vector<HostShare> hosts{};         ///< For a run with several hosts.
  std::optional<std::uint64_t> worlds{};  ///< In real time: number of worlds that the manager sent.
  /// In real time: number of states that the manager received.
  std::optional<std::uint64_t> states{};
  std::optional<SharedEdits> edits{};

  [[nodiscard]] bool any_lost() const noexcept;
  /// Simulated time of the run.
  [[nodiscard]] double done_s() const noexcept;
  [[nodiscard]] double time_s(const sim::Event& event) const noexcept;
  [[nodiscard]] std::size_t real_robots() const;
  [[nodiscard]] std::size_t count(sim::EventKind kind) const;
};

/// How often guards acted, by robot and action, such as `slowed by fence`.
using GuardCounts = std::map<std::string, std::map<std::string, std::size_t>>;
[[nodiscard]] GuardCounts guard_counts(const RunResults& results);

/// Evaluates the run: completeness, checks, hash.
[[nodiscard]] RunOutcome judge(const RunResults& results);

/// Why there is no run hash; empty if there is one.
[[nodiscard]] std::string why_no_hash(const RunResults& results, const RunOutcome& outcome);

/// The content of result.json.
[[nodiscard]] std::string result_json(const RunResults& results, const RunOutcome& outcome);

/// The table of the summary for a terminal.
[[nodiscard]] std::string summary_text(const RunResults& results, const RunOutcome& outcome);

/// The picture of the run.
[[nodiscard]] report::Picture make_picture(const RunResults& results, const RunOutcome& outcome);

/// Room on the disk for the results, taken before a recording may fill it; see take_disk_room().
[[nodiscard]] Descriptor take_room_for_results(const std::filesystem::path& folder,
                                               const sim::EngineSpec& spec);

/// Evaluates the run and writes summary.txt, events.log, result.json and, if requested, the
/// pictures, in this order. Each is written by itself: one that cannot be written, such as on a
/// full disk, is a problem of the outcome, which then is not whole.
[[nodiscard]] RunOutcome write_results(const RunResults& results,
                                       const std::filesystem::path& folder, bool picture);

}  // namespace rave::runtime
