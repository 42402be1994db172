// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rave::scip {

/// One answer of the device whose every line bore the right checksum. Points into the decoder.
struct Reply {
  std::string_view echo;    ///< The command as it was sent, or with the scans that are left.
  std::string_view status;  ///< Two characters; one from a device that still speaks SCIP 1.1.
  /// What follows, without checksums; of VV, PP and II also without the semicolon.
  std::vector<std::string_view> lines;
};

/// Cuts the bytes of a device into replies. A reply is: the echo of the command, a status, any
/// lines, and an empty line. What does not fit is dropped up to the next empty line and counted.
///
/// A checksum has six bits. It finds every change of a single character, but one in 64 of those
/// that change several characters of one line and leave them in the code's range.
/// Pure; takes no memory after the first few replies.
class ScipDecoder {
 public:
  /// The longest reply is that of 1440 ranges of 3 characters; more is garbage.
  static constexpr std::size_t kMaxReply = 8192;
  static constexpr std::size_t kMaxLine = 160;

  struct Counts {
    std::uint64_t replies = 0;       ///< Given out.
    std::uint64_t bad_checksum = 0;  ///< Dropped: a line's checksum is wrong.
    std::uint64_t malformed = 0;     ///< Dropped: no status, a line too short or too long.
  };

  ScipDecoder() { text_.reserve(kMaxReply + 1); }

  /// Takes one byte. The reply that it completes, valid until the next call; null if none.
  [[nodiscard]] const Reply* push(char byte);
  /// Whether the next byte would be the first of a reply.
  [[nodiscard]] bool between_replies() const noexcept {
    return given_out_ || (text_.empty() && !skipping_);
  }
  /// Forgets what has begun.
  void reset() noexcept;
  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }

 private:
  [[nodiscard]] const Reply* complete();
  [[nodiscard]] bool take_line(std::string_view line, bool semicolon);

  std::string text_;             // lines with their ends, of the reply that is coming in
  std::size_t line_length_ = 0;  // of the line that is coming in
  bool skipping_ = false;        // too long: nothing counts before the next empty line
  bool given_out_ = false;       // the text is that of a reply that was given out
  Reply reply_;
  Counts counts_;
};

}  // namespace rave::scip
