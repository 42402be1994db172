// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <type_traits>
#include <vector>

#include "rave/bus/local_transport.hpp"
#include "rave/bus/request_parts.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"

/// Bytes from the network as samples of every topic: the first byte chooses the topic (bits 0 to 6)
/// and the byte order (bit 7). The rest goes through the deserialiser and the validation, as in a
/// reader, or is a datagram of the local transport, whose head and bounds are checked first.
namespace rave::bus::testing {

template <class Message>
bool receive(std::span<const std::byte> bytes, bool swapped) {
  Decoded<Message> decoded;
  if (!decoded.decode(bytes, swapped) || !validate(decoded.sample())) return false;
  if constexpr (std::is_same_v<Message, RequestAnswer>) {
    static_cast<void>(AnswerParts().add(text_of(decoded.sample().text)));
  }
  return true;
}

/// Twice, the second time into the memory of the first.
template <class Message>
bool receive_local(std::span<const std::byte> bytes, bool /*swapped*/) {
  LocalDecoder decoder(topic_of<Message>());
  bool valid = false;
  for (int i = 0; i < 2; ++i) {
    // Aligned as the receiver's memory is, and not a byte longer than it must be.
    std::vector<std::byte> datagram(bytes.begin(), bytes.end());
    const void* const sample = decoder.decode(datagram);
    valid = sample != nullptr && validate(*static_cast<const Message*>(sample));
  }
  return valid;
}

using Receive = bool (*)(std::span<const std::byte>, bool);
inline constexpr Receive kTopics[] = {receive<HostState>,
                                      receive<World>,
                                      receive<RosterEntry>,
                                      receive<Obstacle>,
                                      receive<Command>,
                                      receive<Packet>,
                                      receive<HostInfo>,
                                      receive<ClockPing>,
                                      receive<ClockPong>,
                                      receive<HostReport>,
                                      receive<WorldStep>,
                                      receive<RunState>,
                                      receive<ProcessState>,
                                      receive<HostResultsPart>,
                                      receive<Request>,
                                      receive<RequestAnswer>,
                                      receive_local<HostReport>,
                                      receive_local<WorldStep>,
                                      receive<LineInfo>,
                                      receive<LineWithdrawal>,
                                      receive<Look>,
                                      receive<Readings>,
                                      receive<RunEvents>,
                                      receive<MapTile>,
                                      receive<CommandAnswer>};

/// Whether the bytes, which are not empty, are a valid sample.
inline bool receive_any(std::span<const std::byte> bytes) {
  const auto first = std::to_integer<unsigned>(bytes[0]);
  return kTopics[(first & 0x7fU) % std::size(kTopics)](bytes.subspan(1), (first & 0x80U) != 0);
}

}  // namespace rave::bus::testing
