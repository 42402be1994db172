// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "kinds.hpp"
#include "observer.hpp"
#include "rave/record/run_record.hpp"

namespace rave::robot_host {

/// Writes the record of a run: every percept as the program got it, every command, pose and event.
class RecordKeeper final : public Observer {
 public:
  /// Begins the file. `log` hears of a full disk, once; the run goes on without a record then.
  [[nodiscard]] static Result<std::unique_ptr<RecordKeeper>> begin(
      const std::filesystem::path& path, const sim::Engine& engine, const BodyKinds& kinds,
      const std::string& scenario_name, const std::string& expanded_scenario, LogSink* log);

  void after_step(sim::Engine& engine) override;

  /// Events of the last step that observers found.
  void keep(std::span<const sim::Event> events);

  [[nodiscard]] record::RunRecorder& recorder() noexcept { return recorder_; }

  /// Closes the file. `hash`: none for a live run. Errors: what kept it from being written.
  Status end(std::optional<std::uint64_t> hash) { return recorder_.end(hash); }

 private:
  RecordKeeper(record::RunRecorder recorder, const sim::EngineSpec& spec, const BodyKinds& kinds);
  void keep_robot(const sim::Engine& engine, std::uint32_t robot);

  record::RunRecorder recorder_;
  const BodyKinds* kinds_;
  std::vector<std::vector<std::uint32_t>> seen_;  ///< Sequence of each sensor of each robot.
  std::vector<record::RobotPose> poses_;
};

}  // namespace rave::robot_host
