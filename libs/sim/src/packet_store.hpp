// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "rave/robot/message.hpp"

namespace rave::sim {

/// One message between outbox and inboxes.
struct StoredPacket {
  MessageHead head;
  std::uint32_t endpoint = 0;    ///< Of the sender.
  std::uint32_t cost_bytes = 0;  ///< On the air, overhead included.
  std::int64_t queued_ns = 0;
  std::int64_t complete_ns = 0;    ///< When the last byte has left.
  std::uint64_t content_hash = 0;  ///< Of the bytes, for the run hash.
  std::uint32_t users = 0;         ///< Deliveries and queues that still need it.
};

/// Keeps messages under way. Slots are used again, so that a run in its swing allocates nothing.
class PacketStore {
 public:
  /// `slot_bytes`: the longest message.
  void begin(std::uint32_t slot_bytes) {
    slot_bytes_ = slot_bytes;
    packets_.clear();
    free_.clear();
    data_.clear();
  }

  /// A new packet with one user.
  std::uint32_t add(const StoredPacket& packet, std::span<const std::byte> bytes) {
    if (free_.empty()) {
      free_.push_back(static_cast<std::uint32_t>(packets_.size()));
      packets_.emplace_back();
      data_.resize(data_.size() + slot_bytes_);
    }
    const std::uint32_t id = free_.back();
    free_.pop_back();
    packets_[id] = packet;
    packets_[id].users = 1;
    if (!bytes.empty()) std::memcpy(&data_[first_byte(id)], bytes.data(), bytes.size());
    return id;
  }
  void use(std::uint32_t id) noexcept { ++packets_[id].users; }
  void release(std::uint32_t id) {
    if (--packets_[id].users == 0) free_.push_back(id);
  }

  [[nodiscard]] StoredPacket& operator[](std::uint32_t id) noexcept { return packets_[id]; }
  [[nodiscard]] const StoredPacket& operator[](std::uint32_t id) const noexcept {
    return packets_[id];
  }
  [[nodiscard]] std::span<const std::byte> bytes_of(std::uint32_t id) const noexcept {
    return std::span(data_).subspan(first_byte(id), packets_[id].head.size);
  }

 private:
  [[nodiscard]] std::size_t first_byte(std::uint32_t id) const noexcept {
    return std::size_t{id} * slot_bytes_;
  }

  std::uint32_t slot_bytes_ = 0;
  std::vector<StoredPacket> packets_;
  std::vector<std::byte> data_;
  std::vector<std::uint32_t> free_;
};

}  // namespace rave::sim
