// SPDX-License-Identifier: Apache-2.0
#include "udp_pose/pose_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rave::udp_pose {
namespace {

/// This many old samples in a row, each newer than the one before, mean that the sender was
/// restarted: a network does not delay that many and then deliver them in order.
constexpr std::int32_t kRestartAfter = 10;
/// A larger gap in the sequence means that the sender was silent or numbers differently, not that
/// samples were lost.
constexpr std::int64_t kLargestLoss = 1'000'000;

}  // namespace

void PoseStream::restart() {
  ++state_.restarts;
  anew_ = true;
  any_ = false;
  newest_seq_ = -1;
  since_restart_ = 0;
  old_in_a_row_ = 0;
}

bool PoseStream::admit(std::string_view sender, double host_s, std::string& news) {
  const std::string before = sender_.present().value_or("");
  // Simple senders open a socket for each datagram, which then has a port of its own.
  const bool gives_way = sender_.heard_once();
  const auto verdict = sender_.take(std::string(sender), host_s, lost_after_s_, gives_way);
  if (verdict.counts) state_.sender = sender;
  if (verdict.changed && !gives_way) {
    news = fmt::format("the poses of `{}` come from {} now; {} has been silent for {} s", body_,
                       sender, before, lost_after_s_);
    restart();
  }
  if (verdict.counts) return true;
  ++state_.other_senders;
  if (verdict.new_rival) {
    news = fmt::format("two senders of poses of `{}`, {} and {}: only the first counts", body_,
                       before, sender);
    state_.trouble = news;
  }
  return false;
}

PoseStream::Verdict PoseStream::order(const PoseDatagram& datagram) {
  if (any_ && datagram.t_s <= newest_t_s_) {
    if (datagram.t_s == newest_t_s_) return Verdict::kDuplicate;
    // Old samples that are in order among themselves come from one sender with another clock;
    // delayed ones would arrive mixed.
    const bool rising = old_in_a_row_ == 0 || datagram.t_s > previous_old_t_s_;
    old_in_a_row_ = rising ? old_in_a_row_ + 1 : 0;
    previous_old_t_s_ = datagram.t_s;
    if (old_in_a_row_ < kRestartAfter) return Verdict::kOutOfOrder;
    clock_.reset();
    restart();
  }
  return Verdict::kAccepted;
}

void PoseStream::keep(const PoseDatagram& datagram) {
  old_in_a_row_ = 0;
  if (datagram.seq && newest_seq_ >= 0) {
    const std::int64_t missing = *datagram.seq - newest_seq_ - 1;
    if (missing > 0 && missing < kLargestLoss) state_.lost += static_cast<std::uint64_t>(missing);
  }
  if (datagram.seq) newest_seq_ = *datagram.seq;
  if (!any_) first_t_s_ = datagram.t_s;
  any_ = true;
  newest_t_s_ = datagram.t_s;
}

PoseStream::Taken PoseStream::take(std::string_view bytes, std::string_view sender, double host_s,
                                   PoseDatagram& datagram) {
  auto parsed = parse_datagram(bytes);
  if (!parsed) {
    ++state_.refused;
    state_.trouble = parsed.error().message;
    return {Verdict::kRefused, false, 0, ""};
  }
  if (parsed->body != body_) {
    ++state_.other_bodies;
    return {Verdict::kOtherBody, false, 0, ""};
  }
  std::string news;
  if (!admit(sender, host_s, news)) return {Verdict::kOtherSender, false, 0, std::move(news)};
  const Verdict verdict = order(*parsed);
  if (verdict != Verdict::kAccepted) {
    ++(verdict == Verdict::kDuplicate ? state_.duplicates : state_.out_of_order);
    return {verdict, false, 0, std::move(news)};
  }
  const auto sample = clock_.add(parsed->t_s, host_s);
  if (sample == line::ClockOffset::Sample::kEarly) {
    ++state_.early;
    return {Verdict::kEarly, false, 0, std::move(news)};
  }
  if (sample == line::ClockOffset::Sample::kSet) restart();
  keep(*parsed);
  datagram = std::move(*parsed);
  const double true_s = datagram.t_s + clock_.offset_s(datagram.t_s);
  const double delay_s = host_s - true_s;
  sum_delay_s_ += delay_s;
  state_.mean_delay_s = sum_delay_s_ / static_cast<double>(++ordered_);
  state_.max_delay_s = std::max(state_.max_delay_s, delay_s);
  state_.clock_offset_s = clock_.offset_s();
  state_.clock_drift_ppm = clock_.drift_ppm();
  // Late samples still count for the clock and the order above; only the program does not get them.
  if (delay_s > max_delay_s_) {
    ++state_.late;
    return {Verdict::kLate, false, true_s, std::move(news)};
  }
  ++state_.samples;
  if (++since_restart_ > 1 && newest_t_s_ > first_t_s_) {
    state_.rate_hz = static_cast<double>(since_restart_ - 1) / (newest_t_s_ - first_t_s_);
  }
  return {Verdict::kAccepted, std::exchange(anew_, false), true_s, std::move(news)};
}

}  // namespace rave::udp_pose
