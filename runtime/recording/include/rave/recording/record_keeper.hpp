// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "rave/control/run_control.hpp"
#include "rave/observe/kinds.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/record/run_record.hpp"
#include "rave/recording/part_keeper.hpp"
#include "rave/recording/record_columns.hpp"
#include "rave/recording/variance_keeper.hpp"

namespace rave::runtime {

/// Records a run: every percept as the program received it, every command, pose and event.
class RecordKeeper final : public RunObserver {
 public:
  /// Properties of the recording besides RunInfo.
  struct About {
    record::StringMap hybrids;  ///< PartKeeper::describe().
    bool hashed = true;         ///< A lock-step run, so the hash of each step is recorded.
    std::string host{};         ///< Name of the host, if it is one of several.
    record::StringMap hosts{};  ///< The robots of each host, if there are several.
  };
  /// Creates the file. A full disk is logged once in `log`; the run then continues without a
  /// recording.
  [[nodiscard]] static Result<std::unique_ptr<RecordKeeper>> open(const std::filesystem::path& path,
                                                                  const sim::Engine& engine,
                                                                  const BodyKinds& kinds,
                                                                  const record::RunInfo& info,
                                                                  const About& about, LogSink* log);

  // It records after the other observers, because their findings are part of the recording.
  void after_step(const StepView& /*step*/) override {}
  void after_all(const StepView& step, std::span<RunObserver* const> all) override;

  /// Records a step without the findings of observers.
  void keep(const StepView& step);

  /// Records events of the last step that observers found.
  void keep(std::span<const sim::Event> events);

  /// Records a request that takes effect at this step.
  void keep(const request::Request& request, std::uint64_t step);

  /// Records a chat message (kChat) before this step.
  void say(const request::Request& chat, std::uint64_t step);

  [[nodiscard]] record::RunRecorder& recorder() noexcept { return recorder_; }

  /// Closes the file. `hash`: empty for a live run. Errors: a failed write.
  Status end(std::optional<std::uint64_t> hash) { return recorder_.end(hash); }

 private:
  RecordKeeper(record::RunRecorder recorder, const sim::Engine& engine, const BodyKinds& kinds,
               bool hashed);
  /// Updates the kind of pose of robots that were handed over in the last step.
  void follow(const sim::Engine& engine);
  void keep_poses(const sim::Engine& engine);
  void keep_pose(const sim::Engine& engine, RobotId robot);
  /// Records robots [begin, end), whose reported pose is the true one.
  void keep_row(const sim::Engine& engine, std::uint32_t begin, std::uint32_t end);

  record::RunRecorder recorder_;
  PartKeeper parts_;
  const BodyKinds* kinds_;
  std::vector<RecordColumns> groups_;
  std::vector<std::uint8_t> told_truth_;  ///< By robot: simulated, without a pose source.
  bool with_real_ = false;  ///< There are real robots, which push simulated ones aside.
  VarianceKeeper variances_;
  bool hashed_;
};

/// Records a chat message (kChat) before this step.
void record_chat(const request::Request& chat, std::uint64_t step, record::RunRecorder& recorder);

/// The RunInfo of an engine: seed, step, all robots, and the sensors of the robots that run here.
[[nodiscard]] record::RunInfo info_of(const sim::Engine& engine, const BodyKinds& kinds);
/// The RunInfo of a spec, without sensors.
[[nodiscard]] record::RunInfo info_of(const sim::EngineSpec& spec, const BodyKinds& kinds);

/// Records events of the current step with descriptions for people.
void record_events(const BodyKinds& kinds, std::span<const sim::Event> events,
                   record::RunRecorder& recorder);

}  // namespace rave::runtime
