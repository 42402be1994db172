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

/// The robots of each host of a scenario, for the recordings of its processes.
[[nodiscard]] Result<record::StringMap> hosts_for_record(const config::ExpandedScenario& scenario);

/// The recording of the world authority: contacts, changes of the world, and its part of the hash.
/// Together with the recordings of the hosts it gives the recording of the whole run.
class WorldRecord {
 public:
  /// A full disk is logged in `log`. Errors: those of RunRecorder::open().
  [[nodiscard]] static Result<std::unique_ptr<WorldRecord>> begin(
      const std::filesystem::path& path, const config::ExpandedScenario& scenario,
      const sim::EngineSpec& spec, const BodyKinds& kinds, LogSink* log);

  /// Records a step. end() reports a failed write.
  void step(std::uint64_t step, const BodyKinds& kinds, std::span<const sim::Event> events,
            std::uint64_t hash);
  /// Records a chat message (kChat) before this step.
  void say(const request::Request& chat, std::uint64_t step);
  Status end(std::uint64_t hash) { return recorder_.end(hash); }

 private:
  WorldRecord(record::RunRecorder recorder, Duration step)
      : recorder_(std::move(recorder)), step_(step) {}

  record::RunRecorder recorder_;
  Duration step_;
};

}  // namespace rave::runtime
