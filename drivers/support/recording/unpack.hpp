// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::recording {

/// The text of a log file, and whether its gzip stream ended before its time.
struct UnpackedText {
  std::string text;
  /// True if the gzip stream broke off; `text` is what came before.
  bool cut = false;
};

/// Unpacks gzip (any number of members); bytes that do not start like gzip are taken as plain
/// text. `file` is for messages only. Errors (kParse): damaged data, a checksum or length that
/// does not match, bytes after the end of the stream, more than `max_bytes` of text.
[[nodiscard]] Result<UnpackedText> unpack_text(std::string_view bytes, const std::string& file,
                                               std::size_t max_bytes);

/// SHA-256 of the bytes as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::string_view bytes);

}  // namespace rave::recording
