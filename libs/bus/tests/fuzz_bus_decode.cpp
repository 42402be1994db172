// SPDX-License-Identifier: Apache-2.0
// Bytes from the network as samples of every topic: the first byte chooses the topic and the byte
// order, the rest goes through the deserialiser and the validation, as in a reader.
#include <cstddef>
#include <cstdint>
#include <span>

#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"

namespace {

using namespace rave::bus;

template <class Message>
void receive(std::span<const std::byte> bytes, bool swapped) {
  testing::Decoded<Message> decoded;
  if (decoded.decode(bytes, swapped)) static_cast<void>(validate(decoded.sample()));
}

using Receive = void (*)(std::span<const std::byte>, bool);
constexpr Receive kTopics[] = {receive<HostState>, receive<World>,        receive<RosterEntry>,
                               receive<Obstacle>,  receive<Edit>,         receive<Command>,
                               receive<Packet>,    receive<HostInfo>,     receive<ClockPing>,
                               receive<ClockPong>, receive<HostReport>,   receive<WorldStep>,
                               receive<RunState>,  receive<ProcessState>, receive<FindingsPart>,
                               receive<Wish>,      receive<WishAnswer>};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  kTopics[(data[0] & 0x7fU) % std::size(kTopics)](bytes, (data[0] & 0x80U) != 0);
  return 0;
}
