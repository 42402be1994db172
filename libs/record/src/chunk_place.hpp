// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "bytes.hpp"
#include "rave/base/result.hpp"
#include "rave/record/mcap_types.hpp"

namespace rave::record {

/// The place of a written chunk. Its index is read back from the file at the end: in memory, the
/// index of a long run would be the largest part of the recorder.
struct ChunkPlace {
  std::uint64_t offset = 0;
  std::uint64_t index_length = 0;  ///< Size of the message indexes after it, bytes.
};

/// Reads the head and message indexes of a chunk from an open file. `path` is used in messages,
/// `buffer` is scratch memory. Errors: kIo.
[[nodiscard]] Result<ChunkInfo> read_back(int fd, const ChunkPlace& place, const std::string& path,
                                          Bytes& buffer);

}  // namespace rave::record
