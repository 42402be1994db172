// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "rave/base/token_bucket.hpp"

namespace rave::web {

/// Limits the rate of actions by name with token buckets: `burst` at once, then `per_s`. Memory is
/// bounded. One thread.
class RateLimit {
 public:
  using Clock = TokenBucket::Clock;
  RateLimit(double per_s, double burst) : per_s_(per_s), burst_(burst) {}

  /// Takes a token of `name`. False: there is none.
  [[nodiscard]] bool take(std::string_view name, Clock::time_point now);
  /// Whether `name` has a token.
  [[nodiscard]] bool has(std::string_view name, Clock::time_point now) const;
  [[nodiscard]] std::size_t size() const noexcept { return buckets_.size(); }

 private:
  void make_room(Clock::time_point now);

  double per_s_;
  double burst_;
  std::map<std::string, TokenBucket, std::less<>> buckets_;
};

/// The part of an address that identifies a subscriber: the whole IPv4 address, or the first 64
/// bits of an IPv6 address, since one machine may use any number of addresses below them. Text that
/// is not an address is returned unchanged.
[[nodiscard]] std::string network_of(const std::string& address);

/// Whether an address is a loopback address.
[[nodiscard]] bool is_loopback(const std::string& address);

}  // namespace rave::web
