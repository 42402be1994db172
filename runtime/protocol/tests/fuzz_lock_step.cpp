// SPDX-License-Identifier: Apache-2.0
// Bytes from the network as reports and worlds, all the way to what the engine and the authority
// are given: deserialiser, validation, and the reading of messages.
#include <cstddef>
#include <cstdint>
#include <span>

#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"
#include "rave/protocol/step_messages.hpp"

namespace {

using namespace rave;

void receive_report(std::span<const std::byte> bytes, bool swapped) {
  bus::testing::Decoded<bus::HostReport> decoded;
  if (!decoded.decode(bytes, swapped) || !bus::validate(decoded.sample())) return;
  sim::HostReport report;
  if (!lock_step::read(decoded.sample(), report)) return;
  // What was read can be sent again.
  lock_step::ReportMessage message;
  static_cast<void>(message.fill(report, 1, 2));
}

void receive_world(std::span<const std::byte> bytes, bool swapped) {
  bus::testing::Decoded<bus::WorldStep> decoded;
  if (!decoded.decode(bytes, swapped) || !bus::validate(decoded.sample())) return;
  sim::WorldStep world;
  sim::AuthorityState authority;
  if (!lock_step::read(decoded.sample(), world, authority)) return;
  lock_step::WorldMessage message;
  static_cast<void>(message.fill(world, authority, 1));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  const bool swapped = (data[0] & 0x80U) != 0;
  ((data[0] & 1U) != 0 ? receive_world : receive_report)(bytes, swapped);
  return 0;
}
