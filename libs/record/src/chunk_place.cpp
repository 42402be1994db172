// SPDX-License-Identifier: Apache-2.0
// What the summary says of a chunk, read back from the file: a long run has too many chunks to keep
// this in memory.
#include "chunk_place.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "mcap_format.hpp"

namespace rave::record {
namespace {

/// Size of opcode, length, two times, size, checksum, `zstd` or empty, compressed size.
constexpr std::size_t kLongestHead = kRecordHead + 8 + 8 + 8 + 4 + 4 + 4 + 8;

[[nodiscard]] Status read_at(int fd, std::uint64_t offset, std::size_t size,
                             const std::string& path, Bytes& out) {
  out.resize(size);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count =
        ::pread(fd, out.data() + done, size - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      return fail(ErrorCode::kIo, "cannot read `{}` back at offset {}: {}", path, offset + done,
                  count == 0 ? "the file was truncated" : std::strerror(errno));
    }
    done += static_cast<std::size_t>(count);
  }
  return {};
}

}  // namespace

// The head of a chunk and its message indexes have all that the index of the chunk needs.
Result<ChunkInfo> read_back(int fd, const ChunkPlace& place, const std::string& path,
                            Bytes& buffer) {
  const auto changed = [&] {
    return fail(ErrorCode::kIo, "`{}` was changed at offset {} during writing", path, place.offset);
  };
  ChunkInfo info;
  info.offset = place.offset;
  info.message_index_length = place.index_length;
  // More than the head can be read: a chunk is always followed by the end of the data.
  RAVE_TRY(read_at(fd, place.offset, kLongestHead, path, buffer));
  ByteReader head(buffer);
  const auto code = head.get<std::uint8_t>();
  info.length = kRecordHead + head.get<std::uint64_t>();
  std::uint32_t crc = 0;
  head(info.start_ns, info.end_ns, info.uncompressed_size, crc, info.compression,
       info.compressed_size);
  if (!head.ok() || code != opcode::kChunk) return changed();
  RAVE_TRY(read_at(fd, place.offset + info.length, place.index_length, path, buffer));
  ByteReader indexes(buffer);
  while (indexes.rest() > 0) {
    const std::uint64_t at = place.offset + info.length + indexes.position();
    const auto kind = indexes.get<std::uint8_t>();
    ByteReader index(indexes.raw(indexes.get<std::uint64_t>()));
    info.channels.emplace_back(index.get<std::uint16_t>(), at);
    if (!indexes.ok() || !index.ok() || kind != opcode::kMessageIndex) return changed();
  }
  return info;
}

}  // namespace rave::record
