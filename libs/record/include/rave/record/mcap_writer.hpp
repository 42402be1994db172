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

/// How an MCAP file is written.
struct McapWriterOptions {
  std::size_t chunk_bytes = std::size_t{1} << 20;  ///< A chunk is closed when it holds this much.
  /// -7 to 19, while the disk and the compressor keep up. With a tenth of `backlog_bytes` waiting
  /// chunks are compressed more lightly, with half of them not at all.
  int zstd_level = 1;
  std::string profile = "ros2";  ///< Of the header; `ros2` or empty.
  std::string library = "rave";
  /// An open chunk is closed after this much wall time, also when nobody writes. With the time to
  /// compress and write one chunk it stays below the second that a killed process may lose.
  double flush_interval_s = 0.5;
  /// Messages waiting for the disk; beyond it write() waits instead of losing any.
  std::size_t backlog_bytes = std::size_t{64} << 20;
};

/// Writes one MCAP file (version 0, https://mcap.dev/spec) with zstd chunks and a full index.
///
/// The caller only appends to the chunk that is open; a thread of the writer compresses full
/// chunks and writes them with write(2), each as one piece, so that a process that is killed
/// leaves a file that can be read up to its last flush. (A power failure is not covered: nothing
/// is synchronised to the disk.)
///
/// All functions are for one thread at a time. When the disk refuses a write, the file is cut
/// behind its last whole chunk, the sink is told once, this and every later call returns that
/// error and drops what it was given; close() then still tries to write the index.
class McapWriter {
 public:
  /// Creates or replaces the file. `sink` may be null; otherwise it must outlive the writer and is
  /// called from the writer's thread. Errors: kIo, kNotFound (folder), kInvalidArgument (options).
  [[nodiscard]] static Result<McapWriter> open(const std::filesystem::path& path,
                                               McapWriterOptions options = {},
                                               LogSink* sink = nullptr);

  McapWriter(McapWriter&&) noexcept;
  McapWriter& operator=(McapWriter&&) noexcept;
  /// Closes the file; a failure has then nobody to be told but the sink.
  ~McapWriter();

  /// The id to give to add_channel(). Errors: more than 65535 of them, or closed.
  [[nodiscard]] Result<std::uint16_t> add_schema(std::string_view name, std::string_view encoding,
                                                 std::string_view data);
  /// The id to give to write(). `schema_id` 0: none. Errors: an unknown schema, more than 65535
  /// channels, or closed.
  [[nodiscard]] Result<std::uint16_t> add_channel(std::string_view topic,
                                                  std::string_view message_encoding,
                                                  std::uint16_t schema_id,
                                                  const StringMap& metadata = {});

  /// Appends one message. Errors: an unknown channel, closed, or a write that failed since.
  Status write(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_time_ns,
               std::uint64_t publish_time_ns, std::span<const std::byte> bytes);
  /// The same for a message that lies in several pieces.
  Status write_parts(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_time_ns,
                     std::uint64_t publish_time_ns,
                     std::span<const std::span<const std::byte>> parts);

  /// Puts a file into the file, outside of the chunks. `time_ns` on the clock of the messages.
  Status add_attachment(std::string_view name, std::string_view media_type,
                        std::span<const std::byte> bytes, std::uint64_t time_ns = 0);
  Status add_metadata(std::string_view name, const StringMap& entries);

  /// Returns when all that was written so far is in the file.
  Status flush();
  /// Writes what is open, the index and the footer. Further calls fail with kState; a second
  /// close() does nothing.
  Status close();

  /// Messages that were dropped after a failed write.
  [[nodiscard]] std::uint64_t dropped() const noexcept;
  /// How often write() had to wait for the disk.
  [[nodiscard]] std::uint64_t waits() const noexcept;

 private:
  class Impl;
  explicit McapWriter(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::record
