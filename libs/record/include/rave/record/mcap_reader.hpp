// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/record/mcap_types.hpp"

namespace rave::record {

struct RecordFile;
class ByteSource;

/// Options for reading an MCAP file.
struct McapReaderOptions {
  /// A chunk that claims to be larger is treated as damaged.
  std::uint64_t max_chunk_bytes = std::uint64_t{1} << 30;
};

/// The result of checking every byte of a file. Each text names file and offset.
struct CheckedFile {
  std::vector<std::string> cuts;      ///< Missing parts at the end of a truncated file.
  std::vector<std::string> damages;   ///< Checksum mismatches and incomplete records.
  std::vector<std::string> unsummed;  ///< Parts without a checksum, which cannot be checked.

  /// Whether every byte is known to be as written.
  [[nodiscard]] bool whole() const noexcept {
    return cuts.empty() && damages.empty() && unsummed.empty();
  }
};

/// Selects the messages of a MessageCursor. Times in ns of the recording's clock, both inclusive.
struct MessageFilter {
  std::vector<std::uint16_t> channels;  ///< Channel ids; empty: all.
  std::uint64_t from_ns = 0;
  std::uint64_t to_ns = ~std::uint64_t{0};
};

/// Iterates over messages in order of log time; those of equal time in the order of writing. Shares
/// ownership of the file, so it may outlive the reader. One thread.
class MessageCursor {
 public:
  MessageCursor(MessageCursor&&) noexcept;
  MessageCursor& operator=(MessageCursor&&) noexcept;
  ~MessageCursor();

  /// The next message, or nothing at the end. Its bytes are valid until the next call. A damaged
  /// chunk is an error that names file and offset; the next call continues with the other chunks.
  [[nodiscard]] Result<std::optional<MessageView>> next();

 private:
  friend class McapReader;
  class Impl;
  explicit MessageCursor(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

/// Reads MCAP files (version 0, https://mcap.dev/spec), uncompressed or zstd. It uses the summary
/// at the end of the file. If the summary is missing or damaged, it scans the file from the start
/// and stops without an error at the first incomplete record. No content of a file is trusted. One
/// thread.
class McapReader {
 public:
  /// Opens a file. Errors: kNotFound, kIo, kParse (not an MCAP file).
  [[nodiscard]] static Result<McapReader> open(const std::filesystem::path& path,
                                               McapReaderOptions options = {});
  /// Opens bytes in memory, which must outlive the reader and its cursors; `name` replaces the path
  /// in errors.
  [[nodiscard]] static Result<McapReader> open_memory(std::span<const std::byte> bytes,
                                                      std::string name,
                                                      McapReaderOptions options = {});

  [[nodiscard]] const std::string& profile() const noexcept;
  [[nodiscard]] const std::string& library() const noexcept;
  /// Whether the file ends with a footer; without one it is truncated.
  [[nodiscard]] bool ended() const noexcept;
  /// Whether the file has index and footer and no known damage. Opening reads the index only;
  /// check() also reads the data.
  [[nodiscard]] bool whole() const noexcept;
  /// Damage found when opening; each text names file and offset.
  [[nodiscard]] std::vector<std::string> damages() const;
  [[nodiscard]] std::uint64_t file_size() const noexcept;
  [[nodiscard]] const std::vector<SchemaInfo>& schemas() const noexcept;
  [[nodiscard]] const std::vector<ChannelInfo>& channels() const noexcept;
  [[nodiscard]] const Statistics& statistics() const noexcept;
  [[nodiscard]] const std::vector<ChunkInfo>& chunks() const noexcept;
  [[nodiscard]] const std::vector<AttachmentInfo>& attachments() const noexcept;
  [[nodiscard]] const std::vector<MetadataInfo>& metadata() const noexcept;

  /// The channel of a topic; null if it does not exist.
  [[nodiscard]] const ChannelInfo* channel(std::string_view topic) const noexcept;
  [[nodiscard]] const SchemaInfo* schema(std::uint16_t id) const noexcept;

  [[nodiscard]] MessageCursor messages(MessageFilter filter = {}) const;
  /// The content of an attachment; its checksum is verified.
  [[nodiscard]] Result<std::string> read_attachment(const AttachmentInfo& attachment) const;
  [[nodiscard]] Result<StringMap> read_metadata(const MetadataInfo& metadata) const;
  /// The entries of the first readable metadata of this name; empty if there is none.
  [[nodiscard]] StringMap metadata_named(std::string_view name) const;
  /// Reads the whole file and verifies every checksum and record. Continues after damage.
  [[nodiscard]] CheckedFile check() const;

 private:
  explicit McapReader(std::shared_ptr<const RecordFile> file) noexcept;
  [[nodiscard]] static Result<McapReader> open_source(std::unique_ptr<ByteSource> source,
                                                      McapReaderOptions options);
  std::shared_ptr<const RecordFile> file_;  ///< Shared with the cursors.
};

}  // namespace rave::record
