// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "rave/robot/transmitter.hpp"

namespace rave::sim {

/// Where the device of one transmitter puts what it hears, until the next step takes it. The sink
/// may be used from any one thread of the driver, all else belongs to the engine's.
class RadioPort final : public PacketSink {
 public:
  explicit RadioPort(std::uint32_t max_packet_bytes);

  void receive(const std::byte* packet, std::uint64_t size) noexcept override;
  void fail(const char* text, std::uint64_t size) noexcept override;
  void recover() noexcept override;

  /// Takes the oldest packet; valid until the next call. False: there is none.
  bool next(std::span<const std::byte>& packet);
  /// Packets that were lost because they were not taken, or because they were too long.
  struct Overruns {
    std::uint64_t count = 0;
    std::uint32_t sender = 0;  ///< Hash of the name of the sender that sent too many; 0: unknown.
  };
  /// Those since the last call.
  [[nodiscard]] Overruns take_overruns();
  /// Why the device is gone; empty if it works.
  [[nodiscard]] std::string failure() const;
  void clear();

 private:
  static constexpr std::size_t kDepth = 256;
  struct Slot {
    std::size_t size = 0;
    std::uint32_t sender = 0;
    std::vector<std::byte> bytes;
  };
  /// Who has how many packets in the queue, or has lost how many.
  struct Share {
    std::uint32_t sender = 0;
    std::uint64_t count = 0;
  };

  void drop_one();

  mutable std::mutex mutex_;  // guards all but taken_
  std::vector<Slot> slots_;
  std::vector<std::uint16_t> queue_;  ///< Slots in use, oldest first.
  std::vector<std::uint16_t> free_;   ///< The others.
  std::vector<Share> held_;           ///< By sender, none with 0.
  std::vector<Share> lost_;           ///< By sender; those beyond kDepth of them are not named.
  std::uint64_t overruns_ = 0;
  std::string failure_;
  Slot taken_;
};

/// Knows which packets of a sender have come: those of a window of 64 behind the newest, one bit
/// each; older ones count as repeated.
class RepeatFilter {
 public:
  /// True if the packet is new; notes it.
  bool accept(std::uint32_t sender, std::uint32_t channel, std::uint32_t boot,
              std::uint32_t sequence);
  void clear() { heard_.clear(); }

 private:
  static constexpr std::size_t kMaxSenders = 4096;
  struct Heard {
    std::uint32_t boot = 0;
    std::uint32_t newest = 0;
    std::uint64_t before = 0;  ///< Bit k: newest - k has come.
  };
  std::map<std::uint64_t, Heard> heard_;
};

}  // namespace rave::sim
