// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "bytes.hpp"
#include "rave/record/mcap_types.hpp"

// The records of an MCAP file, according to the public specification (https://mcap.dev/spec).
namespace rave::record {

inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
inline constexpr std::size_t kRecordHead = 9;   // opcode and length
inline constexpr std::size_t kFooterSize = 20;  // without its head
inline constexpr std::size_t kMessageHead = 22;

namespace opcode {
inline constexpr std::uint8_t kHeader = 0x01;
inline constexpr std::uint8_t kFooter = 0x02;
inline constexpr std::uint8_t kSchema = 0x03;
inline constexpr std::uint8_t kChannel = 0x04;
inline constexpr std::uint8_t kMessage = 0x05;
inline constexpr std::uint8_t kChunk = 0x06;
inline constexpr std::uint8_t kMessageIndex = 0x07;
inline constexpr std::uint8_t kChunkIndex = 0x08;
inline constexpr std::uint8_t kAttachment = 0x09;
inline constexpr std::uint8_t kAttachmentIndex = 0x0A;
inline constexpr std::uint8_t kStatistics = 0x0B;
inline constexpr std::uint8_t kMetadata = 0x0C;
inline constexpr std::uint8_t kMetadataIndex = 0x0D;
inline constexpr std::uint8_t kSummaryOffset = 0x0E;
inline constexpr std::uint8_t kDataEnd = 0x0F;
}  // namespace opcode

/// The opcode of a struct in the summary, and its fields in the order of the specification.
template <class Info>
struct RecordLayout;

template <>
struct RecordLayout<SchemaInfo> {
  static constexpr std::uint8_t kCode = opcode::kSchema;
  static auto fields(auto& v) { return std::tie(v.id, v.name, v.encoding, v.data); }
};

template <>
struct RecordLayout<ChannelInfo> {
  static constexpr std::uint8_t kCode = opcode::kChannel;
  static auto fields(auto& v) {
    return std::tie(v.id, v.schema_id, v.topic, v.message_encoding, v.metadata);
  }
};

template <>
struct RecordLayout<ChunkInfo> {
  static constexpr std::uint8_t kCode = opcode::kChunkIndex;
  static auto fields(auto& v) {
    return std::tie(v.start_ns, v.end_ns, v.offset, v.length, v.channels, v.message_index_length,
                    v.compression, v.compressed_size, v.uncompressed_size);
  }
};

template <>
struct RecordLayout<AttachmentInfo> {
  static constexpr std::uint8_t kCode = opcode::kAttachmentIndex;
  static auto fields(auto& v) {
    return std::tie(v.offset, v.length, v.log_time_ns, v.create_time_ns, v.data_size, v.name,
                    v.media_type);
  }
};

template <>
struct RecordLayout<MetadataInfo> {
  static constexpr std::uint8_t kCode = opcode::kMetadataIndex;
  static auto fields(auto& v) { return std::tie(v.offset, v.length, v.name); }
};

template <>
struct RecordLayout<Statistics> {
  static constexpr std::uint8_t kCode = opcode::kStatistics;
  static auto fields(auto& v) {
    return std::tie(v.message_count, v.schema_count, v.channel_count, v.attachment_count,
                    v.metadata_count, v.chunk_count, v.start_ns, v.end_ns,
                    v.channel_message_counts);
  }
};

template <class Info>
void put_record(Bytes& out, const Info& info) {
  ByteWriter writer(out);
  const std::size_t record = writer.begin_record(RecordLayout<Info>::kCode);
  std::apply(writer, RecordLayout<Info>::fields(info));
  writer.end_record(record);
}

/// Decodes the content of one record (without opcode and length); returns whether it was complete.
template <class Info>
[[nodiscard]] bool get_record(ByteSpan content, Info& info) {
  ByteReader reader(content);
  std::apply(reader, RecordLayout<Info>::fields(info));
  return reader.ok();
}

[[nodiscard]] inline bool get_message(ByteSpan content, MessageView& message) {
  ByteReader reader(content);
  reader(message.channel, message.sequence, message.log_time_ns, message.publish_time_ns);
  message.bytes = reader.raw(reader.rest());
  return reader.ok();
}

/// Reads opcode and length of a record; false unless it has this opcode and fills the bytes.
[[nodiscard]] inline bool begins_record(ByteReader& reader, std::uint8_t code) {
  const bool is_it = reader.get<std::uint8_t>() == code;
  // Read before the rest is asked for.
  const auto length = reader.get<std::uint64_t>();
  return is_it && length == reader.rest();
}

}  // namespace rave::record
