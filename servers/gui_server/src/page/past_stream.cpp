// SPDX-License-Identifier: Apache-2.0
#include "page/past_stream.hpp"

#include <algorithm>

#include "page/frames.hpp"

namespace rave::gui_server {

PastStream::PastStream(std::unique_ptr<Cursor> cursor, double now_s, Wanted wanted)
    : cursor_(std::move(cursor)),
      next_s_(std::max(0.0, now_s - kPast_s)),
      until_s_(now_s - kPastSpacing_s / 2),
      wanted_(std::move(wanted)) {}

bool PastStream::send(std::size_t bytes, std::chrono::nanoseconds time, std::uint32_t& sequence,
                      const Send& send) {
  const auto begin = std::chrono::steady_clock::now();
  std::size_t sent = 0;
  while (next_s_ < until_s_) {
    if (sent >= bytes || std::chrono::steady_clock::now() - begin > time) return true;
    const double t_s = next_s_;
    next_s_ += kPastSpacing_s;
    if (!cursor_->go_to(t_s)) return false;
    if (wanted_.poses) sent += send_poses(t_s, sequence, send);
    if (!wanted_.readings.empty()) sent += send_readings(send);
  }
  return false;
}

std::size_t PastStream::send_poses(double t_s, std::uint32_t& sequence, const Send& send) const {
  const PosesAt& poses = cursor_->poses();
  // A time before the first that is kept gives a later moment, which has a turn of its own.
  if (poses.robots.empty() || poses.time_s > t_s + kPastSpacing_s) return 0;
  PoseFrameHead head;
  head.sequence = ++sequence;
  head.past = true;
  std::string frame = encode_poses(poses, head);
  const std::size_t bytes = frame.size();
  send(std::move(frame));
  return bytes;
}

std::size_t PastStream::send_readings(const Send& send) {
  std::size_t bytes = 0;
  for (const ReadingAt& reading : cursor_->readings(wanted_.readings, wanted_.parts)) {
    const LookedAt sensor{reading.slot, reading.sensor};
    double& told_s = told_.try_emplace({sensor, reading.part}, -1).first->second;
    if (told_s == reading.stamp_s) continue;
    told_s = reading.stamp_s;
    std::string frame = encode_reading(reading, cursor_->poses().time_s, true);
    bytes += frame.size();
    send(std::move(frame));
  }
  return bytes;
}

}  // namespace rave::gui_server
