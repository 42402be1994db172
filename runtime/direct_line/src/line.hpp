// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "rave/direct_line/ticket.hpp"
#include "rave/web/server.hpp"

namespace rave::direct_line {

/// One page at the other end. Until it has shown a ticket it may say nothing else.
struct Line {
  using Clock = std::chrono::steady_clock;

  web::Socket* socket = nullptr;
  std::string peer;
  std::string address;  ///< That the page has dialled.
  std::string origin;   ///< Of the page, as the browser says.
  std::string challenge;
  Clock::time_point since{};
  std::optional<Ticket> ticket{};
  bool closing = false;
  unsigned nonsense = 0;
  std::string told_state{};
  std::set<std::string, std::less<>> ordered{};  ///< Robots whose lease the page may have.

  /// For the log: `anna (192.168.1.7)`.
  [[nodiscard]] std::string who() const {
    return ticket ? ticket->user + " (" + peer + ")" : "somebody (" + peer + ")";
  }
  void send(std::string text) const {
    socket->send_text(std::make_shared<const std::string>(std::move(text)));
  }
};

}  // namespace rave::direct_line
