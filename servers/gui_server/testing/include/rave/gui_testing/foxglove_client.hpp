// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "rave/web_testing/raw_client.hpp"

namespace rave::gui_server::testing {

using web::testing::RawClient;
using web::testing::RawSocket;

/// A client of the Foxglove WebSocket protocol, as far as tests need one.
class FoxgloveClient {
 public:
  using Json = nlohmann::ordered_json;

  /// `target`: path and query. `headers`: further ones, each with its end of line.
  FoxgloveClient(std::uint16_t port, const std::filesystem::path& authority,
                 const std::string& target, const std::string& headers = {},
                 std::string_view protocols = "foxglove.websocket.v1")
      : socket_(port, authority, headers + fmt::format("Sec-WebSocket-Protocol: {}\r\n", protocols),
                target) {}

  [[nodiscard]] RawSocket& socket() noexcept { return socket_; }
  [[nodiscard]] std::string status() const {
    return socket_.answer().size() < 12 ? socket_.answer() : socket_.answer().substr(9, 3);
  }
  /// The next text message with that op; null: the connection ended, or none came for too long.
  [[nodiscard]] Json next(std::string_view op) {
    const auto limit = Clock::now() + kPatience;
    while (Clock::now() < limit) {
      const auto frame = socket_.next();
      if (!frame) return nullptr;
      Json message = take(*frame);
      if (message.is_object() && message.at("op") == op) return message;
    }
    return nullptr;
  }
  /// Waits until a topic is advertised and subscribes to it. False: the connection ended.
  [[nodiscard]] bool subscribe(const std::string& topic, std::uint32_t id) {
    while (!channels.contains(topic)) {
      if (next("advertise").is_null()) return false;
    }
    socket_.send(fmt::format(R"({{"op":"subscribe","subscriptions":[{{"id":{},"channelId":{}}}]}})",
                             id, channels.at(topic)));
    return true;
  }
  /// The next message of a subscription that was not looked at yet; null: the connection ended, or
  /// none came for too long.
  [[nodiscard]] Json data(std::uint32_t subscription) {
    const auto limit = Clock::now() + kPatience;
    auto& waiting = data_[subscription];
    while (waiting.empty()) {
      const auto frame = Clock::now() < limit ? socket_.next() : std::nullopt;
      if (!frame) return nullptr;
      static_cast<void>(take(*frame));
    }
    auto [time, message] = std::move(waiting.front());
    waiting.pop_front();
    time_ns = time;
    return message;
  }

  std::map<std::string, std::uint32_t> channels;  ///< By topic, as advertised now.
  std::uint64_t time_ns = 0;                      ///< Of the last message.
  std::uint64_t clock_ns = 0;                     ///< As the server told it last.

 private:
  static std::uint64_t number(const std::string& bytes, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) {
      value = value * 256 + static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
  }
  /// Keeps what was advertised, and data; returns a text message, or null.
  Json take(const RawSocket::Frame& frame) {
    if (frame.opcode == 2 && frame.payload.size() >= 13 && frame.payload[0] == 1) {
      data_[static_cast<std::uint32_t>(number(frame.payload, 1, 4))].emplace_back(
          number(frame.payload, 5, 8), Json::parse(frame.payload.substr(13), nullptr, false));
    }
    if (frame.opcode == 2 && frame.payload.size() == 9 && frame.payload[0] == 2) {
      clock_ns = number(frame.payload, 1, 8);
    }
    if (frame.opcode != 1) return nullptr;
    Json message = Json::parse(frame.payload, nullptr, false);
    if (!message.is_object()) return nullptr;
    if (message.at("op") == "advertise") {
      for (const Json& channel : message.at("channels")) {
        channels[channel.at("topic")] = channel.at("id").get<std::uint32_t>();
      }
    } else if (message.at("op") == "unadvertise") {
      for (const Json& id : message.at("channelIds")) {
        std::erase_if(channels, [&id](const auto& entry) { return entry.second == id; });
      }
    }
    return message;
  }

  using Clock = std::chrono::steady_clock;
  static constexpr auto kPatience = std::chrono::seconds(30);

  RawSocket socket_;
  std::map<std::uint32_t, std::deque<std::pair<std::uint64_t, Json>>> data_;  ///< By subscription.
};

}  // namespace rave::gui_server::testing
