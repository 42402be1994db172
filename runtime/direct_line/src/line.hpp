// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <set>
#include <string>

#include "rave/direct_line/ticket.hpp"
#include "rave/web/server.hpp"

namespace rave::direct_line {

/// The connection to one page. Until the page has shown a ticket, other messages are refused.
struct Line {
  using Clock = std::chrono::steady_clock;

  web::Socket* socket = nullptr;
  std::string peer;
  std::string address;  ///< The address that the page connected to.
  std::string origin;   ///< The origin of the page, as reported by the browser.
  std::string challenge;
  Clock::time_point since{};
  std::optional<Ticket> ticket{};
  bool closing = false;
  unsigned nonsense = 0;
  std::string told_state{};
  std::set<std::string, std::less<>> ordered{};  ///< Robots whose lease the page may have.

  /// The name for the log: `anna (192.168.1.7)`.
  [[nodiscard]] std::string who() const {
    return ticket ? ticket->user + " (" + peer + ")" : "somebody (" + peer + ")";
  }
  void send(std::string text) const {
    socket->send_text(std::make_shared<const std::string>(std::move(text)));
  }
};

}  // namespace rave::direct_line
