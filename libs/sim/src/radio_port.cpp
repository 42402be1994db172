// SPDX-License-Identifier: Apache-2.0
#include "radio_port.hpp"

#include <cstring>
#include <utility>

namespace rave::sim {

RadioPort::RadioPort(std::uint32_t max_packet_bytes) : slots_(kDepth) {
  for (Slot& slot : slots_) slot.bytes.resize(max_packet_bytes);
  taken_.bytes.resize(max_packet_bytes);
}

void RadioPort::receive(const std::byte* packet, std::uint64_t size) noexcept {
  const std::lock_guard lock(mutex_);
  if (size > slots_[0].bytes.size()) {
    ++overruns_;
    return;
  }
  if (count_ == kDepth) {
    first_ = (first_ + 1) % kDepth;
    --count_;
    ++overruns_;
  }
  Slot& slot = slots_[(first_ + count_++) % kDepth];
  slot.size = size;
  if (size > 0) std::memcpy(slot.bytes.data(), packet, size);
}

void RadioPort::fail(const char* text, std::uint64_t size) noexcept {
  const std::lock_guard lock(mutex_);
  failure_.assign(text, size);
  if (failure_.empty()) failure_ = "the device is gone";
}

void RadioPort::recover() noexcept {
  const std::lock_guard lock(mutex_);
  failure_.clear();
}

bool RadioPort::next(std::span<const std::byte>& packet) {
  const std::lock_guard lock(mutex_);
  if (count_ == 0) return false;
  std::swap(taken_, slots_[first_]);
  first_ = (first_ + 1) % kDepth;
  --count_;
  packet = std::span(taken_.bytes).first(taken_.size);
  return true;
}

std::uint64_t RadioPort::take_overruns() {
  const std::lock_guard lock(mutex_);
  return std::exchange(overruns_, 0);
}

std::string RadioPort::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void RadioPort::clear() {
  const std::lock_guard lock(mutex_);
  first_ = count_ = 0;
  overruns_ = 0;
  failure_.clear();
}

bool RepeatFilter::accept(std::uint32_t sender, std::uint32_t channel, std::uint32_t boot,
                          std::uint32_t sequence) {
  // Anybody may send, so what is remembered is bounded.
  if (heard_.size() >= kMaxSenders) heard_.clear();
  const auto [it, first] = heard_.try_emplace((std::uint64_t{sender} << 32U) | channel);
  Heard& heard = it->second;
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
