// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

/// The messages between two doctors, as datagrams independent of the bus.
namespace rave::doctor {

inline constexpr std::size_t kLargestProbe = 65'000;

/// The data of a doctor about its machine and its configuration.
struct About {
  std::string machine;
  std::string version;
  std::uint64_t interface_stamp = 0;
  std::uint32_t domain = 0;
  std::string multicast;    ///< One of bus::kMulticastNames.
  std::string authority;    ///< Fingerprint of the certificate authority; empty: no certificates.
  std::string participant;  ///< Participant name on the bus; empty: not on the bus.
  /// Port at which it also listens, where a participant would; 0: none.
  std::uint16_t discovery_port = 0;
  std::uint16_t data_port = 0;   ///< Likewise.
  bool hears_multicast = false;  ///< It has joined the multicast group.
  friend bool operator==(const About&, const About&) = default;
};

struct Probe {
  enum class Kind : std::uint8_t {
    kAsk,     ///< Requests an answer of at most `want` bytes.
    kAnswer,  ///< Answers a kAsk; with `by_multicast`, one that came by multicast.
    kCall,    ///< Requests a kShout to the group.
    kShout,
  };
  Kind kind = Kind::kAsk;
  std::uint64_t number = 0;   ///< An answer has the number of its question.
  std::uint32_t want = 0;     ///< Requested bytes of the answer; 0: the minimum.
  std::uint32_t size = 0;     ///< kAnswer: size of the received question in bytes.
  bool by_multicast = false;  ///< kAnswer: the question came by multicast.
  std::int64_t sent_ns = 0;   ///< System clock of the sender, since 1970.
  std::int64_t asked_ns = 0;  ///< kAnswer: `sent_ns` of the question.
  /// kAnswer: time of reception of the question, system clock of the answering machine.
  std::int64_t received_ns = 0;
  About about;  ///< kAnswer.
  friend bool operator==(const Probe&, const Probe&) = default;
};

/// A probe as bytes: JSON, padded with spaces to `least` bytes (at most kLargestProbe).
[[nodiscard]] std::string write_probe(const Probe& probe, std::size_t least = 0);

/// The inverse of write_probe(); refuses everything else with error kParse.
[[nodiscard]] Result<Probe> parse_probe(std::string_view bytes);

}  // namespace rave::doctor
