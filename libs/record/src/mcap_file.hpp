// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "bytes.hpp"
#include "chunk.hpp"
#include "chunk_place.hpp"
#include "rave/base/descriptor.hpp"
#include "rave/base/result.hpp"
#include "rave/record/mcap_types.hpp"

struct ZSTD_CCtx_s;

namespace rave::record {

/// The file of an McapWriter and the content of its index. Used by one thread at a time. Every
/// function writes one self-contained record; after a failure, nothing.
class McapFile {
 public:
  [[nodiscard]] static Result<std::unique_ptr<McapFile>> create(const std::filesystem::path& path,
                                                                std::string_view profile,
                                                                std::string_view library);
  McapFile(const McapFile&) = delete;
  McapFile& operator=(const McapFile&) = delete;
  ~McapFile();

  /// `zstd_level`: empty to write the chunk uncompressed.
  [[nodiscard]] Status write_chunk(const Chunk& chunk, std::optional<int> zstd_level);
  [[nodiscard]] Status write_attachment(const AttachmentInfo& info, ByteSpan data);
  [[nodiscard]] Status write_metadata(std::string_view name, const StringMap& entries);
  /// Writes data end, summary, summary offsets and footer; closes the file.
  [[nodiscard]] Status finish(const std::vector<SchemaInfo>& schemas,
                              const std::vector<ChannelInfo>& channels);

 private:
  McapFile(std::filesystem::path path, int fd);
  [[nodiscard]] Status append(ByteSpan bytes);
  void put_chunk_record(const Chunk& chunk, std::optional<int> zstd_level, ChunkInfo& info);
  void put_message_indexes(const Chunk& chunk, ChunkInfo& info);
  void count(const Chunk& chunk, const ChunkInfo& info);
  [[nodiscard]] Status put_summary(const std::vector<SchemaInfo>& schemas,
                                   const std::vector<ChannelInfo>& channels);

  std::filesystem::path path_;
  Descriptor file_;
  ZSTD_CCtx_s* compressor_;
  std::uint64_t offset_ = 0;
  std::uint32_t data_crc_ = 0;
  Bytes out_;
  Bytes compressed_;
  std::vector<Chunk::Entry> sorted_;
  std::deque<ChunkPlace> chunks_;
  std::vector<AttachmentInfo> attachments_;
  std::vector<MetadataInfo> metadata_;
  Statistics statistics_;
};

}  // namespace rave::record
