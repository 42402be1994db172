// SPDX-License-Identifier: Apache-2.0
#include "mocap_station.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace peer {

MocapStation::MocapStation(const Arguments& given, const std::string& prefix, OwnClock clock)
    : body_(given.text(prefix + "body", "robot")),
      period_ns_(std::llround(1e9 / given.number(prefix + "rate-hz", 100))),
      noise_m_(given.number(prefix + "noise-m", 0)),
      delay_s_(given.number(prefix + "delay-s", 0)),
      jitter_s_(given.number(prefix + "jitter-s", 0)),
      loss_(given.number(prefix + "loss", 0)),
      twice_(given.number(prefix + "twice", 0)),
      clock_(clock),
      log_(given.text(prefix + "log", "")),
      socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  to_.sin_family = AF_INET;
  to_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  to_.sin_port = htons(static_cast<std::uint16_t>(given.number(prefix + "port", 0)));
}

MocapStation::~MocapStation() { ::close(socket_); }

void MocapStation::send(const std::string& text) {
  (void)::sendto(socket_, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&to_),
                 sizeof to_);
}

void MocapStation::send_due() {
  while (due_ns() <= true_ns()) {
    send(waiting_.top().text);
    waiting_.pop();
  }
}

std::int64_t MocapStation::due_ns() const {
  return waiting_.empty() ? std::numeric_limits<std::int64_t>::max() : waiting_.top().at_ns;
}

void MocapStation::restart() {
  clock_.restart();
  count_ = 0;
}

void MocapStation::set_lag(double growth, double most_s) {
  lag_growth_ = growth;
  lag_most_s_ = most_s;
}

void MocapStation::sample(std::int64_t at_ns, double true_x, double true_y, double yaw,
                          std::mt19937_64& random) {
  std::normal_distribution<double> noise(0, 1);
  std::exponential_distribution<double> jitter(1);
  std::uniform_real_distribution<double> chance(0, 1);
  constexpr double kFar_m = 500;
  const double x = true_x + noise_m_ * noise(random) + (far_left_ > 0 ? kFar_m : 0);
  far_left_ = std::max(0, far_left_ - 1);
  if (turn_every_ > 0 && count_ % turn_every_ == 0) yaw += M_PI;
  lag_s_ = std::min(lag_s_ + lag_growth_ * static_cast<double>(period_ns_) * 1e-9, lag_most_s_);
  const double y = true_y + noise_m_ * noise(random);
  char text[320];
  std::snprintf(text, sizeof text,
                "{\"body\":\"%s\",\"seq\":%lld,\"t\":%.9f,\"x\":%.9f,\"y\":%.9f,\"yaw\":%.9f,"
                "\"cov\":[%.9g,%.9g,%.9g]}",
                body_.c_str(), static_cast<long long>(++count_), clock_.seconds_at(at_ns), x, y,
                yaw, noise_m_ * noise_m_, noise_m_ * noise_m_, 1e-6);
  const std::int64_t leaves =
      at_ns + std::llround((delay_s_ + lag_s_ + jitter_s_ * jitter(random)) * 1e9);
  const bool lost = chance(random) < loss_ || mute_;
  char entry[200];
  std::snprintf(entry, sizeof entry, "%lld %lld %lld %.9f %.9f %.9f %s",
                static_cast<long long>(count_), static_cast<long long>(at_ns),
                static_cast<long long>(leaves), x, y, yaw, lost ? "lost" : "sent");
  log_.write(entry);
  if (lost) return;
  waiting_.push({leaves, text});
  if (chance(random) < twice_) waiting_.push({leaves + period_ns_ / 2, text});
}

}  // namespace peer
