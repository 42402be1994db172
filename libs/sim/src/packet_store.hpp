// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "rave/math/pose.hpp"
#include "rave/robot/message.hpp"

namespace rave::sim {

/// What a receiver must know of who sent a message, as it was when the message left.
struct PacketOrigin {
  Vec2 p_W;            ///< Reported position, if `located`.
  double range_m = 0;  ///< Of the sender's radio; 0: no limit.
  double antenna_z_m = 0;
  bool located = false;        ///< The sender has a reported pose.
  bool line_of_sight = false;  ///< The sender's radio asks for it.
};

/// One message between outbox and inboxes.
struct StoredPacket {
  MessageHead head;
  std::uint32_t endpoint = 0;    ///< Of the sender.
  std::uint32_t cost_bytes = 0;  ///< On the air, overhead included.
  std::int64_t queued_ns = 0;
  std::int64_t complete_ns = 0;    ///< When the last byte has left.
  std::uint64_t content_hash = 0;  ///< Of the bytes, for the run hash.
  PacketOrigin origin;             ///< Known once it has left.
  std::uint32_t users = 0;         ///< Deliveries and queues that still need it.
};

/// Keeps messages that are not delivered yet. Slots are reused, so that a run in steady state
/// allocates nothing.
class PacketStore {
 public:
  /// `slot_bytes`: the longest message.
  void begin(std::uint32_t slot_bytes) {
    slot_bytes_ = slot_bytes;
    packets_.clear();
    free_.clear();
    data_.clear();
  }

  /// Makes room for longer messages; views of bytes end.
  void widen(std::uint32_t slot_bytes) {
    if (slot_bytes <= slot_bytes_) return;
    std::vector<std::byte> data(packets_.size() * slot_bytes);
    for (std::size_t id = 0; id < packets_.size(); ++id) {
      if (slot_bytes_ == 0) break;
      std::memcpy(&data[id * slot_bytes], &data_[id * slot_bytes_], slot_bytes_);
    }
    data_ = std::move(data);
    slot_bytes_ = slot_bytes;
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
