// SPDX-License-Identifier: Apache-2.0
// Limits by network, in token buckets.
#include "rave/web/rate_limit.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace rave::web {
namespace {

constexpr std::size_t kMostNames = 10'000;

/// The prefix of an IPv4 address in IPv6, as seen by a listener on `::`.
constexpr std::string_view kMapped = "::ffff:";

}  // namespace

bool RateLimit::take(std::string_view name, Clock::time_point now) {
  auto found = buckets_.find(name);
  if (found == buckets_.end()) {
    make_room(now);
    found = buckets_.emplace(std::string(name), TokenBucket(per_s_, burst_)).first;
  }
  return found->second.take(now);
}

bool RateLimit::has(std::string_view name, Clock::time_point now) const {
  const auto found = buckets_.find(name);
  return found == buckets_.end() || found->second.tokens(now) >= 1;
}

void RateLimit::make_room(Clock::time_point now) {
  if (buckets_.size() < kMostNames) return;
  std::erase_if(buckets_, [&](const auto& entry) { return entry.second.tokens(now) >= burst_; });
  // This many names at once are an attack; forgetting one of them does not help it.
  if (buckets_.size() >= kMostNames) buckets_.erase(buckets_.begin());
}

std::string network_of(const std::string& address) {
  if (address.starts_with(kMapped)) return address.substr(kMapped.size());
  std::array<unsigned char, 16> bytes{};
  if (inet_pton(AF_INET6, address.substr(0, address.find('%')).c_str(), bytes.data()) != 1) {
    return address;
  }
  // A customer of a provider has at least a /64 of IPv6, so limits by address would have no effect.
  std::fill(bytes.begin() + 8, bytes.end(), static_cast<unsigned char>(0));
  std::array<char, INET6_ADDRSTRLEN> text{};
  inet_ntop(AF_INET6, bytes.data(), text.data(), text.size());
  return std::string(text.data()) + "/64";
}

bool is_loopback(const std::string& address) {
  const std::string plain = address.starts_with(kMapped) ? address.substr(kMapped.size()) : address;
  return plain.starts_with("127.") || plain == "::1";
}

}  // namespace rave::web
