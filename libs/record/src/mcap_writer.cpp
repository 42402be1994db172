// SPDX-License-Identifier: Apache-2.0
// The producer's side of a recording: ids of schemas and channels, and messages into the open
// chunk.
#include "rave/record/mcap_writer.hpp"

#include "write_queue.hpp"

namespace rave::record {

/// The producer's side: ids, and the open chunk.
class McapWriter::Impl {
 public:
  Impl(std::unique_ptr<McapFile> file, const McapWriterOptions& options, LogSink* sink)
      : queue(std::move(file), options, sink) {}

  [[nodiscard]] Status usable() {
    if (closed) return fail(ErrorCode::kState, "the recording is closed");
    return queue.failure();
  }

  WriteQueue queue;
  std::vector<SchemaInfo> schemas;
  std::vector<ChannelInfo> channels;
  bool closed = false;
};

McapWriter::McapWriter(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
McapWriter::McapWriter(McapWriter&&) noexcept = default;
McapWriter& McapWriter::operator=(McapWriter&& other) noexcept {
  if (this != &other) {
    if (impl_) static_cast<void>(close());
    impl_ = std::move(other.impl_);
  }
  return *this;
}

McapWriter::~McapWriter() {
  if (impl_) static_cast<void>(close());
}

Result<McapWriter> McapWriter::open(const std::filesystem::path& path, McapWriterOptions options,
                                    LogSink* sink) {
  const bool level_ok = options.zstd_level >= -7 && options.zstd_level <= 19;
  if (!level_ok || options.chunk_bytes == 0 || !(options.flush_interval_s > 0) ||
      !(options.flush_interval_s < 1e6)) {
    return fail(ErrorCode::kInvalidArgument,
                "the recording needs a zstd level of -7 to 19, a chunk size and a flush interval "
                "above 0 (given: {}, {} bytes, {} s)",
                options.zstd_level, options.chunk_bytes, options.flush_interval_s);
  }
  RAVE_TRY_ASSIGN(auto file, McapFile::create(path, options.profile, options.library));
  auto impl = std::make_unique<Impl>(std::move(file), options, sink);
  RAVE_TRY(impl->queue.start());
  return McapWriter(std::move(impl));
}

Result<std::uint16_t> McapWriter::add_schema(std::string_view name, std::string_view encoding,
                                             std::string_view data) {
  RAVE_TRY(impl_->usable());
  if (impl_->schemas.size() == 65535) {
    return fail(ErrorCode::kInvalidArgument,
                "a recording has at most 65535 schemas; `{}` is one too many", name);
  }
  SchemaInfo schema{static_cast<std::uint16_t>(impl_->schemas.size() + 1), std::string(name),
                    std::string(encoding), std::string(data)};
  // Into the chunk as well as into the summary: a file without its end can still be understood.
  impl_->queue.append([&](Chunk& chunk) { put_record(chunk.records, schema); });
  impl_->schemas.push_back(std::move(schema));
  return impl_->schemas.back().id;
}

Result<std::uint16_t> McapWriter::add_channel(std::string_view topic,
                                              std::string_view message_encoding,
                                              std::uint16_t schema_id, const StringMap& metadata) {
  RAVE_TRY(impl_->usable());
  if (schema_id > impl_->schemas.size()) {
    return fail(ErrorCode::kInvalidArgument, "channel `{}` names schema {}, which does not exist",
                topic, schema_id);
  }
  if (impl_->channels.size() == 65535) {
    return fail(ErrorCode::kInvalidArgument,
                "a recording has at most 65535 channels; `{}` is one too many", topic);
  }
  ChannelInfo channel{static_cast<std::uint16_t>(impl_->channels.size() + 1), schema_id,
                      std::string(topic), std::string(message_encoding), metadata};
  impl_->queue.append([&](Chunk& chunk) { put_record(chunk.records, channel); });
  impl_->channels.push_back(std::move(channel));
  return impl_->channels.back().id;
}

Status McapWriter::write(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_time_ns,
                         std::uint64_t publish_time_ns, std::span<const std::byte> bytes) {
  return write_parts(channel, sequence, log_time_ns, publish_time_ns, std::span(&bytes, 1));
}

Status McapWriter::write_parts(std::uint16_t channel, std::uint32_t sequence,
                               std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
                               std::span<const std::span<const std::byte>> parts) {
  if (auto usable = impl_->usable(); !usable) {
    // The run continues without its recording; missing messages are counted.
    impl_->queue.count_dropped();
    return usable;
  }
  if (channel == 0 || channel > impl_->channels.size()) {
    return fail(ErrorCode::kInvalidArgument, "message for channel {}, which does not exist",
                channel);
  }
  std::uint64_t size = kMessageHead;
  for (const auto part : parts) size += part.size();
  impl_->queue.append([&](Chunk& chunk) {
    chunk.entries.push_back({log_time_ns, chunk.records.size(), channel});
    // The head of a message has fixed places, and this is done for each message of a run.
    std::array<std::byte, kRecordHead + kMessageHead> head;
    head[0] = std::byte{opcode::kMessage};
    std::memcpy(&head[1], &size, 8);
    std::memcpy(&head[9], &channel, 2);
    std::memcpy(&head[11], &sequence, 4);
    std::memcpy(&head[15], &log_time_ns, 8);
    std::memcpy(&head[23], &publish_time_ns, 8);
    ByteWriter writer(chunk.records);
    writer.raw(head);
    for (const auto part : parts) writer.raw(part);
  });
  return {};
}

Status McapWriter::add_attachment(std::string_view name, std::string_view media_type,
                                  std::span<const std::byte> bytes, std::uint64_t time_ns) {
  RAVE_TRY(impl_->usable());
  AttachmentInfo info;
  info.log_time_ns = time_ns;
  info.create_time_ns = time_ns;
  info.name = name;
  info.media_type = media_type;
  impl_->queue.push(AttachmentJob{std::move(info), Bytes(bytes.begin(), bytes.end())});
  return {};
}

Status McapWriter::add_metadata(std::string_view name, const StringMap& entries) {
  RAVE_TRY(impl_->usable());
  impl_->queue.push(MetadataJob{std::string(name), entries});
  return {};
}

Status McapWriter::flush() {
  RAVE_TRY(impl_->usable());
  impl_->queue.drain();
  return impl_->queue.failure();
}

Status McapWriter::close() {
  if (impl_->closed) return {};
  impl_->closed = true;
  return impl_->queue.finish(impl_->schemas, impl_->channels);
}

std::uint64_t McapWriter::dropped() const noexcept { return impl_->queue.dropped(); }
std::uint64_t McapWriter::waits() const noexcept { return impl_->queue.waits(); }

}  // namespace rave::record
