// SPDX-License-Identifier: Apache-2.0
#include "rave/recording/record_columns.hpp"

#include <algorithm>
#include <cstring>

namespace rave::runtime {
namespace {

/// The number of actuator commands that are compared in one block before each one is.
/// Most commands do not change from step to step. One comparison of a block is a single memcmp()
/// and answers for all of it.
constexpr std::size_t kCompared = 64;

[[nodiscard]] bool alike(const SampleHeader& a, const SampleHeader& b) noexcept {
  return a.stamp_ns == b.stamp_ns && a.sequence == b.sequence && a.count == b.count &&
         a.dropped == b.dropped;
}

[[nodiscard]] record::ReadingHeader recorded(const SampleHeader& header) noexcept {
  return {header.stamp_ns, header.sequence, header.count, 1, header.dropped};
}

/// Compared by bits, because -0 and 0 are different commands.
[[nodiscard]] bool same_bits(const Command* a, const Command* b, std::size_t count) noexcept {
  return std::memcmp(a, b, count * sizeof(Command)) == 0;
}

}  // namespace

std::vector<RobotRow> rows_of(std::span<const RobotId> members) {
  std::vector<RobotRow> rows;
  for (std::uint32_t m = 0; m < members.size(); ++m) {
    // Robots of a group usually have consecutive numbers, so a group is a handful of rows.
    const bool follows =
        !rows.empty() && rows.back().first.value() + rows.back().robots == members[m].value();
    if (follows) {
      ++rows.back().robots;
    } else {
      rows.push_back({m, 1, members[m]});
    }
  }
  return rows;
}

RecordColumns::RecordColumns(const sim::Engine& engine, std::uint32_t group)
    : group_(group),
      members_(engine.members(group).begin(), engine.members(group).end()),
      rows_(rows_of(members_)) {
  const sim::RobotType& type = engine.type_of(group);
  for (const sim::SensorSpec& sensor : type.sensors) {
    sensors_.push_back({static_cast<std::uint8_t>(sensor.kind), record_size(sensor.kind),
                        std::vector<std::uint32_t>(members_.size(), 0)});
  }
  controllers_ = static_cast<std::uint32_t>(type.controllers.size());
  told_.resize(type.actuators.size(), std::vector<Command>(members_.size()));
}

void RecordColumns::keep_percepts(const sim::Engine& engine, record::RunRecorder& recorder) {
  for (std::uint32_t s = 0; s < sensors_.size(); ++s) {
    const sim::SampleColumns samples = engine.samples(group_, s);
    for (const RobotRow& row : rows_) keep_row(row, samples, s, recorder);
  }
}

void RecordColumns::keep_row(const RobotRow& row, const sim::SampleColumns& samples,
                             std::uint32_t sensor, record::RunRecorder& recorder) {
  Sensor& known = sensors_[sensor];
  const SampleHeader* const headers = samples.headers.data() + row.first_member;
  std::uint32_t* const seen = known.seen.data() + row.first_member;
  std::uint32_t fresh = 0;
  bool uniform = true;
  for (std::uint32_t i = 0; i < row.robots; ++i) {
    // A row is written as one block only if all robots have a new sample with the same header.
    fresh += headers[i].sequence != seen[i] ? 1U : 0U;
    uniform = uniform && alike(headers[i], headers[0]);
  }
  if (fresh == 0) return;
  const std::uint32_t bytes = headers[0].count * known.record_bytes;
  // A block contains the records without gaps, so records with gaps are copied one by one.
  if (fresh < row.robots || !uniform || bytes == 0 || bytes != samples.stride_bytes) {
    for (std::uint32_t i = 0; i < row.robots; ++i) {
      if (headers[i].sequence == seen[i]) continue;
      keep_sample(RobotId(row.first.value() + i), row.first_member + i, samples, sensor, recorder);
    }
    return;
  }
  std::fill_n(seen, row.robots, headers[0].sequence);
  const std::byte* const first =
      samples.records + std::size_t{row.first_member} * samples.stride_bytes;
  recorder.percepts({row.first,
                     row.robots,
                     DeviceId(sensor),
                     known.kind,
                     recorded(headers[0]),
                     {first, std::size_t{row.robots} * bytes}});
}

void RecordColumns::keep_sample(RobotId robot, std::size_t member,
                                const sim::SampleColumns& samples, std::uint32_t sensor,
                                record::RunRecorder& recorder) {
  Sensor& known = sensors_[sensor];
  const SampleHeader& header = samples.headers[member];
  known.seen[member] = header.sequence;
  recorder.percept({robot,
                    DeviceId(sensor),
                    known.kind,
                    record::PerceptPart::kResult,
                    recorded(header),
                    {samples.records + member * samples.stride_bytes,
                     std::size_t{header.count} * known.record_bytes}});
}

void RecordColumns::keep_commands(const sim::Engine& engine, record::RunRecorder& recorder) const {
  // The column has the step in which each command was given; only those of the step that is done
  // are new.
  const auto last = static_cast<std::int64_t>(engine.steps_done()) - 1;
  for (std::uint32_t c = 0; c < controllers_; ++c) {
    const sim::CommandColumns given = engine.commands(group_, c);
    for (const RobotRow& row : rows_) {
      const auto steps = given.steps.subspan(row.first_member, row.robots);
      const auto commands = given.commands.subspan(row.first_member, row.robots);
      const auto fresh = std::count(steps.begin(), steps.end(), last);
      if (fresh == static_cast<std::ptrdiff_t>(row.robots)) {
        recorder.commands({row.first, row.robots, DeviceId(c), std::as_bytes(commands)});
        continue;
      }
      for (std::uint32_t i = 0; fresh > 0 && i < row.robots; ++i) {
        if (steps[i] != last) continue;
        recorder.command(
            {RobotId(row.first.value() + i), DeviceId(c), std::as_bytes(commands.subspan(i, 1))});
      }
    }
  }
}

void RecordColumns::keep_actuators(const sim::Engine& engine, record::RunRecorder& recorder) {
  for (std::uint32_t a = 0; a < told_.size(); ++a) {
    const std::span<const Command> commands = engine.actuator_commands(group_, a);
    std::vector<Command>& told = told_[a];
    for (std::size_t first = 0; first < told.size(); first += kCompared) {
      const std::size_t count = std::min(kCompared, told.size() - first);
      if (same_bits(&commands[first], &told[first], count)) continue;
      for (std::size_t m = first; m < first + count; ++m) {
        if (same_bits(&commands[m], &told[m], 1)) continue;
        // Commands to actuators are recorded when they change: they hold until then.
        told[m] = commands[m];
        recorder.actuator({members_[m], DeviceId(a), std::as_bytes(commands.subspan(m, 1))});
      }
    }
  }
}

}  // namespace rave::runtime
