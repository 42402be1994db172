// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/record/mcap_types.hpp"

namespace rave::record {

/// Options for writing an MCAP file.
struct McapWriterOptions {
  std::size_t chunk_bytes = std::size_t{1} << 20;  ///< A chunk is closed at this size.
  /// Level -7 to 19 for normal load. If a tenth of `backlog_bytes` is waiting, chunks are
  /// compressed at a lower level; at half of it, not at all.
  int zstd_level = 1;
  std::string profile = "ros2";  ///< Profile in the header; `ros2` or empty.
  std::string library = "rave";
  /// Wall time after which an open chunk is closed even if nothing is written. Together with
  /// compressing and writing one chunk this stays below one second, the most that a killed process
  /// may lose.
  double flush_interval_s = 0.5;
  /// The limit of bytes that wait for the disk; beyond it write() blocks instead of dropping
  /// messages.
  std::size_t backlog_bytes = std::size_t{64} << 20;
};

/// Writes one MCAP file (version 0, https://mcap.dev/spec) with zstd chunks and a full index.
///
/// The caller appends to the open chunk only. A thread of the writer compresses full chunks and
/// writes each with one write(2), so the file of a killed process is readable up to its last flush.
/// (A power failure is not covered: nothing is synchronised to the disk.)
///
/// One thread at a time. If a write to the disk fails, the file is truncated after its last
/// complete chunk and the sink gets the error once. This call and all later ones return the error
/// and drop their data; close() still tries to write the index.
class McapWriter {
 public:
  /// Creates or replaces the file. `sink` may be null; otherwise it must outlive the writer and is
  /// called from the writer's thread. Errors: kIo, kNotFound (folder), kInvalidArgument (options).
  [[nodiscard]] static Result<McapWriter> open(const std::filesystem::path& path,
                                               McapWriterOptions options = {},
                                               LogSink* sink = nullptr);

  McapWriter(McapWriter&&) noexcept;
  McapWriter& operator=(McapWriter&&) noexcept;
  /// Closes the file; an error is reported to the sink only.
  ~McapWriter();

  /// Adds a schema; returns the id for add_channel(). Errors: more than 65535 schemas, or closed.
  [[nodiscard]] Result<std::uint16_t> add_schema(std::string_view name, std::string_view encoding,
                                                 std::string_view data);
  /// Adds a channel; returns the id for write(). `schema_id` 0: none. Errors: unknown schema, more
  /// than 65535 channels, or closed.
  [[nodiscard]] Result<std::uint16_t> add_channel(std::string_view topic,
                                                  std::string_view message_encoding,
                                                  std::uint16_t schema_id,
                                                  const StringMap& metadata = {});

  /// Appends one message. Errors: unknown channel, closed, or an earlier failed write.
  Status write(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_time_ns,
               std::uint64_t publish_time_ns, std::span<const std::byte> bytes);
  /// Like write(), for a message in several pieces.
  Status write_parts(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_time_ns,
                     std::uint64_t publish_time_ns,
                     std::span<const std::span<const std::byte>> parts);

  /// Attaches a file, outside of the chunks. `time_ns` is in the clock of the messages.
  Status add_attachment(std::string_view name, std::string_view media_type,
                        std::span<const std::byte> bytes, std::uint64_t time_ns = 0);
  Status add_metadata(std::string_view name, const StringMap& entries);

  /// Returns when all data written so far is in the file.
  Status flush();
  /// Writes the open chunk, the index and the footer. Later calls fail with kState; a second
  /// close() does nothing.
  Status close();

  /// The number of messages dropped after a failed write.
  [[nodiscard]] std::uint64_t dropped() const noexcept;
  /// How often write() had to wait for the disk.
  [[nodiscard]] std::uint64_t waits() const noexcept;

 private:
  class Impl;
  explicit McapWriter(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::record
