// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "bytes.hpp"
#include "rave/base/result.hpp"
#include "rave/record/mcap_types.hpp"

namespace rave::record {

/// Where a chunk that was written lies. All that the summary says of it is read back from the file
/// at the end: kept in memory, the index of a long run would be most of what the run takes.
struct ChunkPlace {
  std::uint64_t offset = 0;
  std::uint64_t index_length = 0;  ///< Of the message indexes behind it, bytes.
};

/// Reads head and message indexes of a chunk from an open file. `path` is for messages, `buffer` is
/// used on the way. Errors: kIo.
[[nodiscard]] Result<ChunkInfo> read_back(int fd, const ChunkPlace& place, const std::string& path,
                                          Bytes& buffer);

}  // namespace rave::record
