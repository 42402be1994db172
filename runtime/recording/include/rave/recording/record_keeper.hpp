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

/// Writes the record of a run: every percept as the program got it, every command, pose and event.
class RecordKeeper final : public RunObserver {
 public:
  /// What the record says of its run beside RunInfo.
  struct About {
    record::StringMap hybrids;  ///< PartKeeper::describe().
    bool hashed = true;         ///< A lock-step run, whose hash is kept of each step.
    std::string host{};         ///< Of one of several: its name.
    record::StringMap hosts{};  ///< ... and which robots each of them runs.
  };
  /// Begins the file. `log` hears of a full disk, once; the run goes on without a record then.
  [[nodiscard]] static Result<std::unique_ptr<RecordKeeper>> open(const std::filesystem::path& path,
                                                                  const sim::Engine& engine,
                                                                  const BodyKinds& kinds,
                                                                  const record::RunInfo& info,
                                                                  const About& about, LogSink* log);

  void after_step(const StepView& step) override;

  /// Events of the last step that observers found.
  void keep(std::span<const sim::Event> events);

  /// What was asked of the run and counts from this step on.
  void keep(const RunRequest& request, std::uint64_t step);

  /// What was said before this step; a kChat.
  void say(const RunRequest& chat, std::uint64_t step);

  [[nodiscard]] record::RunRecorder& recorder() noexcept { return recorder_; }

  /// Closes the file. `hash`: none for a live run. Errors: what kept it from being written.
  Status end(std::optional<std::uint64_t> hash) { return recorder_.end(hash); }

 private:
  RecordKeeper(record::RunRecorder recorder, const sim::Engine& engine, const BodyKinds& kinds,
               bool hashed);
  /// Robots that were handed over in the last step are told otherwise where they are.
  void follow(const sim::Engine& engine);
  void keep_poses(const sim::Engine& engine);
  void keep_pose(const sim::Engine& engine, RobotId robot);
  /// Robots [begin, end), which were all told their true pose.
  void keep_row(const sim::Engine& engine, std::uint32_t begin, std::uint32_t end);

  record::RunRecorder recorder_;
  PartKeeper parts_;
  const BodyKinds* kinds_;
  std::vector<RecordColumns> groups_;
  std::vector<std::uint8_t> told_truth_;  ///< By robot: simulated, without a pose source.
  bool with_real_ = false;                ///< There are real robots, which others make way for.
  VarianceKeeper variances_;
  bool hashed_;
};

/// Writes what was said before this step; a kChat.
void record_chat(const RunRequest& chat, std::uint64_t step, record::RunRecorder& recorder);

/// What an engine knows for the beginning of a record: start, seed, step, all robots, and the
/// sensors of those that run here.
[[nodiscard]] record::RunInfo info_of(const sim::Engine& engine, const BodyKinds& kinds);
/// The same without sensors.
[[nodiscard]] record::RunInfo info_of(const sim::EngineSpec& spec, const BodyKinds& kinds);

/// Writes events of the present step, in the words of people.
void record_events(const BodyKinds& kinds, std::span<const sim::Event> events,
                   record::RunRecorder& recorder);

}  // namespace rave::runtime
