// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/bus/topics.hpp"
#include "rave/bus_testing/cdr.hpp"

namespace rave::bus::testing {

/// The same for messages of the bus.
template <class Message>
class Decoded : public DecodedAs<Message> {
 public:
  Decoded() : DecodedAs<Message>(*topic_of<Message>().type) {}
};

template <class Message>
[[nodiscard]] std::vector<std::byte> encode(const Message& sample) {
  return encode_as(*topic_of<Message>().type, sample);
}

}  // namespace rave::bus::testing
