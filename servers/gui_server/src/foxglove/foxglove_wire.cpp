// SPDX-License-Identifier: Apache-2.0
#include "foxglove/foxglove_wire.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "rave/base/json_text.hpp"

namespace rave::gui_server {
namespace {

// The messages of the Foxglove WebSocket protocol, version 1
// (docs/explanation/foxglove-protocol.md). Texts are JSON; binary messages begin with an opcode and
// are little-endian.
using FoxgloveJson = nlohmann::ordered_json;

std::string foxglove_text(const FoxgloveJson& message) { return json_text(message); }

template <class Number>
void add_little_endian(std::string& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    bytes += static_cast<char>((number >> (8U * i)) & 0xffU);
  }
}

}  // namespace

std::string foxglove_server_info(std::string_view name, std::string_view session) {
  return foxglove_text({{"op", "serverInfo"},
                        {"name", name},
                        // Only `time`: without `clientPublish` and `parameters` a client has
                        // nothing to send but subscriptions.
                        {"capabilities", FoxgloveJson::array({"time"})},
                        {"metadata", FoxgloveJson::object()},
                        {"sessionId", session}});
}

std::string foxglove_advertise(std::span<const FoxgloveChannel> channels) {
  FoxgloveJson message = {{"op", "advertise"}, {"channels", FoxgloveJson::array()}};
  for (const FoxgloveChannel& channel : channels) {
    message["channels"].push_back({{"id", channel.id},
                                   {"topic", channel.topic},
                                   {"encoding", "json"},
                                   {"schemaName", channel.schema_name},
                                   {"schema", channel.schema},
                                   {"schemaEncoding", "jsonschema"}});
  }
  return foxglove_text(message);
}

std::string foxglove_unadvertise(std::span<const FoxgloveChannel> channels) {
  FoxgloveJson message = {{"op", "unadvertise"}, {"channelIds", FoxgloveJson::array()}};
  for (const FoxgloveChannel& channel : channels) message["channelIds"].push_back(channel.id);
  return foxglove_text(message);
}

std::string foxglove_status(FoxgloveLevel level, std::string_view text) {
  return foxglove_text(
      {{"op", "status"}, {"level", static_cast<int>(level)}, {"message", std::string(text)}});
}

std::string foxglove_data(std::uint32_t subscription, std::uint64_t time_ns,
                          std::string_view message) {
  std::string bytes;
  // Opcode 1 (message data), subscription (4 bytes), time (8 bytes), payload.
  bytes.reserve(13 + message.size());
  bytes += '\x01';
  add_little_endian(bytes, subscription);
  add_little_endian(bytes, time_ns);
  return bytes.append(message);
}

std::string foxglove_time(std::uint64_t time_ns) {
  // Opcode 2 (time).
  std::string bytes(1, '\x02');
  add_little_endian(bytes, time_ns);
  return bytes;
}

std::uint64_t foxglove_ns(double time_s) {
  // Times are unsigned in the protocol.
  return time_s > 0 ? static_cast<std::uint64_t>(std::llround(time_s * 1e9)) : 0;
}

}  // namespace rave::gui_server
