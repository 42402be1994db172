// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/observe/kinds.hpp"
#include "rave/record/run_record.hpp"

namespace rave::runtime {

/// Which robots each host of a scenario runs, for the records of its processes.
[[nodiscard]] Result<record::StringMap> hosts_for_record(const config::ExpandedScenario& scenario);

/// The record of what only the authority of a shared world knows: contacts, changes of the world,
/// and its part of the hash. Beside the records of the hosts it makes that of the whole run.
class WorldRecord {
 public:
  /// `log` hears of a full disk. Errors: as RunRecorder::open().
  [[nodiscard]] static Result<std::unique_ptr<WorldRecord>> begin(
      const std::filesystem::path& path, const config::ExpandedScenario& scenario,
      const sim::EngineSpec& spec, const BodyKinds& kinds, LogSink* log);

  /// A step is done. That it could not be written is told by end().
  void step(std::uint64_t step, const BodyKinds& kinds, std::span<const sim::Event> events,
            std::uint64_t hash);
  /// What was said before this step; a kChat.
  void say(const RunRequest& chat, std::uint64_t step);
  Status end(std::uint64_t hash) { return recorder_.end(hash); }

 private:
  WorldRecord(record::RunRecorder recorder, Duration step)
      : recorder_(std::move(recorder)), step_(step) {}

  record::RunRecorder recorder_;
  Duration step_;
};

}  // namespace rave::runtime
