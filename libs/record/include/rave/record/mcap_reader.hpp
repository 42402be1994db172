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

/// How an MCAP file is read.
struct McapReaderOptions {
  /// A chunk that says it is larger than this is taken for damaged.
  std::uint64_t max_chunk_bytes = std::uint64_t{1} << 30;
};

/// What a look at every byte of a file found. Each text names file and offset.
struct CheckedFile {
  std::vector<std::string> cuts;      ///< What is missing at the end of a file that broke off.
  std::vector<std::string> damages;   ///< What does not match its checksum, or is no whole record.
  std::vector<std::string> unsummed;  ///< Pieces without a checksum, of which nothing can be said.

  /// Each byte is the one that was written.
  [[nodiscard]] bool whole() const noexcept {
    return cuts.empty() && damages.empty() && unsummed.empty();
  }
};

/// Which messages a MessageCursor gives. Times in ns on the clock of the record, both included.
struct MessageFilter {
  std::vector<std::uint16_t> channels;  ///< Empty: all.
  std::uint64_t from_ns = 0;
  std::uint64_t to_ns = ~std::uint64_t{0};
};

/// Messages in order of log time; those of equal time in the order in which they were written.
/// Holds its own share of the file, so it may outlive the reader. One thread.
class MessageCursor {
 public:
  MessageCursor(MessageCursor&&) noexcept;
  MessageCursor& operator=(MessageCursor&&) noexcept;
  ~MessageCursor();

  /// The next message, or nothing at the end. Its bytes stay until the next call. A damaged chunk
  /// is an error that names file and offset; the call after it goes on with the other chunks.
  [[nodiscard]] Result<std::optional<MessageView>> next();

 private:
  friend class McapReader;
  class Impl;
  explicit MessageCursor(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

/// Reads MCAP files (version 0, https://mcap.dev/spec), uncompressed or zstd. Opens by the summary
/// at the end; if that is missing or damaged, by going through the file from its start, which ends
/// quietly at the first piece that is not whole. Nothing in a file is trusted. One thread.
class McapReader {
 public:
  /// Errors: kNotFound, kIo, kParse (no MCAP file at all).
  [[nodiscard]] static Result<McapReader> open(const std::filesystem::path& path,
                                               McapReaderOptions options = {});
  /// The same for bytes in memory, which must outlive the reader and its cursors; `name` stands for
  /// the path in errors.
  [[nodiscard]] static Result<McapReader> open_memory(std::span<const std::byte> bytes,
                                                      std::string name,
                                                      McapReaderOptions options = {});

  [[nodiscard]] const std::string& profile() const noexcept;
  [[nodiscard]] const std::string& library() const noexcept;
  /// Whether the file ends with a footer; one that does not broke off.
  [[nodiscard]] bool ended() const noexcept;
  /// Whether it ends as it should, with index and footer, and nothing is known to be wrong.
  /// Opening reads the index, not the data: check() does.
  [[nodiscard]] bool whole() const noexcept;
  /// What opening found to be wrong, if anything; each names file and offset.
  [[nodiscard]] std::vector<std::string> damages() const;
  [[nodiscard]] std::uint64_t file_size() const noexcept;
  [[nodiscard]] const std::vector<SchemaInfo>& schemas() const noexcept;
  [[nodiscard]] const std::vector<ChannelInfo>& channels() const noexcept;
  [[nodiscard]] const Statistics& statistics() const noexcept;
  [[nodiscard]] const std::vector<ChunkInfo>& chunks() const noexcept;
  [[nodiscard]] const std::vector<AttachmentInfo>& attachments() const noexcept;
  [[nodiscard]] const std::vector<MetadataInfo>& metadata() const noexcept;

  /// The channel of a topic; null if there is none.
  [[nodiscard]] const ChannelInfo* channel(std::string_view topic) const noexcept;
  [[nodiscard]] const SchemaInfo* schema(std::uint16_t id) const noexcept;

  [[nodiscard]] MessageCursor messages(MessageFilter filter = {}) const;
  /// The content of an attachment, its checksum compared.
  [[nodiscard]] Result<std::string> read_attachment(const AttachmentInfo& attachment) const;
  [[nodiscard]] Result<StringMap> read_metadata(const MetadataInfo& metadata) const;
  /// Reads everything once: every checksum and every record of every chunk. Goes on after a damage.
  [[nodiscard]] CheckedFile check() const;
  /// check() as one answer: the first cut or damage. Pieces without a checksum are allowed.
  [[nodiscard]] Status verify() const;

 private:
  explicit McapReader(std::shared_ptr<const RecordFile> file) noexcept;
  [[nodiscard]] static Result<McapReader> open_source(std::unique_ptr<ByteSource> source,
                                                      McapReaderOptions options);
  std::shared_ptr<const RecordFile> file_;  ///< Shared with the cursors.
};

}  // namespace rave::record
