// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rave/robot/program.hpp"

namespace rave::isolation {

/// The header at offset 0 of the shared memory.
struct SharedHead {
  static constexpr std::uint64_t kMagic = 0x314f534945564152ULL;  // "RAVEISO1", little endian
  std::uint64_t magic = kMagic;
  std::uint64_t total_bytes = 0;
  std::uint64_t setup_bytes = 0;
};

/// The members of a DecideItem that are not pointers.
struct SharedDecide {
  std::int64_t now_ns = 0;
  PoseReading pose;
  std::uint32_t decision = 0;
  std::uint32_t robot = 0;
  std::uint64_t seed = 0;
};

/// The orders of people as bytes; see order_bytes.hpp.
struct SharedOrders {
  std::uint32_t count = 0;
  std::uint32_t bytes = 0;
  std::uint32_t driven = 0;
  std::uint32_t listens = 0;  ///< Not 0 if answers are accepted.
};
/// The space for the orders of one decision: a path, texts, and the names of the authors.
inline constexpr std::size_t kOrderBytes = 32'768;

/// The answers of a program to people in one decision: this header, then size and text of each
/// answer.
struct SharedAnswers {
  std::uint32_t count = 0;
  std::uint32_t bytes = 0;
};
inline constexpr std::size_t kAnswerBytes = 8'192;

/// The members of a Mailbox that are neither pointers nor limits.
struct SharedMailbox {
  std::uint32_t count = 0;
  std::uint32_t bytes = 0;
  std::uint32_t dropped = 0;
  std::uint32_t reserved = 0;
};

/// The offsets in the memory that host and child share. They depend only on the setup, so both
/// sides compute them and the host never relies on a number that the child could change.
struct Layout {
  struct Sensor {
    std::size_t header = 0;   ///< Offset of the SampleHeader.
    std::size_t records = 0;  ///< Offset of the records.
    std::uint32_t capacity = 0;
    std::uint32_t record_bytes = 0;
  };

  /// One direction of a communicator.
  struct Box {
    std::size_t state = 0;  ///< Offset of the SharedMailbox.
    std::size_t heads = 0;  ///< Offset of the MessageHeads.
    std::size_t data = 0;   ///< Offset of the messages' bytes.
    std::uint32_t max_messages = 0;
    std::uint32_t max_bytes = 0;
    std::uint32_t max_message_bytes = 0;
  };
  struct Communicator {
    Box in;
    Box out;
  };

  std::size_t setup = 0;
  std::size_t decide = 0;
  std::vector<Sensor> sensors;
  std::vector<Communicator> communicators;
  std::size_t orders = 0;   ///< Offset of the SharedOrders; their bytes follow.
  std::size_t answers = 0;  ///< Offset of the SharedAnswers; their bytes follow.
  std::size_t state = 0;    ///< Offset of the number of Commands::state().
  std::size_t commands = 0;
  std::size_t command_count = 0;
  std::size_t total_bytes = 0;
};

[[nodiscard]] Layout make_layout(std::size_t setup_bytes, std::span<const SensorInfo> sensors,
                                 std::span<const CommunicatorInfo> communicators,
                                 std::size_t command_count);

}  // namespace rave::isolation
