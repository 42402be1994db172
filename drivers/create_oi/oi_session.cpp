// SPDX-License-Identifier: Apache-2.0
#include "create_oi/oi_session.hpp"

namespace rave::oi {
namespace {

using line::ReadEnd;

/// Commands are short: a line that blocks for this long is stuck.
constexpr line::Wait kSend{100};

/// The largest number of data bytes (of a song) that the robot may still expect from an interrupted
/// command. Zeros fill it; surplus zeros are ignored, because 0 is not a command.
constexpr std::size_t kFill = 34;

}  // namespace

Status OiSession::send(std::string_view command) {
  // Not interrupted by the bell: a command is sent completely or not at all.
  return line_.write(command, kSend, nullptr);
}

Status OiSession::begin(Mode mode) {
  decoder_.reset();
  times_.reset();
  RAVE_TRY(send(std::string(kFill, '\0')));
  RAVE_TRY(send(start_command()));
  RAVE_TRY(send(pause_stream_command()));
  RAVE_TRY(send(mode_command(mode)));
  RAVE_TRY(send(drive_direct_command(0, 0)));
  const auto packets = decoder_.packets();
  return send(stream_command(packets));
}

void OiSession::end() noexcept {
  (void)send(drive_direct_command(0, 0) + pause_stream_command() + start_command());
}

OiSession::Next OiSession::next(line::HostTime limit) {
  while (true) {
    while (used_ < have_) {
      const Frame* const frame = decoder_.push(static_cast<std::uint8_t>(room_[used_++]), came_s_);
      if (frame != nullptr) return {ReadEnd::kBytes, frame};
    }
    used_ = 0;
    have_ = 0;
    const auto got = line_.read(room_, line::until(limit), wake_);
    if (got.end != ReadEnd::kBytes) return {got.end, nullptr};
    came_s_ = line::host_seconds(line::host_now());
    have_ = got.size;
  }
}

}  // namespace rave::oi
