// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "bytes.hpp"

namespace rave::record {

/// Messages to be written: the uncompressed records of a chunk, and the offset of each message in
/// them.
struct Chunk {
  struct Entry {
    std::uint64_t log_time_ns;
    std::uint64_t offset;
    std::uint16_t channel;
  };

  Bytes records;
  std::vector<Entry> entries;

  void clear() noexcept {
    records.clear();
    entries.clear();
  }
};

}  // namespace rave::record
