// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "rave/line/clock_offset.hpp"
#include "rave/line/one_sender.hpp"
#include "udp_pose/pose_datagram.hpp"

namespace rave::udp_pose {

/// Statistics of the stream, for the report. A plain value.
struct StreamState {
  std::uint64_t samples = 0;        ///< Accepted.
  std::uint64_t refused = 0;        ///< Invalid datagrams.
  std::uint64_t other_bodies = 0;   ///< Datagrams of other bodies.
  std::uint64_t other_senders = 0;  ///< Poses of the body by another sender than the present one.
  std::uint64_t duplicates = 0;
  std::uint64_t out_of_order = 0;
  std::uint64_t late = 0;
  std::uint64_t early = 0;     ///< They seemed to arrive before they were sent.
  std::uint64_t lost = 0;      ///< Sequence numbers that never arrived, or arrived too late.
  std::uint64_t restarts = 0;  ///< Restarts of the sender, or of its clock when it was set.
  /// Dropped: a better clock estimate moved them before the previous one.
  std::uint64_t held_back = 0;
  double rate_hz = 0;         ///< Rate of accepted samples by the sender's clock.
  double clock_offset_s = 0;  ///< Host (its steady clock) minus sender, least delay included.
  double clock_drift_ppm = 0;
  double mean_delay_s = 0;  ///< Mean delay beyond the least one, of all samples in order.
  double max_delay_s = 0;
  std::string sender;   ///< Address of the present sender.
  std::string trouble;  ///< Why the last datagram was refused, or whose were; empty if none was.
};

/// Orders the samples of one body and estimates the sender's clock. Pure: reads no clock, opens no
/// socket. Not thread-safe.
class PoseStream {
 public:
  /// A sample counts as late if its delay exceeds the least delay by more than `max_delay_s`.
  /// Another sender takes the place of one that has been silent for `lost_after_s`.
  PoseStream(std::string body, double max_delay_s, double lost_after_s)
      : body_(std::move(body)), max_delay_s_(max_delay_s), lost_after_s_(lost_after_s) {}

  enum class Verdict {
    kAccepted,
    kRefused,
    kOtherBody,
    kOtherSender,
    kDuplicate,
    kOutOfOrder,
    kLate,
    kEarly
  };
  struct Taken {
    Verdict verdict = Verdict::kRefused;
    /// The sender began anew, or its clock was set: what was known of its clock does not count any
    /// more, so poses that are late from now on may look fresh.
    bool anew = false;
    /// Time at which the pose was true, in the host's clock, least delay included.
    double host_s = 0;
    std::string news;  ///< For users: there is a second sender, or another one than before.
  };
  /// Processes one datagram of `sender` that arrived at `host_s`. Sets `datagram` if it is
  /// accepted.
  Taken take(std::string_view bytes, std::string_view sender, double host_s,
             PoseDatagram& datagram);

  [[nodiscard]] const StreamState& state() const noexcept { return state_; }

 private:
  /// Whether a pose of this sender counts.
  [[nodiscard]] bool admit(std::string_view sender, double host_s, std::string& news);
  [[nodiscard]] Verdict order(const PoseDatagram& datagram);
  void keep(const PoseDatagram& datagram);
  void restart();

  std::string body_;
  double max_delay_s_;
  double lost_after_s_;
  line::OneSender<std::string> sender_;
  line::ClockOffset clock_;
  StreamState state_;
  bool any_ = false;
  bool anew_ = false;  // since the last accepted one
  double first_t_s_ = 0;
  double newest_t_s_ = 0;
  std::int64_t newest_seq_ = -1;
  std::uint64_t since_restart_ = 0;
  std::int32_t old_in_a_row_ = 0;
  double previous_old_t_s_ = 0;
  std::uint64_t ordered_ = 0;
  double sum_delay_s_ = 0;
};

}  // namespace rave::udp_pose
