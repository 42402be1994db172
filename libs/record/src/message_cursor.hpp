// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <queue>

#include "record_file.hpp"

namespace rave::record {

/// A heap over the chunks that overlap the present moment. A chunk is unpacked when its start is
/// reached and let go when its last message was given.
class MessageCursor::Impl {
 public:
  Impl(std::shared_ptr<const RecordFile> file, MessageFilter filter);

  [[nodiscard]] Result<std::optional<MessageView>> next();

 private:
  struct Place {
    std::uint64_t log_time_ns;
    std::uint64_t offset;  ///< Of the content in the records.
    std::uint64_t size;
  };
  struct OpenChunk {
    Bytes records;
    std::vector<Place> places;  ///< By time, then as written.
    std::size_t next = 0;
  };
  struct Head {
    std::uint64_t log_time_ns;
    std::size_t chunk;  ///< Place in the file: chunks of equal time come in that order.

    friend bool operator>(const Head& a, const Head& b) noexcept {
      return a.log_time_ns != b.log_time_ns ? a.log_time_ns > b.log_time_ns : a.chunk > b.chunk;
    }
  };

  [[nodiscard]] bool wanted(const ChunkInfo& chunk) const;
  [[nodiscard]] Status open_chunk(std::size_t index);

  std::shared_ptr<const RecordFile> file_;  ///< Shared with the reader and other cursors.
  MessageFilter filter_;                    ///< Its channels sorted.
  std::vector<std::size_t> waiting_;        ///< Chunks not opened yet, the earliest at the end.
  std::vector<std::unique_ptr<OpenChunk>> open_;  ///< By chunk; null where none is open.
  std::priority_queue<Head, std::vector<Head>, std::greater<>> heads_;
  std::optional<std::size_t> spent_;  ///< Let go at the next call: its bytes were given out.
};

}  // namespace rave::record
