// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

/// What one doctor says to another, in datagrams beside the bus.
namespace rave::doctor {

inline constexpr std::size_t kLargestProbe = 65'000;

/// What a doctor tells of its machine and of how it takes part.
struct About {
  std::string machine;
  std::string version;
  std::uint64_t interface_stamp = 0;
  std::uint32_t domain = 0;
  std::string multicast;  ///< off, discovery or on.
  std::string authority;  ///< Fingerprint of the authority of its certificates; empty: it has none.
  std::string participant;           ///< What it is called on the bus; empty: it is not on it.
  std::uint16_t discovery_port = 0;  ///< Of a participant, where it listens, too; 0: none.
  std::uint16_t data_port = 0;       ///< The same.
  bool hears_multicast = false;      ///< It takes part in the group.
  friend bool operator==(const About&, const About&) = default;
};

struct Probe {
  enum class Kind : std::uint8_t {
    kAsk,     ///< An answer is wanted, of `want` bytes at most.
    kAnswer,  ///< To a kAsk; or, with `by_multicast`, also to one that came so.
    kCall,    ///< A kShout to the group is wanted.
    kShout,
  };
  Kind kind = Kind::kAsk;
  std::uint64_t number = 0;      ///< An answer has that of its question.
  std::uint32_t want = 0;        ///< Bytes of the answer; 0: as short as it can be.
  std::uint32_t size = 0;        ///< kAnswer: of the question as it came, in bytes.
  bool by_multicast = false;     ///< kAnswer: the question came so.
  std::int64_t sent_ns = 0;      ///< Clock of day of the sender, since 1970.
  std::int64_t asked_ns = 0;     ///< kAnswer: `sent_ns` of the question.
  std::int64_t received_ns = 0;  ///< kAnswer: when it came, clock of day of the one who answers.
  About about;                   ///< kAnswer.
  friend bool operator==(const Probe&, const Probe&) = default;
};

/// A probe as bytes: JSON, with spaces behind it up to `least` bytes (at most kLargestProbe).
[[nodiscard]] std::string write_probe(const Probe& probe, std::size_t least = 0);

/// Reads back what write_probe() wrote; anything else is refused: error kParse.
[[nodiscard]] Result<Probe> parse_probe(std::string_view bytes);

}  // namespace rave::doctor
