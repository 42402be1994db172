// SPDX-License-Identifier: Apache-2.0
// Writes the records of an MCAP file (https://mcap.dev/spec): header, chunks with their message
// indexes, attachments and metadata as they come, and at the end a summary that lists them.
#include "mcap_file.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "crc32.hpp"
#include "mcap_format.hpp"

namespace rave::record {

McapFile::McapFile(std::filesystem::path path, int fd)
    : path_(std::move(path)), file_(fd), compressor_(ZSTD_createCCtx()) {}

McapFile::~McapFile() { ZSTD_freeCCtx(compressor_); }

Result<std::unique_ptr<McapFile>> McapFile::create(const std::filesystem::path& path,
                                                   std::string_view profile,
                                                   std::string_view library) {
  // Readable, too: the summary at the end is made from chunks that are read back.
  const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (fd < 0) {
    const int code = errno;
    return fail(code == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo, "cannot create `{}`: {}",
                path.string(), std::strerror(code));
  }
  std::unique_ptr<McapFile> file(new McapFile(path, fd));
  if (file->compressor_ == nullptr) return fail(ErrorCode::kIo, "no memory for a compressor");
  ByteWriter writer(file->out_);
  writer.raw(as_bytes(kMagic));
  const std::size_t record = writer.begin_record(opcode::kHeader);
  writer(profile, library);
  writer.end_record(record);
  RAVE_TRY(file->append(file->out_));
  return file;
}

Status McapFile::append(ByteSpan bytes) {
  ByteSpan rest = bytes;
  while (!rest.empty()) {
    const ssize_t count = ::write(file_.get(), rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int code = errno;
      // Truncate the incomplete record, so that later ones, if only the index, follow a complete
      // one.
      const auto good = static_cast<off_t>(offset_);
      const bool cut =
          ::ftruncate(file_.get(), good) == 0 && ::lseek(file_.get(), good, SEEK_SET) == good;
      return fail(ErrorCode::kIo, "cannot write `{}` at offset {}: {}{}", path_.string(), offset_,
                  std::strerror(code),
                  cut ? "" : " (and the incomplete piece could not be removed)");
    }
    rest = rest.subspan(static_cast<std::size_t>(count));
  }
  offset_ += bytes.size();
  // The data end record has a sum over all bytes of the file before it.
  data_crc_ = crc32(bytes, data_crc_);
  return {};
}

void McapFile::put_chunk_record(const Chunk& chunk, std::optional<int> zstd_level,
                                ChunkInfo& info) {
  info.uncompressed_size = chunk.records.size();
  ByteSpan data = chunk.records;
  if (zstd_level) {
    compressed_.resize(ZSTD_compressBound(chunk.records.size()));
    const std::size_t size =
        ZSTD_compressCCtx(compressor_, compressed_.data(), compressed_.size(), chunk.records.data(),
                          chunk.records.size(), *zstd_level);
    // Data that do not shrink are stored as they are; an error of the compressor costs no data.
    if (ZSTD_isError(size) == 0 && size < chunk.records.size()) {
      info.compression = "zstd";
      data = ByteSpan(compressed_).first(size);
    }
  }
  info.compressed_size = data.size();
  ByteWriter writer(out_);
  const std::size_t record = writer.begin_record(opcode::kChunk);
  writer(info.start_ns, info.end_ns, info.uncompressed_size, crc32(chunk.records), info.compression,
         info.compressed_size);
  writer.raw(data);
  writer.end_record(record);
  info.length = out_.size();
}

void McapFile::put_message_indexes(const Chunk& chunk, ChunkInfo& info) {
  // One index per channel, each in the order of time.
  sorted_ = chunk.entries;
  std::stable_sort(sorted_.begin(), sorted_.end(), [](const auto& a, const auto& b) {
    return a.channel != b.channel ? a.channel < b.channel : a.log_time_ns < b.log_time_ns;
  });
  ByteWriter writer(out_);
  for (auto first = sorted_.begin(); first != sorted_.end();) {
    const auto last = std::find_if(first, sorted_.end(), [channel = first->channel](const auto& e) {
      return e.channel != channel;
    });
    info.channels.emplace_back(first->channel, info.offset + out_.size());
    const std::size_t record = writer.begin_record(opcode::kMessageIndex);
    writer(first->channel);
    const std::size_t array = writer.begin_size32();
    for (auto entry = first; entry != last; ++entry) writer(entry->log_time_ns, entry->offset);
    writer.end_size32(array);
    writer.end_record(record);
    first = last;
  }
  info.message_index_length = out_.size() - info.length;
}

void McapFile::count(const Chunk& chunk, const ChunkInfo& info) {
  if (!chunk.entries.empty()) {
    const bool first = statistics_.message_count == 0;
    statistics_.start_ns = first ? info.start_ns : std::min(statistics_.start_ns, info.start_ns);
    statistics_.end_ns = std::max(statistics_.end_ns, info.end_ns);
  }
  statistics_.message_count += chunk.entries.size();
  for (const auto& entry : chunk.entries) ++statistics_.channel_message_counts[entry.channel];
}

Status McapFile::write_chunk(const Chunk& chunk, std::optional<int> zstd_level) {
  ChunkInfo info;
  info.offset = offset_;
  if (!chunk.entries.empty()) {
    const auto by_time = [](const auto& a, const auto& b) { return a.log_time_ns < b.log_time_ns; };
    const auto [low, high] =
        std::minmax_element(chunk.entries.begin(), chunk.entries.end(), by_time);
    info.start_ns = low->log_time_ns;
    info.end_ns = high->log_time_ns;
  }
  // Chunk and indexes in one call: if writing fails, append() removes both.
  out_.clear();
  put_chunk_record(chunk, zstd_level, info);
  put_message_indexes(chunk, info);
  RAVE_TRY(append(out_));
  count(chunk, info);
  // Only the place: what the summary needs is read back at the end, so memory hardly grows with the
  // length of a run.
  chunks_.push_back({info.offset, info.message_index_length});
  return {};
}

Status McapFile::write_attachment(const AttachmentInfo& info, ByteSpan data) {
  out_.clear();
  ByteWriter writer(out_);
  const std::size_t record = writer.begin_record(opcode::kAttachment);
  writer(info.log_time_ns, info.create_time_ns, info.name, info.media_type,
         std::uint64_t{data.size()});
  writer.raw(data);
  // Over all fields of the record before it.
  writer(crc32(ByteSpan(out_).subspan(record)));
  writer.end_record(record);
  AttachmentInfo placed = info;
  placed.offset = offset_;
  placed.length = out_.size();
  placed.data_size = data.size();
  RAVE_TRY(append(out_));
  attachments_.push_back(std::move(placed));
  return {};
}

Status McapFile::write_metadata(std::string_view name, const StringMap& entries) {
  out_.clear();
  ByteWriter writer(out_);
  const std::size_t record = writer.begin_record(opcode::kMetadata);
  writer(name, entries);
  writer.end_record(record);
  const MetadataInfo placed{offset_, out_.size(), std::string(name)};
  RAVE_TRY(append(out_));
  metadata_.push_back(placed);
  return {};
}

Status McapFile::put_summary(const std::vector<SchemaInfo>& schemas,
                             const std::vector<ChannelInfo>& channels) {
  struct Group {
    std::uint8_t code;
    std::uint64_t start;
    std::uint64_t length;
  };
  // Records of one kind are one group, and the offsets of the groups let readers load only those
  // that they need.
  std::vector<Group> groups;
  const auto group = [&]<class Info>(std::span<const Info> items) {
    const std::size_t start = out_.size();
    for (const Info& item : items) put_record(out_, item);
    if (items.empty()) return;
    groups.push_back({RecordLayout<Info>::kCode, offset_ + start, out_.size() - start});
  };
  statistics_.schema_count = static_cast<std::uint16_t>(schemas.size());
  statistics_.channel_count = static_cast<std::uint32_t>(channels.size());
  statistics_.chunk_count = static_cast<std::uint32_t>(chunks_.size());
  statistics_.attachment_count = static_cast<std::uint32_t>(attachments_.size());
  statistics_.metadata_count = static_cast<std::uint32_t>(metadata_.size());
  group(std::span(schemas));
  group(std::span(channels));
  group(std::span<const Statistics>(&statistics_, 1));
  const std::size_t indexes = out_.size();
  for (const ChunkPlace& place : chunks_) {
    RAVE_TRY_ASSIGN(const ChunkInfo info,
                    read_back(file_.get(), place, path_.string(), compressed_));
    put_record(out_, info);
  }
  if (out_.size() > indexes) {
    groups.push_back({opcode::kChunkIndex, offset_ + indexes, out_.size() - indexes});
  }
  group(std::span(std::as_const(attachments_)));
  group(std::span(std::as_const(metadata_)));
  const std::uint64_t offsets_start = offset_ + out_.size();
  ByteWriter writer(out_);
  for (const Group& item : groups) {
    const std::size_t record = writer.begin_record(opcode::kSummaryOffset);
    writer(item.code, item.start, item.length);
    writer.end_record(record);
  }
  const std::size_t record = writer.begin_record(opcode::kFooter);
  // The last is the place of the checksum, which covers the summary and the footer up to there.
  writer(offset_, offsets_start, std::uint32_t{0});
  writer.end_record(record);
  const ByteSpan summed = ByteSpan(out_).first(out_.size() - sizeof(std::uint32_t));
  const std::uint32_t crc = crc32(summed);
  std::memcpy(out_.data() + summed.size(), &crc, sizeof crc);
  writer.raw(as_bytes(kMagic));
  return {};
}

Status McapFile::finish(const std::vector<SchemaInfo>& schemas,
                        const std::vector<ChannelInfo>& channels) {
  out_.clear();
  ByteWriter writer(out_);
  const std::size_t record = writer.begin_record(opcode::kDataEnd);
  writer(data_crc_);
  writer.end_record(record);
  RAVE_TRY(append(out_));
  out_.clear();
  RAVE_TRY(put_summary(schemas, channels));
  RAVE_TRY(append(out_));
  // Closing may report that what was written is lost.
  if (::close(file_.release()) != 0) {
    return fail(ErrorCode::kIo, "cannot close `{}`: {}", path_.string(), std::strerror(errno));
  }
  return {};
}

}  // namespace rave::record
