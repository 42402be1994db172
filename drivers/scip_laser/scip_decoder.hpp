// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rave::scip {

/// One reply of the device with right checksums in all lines. Points into the decoder.
struct Reply {
  std::string_view echo;    ///< The command as sent, or with the number of remaining scans.
  std::string_view status;  ///< Two characters; one from a device in SCIP 1.1 mode.
  /// The data lines without checksums; for VV, PP and II also without the semicolon.
  std::vector<std::string_view> lines;
};

/// Extracts replies from the bytes of a device. A reply is: the echo of the command, a status, any
/// lines, and an empty line. Anything else is dropped up to the next empty line and counted.
///
/// A checksum has six bits. It detects every change of a single character, but misses one in 64 of
/// the changes of several characters of a line that remain in the valid range. Pure; no allocation
/// after the first few replies.
class ScipDecoder {
 public:
  /// The longest reply has 1440 ranges of 3 characters; a longer one is invalid.
  static constexpr std::size_t kMaxReply = 8192;
  static constexpr std::size_t kMaxLine = 160;

  struct Counts {
    std::uint64_t replies = 0;       ///< Replies returned.
    std::uint64_t bad_checksum = 0;  ///< Dropped: wrong checksum.
    std::uint64_t malformed = 0;  ///< Dropped: no status, or a line that is too short or too long.
  };

  ScipDecoder() { text_.reserve(kMaxReply + 1); }

  /// Adds one byte. Returns the reply that it completes, valid until the next call; null if none.
  [[nodiscard]] const Reply* push(char byte);
  /// Whether the next byte begins a reply.
  [[nodiscard]] bool between_replies() const noexcept {
    return given_out_ || (text_.empty() && !skipping_);
  }
  /// Discards a partial reply.
  void reset() noexcept;
  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }

 private:
  [[nodiscard]] const Reply* complete();
  [[nodiscard]] bool take_line(std::string_view line, bool semicolon);

  std::string text_;             // lines, with newlines, of the current reply
  std::size_t line_length_ = 0;  // length of the current line
  bool skipping_ = false;        // too long: ignore everything up to the next empty line
  bool given_out_ = false;       // text_ is a reply that was returned
  Reply reply_;
  Counts counts_;
};

}  // namespace rave::scip
