// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "create_oi/frame_times.hpp"
#include "create_oi/oi_code.hpp"
#include "create_oi/oi_decoder.hpp"
#include "rave/line/byte_line.hpp"

namespace rave::oi {

/// A session with a robot over an open line. For one thread; reads end when `wake` rings, which
/// must outlive the session.
class OiSession {
 public:
  OiSession(line::ByteLine line, const line::Wake* wake, std::vector<std::uint8_t> packets)
      : line_(std::move(line)),
        wake_(wake),
        decoder_(std::move(packets)),
        times_(kStreamPeriod_s) {}

  /// Opens the interface, sets the mode, stops the wheels and requests the stream. It also recovers
  /// a robot that still waits for the rest of an earlier host's command. Errors: kIo (the line is
  /// lost), kTimeout.
  [[nodiscard]] Status begin(Mode mode);
  /// Stops the wheels, ends the stream and sets passive mode, if the line permits.
  void end() noexcept;
  /// Sends a command. Errors: those of begin().
  [[nodiscard]] Status send(std::string_view command);

  struct Next {
    line::ReadEnd end = line::ReadEnd::kTimeout;  ///< kBytes: `frame` is set.
    const Frame* frame = nullptr;                 ///< Valid until the next call.
  };
  /// Reads the next valid frame.
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
  std::size_t used_ = 0;  // of these, passed to the decoder
  double came_s_ = 0;     // time of arrival of the bytes in room_
};

}  // namespace rave::oi
