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

// What tools ask of the record of a run: who took part, and what one sensor read.
namespace rave::record {

/// What stands at the beginning of a record, with its scenario and its input files. Errors: kParse
/// (not written by RAVE, or damaged).
[[nodiscard]] Result<RunInfo> read_run_info(const McapReader& reader);

/// How the run ended; none if it was killed or the end is damaged.
[[nodiscard]] std::optional<RunEnd> read_run_end(const McapReader& reader);

/// All messages of one topic, in order; empty if the record has none. Errors: kIo, kParse.
/// `take(message)` returns a Status; the first failure ends it.
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

/// The robot of a name. Errors: kNotFound with the nearest name.
[[nodiscard]] Result<const RecordedRobot*> find_robot(const RunInfo& run, std::string_view name);
/// The sensor of a name of that robot. Errors: kNotFound with the nearest name.
[[nodiscard]] Result<const RecordedSensor*> find_sensor(const RunInfo& run,
                                                        const RecordedRobot& robot,
                                                        std::string_view name);

/// All readings of one sensor, in the order in which the run gave them.
struct SensorSamples {
  struct Sample {
    SimTime delivered;  ///< The step that handed it over.
    ReadingHeader header;
    std::size_t offset = 0;  ///< Into `records`.
    std::size_t size = 0;    ///< Bytes.
  };
  std::vector<Sample> samples;
  std::vector<std::byte> records;

  [[nodiscard]] std::span<const std::byte> records_of(const Sample& sample) const noexcept {
    return std::span(records).subspan(sample.offset, sample.size);
  }
};

/// Goes through the percepts of the record once. Errors: kIo, kParse (a damaged piece).
[[nodiscard]] Result<SensorSamples> read_samples(const McapReader& reader, RobotId robot,
                                                 DeviceId sensor, PerceptPart part);

/// Where one robot was, of each step. Missing in a step: nothing was known.
struct PoseTrackPoint {
  SimTime time;
  std::optional<Pose2> true_pose;
  std::optional<Pose2> reported_pose;
};
[[nodiscard]] Result<std::vector<PoseTrackPoint>> read_poses(const McapReader& reader,
                                                             RobotId robot);

}  // namespace rave::record
