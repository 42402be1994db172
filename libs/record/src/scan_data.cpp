// SPDX-License-Identifier: Apache-2.0
// Lists what is in a recording that has no summary: one that is being written, or whose process was
// killed.
#include <algorithm>
#include <set>

#include "record_file.hpp"

namespace rave::record {
namespace {

/// Messages outside of chunks are read in blocks of about this size.
constexpr std::uint64_t kBareBytes = std::uint64_t{1} << 20;

/// Scans the data section of a recording and lists its records.
class DataScan {
 public:
  explicit DataScan(RecordFile& file) noexcept : file_(file) {}

  // Records are frames of code and length, so a file without its end is read from one to the next
  // up to the first that is not whole.
  void run() {
    std::uint64_t at = file_.data_begin;
    const std::uint64_t end = file_.source->size();
    while (at < end) {
      if (end - at < kRecordHead) return cut(at);
      if (!file_.source->read(at, kRecordHead, head_)) return cut(at);
      ByteReader reader(head_);
      const auto code = reader.get<std::uint8_t>();
      const auto size = reader.get<std::uint64_t>();
      if (code == opcode::kDataEnd || code == opcode::kFooter) {
        file_.data_end = at;
        return;
      }
      // Code 0 does not exist; a block of zeros is what a file system can leave after a crash.
      if (code == 0 || size > end - at - kRecordHead) return cut(at);
      if (!take(code, at, size)) return cut(at);
      at += kRecordHead + size;
    }
    // A file that ends between two records lacks its end too; open() reports that.
  }

 private:
  void cut(std::uint64_t at) {
    // With a footer the rest was lost; without one it was never written.
    (file_.ended ? file_.damages : file_.cuts)
        .push_back(fmt::format(
            "`{}`: an incomplete MCAP record at offset {}; {} bytes from there on are not read",
            file_.source->name(), at, file_.source->size() - at));
  }

  [[nodiscard]] bool take(std::uint8_t code, std::uint64_t at, std::uint64_t size) {
    switch (code) {
      case opcode::kChunk:
        return take_chunk(at, size);
      case opcode::kMessage:
        return take_bare(at, size);
      case opcode::kSchema:
      case opcode::kChannel:
      case opcode::kAttachment:
      case opcode::kMetadata:
        if (code == opcode::kAttachment) return take_attachment(at, size);
        if (!file_.source->read(at + kRecordHead, size, content_)) return false;
        return code == opcode::kMetadata ? take_metadata(at, size)
                                         : note_definition(file_, code, content_);
      default:
        return true;
    }
  }

  // What the summary would have said.
  void count(const MessageView& message) {
    Statistics& all = file_.statistics;
    const bool first = all.message_count == 0;
    all.start_ns = first ? message.log_time_ns : std::min(all.start_ns, message.log_time_ns);
    all.end_ns = std::max(all.end_ns, message.log_time_ns);
    ++all.message_count;
    ++all.channel_message_counts[message.channel];
  }

  /// An unreadable chunk is noted and skipped: its frame gives the place of the next.
  [[nodiscard]] bool take_chunk(std::uint64_t at, std::uint64_t size) {
    ChunkInfo chunk;
    chunk.offset = at;
    chunk.length = kRecordHead + size;
    ++file_.statistics.chunk_count;
    if (const Status loaded = load_chunk(file_, chunk, records_); !loaded) {
      file_.damages.push_back(loaded.error().message);
      return true;
    }
    chunk.uncompressed_size = records_.size();
    std::set<std::uint16_t> channels;
    bool first = true;
    bool ok = true;
    const bool complete = for_each_record(records_, [&](auto code, ByteSpan content, std::size_t) {
      if (code == opcode::kSchema || code == opcode::kChannel) {
        ok = note_definition(file_, code, content);
        return ok;
      }
      MessageView message;
      if (code != opcode::kMessage) return true;
      ok = get_message(content, message);
      if (!ok) return false;
      count(message);
      channels.insert(message.channel);
      chunk.start_ns = first ? message.log_time_ns : std::min(chunk.start_ns, message.log_time_ns);
      chunk.end_ns = std::max(chunk.end_ns, message.log_time_ns);
      first = false;
      return true;
    });
    if (!ok || !complete) {
      file_.damages.push_back(fmt::format("`{}`: the chunk at offset {} has an incomplete record",
                                          file_.source->name(), at));
    }
    for (const auto channel : channels) chunk.channels.emplace_back(channel, 0);
    if (!channels.empty()) file_.chunks.push_back(std::move(chunk));
    return true;
  }

  [[nodiscard]] bool take_bare(std::uint64_t at, std::uint64_t size) {
    MessageView message;
    if (!file_.source->read(at + kRecordHead, size, content_)) return false;
    if (!get_message(content_, message)) return false;
    count(message);
    const std::uint64_t length = kRecordHead + size;
    // Messages in a row count as one chunk, so that readers need not know that there are bare ones.
    if (!file_.chunks.empty()) {
      ChunkInfo& last = file_.chunks.back();
      if (last.bare && last.offset + last.length == at && last.length < kBareBytes) {
        last.length += length;
        last.start_ns = std::min(last.start_ns, message.log_time_ns);
        last.end_ns = std::max(last.end_ns, message.log_time_ns);
        return true;
      }
    }
    ChunkInfo chunk;
    chunk.bare = true;
    chunk.offset = at;
    chunk.length = length;
    chunk.uncompressed_size = length;
    chunk.start_ns = message.log_time_ns;
    chunk.end_ns = message.log_time_ns;
    file_.chunks.push_back(std::move(chunk));
    return true;
  }

  [[nodiscard]] bool take_attachment(std::uint64_t at, std::uint64_t size) {
    if (!file_.source->read(at + kRecordHead, size, content_)) return false;
    ByteReader reader(content_);
    AttachmentInfo info;
    info.offset = at;
    info.length = kRecordHead + size;
    reader(info.log_time_ns, info.create_time_ns, info.name, info.media_type, info.data_size);
    static_cast<void>(reader.raw(info.data_size));
    if (!reader.ok()) return false;
    file_.attachments.push_back(std::move(info));
    ++file_.statistics.attachment_count;
    return true;
  }

  [[nodiscard]] bool take_metadata(std::uint64_t at, std::uint64_t size) {
    ByteReader reader(content_);
    MetadataInfo& info = file_.metadata.emplace_back(at, kRecordHead + size, "");
    reader(info.name);
    ++file_.statistics.metadata_count;
    return reader.ok();
  }

  RecordFile& file_;
  Bytes head_;
  Bytes content_;
  Bytes records_;
};

}  // namespace

void scan_data(RecordFile& file) {
  // A summary that was read in part may be wrong; all is found anew.
  file.schemas.clear();
  file.channels.clear();
  file.chunks.clear();
  file.attachments.clear();
  file.metadata.clear();
  file.statistics = {};
  DataScan(file).run();
  file.statistics.schema_count = static_cast<std::uint16_t>(file.schemas.size());
  file.statistics.channel_count = static_cast<std::uint32_t>(file.channels.size());
}

}  // namespace rave::record
