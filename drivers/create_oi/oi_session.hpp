// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "create_oi/frame_times.hpp"
#include "create_oi/oi_code.hpp"
#include "create_oi/oi_decoder.hpp"
#include "line/byte_line.hpp"

namespace rave::oi {

/// A conversation with a robot over an open line. For one thread; reads end when `wake` rings,
/// which must outlive the session.
class OiSession {
 public:
  OiSession(line::ByteLine line, const line::Wake* wake, std::vector<std::uint8_t> packets)
      : line_(std::move(line)),
        wake_(wake),
        decoder_(std::move(packets)),
        times_(kStreamPeriod_s) {}

  /// Opens the interface, chooses the mode, stands still, and asks for the stream. A robot that is
  /// in the middle of a command of a former host is brought to order by it.
  /// Errors: kIo (the line is gone), kTimeout.
  [[nodiscard]] Status begin(Mode mode);
  /// Stands still, ends the stream, and leaves the robot in passive mode, as far as the line
  /// allows.
  void end() noexcept;
  /// Sends a command. Errors: as begin().
  [[nodiscard]] Status send(std::string_view command);

  struct Next {
    line::ReadEnd end = line::ReadEnd::kTimeout;  ///< kBytes: `frame` is there.
    const Frame* frame = nullptr;                 ///< Valid until the next call.
  };
  /// The next good frame.
  [[nodiscard]] Next next(line::HostTime limit);

  [[nodiscard]] const std::string& lost() const noexcept { return line_.lost(); }
  [[nodiscard]] const StreamDecoder::Counts& counts() const noexcept { return decoder_.counts(); }
  [[nodiscard]] FrameTimes& times() noexcept { return times_; }
  [[nodiscard]] const FrameTimes& times() const noexcept { return times_; }
  [[nodiscard]] std::size_t frame_size() const noexcept { return decoder_.frame_size(); }

 private:
  line::ByteLine line_;
  const line::Wake* wake_;
  StreamDecoder decoder_;
  FrameTimes times_;
  std::array<char, 1024> room_{};
  std::size_t have_ = 0;  // bytes in room_
  std::size_t used_ = 0;  // of them, those the decoder has had
  double came_s_ = 0;     // the bytes in room_
};

}  // namespace rave::oi
