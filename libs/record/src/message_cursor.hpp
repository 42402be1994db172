// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <queue>

#include "record_file.hpp"

namespace rave::record {

/// A heap over the chunks that overlap the current time. A chunk is decompressed when its start is
/// reached and freed after its last message.
class MessageCursor::Impl {
 public:
  Impl(std::shared_ptr<const RecordFile> file, MessageFilter filter);

  [[nodiscard]] Result<std::optional<MessageView>> next();

 private:
  struct Place {
    std::uint64_t log_time_ns;
    std::uint64_t offset;  ///< Offset of the content in the records.
    std::uint64_t size;
  };
  struct OpenChunk {
    Bytes records;
    std::vector<Place> places;  ///< By time, then in order of writing.
    std::size_t next = 0;
  };
  struct Head {
    std::uint64_t log_time_ns;
    std::size_t chunk;  ///< Index in the file: chunks of equal time are used in that order.

    friend bool operator>(const Head& a, const Head& b) noexcept {
      return a.log_time_ns != b.log_time_ns ? a.log_time_ns > b.log_time_ns : a.chunk > b.chunk;
    }
  };

  [[nodiscard]] bool wanted(const ChunkInfo& chunk) const;
  [[nodiscard]] Status open_chunk(std::size_t index);

  std::shared_ptr<const RecordFile> file_;        ///< Shared with the reader and other cursors.
  MessageFilter filter_;                          ///< Its channels sorted.
  std::vector<std::size_t> waiting_;              ///< Chunks not opened yet, the earliest last.
  std::vector<std::unique_ptr<OpenChunk>> open_;  ///< By chunk; null where none is open.
  std::priority_queue<Head, std::vector<Head>, std::greater<>> heads_;
  /// To be freed at the next call: its bytes were returned to the caller.
  std::optional<std::size_t> spent_;
};

}  // namespace rave::record
