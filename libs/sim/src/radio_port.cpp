// SPDX-License-Identifier: Apache-2.0
// The queue between the thread of a device and the engine. It has a fixed size, and a sender that
// floods loses its own packets and not those of others.
#include "radio_port.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "rave/robot/radio_sender.hpp"

namespace rave::sim {
namespace {

template <class Shares>
auto share_of(Shares& shares, std::uint32_t sender) {
  return std::find_if(shares.begin(), shares.end(),
                      [&](const auto& share) { return share.sender == sender; });
}

template <class Shares>
void count_one(Shares& shares, std::uint32_t sender) {
  const auto found = share_of(shares, sender);
  if (found != shares.end()) {
    ++found->count;
  } else {
    shares.push_back({sender, 1});
  }
}

template <class Shares>
void uncount_one(Shares& shares, std::uint32_t sender) {
  const auto found = share_of(shares, sender);
  if (--found->count == 0) shares.erase(found);
}

}  // namespace

RadioPort::RadioPort(std::uint32_t max_packet_bytes) : slots_(kDepth) {
  for (Slot& slot : slots_) slot.bytes.resize(max_packet_bytes);
  taken_.bytes.resize(max_packet_bytes);
  queue_.reserve(kDepth);
  free_.reserve(kDepth);
  held_.reserve(kDepth);
  lost_.reserve(kDepth);
  clear();
}

void RadioPort::receive(const std::byte* packet, std::uint64_t size) noexcept {
  const std::lock_guard lock(mutex_);
  const std::uint32_t sender = radio_sender({packet, size});
  if (size > slots_[0].bytes.size()) {
    ++overruns_;
    return;
  }
  // The thread of the driver never waits for the engine; what is too much is dropped.
  if (free_.empty()) drop_one();
  Slot& slot = slots_[free_.back()];
  slot.size = size;
  slot.sender = sender;
  if (size > 0) std::memcpy(slot.bytes.data(), packet, size);
  queue_.push_back(free_.back());
  free_.pop_back();
  count_one(held_, sender);
}

/// The oldest of the sender that has most in the queue: a flooding sender displaces its own
/// messages.
void RadioPort::drop_one() {
  const auto most = std::max_element(
      held_.begin(), held_.end(), [](const auto& a, const auto& b) { return a.count < b.count; });
  const std::uint32_t sender = most->sender;
  const auto oldest = std::find_if(queue_.begin(), queue_.end(), [&](std::uint16_t slot) {
    return slots_[slot].sender == sender;
  });
  free_.push_back(*oldest);
  queue_.erase(oldest);
  uncount_one(held_, sender);
  ++overruns_;
  if (lost_.size() < kDepth) count_one(lost_, sender);
}

void RadioPort::fail(const char* text, std::uint64_t size) noexcept {
  const std::lock_guard lock(mutex_);
  failure_.assign(text, size);
  if (failure_.empty()) failure_ = "the device is lost";
}

void RadioPort::recover() noexcept {
  const std::lock_guard lock(mutex_);
  failure_.clear();
}

bool RadioPort::next(std::span<const std::byte>& packet) {
  const std::lock_guard lock(mutex_);
  if (queue_.empty()) return false;
  const std::uint16_t oldest = queue_.front();
  queue_.erase(queue_.begin());
  free_.push_back(oldest);
  uncount_one(held_, slots_[oldest].sender);
  // Swapped out, so that the caller can read the bytes without the lock until its next call.
  std::swap(taken_, slots_[oldest]);
  packet = std::span(taken_.bytes).first(taken_.size);
  return true;
}

RadioPort::Overruns RadioPort::take_overruns() {
  const std::lock_guard lock(mutex_);
  Overruns taken{std::exchange(overruns_, 0), 0};
  std::uint64_t most = 0;
  for (const Share& share : lost_) {
    if (share.sender == 0 || share.count <= most) continue;
    taken.sender = share.sender;
    most = share.count;
  }
  lost_.clear();
  return taken;
}

std::string RadioPort::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void RadioPort::clear() {
  const std::lock_guard lock(mutex_);
  queue_.clear();
  free_.resize(kDepth);
  std::iota(free_.begin(), free_.end(), std::uint16_t{0});
  held_.clear();
  lost_.clear();
  overruns_ = 0;
  failure_.clear();
}

// The window of the last 64 sequence numbers of each sender, one bit each, as in the protection of
// IPsec against replay (RFC 4303, section 3.4.3). Radios may repeat packets and change their order.
bool RepeatFilter::accept(std::uint32_t sender, std::uint32_t channel, std::uint32_t boot,
                          std::uint32_t sequence) {
  // Anybody may send, so what is remembered is bounded.
  if (heard_.size() >= kMaxSenders) heard_.clear();
  const auto [it, first] = heard_.try_emplace((std::uint64_t{sender} << 32U) | channel);
  Heard& heard = it->second;
  // A sender that was started again counts from the beginning.
  if (first || heard.boot != boot) {
    heard = {boot, sequence, 1};
    return true;
  }
  const std::uint32_t ahead = sequence - heard.newest;  // modulo 2^32
  if (ahead != 0 && ahead < 0x8000'0000U) {
    heard.before = ahead < 64 ? (heard.before << ahead) | 1U : 1U;
    heard.newest = sequence;
    return true;
  }
  const std::uint32_t behind = heard.newest - sequence;
  if (behind >= 64 || (heard.before >> behind & 1U) != 0) return false;
  heard.before |= std::uint64_t{1} << behind;
  return true;
}

}  // namespace rave::sim
