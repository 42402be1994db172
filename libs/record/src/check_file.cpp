// SPDX-License-Identifier: Apache-2.0
// Reads all of a file and compares every checksum that is there.
#include <fmt/format.h>

#include <algorithm>

#include "crc32.hpp"
#include "record_file.hpp"

namespace rave::record {
namespace {

constexpr std::uint64_t kReadBytes = std::uint64_t{1} << 20;

class FileCheck {
 public:
  explicit FileCheck(const RecordFile& file) : file_(file), source_(*file.source) {
    checked_.cuts = file.cuts;
    checked_.damages = file.damages;
  }

  // From the parts to the whole: damage is reported at the smallest record that has it.
  CheckedFile run() {
    if (file_.ended && !file_.summed) unsummed("index");
    for (const AttachmentInfo& attachment : file_.attachments) check_attachment(attachment);
    for (const MetadataInfo& metadata : file_.metadata) check_metadata(metadata);
    for (const ChunkInfo& chunk : file_.chunks) check_chunk(chunk);
    // If a chunk is damaged, its messages are missing anyway.
    if (messages_ != file_.statistics.message_count && checked_.damages.empty()) {
      damage(fmt::format("`{}` states {} messages; it has {}", source_.name(),
                         file_.statistics.message_count, messages_));
    }
    if (file_.data_end != 0 && file_.ended) check_data();
    return std::move(checked_);
  }

 private:
  void damage(std::string text) { checked_.damages.push_back(std::move(text)); }
  void unsummed(std::string_view what) {
    checked_.unsummed.push_back(fmt::format("`{}`: the {} has no checksum", source_.name(), what));
  }
  void damage_at(std::string_view what, std::uint64_t offset, std::string_view how) {
    damage(fmt::format("`{}`: the {} at offset {} {}", source_.name(), what, offset, how));
  }

  void check_attachment(const AttachmentInfo& info) {
    const std::string what = fmt::format("attachment `{}`", info.name);
    Bytes bytes;
    if (const Status read = source_.read(info.offset, info.length, bytes); !read) {
      return damage(read.error().message);
    }
    ByteReader reader(bytes);
    const bool right = begins_record(reader, opcode::kAttachment);
    constexpr std::size_t kCrc = sizeof(std::uint32_t);
    if (!right || bytes.size() < kRecordHead + kCrc) {
      return damage_at(what, info.offset, "is incomplete");
    }
    const ByteSpan summed = ByteSpan(bytes).first(bytes.size() - kCrc).subspan(kRecordHead);
    const auto crc = ByteReader(ByteSpan(bytes).last(kCrc)).get<std::uint32_t>();
    if (crc == 0) return unsummed(what);
    if (crc32(summed) != crc) damage_at(what, info.offset, "does not match its checksum");
  }

  /// Metadata records have no checksum of their own; the checksum of all data covers them.
  void check_metadata(const MetadataInfo& info) {
    Bytes bytes;
    if (const Status read = source_.read(info.offset, info.length, bytes); !read) {
      return damage(read.error().message);
    }
    ByteReader reader(bytes);
    const bool right = begins_record(reader, opcode::kMetadata);
    std::string name;
    StringMap entries;
    reader(name, entries);
    if (!right || name != info.name || !reader.ok()) {
      damage_at(fmt::format("metadata `{}`", info.name), info.offset, "is incomplete");
    }
  }

  void check_chunk(const ChunkInfo& info) {
    bool summed = true;
    if (const Status loaded = load_chunk(file_, info, records_, &summed); !loaded) {
      return damage(loaded.error().message);
    }
    if (!summed) unsummed(fmt::format("chunk at offset {}", info.offset));
    const auto count = [this](const MessageView&, std::size_t, std::size_t) { ++messages_; };
    if (!for_each_message(records_, count)) {
      damage_at("chunk", info.offset, "has an incomplete record");
    }
  }

  /// The checksum of all data also covers records without their own.
  /// In pieces: a recording may be larger than memory.
  void check_data() {
    Bytes bytes;
    std::uint32_t sum = 0;
    for (std::uint64_t at = 0; at < file_.data_end; at += bytes.size()) {
      const auto size = std::min(kReadBytes, file_.data_end - at);
      if (const Status read = source_.read(at, size, bytes); !read) {
        return damage(read.error().message);
      }
      sum = crc32(bytes, sum);
    }
    const Status read = source_.read(file_.data_end, kRecordHead + 4, bytes);
    ByteReader reader(bytes);
    if (!read || !begins_record(reader, opcode::kDataEnd)) {
      return damage(fmt::format("`{}`: the data do not end at offset {} as stated", source_.name(),
                                file_.data_end));
    }
    const auto crc = reader.get<std::uint32_t>();
    if (crc == 0) return unsummed("data section");
    if (crc == sum) return;
    damage(fmt::format("`{}`: the data before offset {} do not match their checksum{}",
                       source_.name(), file_.data_end,
                       checked_.damages.empty()
                           ? ": the header, metadata, or the head or index of a chunk is damaged"
                           : ""));
  }

  const RecordFile& file_;
  const ByteSource& source_;
  CheckedFile checked_;
  std::uint64_t messages_ = 0;
  Bytes records_;
};

}  // namespace

CheckedFile check_file(const RecordFile& file) { return FileCheck(file).run(); }

}  // namespace rave::record
