// SPDX-License-Identifier: Apache-2.0
// An open file: its summary, and its chunks on demand.
#include "record_file.hpp"

#include <zstd.h>

#include <algorithm>
#include <concepts>

#include "crc32.hpp"

namespace rave::record {

namespace {

/// Adds a description to a list by id. The first one of an id counts; later chunks repeat it.
template <class Info>
[[nodiscard]] bool note(ByteSpan content, std::vector<Info>& known) {
  Info info;
  if (!get_record(content, info)) return false;
  // A channel with schema 0 has none.
  if (std::same_as<Info, SchemaInfo> && info.id == 0) return true;
  const auto at = std::ranges::lower_bound(known, info.id, {}, &Info::id);
  if (at == known.end() || at->id != info.id) known.insert(at, std::move(info));
  return true;
}

}  // namespace

bool note_definition(RecordFile& file, std::uint8_t code, ByteSpan content) {
  return code == opcode::kSchema ? note(content, file.schemas) : note(content, file.channels);
}

bool for_each_record(ByteSpan records,
                     const std::function<bool(std::uint8_t, ByteSpan, std::size_t)>& take) {
  ByteReader reader(records);
  while (reader.rest() > 0) {
    const auto code = reader.get<std::uint8_t>();
    const auto size = reader.get<std::uint64_t>();
    const std::size_t at = reader.position();
    const ByteSpan content = reader.raw(size);
    if (!reader.ok()) return false;
    if (!take(code, content, at)) return true;
  }
  return true;
}

namespace {

[[nodiscard]] bool get_summary_record(RecordFile& file, std::uint8_t code, ByteSpan content,
                                      bool& counted) {
  switch (code) {
    case opcode::kSchema:
    case opcode::kChannel:
      return note_definition(file, code, content);
    case opcode::kChunkIndex:
      return get_record(content, file.chunks.emplace_back());
    case opcode::kAttachmentIndex:
      return get_record(content, file.attachments.emplace_back());
    case opcode::kMetadataIndex:
      return get_record(content, file.metadata.emplace_back());
    case opcode::kStatistics:
      counted = true;
      return get_record(content, file.statistics);
    default:
      return true;
  }
}

[[nodiscard]] Status unpack(const RecordFile& file, const ChunkInfo& chunk, ByteSpan packed,
                            std::string_view compression, std::uint64_t size, Bytes& records) {
  const std::string& name = file.source->name();
  if (size > file.options.max_chunk_bytes) {
    return fail(ErrorCode::kParse, "`{}`: the chunk at offset {} states {} bytes", name,
                chunk.offset, size);
  }
  if (compression.empty() && packed.size() == size) {
    records.assign(packed.begin(), packed.end());
    return {};
  }
  if (compression != "zstd") {
    return fail(ErrorCode::kParse,
                "`{}`: the chunk at offset {} has the compression `{}`; expected zstd", name,
                chunk.offset, compression);
  }
  // Trust the stated size only if the zstd frame agrees, before memory is allocated.
  const auto frame = ZSTD_getFrameContentSize(packed.data(), packed.size());
  std::size_t got = 0;
  if (frame == size || frame == ZSTD_CONTENTSIZE_UNKNOWN) {
    records.resize(size);
    got = ZSTD_decompress(records.data(), records.size(), packed.data(), packed.size());
  }
  if ((frame != size && frame != ZSTD_CONTENTSIZE_UNKNOWN) || ZSTD_isError(got) != 0 ||
      got != size) {
    return fail(ErrorCode::kParse, "`{}`: the chunk at offset {} cannot be decompressed", name,
                chunk.offset);
  }
  return {};
}

}  // namespace

Status read_summary(RecordFile& file) {
  const ByteSource& source = *file.source;
  // The end of a file has a fixed size, so the footer is found without reading the rest.
  constexpr std::uint64_t kTail = kRecordHead + kFooterSize + 8;
  Bytes tail;
  const auto cut = [&] {
    file.cuts.push_back(
        fmt::format("`{}` ends at offset {} without a footer", source.name(), source.size()));
    return fail(ErrorCode::kNotFound, "");
  };
  if (source.size() < file.data_begin + kTail) return cut();
  const std::uint64_t footer_at = source.size() - kTail;
  RAVE_TRY(source.read(footer_at, kTail, tail));
  ByteReader footer(tail);
  const bool is_footer =
      footer.get<std::uint8_t>() == opcode::kFooter && footer.get<std::uint64_t>() == kFooterSize;
  const auto start = footer.get<std::uint64_t>();
  footer.skip<std::uint64_t>();
  const auto crc = footer.get<std::uint32_t>();
  const ByteSpan magic = footer.raw(kMagic.size());
  if (!is_footer || !std::ranges::equal(magic, as_bytes(kMagic))) return cut();
  file.ended = true;
  if (start == 0) {  // permitted: a file without a summary
    if (crc == 0 || crc32(ByteSpan(tail).first(kRecordHead + kFooterSize - 4)) == crc) {
      return fail(ErrorCode::kNotFound, "");
    }
    return fail(ErrorCode::kParse, "`{}`: the footer at offset {} does not match its checksum",
                source.name(), footer_at);
  }
  if (start < file.data_begin || start > footer_at) {
    return fail(ErrorCode::kParse, "`{}`: the footer at offset {} puts the summary at {}",
                source.name(), footer_at, start);
  }
  Bytes summary;
  RAVE_TRY(source.read(start, footer_at - start + kRecordHead + kFooterSize - 4, summary));
  if (crc != 0 && crc32(summary) != crc) {
    return fail(ErrorCode::kParse, "`{}`: the summary at offset {} does not match its checksum",
                source.name(), start);
  }
  file.summed = crc != 0;
  bool ok = true;
  bool counted = false;
  const bool complete = for_each_record(ByteSpan(summary).first(footer_at - start),
                                        [&](auto code, ByteSpan content, std::size_t) {
                                          ok = get_summary_record(file, code, content, counted);
                                          return ok;
                                        });
  if (!ok || !complete) {
    return fail(ErrorCode::kParse, "`{}`: the summary at offset {} has an incomplete record",
                source.name(), start);
  }
  // Without counts, or with messages outside of chunks, the data must be scanned.
  if (!counted || (file.chunks.empty() && file.statistics.message_count > 0)) {
    return fail(ErrorCode::kNotFound, "");
  }
  file.data_end = start < kRecordHead + 4 ? 0 : start - kRecordHead - 4;
  return {};
}

Status load_chunk(const RecordFile& file, const ChunkInfo& chunk, Bytes& records, bool* summed) {
  // Messages outside of chunks: the same records without a frame.
  if (chunk.bare) return file.source->read(chunk.offset, chunk.length, records);
  Bytes bytes;
  RAVE_TRY(file.source->read(chunk.offset, chunk.length, bytes));
  ByteReader reader(bytes);
  const bool right = begins_record(reader, opcode::kChunk);
  reader.skip<std::uint64_t, std::uint64_t>();  // its times
  std::uint64_t size = 0;
  std::uint32_t crc = 0;
  std::string compression;
  reader(size, crc, compression);
  const ByteSpan packed = reader.raw(reader.get<std::uint64_t>());
  if (!right || !reader.ok()) {
    return fail(ErrorCode::kParse, "`{}`: there is no complete chunk at offset {}",
                file.source->name(), chunk.offset);
  }
  if (summed != nullptr) *summed = crc != 0;
  RAVE_TRY(unpack(file, chunk, packed, compression, size, records));
  if (crc != 0 && crc32(records) != crc) {
    return fail(ErrorCode::kParse, "`{}`: the chunk at offset {} does not match its checksum",
                file.source->name(), chunk.offset);
  }
  return {};
}

}  // namespace rave::record
