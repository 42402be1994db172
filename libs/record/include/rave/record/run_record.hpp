// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "rave/record/mcap_writer.hpp"
#include "rave/record/run_messages.hpp"

namespace rave::record {

/// What a record holds beside the exact streams: standard ROS 2 messages for viewers.
struct ViewOptions {
  /// Of `/tf` (all robots; of n > 100 robots the hundredth part of n times slower), and of scans
  /// and velocities of single robots; simulation time. 0: none.
  double rate_hz = 10;
  /// Robots (the first of the scenario) that get `/<robot>/<sensor>` and `/<robot>/cmd_vel`.
  std::uint32_t robots = 16;
};

struct RunRecorderOptions {
  McapWriterOptions file;
  ViewOptions views;
};

/// Writes what a run does into an MCAP file. Knows nothing of the engine: its owner calls
///
///     open, (begin_step, percept..., command..., actuator..., radio..., event..., pose..., hash,
///            end_step)..., end
///
/// from one thread; only console() may be called from any thread. Collects a step in memory and
/// writes one message per stream, so that a step costs a copy of its bytes. Times are simulation
/// times; log time is the time of the step. Errors are those of McapWriter: the first call after a
/// failed write, and each one after it, returns it; the run may go on.
class RunRecorder {
 public:
  /// Begins the file. `sink` may be null, else it must outlive the recorder; it must not lead back
  /// to console(). Errors: as McapWriter::open().
  [[nodiscard]] static Result<RunRecorder> open(const std::filesystem::path& path,
                                                const RunInfo& info,
                                                const RunRecorderOptions& options = {},
                                                LogSink* sink = nullptr);
  RunRecorder(RunRecorder&&) noexcept;
  RunRecorder& operator=(RunRecorder&&) noexcept;
  /// Closes the file; without end() the record then has no `/rave/end`.
  ~RunRecorder();

  /// Adds entries that describe the run, under a name of their own.
  Status describe(std::string_view name, const StringMap& entries);

  void begin_step(std::uint64_t step, SimTime time);
  /// The bytes are copied.
  void percept(const Percept& percept);
  /// The bytes must stay as they are until end_step(), which copies them once. In the record each
  /// robot has its own percept. Readings without records go one by one to percept().
  void percepts(const PerceptBlock& block);
  /// The bytes are copied.
  void command(const CommandRecord& command);
  /// As percepts().
  void commands(const CommandBlock& block);
  void actuator(const ActuatorRecord& command);
  void radio(const RadioPacket& packet);
  /// The run hash after this step; for lock-step runs.
  Status hash(std::uint64_t value);
  Status event(const RunEvent& event);
  /// Between end_step() and begin_step(), or before the first step.
  Status input(const RunInput& input);
  /// The same. The first one of a run begins a channel, which other records do not have.
  Status chat(const RunChat& chat);
  /// The first one of a run begins a channel, which other records do not have.
  Status shadow(const ShadowRecord& shadow);
  /// The same. All robots with a variance; the ones before are void. Within a step.
  Status variances(std::span<const PoseVariance> robots);
  /// Where a robot is; all of the step go into one message.
  void pose(const RobotPose& robot);
  void poses(std::span<const RobotPose> robots) {
    for (const RobotPose& robot : robots) pose(robot);
  }
  void poses(const PoseBlock& block);
  /// Writes what was collected since begin_step().
  Status end_step();

  /// Any thread. Written at the end of the present step, with its time.
  void console(LogLevel level, std::string_view source, std::string_view text);

  /// Returns when all steps so far are in the file.
  Status flush();
  /// Writes the end and closes the file. `hash`: none for a run that has no hash.
  Status end(std::optional<std::uint64_t> hash);

  [[nodiscard]] const McapWriter& file() const noexcept;

 private:
  class Impl;
  explicit RunRecorder(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::record
