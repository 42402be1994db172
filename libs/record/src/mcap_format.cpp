// SPDX-License-Identifier: Apache-2.0
// Records of MCAP as bytes and back, field by field as in https://mcap.dev/spec.
#include "mcap_format.hpp"

namespace rave::record {

// Fields in the order of the specification, numbers little-endian.
void put_schema(Bytes& out, const SchemaInfo& schema) {
  ByteWriter writer(out);
  const std::size_t record = writer.begin_record(opcode::kSchema);
  writer.put(schema.id);
  writer.string(schema.name);
  writer.string(schema.encoding);
  writer.string(schema.data);
  writer.end_record(record);
}

void put_channel(Bytes& out, const ChannelInfo& channel) {
  ByteWriter writer(out);
  const std::size_t record = writer.begin_record(opcode::kChannel);
  writer.put(channel.id);
  writer.put(channel.schema_id);
  writer.string(channel.topic);
  writer.string(channel.message_encoding);
  writer.map(channel.metadata);
  writer.end_record(record);
}

void put_chunk_index(Bytes& out, const ChunkInfo& chunk) {
  ByteWriter writer(out);
  const std::size_t record = writer.begin_record(opcode::kChunkIndex);
  writer.put(chunk.start_ns);
  writer.put(chunk.end_ns);
  writer.put(chunk.offset);
  writer.put(chunk.length);
  const std::size_t offsets = writer.begin_size32();
  for (const auto& [channel, offset] : chunk.channels) {
    writer.put(channel);
    writer.put(offset);
  }
  writer.end_size32(offsets);
  writer.put(chunk.message_index_length);
  writer.string(chunk.compression);
  writer.put(chunk.compressed_size);
  writer.put(chunk.uncompressed_size);
  writer.end_record(record);
}

void put_attachment_index(Bytes& out, const AttachmentInfo& attachment) {
  ByteWriter writer(out);
  const std::size_t record = writer.begin_record(opcode::kAttachmentIndex);
  writer.put(attachment.offset);
  writer.put(attachment.length);
  writer.put(attachment.log_time_ns);
  writer.put(attachment.create_time_ns);
  writer.put(attachment.data_size);
  writer.string(attachment.name);
  writer.string(attachment.media_type);
  writer.end_record(record);
}

void put_metadata_index(Bytes& out, const MetadataInfo& metadata) {
  ByteWriter writer(out);
  const std::size_t record = writer.begin_record(opcode::kMetadataIndex);
  writer.put(metadata.offset);
  writer.put(metadata.length);
  writer.string(metadata.name);
  writer.end_record(record);
}

void put_statistics(Bytes& out, const Statistics& statistics, std::size_t schemas,
                    std::size_t channels) {
  ByteWriter writer(out);
  const std::size_t record = writer.begin_record(opcode::kStatistics);
  writer.put(statistics.message_count);
  writer.put(static_cast<std::uint16_t>(schemas));
  writer.put(static_cast<std::uint32_t>(channels));
  writer.put(statistics.attachment_count);
  writer.put(statistics.metadata_count);
  writer.put(statistics.chunk_count);
  writer.put(statistics.start_ns);
  writer.put(statistics.end_ns);
  const std::size_t counts = writer.begin_size32();
  for (const auto& [channel, count] : statistics.channel_message_counts) {
    writer.put(channel);
    writer.put(count);
  }
  writer.end_size32(counts);
  writer.end_record(record);
}

// Readers look at ok() once, at the end: after a field that is cut, all others are empty.
bool get_schema(ByteSpan content, SchemaInfo& schema) {
  ByteReader reader(content);
  schema.id = reader.get<std::uint16_t>();
  schema.name = reader.string();
  schema.encoding = reader.string();
  schema.data = reader.string();
  return reader.ok();
}

bool get_channel(ByteSpan content, ChannelInfo& channel) {
  ByteReader reader(content);
  channel.id = reader.get<std::uint16_t>();
  channel.schema_id = reader.get<std::uint16_t>();
  channel.topic = reader.string();
  channel.message_encoding = reader.string();
  channel.metadata = reader.map();
  return reader.ok();
}

bool get_chunk_index(ByteSpan content, ChunkInfo& chunk) {
  ByteReader reader(content);
  chunk.start_ns = reader.get<std::uint64_t>();
  chunk.end_ns = reader.get<std::uint64_t>();
  chunk.offset = reader.get<std::uint64_t>();
  chunk.length = reader.get<std::uint64_t>();
  // A map has its size in bytes, not in elements.
  ByteReader offsets(reader.raw(reader.get<std::uint32_t>()));
  while (offsets.ok() && offsets.rest() > 0) {
    const auto channel = offsets.get<std::uint16_t>();
    chunk.channels.emplace_back(channel, offsets.get<std::uint64_t>());
  }
  chunk.message_index_length = reader.get<std::uint64_t>();
  chunk.compression = reader.string();
  chunk.compressed_size = reader.get<std::uint64_t>();
  chunk.uncompressed_size = reader.get<std::uint64_t>();
  return reader.ok() && offsets.ok();
}

bool get_attachment_index(ByteSpan content, AttachmentInfo& attachment) {
  ByteReader reader(content);
  attachment.offset = reader.get<std::uint64_t>();
  attachment.length = reader.get<std::uint64_t>();
  attachment.log_time_ns = reader.get<std::uint64_t>();
  attachment.create_time_ns = reader.get<std::uint64_t>();
  attachment.data_size = reader.get<std::uint64_t>();
  attachment.name = reader.string();
  attachment.media_type = reader.string();
  return reader.ok();
}

bool get_metadata_index(ByteSpan content, MetadataInfo& metadata) {
  ByteReader reader(content);
  metadata.offset = reader.get<std::uint64_t>();
  metadata.length = reader.get<std::uint64_t>();
  metadata.name = reader.string();
  return reader.ok();
}

bool get_statistics(ByteSpan content, Statistics& statistics) {
  ByteReader reader(content);
  statistics.message_count = reader.get<std::uint64_t>();
  static_cast<void>(reader.get<std::uint16_t>());  // numbers of schemas and channels: counted
  static_cast<void>(reader.get<std::uint32_t>());  // when they are listed
  statistics.attachment_count = reader.get<std::uint32_t>();
  statistics.metadata_count = reader.get<std::uint32_t>();
  statistics.chunk_count = reader.get<std::uint32_t>();
  statistics.start_ns = reader.get<std::uint64_t>();
  statistics.end_ns = reader.get<std::uint64_t>();
  ByteReader counts(reader.raw(reader.get<std::uint32_t>()));
  while (counts.ok() && counts.rest() > 0) {
    const auto channel = counts.get<std::uint16_t>();
    statistics.channel_message_counts[channel] = counts.get<std::uint64_t>();
  }
  return reader.ok() && counts.ok();
}

bool get_message(ByteSpan content, MessageView& message) {
  ByteReader reader(content);
  message.channel = reader.get<std::uint16_t>();
  message.sequence = reader.get<std::uint32_t>();
  message.log_time_ns = reader.get<std::uint64_t>();
  message.publish_time_ns = reader.get<std::uint64_t>();
  message.bytes = reader.raw(reader.rest());
  return reader.ok();
}

}  // namespace rave::record
