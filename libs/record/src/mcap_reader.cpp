// SPDX-License-Identifier: Apache-2.0
// A recording as its users see it. What has been read is constant and shared, so cursors may
// outlive the reader.
#include "rave/record/mcap_reader.hpp"

#include <algorithm>

#include "crc32.hpp"
#include "message_cursor.hpp"
#include "record_file.hpp"

namespace rave::record {
namespace {

[[nodiscard]] Status read_header(RecordFile& file) {
  const ByteSource& source = *file.source;
  Bytes bytes;
  if (source.size() < kMagic.size() + kRecordHead) {
    return fail(ErrorCode::kParse, "`{}` is not an MCAP file: it has only {} bytes", source.name(),
                source.size());
  }
  RAVE_TRY(source.read(0, kMagic.size() + kRecordHead, bytes));
  ByteReader reader(bytes);
  if (!std::ranges::equal(reader.raw(kMagic.size()), as_bytes(kMagic))) {
    return fail(ErrorCode::kParse, "`{}` is not an MCAP file (wrong magic bytes)", source.name());
  }
  const auto code = reader.get<std::uint8_t>();
  const auto size = reader.get<std::uint64_t>();
  // The size comes from the file and is compared with it before memory is allocated.
  if (code != opcode::kHeader || size > source.size() - bytes.size()) {
    return fail(ErrorCode::kParse, "`{}`: there is no complete header at offset {}", source.name(),
                kMagic.size());
  }
  const std::uint64_t at = bytes.size();
  RAVE_TRY(source.read(at, size, bytes));
  ByteReader header(bytes);
  header(file.profile, file.library);
  if (!header.ok()) {
    return fail(ErrorCode::kParse, "`{}`: there is no complete header at offset {}", source.name(),
                kMagic.size());
  }
  file.data_begin = at + size;
  return {};
}

}  // namespace

McapReader::McapReader(std::shared_ptr<const RecordFile> file) noexcept : file_(std::move(file)) {}

Result<McapReader> McapReader::open_source(std::unique_ptr<ByteSource> source,
                                           McapReaderOptions options) {
  auto file = std::make_shared<RecordFile>();
  file->source = std::move(source);
  file->options = options;
  RAVE_TRY(read_header(*file));
  // Without a usable summary the data are scanned: slower, but all that is there can be read.
  if (const Status summary = read_summary(*file); !summary) {
    if (!summary.error().message.empty()) file->damages.push_back(summary.error().message);
    scan_data(*file);
  }
  return McapReader(std::move(file));
}

Result<McapReader> McapReader::open(const std::filesystem::path& path, McapReaderOptions options) {
  RAVE_TRY_ASSIGN(auto source, ByteSource::open(path));
  return open_source(std::move(source), options);
}

Result<McapReader> McapReader::open_memory(std::span<const std::byte> bytes, std::string name,
                                           McapReaderOptions options) {
  return open_source(std::make_unique<ByteSource>(std::move(name), bytes), options);
}

const std::string& McapReader::profile() const noexcept { return file_->profile; }
const std::string& McapReader::library() const noexcept { return file_->library; }
bool McapReader::ended() const noexcept { return file_->ended; }
bool McapReader::whole() const noexcept {
  return file_->ended && file_->cuts.empty() && file_->damages.empty();
}
std::vector<std::string> McapReader::damages() const {
  std::vector<std::string> all = file_->cuts;
  all.insert(all.end(), file_->damages.begin(), file_->damages.end());
  return all;
}
std::uint64_t McapReader::file_size() const noexcept { return file_->source->size(); }
const std::vector<SchemaInfo>& McapReader::schemas() const noexcept { return file_->schemas; }
const std::vector<ChannelInfo>& McapReader::channels() const noexcept { return file_->channels; }
const Statistics& McapReader::statistics() const noexcept { return file_->statistics; }
const std::vector<ChunkInfo>& McapReader::chunks() const noexcept { return file_->chunks; }
const std::vector<AttachmentInfo>& McapReader::attachments() const noexcept {
  return file_->attachments;
}
const std::vector<MetadataInfo>& McapReader::metadata() const noexcept { return file_->metadata; }

const ChannelInfo* McapReader::channel(std::string_view topic) const noexcept {
  const auto found = std::ranges::find(file_->channels, topic, &ChannelInfo::topic);
  return found == file_->channels.end() ? nullptr : &*found;
}

const SchemaInfo* McapReader::schema(std::uint16_t id) const noexcept {
  const auto found = std::ranges::find(file_->schemas, id, &SchemaInfo::id);
  return found == file_->schemas.end() ? nullptr : &*found;
}

MessageCursor McapReader::messages(MessageFilter filter) const {
  return MessageCursor(std::make_unique<MessageCursor::Impl>(file_, std::move(filter)));
}

Result<std::string> McapReader::read_attachment(const AttachmentInfo& attachment) const {
  const ByteSource& source = *file_->source;
  Bytes bytes;
  RAVE_TRY(source.read(attachment.offset, attachment.length, bytes));
  ByteReader reader(bytes);
  const bool right = begins_record(reader, opcode::kAttachment);
  reader.skip<std::uint64_t, std::uint64_t, std::string, std::string>();  // as in its index
  const ByteSpan data = reader.raw(reader.get<std::uint64_t>());
  const std::size_t end = reader.position();
  const auto crc = reader.get<std::uint32_t>();
  if (!right || !reader.ok()) {
    return fail(ErrorCode::kParse, "`{}`: there is no complete attachment at offset {}",
                source.name(), attachment.offset);
  }
  // 0 means that the writer made no checksum.
  if (crc != 0 && crc32(ByteSpan(bytes).first(end).subspan(kRecordHead)) != crc) {
    return fail(ErrorCode::kParse, "`{}`: the attachment at offset {} does not match its checksum",
                source.name(), attachment.offset);
  }
  return std::string(reinterpret_cast<const char*>(data.data()), data.size());
}

Result<StringMap> McapReader::read_metadata(const MetadataInfo& metadata) const {
  const ByteSource& source = *file_->source;
  Bytes bytes;
  RAVE_TRY(source.read(metadata.offset, metadata.length, bytes));
  ByteReader reader(bytes);
  const bool right = begins_record(reader, opcode::kMetadata);
  std::string name;
  StringMap entries;
  reader(name, entries);
  if (!right || !reader.ok()) {
    return fail(ErrorCode::kParse, "`{}`: there is no complete metadata at offset {}",
                source.name(), metadata.offset);
  }
  return entries;
}

StringMap McapReader::metadata_named(std::string_view name) const {
  for (const MetadataInfo& metadata : file_->metadata) {
    if (metadata.name != name) continue;
    if (auto entries = read_metadata(metadata)) return *std::move(entries);
  }
  return {};
}

CheckedFile McapReader::check() const { return check_file(*file_); }

}  // namespace rave::record
