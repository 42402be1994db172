// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "byte_source.hpp"
#include "mcap_format.hpp"
#include "rave/record/mcap_reader.hpp"

namespace rave::record {

/// All that is known about an open record. Constant once it is open.
struct RecordFile {
  std::unique_ptr<ByteSource> source;
  McapReaderOptions options;
  std::string profile;
  std::string library;
  bool ended = false;  ///< It ends with a footer.
  /// What is missing at the end of a file that broke off; what is wrong elsewhere. Each names file
  /// and offset.
  std::vector<std::string> cuts;
  std::vector<std::string> damages;
  bool summed = false;  ///< The summary has a checksum, which matches.
  std::vector<SchemaInfo> schemas;
  std::vector<ChannelInfo> channels;
  std::vector<ChunkInfo> chunks;
  std::vector<AttachmentInfo> attachments;
  std::vector<MetadataInfo> metadata;
  Statistics statistics;
  std::uint64_t data_begin = 0;  ///< Behind the header record.
  std::uint64_t data_end = 0;    ///< Begin of the data end record; 0: not known.
};

/// Takes one schema or channel record. A second one of the same id is ignored.
void note_schema(RecordFile& file, SchemaInfo schema);
void note_channel(RecordFile& file, ChannelInfo channel);

/// Fills the file's lists from the summary section. A failure leaves them in any state.
[[nodiscard]] Status read_summary(RecordFile& file);

/// Fills the file's lists by going through the data section. What is not whole ends it and is noted
/// under damages.
void scan_data(RecordFile& file);

/// The records of a chunk, unpacked and with their checksum compared. Errors name file and offset.
/// `summed`, if not null: whether the chunk has a checksum.
[[nodiscard]] Status load_chunk(const RecordFile& file, const ChunkInfo& chunk, Bytes& records,
                                bool* summed = nullptr);

/// Calls `take(opcode, content, offset of the content)` for each record in `records` until it
/// returns false. False: the last record is not whole.
[[nodiscard]] bool for_each_record(
    ByteSpan records, const std::function<bool(std::uint8_t, ByteSpan, std::size_t)>& take);

}  // namespace rave::record
