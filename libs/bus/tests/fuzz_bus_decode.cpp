// SPDX-License-Identifier: Apache-2.0
// Bytes from the network as samples of every topic: the first byte chooses the topic and the byte
// order, the rest goes through the deserialiser and the validation, as in a reader; or as datagrams
// of the local transport, where heads and bounds are looked at first.
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "rave/bus/local_transport.hpp"
#include "rave/bus/request_parts.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"

namespace {

using namespace rave::bus;

template <class Message>
void receive(std::span<const std::byte> bytes, bool swapped) {
  testing::Decoded<Message> decoded;
  if (!decoded.decode(bytes, swapped) || !validate(decoded.sample())) return;
  if constexpr (std::is_same_v<Message, RequestAnswer>) {
    static_cast<void>(AnswerParts().add(text_of(decoded.sample().text)));
  }
}

/// Twice, the second time into the memory of the first.
template <class Message>
void receive_local(std::span<const std::byte> bytes, bool /*swapped*/) {
  LocalDecoder decoder(topic_of<Message>());
  for (int i = 0; i < 2; ++i) {
    // Aligned as the receiver's memory is, and not a byte longer than it must be.
    std::vector<std::byte> datagram(bytes.begin(), bytes.end());
    const void* const sample = decoder.decode(datagram);
    if (sample != nullptr) static_cast<void>(validate(*static_cast<const Message*>(sample)));
  }
}

using Receive = void (*)(std::span<const std::byte>, bool);
constexpr Receive kTopics[] = {receive<HostState>,
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  kTopics[(data[0] & 0x7fU) % std::size(kTopics)](bytes, (data[0] & 0x80U) != 0);
  return 0;
}
