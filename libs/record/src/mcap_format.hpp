// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

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

void put_schema(Bytes& out, const SchemaInfo& schema);
void put_channel(Bytes& out, const ChannelInfo& channel);
void put_chunk_index(Bytes& out, const ChunkInfo& chunk);
void put_attachment_index(Bytes& out, const AttachmentInfo& attachment);
void put_metadata_index(Bytes& out, const MetadataInfo& metadata);
void put_statistics(Bytes& out, const Statistics& statistics, std::size_t schemas,
                    std::size_t channels);

// Each decodes the content of one record (without opcode and length) and returns whether it was
// complete.
[[nodiscard]] bool get_schema(ByteSpan content, SchemaInfo& schema);
[[nodiscard]] bool get_channel(ByteSpan content, ChannelInfo& channel);
[[nodiscard]] bool get_chunk_index(ByteSpan content, ChunkInfo& chunk);
[[nodiscard]] bool get_attachment_index(ByteSpan content, AttachmentInfo& attachment);
[[nodiscard]] bool get_metadata_index(ByteSpan content, MetadataInfo& metadata);
[[nodiscard]] bool get_statistics(ByteSpan content, Statistics& statistics);
[[nodiscard]] bool get_message(ByteSpan content, MessageView& message);

}  // namespace rave::record
