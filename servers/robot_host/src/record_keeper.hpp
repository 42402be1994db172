// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kinds.hpp"
#include "observer.hpp"
#include "rave/record/run_record.hpp"

namespace rave::robot_host {

/// Writes the record of a run: every percept as the program got it, every command, pose and event.
class RecordKeeper final : public Observer {
 public:
  /// What the record says of its run beside what the engine knows.
  struct About {
    std::string scenario;
    std::string expanded;
    record::StringMap versions;
    record::StringMap inputs;
    bool hashed = true;  ///< A lock-step run, whose hash is kept of each step.
  };
  /// Begins the file. `log` hears of a full disk, once; the run goes on without a record then.
  [[nodiscard]] static Result<std::unique_ptr<RecordKeeper>> begin(
      const std::filesystem::path& path, const sim::Engine& engine, const BodyKinds& kinds,
      const About& about, LogSink* log);

  void after_step(sim::Engine& engine) override;

  [[nodiscard]] record::RunRecorder& recorder() noexcept { return recorder_; }

  /// Closes the file. `hash`: none for a live run. Errors: what kept it from being written.
  Status end(std::optional<std::uint64_t> hash) { return recorder_.end(hash); }

 private:
  RecordKeeper(record::RunRecorder recorder, const sim::EngineSpec& spec, const BodyKinds& kinds,
               bool hashed);
  void keep_robot(const sim::Engine& engine, std::uint32_t robot);
  void keep_actuators(const sim::Engine& engine, std::uint32_t robot);
  void keep_events(const sim::Engine& engine);

  record::RunRecorder recorder_;
  const BodyKinds* kinds_;
  std::vector<std::vector<std::uint32_t>> seen_;  ///< Sequence of each sensor of each robot.
  std::vector<std::vector<Command>> told_;  ///< The last command of each actuator of each robot.
  std::vector<record::RobotPose> poses_;
  bool hashed_;
};

}  // namespace rave::robot_host
