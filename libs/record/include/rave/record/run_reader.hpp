// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_messages.hpp"

// Access to the recording of a run for tools: its participants, and the readings of one sensor.
namespace rave::record {

/// Reads the description of the run with its scenario and input files. Errors: kParse (not written
/// by RAVE, or damaged).
[[nodiscard]] Result<RunInfo> read_run_info(const McapReader& reader);

/// The end of the run; empty if it was killed or the end is damaged.
[[nodiscard]] std::optional<RunEnd> read_run_end(const McapReader& reader);

/// Calls `take(message)` for all messages of one topic, in order; none if the recording does not
/// have it. `take` returns a Status; a failure ends the iteration. Errors: kIo, kParse, those of
/// `take`.
template <class Take>
Status for_each_message(const McapReader& reader, const char* topic, Take take) {
  const ChannelInfo* const channel = reader.channel(topic);
  if (channel == nullptr) return {};
  MessageCursor cursor = reader.messages({{channel->id}});
  while (true) {
    RAVE_TRY_ASSIGN(const auto message, cursor.next());
    if (!message) return {};
    RAVE_TRY(take(*message));
  }
}

/// The robot with this name. Errors: kNotFound with the nearest name.
[[nodiscard]] Result<const RecordedRobot*> find_robot(const RunInfo& run, std::string_view name);
/// The sensor of that robot with this name. Errors: kNotFound with the nearest name.
[[nodiscard]] Result<const RecordedSensor*> find_sensor(const RunInfo& run,
                                                        const RecordedRobot& robot,
                                                        std::string_view name);

/// All readings of one sensor, in the order in which they were delivered.
struct SensorSamples {
  struct Sample {
    SimTime delivered;  ///< The step that delivered it.
    ReadingHeader header;
    std::size_t offset = 0;  ///< Offset into `records`.
    std::size_t size = 0;    ///< Bytes.
  };
  std::vector<Sample> samples;
  std::vector<std::byte> records;

  [[nodiscard]] std::span<const std::byte> records_of(const Sample& sample) const noexcept {
    return std::span(records).subspan(sample.offset, sample.size);
  }
};

/// Reads the percepts of the recording once. Errors: kIo, kParse (damaged data).
[[nodiscard]] Result<SensorSamples> read_samples(const McapReader& reader, RobotId robot,
                                                 DeviceId sensor, PerceptPart part);

/// The pose of one robot at the time of one step. A step without an entry: no pose was known.
struct PoseTrackPoint {
  SimTime time;
  std::optional<Pose2> true_pose;
  std::optional<Pose2> reported_pose;
};
[[nodiscard]] Result<std::vector<PoseTrackPoint>> read_poses(const McapReader& reader,
                                                             RobotId robot);

}  // namespace rave::record
