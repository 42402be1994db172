// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/time.hpp"
#include "rave/record/mcap_writer.hpp"
#include "ros_schemas.hpp"

namespace rave::record {

/// A channel of CDR messages and its counter.
struct Stream {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;

  Status write(McapWriter& file, SimTime time, std::span<const std::span<const std::byte>> parts) {
    const auto ns = static_cast<std::uint64_t>(time.ns);
    return file.write_parts(channel, sequence++, ns, ns, parts);
  }
  Status write(McapWriter& file, SimTime time, std::span<const std::byte> bytes) {
    return write(file, time, std::span(&bytes, 1));
  }
};

[[nodiscard]] inline Result<std::uint16_t> add_schema(McapWriter& file, const RosSchema& schema) {
  return file.add_schema(schema.name, "ros2msg", schema.text);
}

[[nodiscard]] inline Result<Stream> add_stream(McapWriter& file, std::string_view topic,
                                               std::uint16_t schema) {
  // The ROS 2 profile requires this key; it is empty because nothing was published.
  RAVE_TRY_ASSIGN(const std::uint16_t channel,
                  file.add_channel(topic, "cdr", schema, {{"offered_qos_profiles", ""}}));
  return Stream{channel, 0};
}

}  // namespace rave::record
