// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "kinds.hpp"
#include "observer.hpp"
#include "part_keeper.hpp"
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

  /// Events of the last step that observers found.
  void keep(std::span<const sim::Event> events);

  [[nodiscard]] record::RunRecorder& recorder() noexcept { return recorder_; }

  /// Closes the file. `hash`: none for a live run. Errors: what kept it from being written.
  Status end(std::optional<std::uint64_t> hash) { return recorder_.end(hash); }

 private:
  /// One sensor of one robot. What it points to stays where it is as long as the engine lives.
  struct Sensor {
    const SampleHeader* header = nullptr;
    const std::byte* records = nullptr;
    std::uint32_t device = 0;
    std::uint32_t record_bytes = 0;
    std::uint32_t seen = 0;  ///< Sequence of the last sample that was kept.
    std::uint8_t kind = 0;
  };
  /// One actuator of one robot, and the last command that was kept.
  struct Actuator {
    const Command* command = nullptr;
    Command told;
  };
  /// A robot's share of the lists; the next robot's begins where it ends.
  struct Robot {
    std::uint32_t sensors_end = 0;
    std::uint32_t actuators_end = 0;
    std::uint32_t controllers = 0;
    bool simulated = false;
  };

  RecordKeeper(record::RunRecorder recorder, const sim::Engine& engine, const BodyKinds& kinds,
               bool hashed);
  void keep_sensors(RobotId robot, std::uint32_t begin, std::uint32_t end);
  void keep_commands(const sim::Engine& engine, RobotId robot, std::uint32_t controllers);
  void keep_actuators(RobotId robot, std::uint32_t begin, std::uint32_t end);
  void keep_pose(const sim::Engine& engine, RobotId robot, bool simulated);

  record::RunRecorder recorder_;
  PartKeeper parts_;
  const BodyKinds* kinds_;
  std::vector<Robot> robots_;
  std::vector<Sensor> sensors_;      ///< Of all robots, one after the other.
  std::vector<Actuator> actuators_;  ///< The same.
  bool hashed_;
};

}  // namespace rave::robot_host
