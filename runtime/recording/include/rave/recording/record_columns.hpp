// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/record/run_record.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// Robots with consecutive ids that are also consecutive in their group.
struct RobotRow {
  std::uint32_t first_member = 0;
  std::uint32_t robots = 0;
  RobotId first;
};

/// Records the new data of all robots of one type after a step, column by column. Equal data of
/// consecutive robots is written as one block.
class RecordColumns {
 public:
  RecordColumns(const sim::Engine& engine, std::uint32_t group);

  void keep_percepts(const sim::Engine& engine, record::RunRecorder& recorder);
  /// The commands of the last step.
  void keep_commands(const sim::Engine& engine, record::RunRecorder& recorder) const;
  /// The actuator commands that changed.
  void keep_actuators(const sim::Engine& engine, record::RunRecorder& recorder);

 private:
  /// One sensor of all members.
  struct Sensor {
    std::uint8_t kind = 0;
    std::uint32_t record_bytes = 0;
    std::vector<std::uint32_t> seen;  ///< Sequences of the last recorded samples, by member.
  };

  void keep_row(const RobotRow& row, const sim::SampleColumns& samples, std::uint32_t sensor,
                record::RunRecorder& recorder);
  void keep_sample(RobotId robot, std::size_t member, const sim::SampleColumns& samples,
                   std::uint32_t sensor, record::RunRecorder& recorder);

  std::uint32_t group_;
  std::vector<RobotId> members_;
  std::vector<RobotRow> rows_;
  std::vector<Sensor> sensors_;
  std::uint32_t controllers_ = 0;
  std::vector<std::vector<Command>> told_;  ///< By actuator and member: the last recorded command.
};

/// Splits members into rows with consecutive ids, in order.
[[nodiscard]] std::vector<RobotRow> rows_of(std::span<const RobotId> members);

}  // namespace rave::runtime
