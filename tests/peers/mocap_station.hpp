// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <netinet/in.h>

#include <cstdint>
#include <queue>
#include <random>
#include <string>

#include "arguments.hpp"
#include "console.hpp"
#include "own_clock.hpp"

namespace peer {

/// A motion capture that sends the pose of one body as UDP JSON: its own clock, delay, losses.
class MocapStation {
 public:
  /// Options, each behind `prefix`: port, body, rate-hz, noise-m, delay-s, jitter-s, loss, twice,
  /// log.
  MocapStation(const Arguments& given, const std::string& prefix, OwnClock clock);
  MocapStation(const MocapStation&) = delete;
  MocapStation& operator=(const MocapStation&) = delete;
  ~MocapStation();

  /// The true pose at a moment of CLOCK_MONOTONIC, in the frame of the motion capture.
  void sample(std::int64_t at_ns, double x, double y, double yaw, std::mt19937_64& random);
  /// Sends what is due.
  void send_due();
  /// When the next datagram leaves; a large number if none waits.
  [[nodiscard]] std::int64_t due_ns() const;
  [[nodiscard]] std::int64_t period_ns() const { return period_ns_; }

  /// Any text, as a datagram.
  void send(const std::string& text);
  void set_mute(bool mute) { mute_ = mute; }
  void set_delay(double delay_s) { delay_s_ = delay_s; }
  /// From now on each pose comes later than the one before, as from a queue that fills up: by
  /// `growth` seconds a second, up to `most_s`.
  void set_lag(double growth, double most_s);
  /// Turns every `nth` heading by 180 degrees; 0: none.
  void turn_every(int nth) { turn_every_ = nth; }
  /// Puts the next poses 500 m away.
  void send_far(int count) { far_left_ = count; }
  /// A new program in the place of the old: clock and count begin anew.
  void restart();

 private:
  struct Datagram {
    std::int64_t at_ns = 0;
    std::string text;
    bool operator>(const Datagram& other) const { return at_ns > other.at_ns; }
  };

  std::string body_;
  std::int64_t period_ns_;
  double noise_m_;
  double delay_s_;
  double jitter_s_;
  double loss_;
  double twice_;
  OwnClock clock_;
  Log log_;
  int socket_ = -1;
  sockaddr_in to_{};
  std::priority_queue<Datagram, std::vector<Datagram>, std::greater<>> waiting_;
  bool mute_ = false;
  double lag_growth_ = 0;
  double lag_most_s_ = 0;
  double lag_s_ = 0;
  int turn_every_ = 0;
  int far_left_ = 0;
  std::int64_t count_ = 0;
};

}  // namespace peer
