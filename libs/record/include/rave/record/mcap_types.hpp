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

/// The format of the messages of a channel. Ids count from 1; 0 means "no schema".
struct SchemaInfo {
  std::uint16_t id = 0;
  std::string name;      ///< `sensor_msgs/msg/LaserScan`
  std::string encoding;  ///< `ros2msg`, `jsonschema`, ...
  std::string data;
};

/// A stream of messages of one schema.
struct ChannelInfo {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
  std::string message_encoding;  ///< `cdr`, `json`, ...
  StringMap metadata;
};

/// The place of an attachment in the file. Times in ns of the recording's clock.
struct AttachmentInfo {
  std::uint64_t offset = 0;  ///< Offset of its record from the start of the file.
  std::uint64_t length = 0;  ///< Length of its record, including opcode and length field.
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  std::uint64_t data_size = 0;
  std::string name;
  std::string media_type;
};

/// The place of a metadata record: a named set of texts.
struct MetadataInfo {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::string name;
};

/// The place and content of a chunk of messages.
struct ChunkInfo {
  std::uint64_t start_ns = 0;  ///< Earliest log time; 0 without messages.
  std::uint64_t end_ns = 0;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint64_t message_index_length = 0;
  std::string compression;  ///< `zstd` or empty.
  /// Ids of the channels with messages in it and offsets of their message indexes; empty: unknown.
  std::vector<std::pair<std::uint16_t, std::uint64_t>> channels;
  /// Not a chunk record but a series of message records directly in the file.
  bool bare = false;
};

/// Counts of the records of a file.
struct Statistics {
  std::uint64_t message_count = 0;
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0;
  std::uint32_t chunk_count = 0;
  std::uint32_t attachment_count = 0;
  std::uint32_t metadata_count = 0;
  std::map<std::uint16_t, std::uint64_t> channel_message_counts;
};

/// One message of a file. The span is valid as long as its source says.
struct MessageView {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::span<const std::byte> bytes;
};

}  // namespace rave::record
