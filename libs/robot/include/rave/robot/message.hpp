// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "rave/base/time.hpp"

namespace rave {

/// Whom a message is for.
enum class RecipientKind : std::uint32_t {
  kEveryone = 0,  ///< All whose communicator of the same name is in reach.
  kRobot = 1,     ///< One robot.
  kTeam = 2,      ///< Those of the sender's team; nobody if it has none.
};

/// The address on a message.
struct Recipient {
  RecipientKind kind = RecipientKind::kEveryone;
  std::uint32_t robot = std::numeric_limits<std::uint32_t>::max();  ///< RobotId, for kRobot.

  [[nodiscard]] static constexpr Recipient everyone() noexcept { return {}; }
  [[nodiscard]] static constexpr Recipient team() noexcept { return {RecipientKind::kTeam}; }
  [[nodiscard]] static constexpr Recipient one(std::uint32_t robot) noexcept {
    return {RecipientKind::kRobot, robot};
  }
  friend constexpr bool operator==(const Recipient&, const Recipient&) noexcept = default;
};

/// Stands before the bytes of one message, on its way out and in. No padding: its bits are part of
/// the run hash.
struct MessageHead {
  /// When the program sent it, simulation time; of a message from another host, whose clock is
  /// another, when it was heard.
  std::int64_t stamp_ns = 0;
  /// RobotId of the sender; filled by the host. Senders that are no robots of the scenario are
  /// numbered from the count of robots on, as they are first heard.
  std::uint32_t from = 0;
  std::uint32_t sequence = 0;  ///< Counts the messages of that communicator from 1; by the host.
  Recipient to;
  std::uint32_t offset = 0;  ///< Of its bytes in the mailbox's data.
  std::uint32_t size = 0;    ///< Bytes.
};
static_assert(sizeof(MessageHead) == 32);

/// Messages of one communicator of one robot in one step, one direction; memory of the host.
struct Mailbox {
  MessageHead* heads = nullptr;
  std::byte* data = nullptr;
  std::uint32_t max_messages = 0;
  std::uint32_t max_bytes = 0;  ///< Of all messages together.
  std::uint32_t count = 0;
  std::uint32_t bytes = 0;
  /// In: lost since the last decision for want of room here. Out: refused by put().
  std::uint32_t dropped = 0;
  std::uint32_t reserved = 0;

  /// Adds a message; false, counted in `dropped`, if there is no room.
  bool put(const MessageHead& head, std::span<const std::byte> text) noexcept;
  void clear() noexcept { count = bytes = dropped = 0; }
  [[nodiscard]] std::span<const std::byte> bytes_of(const MessageHead& head) const noexcept {
    return {data + head.offset, head.size};
  }
};

/// Both directions of one communicator of one robot.
struct CommunicatorView {
  const Mailbox* in = nullptr;  ///< Arrived since the last decision.
  Mailbox* out = nullptr;
};

/// A communicator as the program sees it; fixed when the run starts.
struct CommunicatorInfo {
  const char* name = "";
  std::uint32_t max_messages = 0;       ///< Per decision, each direction.
  std::uint32_t max_bytes = 0;          ///< Per decision, each direction.
  std::uint32_t max_message_bytes = 0;  ///< Of one message; a larger one is refused.
  std::uint32_t reserved = 0;
};

}  // namespace rave
