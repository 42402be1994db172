// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rave/observe/kinds.hpp"
#include "rave/results/facts.hpp"
#include "rave/results/goal_checks.hpp"
#include "rave/results/run_outcome.hpp"
#include "rave/results/shared_results.hpp"

namespace rave::runtime {

/// Where what one host knows of a run comes from.
struct HostShare {
  std::string name;
  std::vector<std::string> folders;  ///< Of each time that it was started; empty: elsewhere.
  bool found = false;                ///< It left what it knows.
  std::optional<double> offset_s;    ///< Of its clock, of runs in real time.
  std::optional<double> bound_s;     ///< How far that may be off.
  std::optional<bool> heard;         ///< It was there at some time, in real time.
  std::optional<std::uint64_t> losses;
};

/// Everything that is known of a run when it has ended.
struct Findings {
  const config::ExpandedScenario& scenario;
  const sim::EngineSpec& spec;  ///< Its world as it was at the end.
  const BodyKinds& kinds;
  const std::string& live_reason;
  const RunFacts& facts;
  double wall_s = 0;
  std::optional<std::uint64_t> hash{};
  bool ended_early = false;
  std::vector<std::uint8_t> lost{};       ///< By robot, 1: nothing is known of it. Empty: of none.
  std::vector<HostShare> hosts{};         ///< Of a run of several.
  std::optional<std::uint64_t> worlds{};  ///< Of one in real time: that the manager sent.
  std::optional<std::uint64_t> states{};  ///< ... and that it got.
  std::optional<SharedEdits> edits{};

  [[nodiscard]] bool any_lost() const noexcept;
  /// Simulated time that was run through.
  [[nodiscard]] double done_s() const noexcept;
  [[nodiscard]] std::size_t real_robots() const;
  [[nodiscard]] std::size_t count(sim::EventKind kind) const;
};

/// What the guards did, by robot: `slowed by fence` and how often.
using GuardCounts = std::map<std::string, std::map<std::string, std::size_t>>;
[[nodiscard]] GuardCounts guard_counts(const Findings& findings);

/// What the run amounts to: whole or not, checks, hash.
[[nodiscard]] RunOutcome judge(const Findings& findings);

/// Why there is no run hash; empty if there is one.
[[nodiscard]] std::string why_no_hash(const Findings& findings, const RunOutcome& outcome);

/// The content of result.json.
[[nodiscard]] std::string result_json(const Findings& findings, const RunOutcome& outcome);

/// The table of the summary for a terminal.
[[nodiscard]] std::string summary_text(const Findings& findings, const RunOutcome& outcome);

/// The picture of the run.
[[nodiscard]] report::Picture make_picture(const Findings& findings, const RunOutcome& outcome);

/// Judges, and writes result.json, summary.txt, events.log and, if wanted, the pictures.
[[nodiscard]] Result<RunOutcome> write_results(const Findings& findings,
                                               const std::filesystem::path& folder, bool picture);

}  // namespace rave::runtime
