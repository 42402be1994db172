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

/// The standard ROS 2 messages for viewers that a recording contains besides the exact streams.
struct ViewOptions {
  /// Rate in simulation time of `/tf` (all robots; for n > 100 robots lower by n / 100), and of
  /// scans and velocities of single robots. 0: none.
  double rate_hz = 10;
  /// The number of robots, in the order of the scenario, with `/<robot>/<sensor>` and
  /// `/<robot>/cmd_vel`.
  std::uint32_t robots = 16;
};

struct RunRecorderOptions {
  McapWriterOptions file;
  ViewOptions views;
};

/// Writes a run into an MCAP file. It does not depend on the engine; its owner calls
///
///     open, (begin_step, percept..., command..., actuator..., radio..., event..., pose..., hash,
///            end_step)..., end
///
/// from one thread; only console() may be called from any thread. It collects a step in memory and
/// writes one message per stream, so a step costs one copy of its bytes. Times are simulation
/// times; the log time is that of the step. Errors are those of McapWriter: after a failed write,
/// every call returns the error; the run may continue.
class RunRecorder {
 public:
  /// Creates the file. `sink` may be null, otherwise it must outlive the recorder; it must not
  /// forward to console(). Errors: those of McapWriter::open().
  [[nodiscard]] static Result<RunRecorder> open(const std::filesystem::path& path,
                                                const RunInfo& info,
                                                const RunRecorderOptions& options = {},
                                                LogSink* sink = nullptr);
  RunRecorder(RunRecorder&&) noexcept;
  RunRecorder& operator=(RunRecorder&&) noexcept;
  /// Closes the file. If end() was not called, the recording has no `/rave/end`.
  ~RunRecorder();

  /// Adds a metadata record with this name to the file.
  Status describe(std::string_view name, const StringMap& entries);

  void begin_step(std::uint64_t step, SimTime time);
  /// Copies the bytes.
  void percept(const Percept& percept);
  /// Copies the bytes in end_step(); they must not change before. The recording has one percept per
  /// robot. Readings without records must be passed to percept() one by one.
  void percepts(const PerceptBlock& block);
  /// Copies the bytes.
  void command(const CommandRecord& command);
  /// Like percepts(): the bytes must not change before end_step().
  void commands(const CommandBlock& block);
  void actuator(const ActuatorRecord& command);
  void radio(const RadioPacket& packet);
  /// The run hash after this step; lock-step runs only.
  Status hash(std::uint64_t value);
  Status event(const RunEvent& event);
  /// Call it between end_step() and begin_step(), or before the first step.
  Status input(const RunInput& input);
  /// Like input(). The channel is created with the first message, so recordings without chat do not
  /// have it.
  Status chat(const RunChat& chat);
  /// The channel is created with the first call, so recordings without shadows do not have it.
  Status shadow(const ShadowRecord& shadow);
  /// Adds the pose of a robot; all poses of the step become one message.
  void pose(const RobotPose& robot);
  void poses(std::span<const RobotPose> robots) {
    for (const RobotPose& robot : robots) pose(robot);
  }
  void poses(const PoseBlock& block);
  /// Writes the data collected since begin_step().
  Status end_step();

  /// Any thread. Written at the end of the current step, with its time.
  void console(LogLevel level, std::string_view source, std::string_view text);

  /// Returns when all steps so far are in the file.
  Status flush();
  /// Writes the end of the run and closes the file. `hash`: empty for a run without a hash.
  Status end(std::optional<std::uint64_t> hash);

  [[nodiscard]] const McapWriter& file() const noexcept;

 private:
  class Impl;
  explicit RunRecorder(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::record
