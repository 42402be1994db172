// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "byte_source.hpp"
#include "mcap_format.hpp"
#include "rave/record/mcap_reader.hpp"

namespace rave::record {

/// All properties of an open recording. Constant once it is open.
struct RecordFile {
  std::unique_ptr<ByteSource> source;
  McapReaderOptions options;
  std::string profile;
  std::string library;
  bool ended = false;  ///< It has a footer.
  /// Missing parts at the end of a truncated file; damage elsewhere. Each text names file and
  /// offset.
  std::vector<std::string> cuts;
  std::vector<std::string> damages;
  bool summed = false;  ///< The summary has a checksum, and it is correct.
  std::vector<SchemaInfo> schemas;
  std::vector<ChannelInfo> channels;
  std::vector<ChunkInfo> chunks;
  std::vector<AttachmentInfo> attachments;
  std::vector<MetadataInfo> metadata;
  Statistics statistics;
  std::uint64_t data_begin = 0;  ///< After the header record.
  std::uint64_t data_end = 0;    ///< Start of the data end record; 0: unknown.
};

/// Adds a schema or channel record; a second one with the same id is ignored. False: incomplete.
[[nodiscard]] bool note_definition(RecordFile& file, std::uint8_t code, ByteSpan content);

/// Reads the lists from the summary section. After a failure they are undefined.
[[nodiscard]] Status read_summary(RecordFile& file);

/// Builds the lists by scanning the data section. Stops at an incomplete record and adds it to the
/// damages.
void scan_data(RecordFile& file);

/// The decompressed records of a chunk, with verified checksum. Errors name file and offset.
/// `summed`, if not null: whether the chunk has a checksum.
[[nodiscard]] Status load_chunk(const RecordFile& file, const ChunkInfo& chunk, Bytes& records,
                                bool* summed = nullptr);

/// Verifies every checksum of a file and counts its messages. Memory: the largest chunk.
[[nodiscard]] CheckedFile check_file(const RecordFile& file);

/// Calls `take(opcode, content, offset of the content)` for each record in `records` until it
/// returns false. False: the last record is incomplete.
[[nodiscard]] bool for_each_record(
    ByteSpan records, const std::function<bool(std::uint8_t, ByteSpan, std::size_t)>& take);

/// Calls `take(message, offset of its content, size of it)` for each message in `records`. False:
/// a message or the last record is incomplete, and the rest was not read.
template <class Take>
[[nodiscard]] bool for_each_message(ByteSpan records, Take take) {
  bool ok = true;
  const bool complete =
      for_each_record(records, [&](std::uint8_t code, ByteSpan content, std::size_t at) {
        if (code != opcode::kMessage) return true;
        MessageView message;
        ok = get_message(content, message);
        if (ok) take(message, at, content.size());
        return ok;
      });
  return ok && complete;
}

}  // namespace rave::record
