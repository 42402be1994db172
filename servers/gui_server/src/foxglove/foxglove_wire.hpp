// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

// What the server says in the WebSocket protocol of Foxglove: text messages, and two binary ones
// (little endian). Plain functions; moments are nanoseconds of the run.
namespace rave::gui_server {

/// One stream of messages, which a client may subscribe to.
struct FoxgloveChannel {
  std::uint32_t id = 0;
  std::string topic;
  std::string schema_name;
  std::string schema;  ///< JSON Schema; messages are JSON.
};

enum class FoxgloveLevel : std::uint8_t { kInfo, kWarning, kError };

/// `session`: another one whenever the server is another one.
[[nodiscard]] std::string foxglove_server_info(std::string_view name, std::string_view session);
[[nodiscard]] std::string foxglove_advertise(std::span<const FoxgloveChannel> channels);
[[nodiscard]] std::string foxglove_unadvertise(std::span<const FoxgloveChannel> channels);
[[nodiscard]] std::string foxglove_status(FoxgloveLevel level, std::string_view text);

/// A message of a channel, for one subscription: 0x01, its id (u32), the moment (u64), the message.
[[nodiscard]] std::string foxglove_data(std::uint32_t subscription, std::uint64_t time_ns,
                                        std::string_view message);
/// Where the clock of the run stands: 0x02, the moment (u64).
[[nodiscard]] std::string foxglove_time(std::uint64_t time_ns);

/// Nanoseconds of a moment in seconds; of one before the run began 0.
[[nodiscard]] std::uint64_t foxglove_ns(double time_s);

}  // namespace rave::gui_server
