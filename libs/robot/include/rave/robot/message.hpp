// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "rave/base/time.hpp"

namespace rave {

/// The kind of receivers of a message.
enum class RecipientKind : std::uint32_t {
  kEveryone = 0,  ///< All robots in range with a communicator of the same name.
  kRobot = 1,     ///< One robot.
  kTeam = 2,      ///< The robots of the sender's team; none if it has no team.
};

/// The address of a message.
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

/// Precedes the bytes of a message in a mailbox. No padding: its bytes are part of the run hash.
struct MessageHead {
  /// Simulation time when the program sent it. For a message from another host, which has another
  /// clock: the time when it was received.
  std::int64_t stamp_ns = 0;
  /// RobotId of the sender, set by the host. Senders outside of the scenario get numbers from the
  /// number of robots on, in the order in which they are first heard.
  std::uint32_t from = 0;
  /// Number of the message at its communicator, from 1; set by the host.
  std::uint32_t sequence = 0;
  Recipient to;
  std::uint32_t offset = 0;  ///< Offset of its bytes in Mailbox::data.
  std::uint32_t size = 0;    ///< Bytes.
};
static_assert(sizeof(MessageHead) == 32);

/// The messages of one communicator of one robot in one step and one direction; memory of the host.
struct Mailbox {
  MessageHead* heads = nullptr;
  std::byte* data = nullptr;
  std::uint32_t max_messages = 0;
  std::uint32_t max_bytes = 0;  ///< Limit for all messages together.
  std::uint32_t count = 0;
  std::uint32_t bytes = 0;
  /// Incoming: messages lost since the last decision because the mailbox was full. Outgoing:
  /// messages that put() refused.
  std::uint32_t dropped = 0;
  std::uint32_t reserved = 0;

  /// Adds a message. Returns false and counts it in `dropped` if there is no room.
  bool put(const MessageHead& head, std::span<const std::byte> text) noexcept;
  void clear() noexcept { count = bytes = dropped = 0; }
  [[nodiscard]] std::span<const std::byte> bytes_of(const MessageHead& head) const noexcept {
    return {data + head.offset, head.size};
  }
};

/// Both directions of one communicator of one robot.
struct CommunicatorView {
  const Mailbox* in = nullptr;  ///< Messages that arrived since the last decision.
  Mailbox* out = nullptr;
};

/// A communicator for its program; fixed when the run starts.
struct CommunicatorInfo {
  const char* name = "";
  std::uint32_t max_messages = 0;       ///< Per decision and direction.
  std::uint32_t max_bytes = 0;          ///< Per decision and direction.
  std::uint32_t max_message_bytes = 0;  ///< Larger messages are refused.
  std::uint32_t reserved = 0;
};

}  // namespace rave
