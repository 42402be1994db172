// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace rave::web {

/// How often somebody may do something: `burst` at once, then `per_s`. One bucket of tokens for
/// each name; what it takes in memory is bounded. One thread.
class RateLimit {
 public:
  using Clock = std::chrono::steady_clock;
  RateLimit(double per_s, double burst) : per_s_(per_s), burst_(burst) {}

  /// Takes a token. False: there is none.
  [[nodiscard]] bool take(std::string_view name, Clock::time_point now);
  /// Whether there is one, without taking it.
  [[nodiscard]] bool has(std::string_view name, Clock::time_point now) const;
  [[nodiscard]] std::size_t size() const noexcept { return buckets_.size(); }

 private:
  struct Bucket {
    double tokens = 0;
    Clock::time_point at{};
  };
  [[nodiscard]] double tokens_of(const Bucket& bucket, Clock::time_point now) const;
  void make_room(Clock::time_point now);

  double per_s_;
  double burst_;
  std::map<std::string, Bucket, std::less<>> buckets_;
};

/// What of an address stands for one subscriber: an address of IPv4, and of IPv6 the first 64 bits,
/// within which one machine may take as many as it likes. An address that is none as it is.
[[nodiscard]] std::string network_of(const std::string& address);

/// Whether an address is of this machine alone.
[[nodiscard]] bool is_loopback(const std::string& address);

}  // namespace rave::web
