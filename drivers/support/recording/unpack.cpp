// SPDX-License-Identifier: Apache-2.0
#include "recording/unpack.hpp"

#include <fmt/ranges.h>
#include <sodium.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

namespace rave::recording {
namespace {

/// Owns the zlib state for one file.
class Inflater {
 public:
  // 16 added to the window size selects the gzip format (zlib manual, inflateInit2).
  Inflater() noexcept : ready_(inflateInit2(&stream_, 16 + MAX_WBITS) == Z_OK) {}
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() {
    if (ready_) inflateEnd(&stream_);
  }
  [[nodiscard]] bool ready() const noexcept { return ready_; }
  [[nodiscard]] z_stream& stream() noexcept { return stream_; }

 private:
  z_stream stream_{};
  bool ready_;
};

bool starts_like_gzip(std::string_view bytes) noexcept {
  return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

tl::unexpected<Error> failure(const std::string& file, std::string_view what) {
  return fail_at({file, 0, 0}, ErrorCode::kParse, "{}", what);
}

tl::unexpected<Error> too_large(const std::string& file, std::size_t max_bytes) {
  return failure(file, fmt::format("the unpacked log is larger than {} bytes", max_bytes));
}

tl::unexpected<Error> damaged(const std::string& file, const z_stream& stream) {
  const char* reason = stream.msg != nullptr ? stream.msg : "unknown reason";
  return failure(file, fmt::format("the gzip data are damaged ({}); fetch the file again", reason));
}

}  // namespace

Result<UnpackedText> unpack_text(std::string_view bytes, const std::string& file,
                                 std::size_t max_bytes) {
  if (!starts_like_gzip(bytes)) {
    if (bytes.size() > max_bytes) return too_large(file, max_bytes);
    return UnpackedText{std::string(bytes), false};
  }
  if (bytes.size() > std::numeric_limits<uInt>::max()) return too_large(file, max_bytes);
  Inflater inflater;
  if (!inflater.ready()) return failure(file, "zlib could not be started");
  z_stream& stream = inflater.stream();
  std::string input(bytes);  // zlib's interface requires non-const input
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  UnpackedText result;
  std::array<char, 1 << 16> buffer{};
  while (true) {
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    const int status = inflate(&stream, Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR) {
      return damaged(file, stream);
    }
    result.text.append(buffer.data(), buffer.size() - stream.avail_out);
    // Checked while unpacking: a small file can unpack to any size.
    if (result.text.size() > max_bytes) return too_large(file, max_bytes);
    if (status == Z_STREAM_END) {
      const std::size_t rest = stream.avail_in;
      if (rest == 0) return result;
      // A gzip file may consist of several members, one after the other (RFC 1952).
      if (!starts_like_gzip(std::string_view(input).substr(input.size() - rest))) {
        return failure(file, fmt::format("{} bytes follow the end of the gzip stream", rest));
      }
      if (inflateReset(&stream) != Z_OK) return damaged(file, stream);
    } else if (stream.avail_in == 0 && stream.avail_out != 0) {
      // All input is used and the end is missing: the file was cut off. What has been unpacked is
      // kept for `accept_cut`.
      result.cut = true;
      return result;
    }
  }
}

// runtime/recording does the same with files that are larger than the memory. No library may be
// used by both without a price: `base` would bring libsodium to every program, `record` would bring
// the reader of recordings to the plug-ins of players.
std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
  crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(bytes.data()),
                     bytes.size());
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace rave::recording
