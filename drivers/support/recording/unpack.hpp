// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::recording {

/// The text of a log file, and whether its gzip stream is truncated.
struct UnpackedText {
  std::string text;
  /// True if the gzip stream is truncated; `text` is its valid part.
  bool cut = false;
};

/// Largest size of a file, packed and unpacked.
inline constexpr std::size_t kMostLogBytes = std::size_t{256} << 20;

/// Unpacks gzip with any number of members; bytes without gzip's magic number are taken as plain
/// text. `file` is used in messages. Errors (kParse): damaged data, a wrong checksum or length,
/// bytes after the end of the stream, more than `max_bytes` of text.
[[nodiscard]] Result<UnpackedText> unpack_text(std::string_view bytes, const std::string& file,
                                               std::size_t max_bytes = kMostLogBytes);

/// SHA-256 of the bytes as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::string_view bytes);

}  // namespace rave::recording
