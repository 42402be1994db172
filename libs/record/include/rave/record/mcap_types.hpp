// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rave::record {

using StringMap = std::map<std::string, std::string>;

/// What the messages of a channel look like. Ids count from 1; 0 means "no schema".
struct SchemaInfo {
  std::uint16_t id = 0;
  std::string name;      ///< `sensor_msgs/msg/LaserScan`
  std::string encoding;  ///< `ros2msg`, `jsonschema`, ...
  std::string data;
};

/// A stream of messages of one kind.
struct ChannelInfo {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
  std::string message_encoding;  ///< `cdr`, `json`, ...
  StringMap metadata;
};

/// Where an attached file lies. Times in ns on the clock of the record.
struct AttachmentInfo {
  std::uint64_t offset = 0;  ///< Of its record, from the start of the file.
  std::uint64_t length = 0;  ///< Of its record, with opcode and length.
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  std::uint64_t data_size = 0;
  std::string name;
  std::string media_type;
};

/// Where a named set of texts lies.
struct MetadataInfo {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::string name;
};

/// Where a chunk of messages lies and what is in it.
struct ChunkInfo {
  std::uint64_t start_ns = 0;  ///< Earliest log time in it; 0 without messages.
  std::uint64_t end_ns = 0;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint64_t message_index_length = 0;
  std::string compression;  ///< `zstd` or empty.
  /// Channels with messages in it and where their indexes lie; empty: not known.
  std::vector<std::pair<std::uint16_t, std::uint64_t>> channels;
  /// No chunk record but a stretch of message records that stand in the file as they are.
  bool bare = false;
};

/// How much there is of what.
struct Statistics {
  std::uint64_t message_count = 0;
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint32_t chunk_count = 0;
  std::uint32_t attachment_count = 0;
  std::uint32_t metadata_count = 0;
  std::map<std::uint16_t, std::uint64_t> channel_message_counts;
};

/// One message as it lies in a record. The bytes belong to whoever gave it.
struct MessageView {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::span<const std::byte> bytes;
};

}  // namespace rave::record
