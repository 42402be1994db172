// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "page_key.hpp"
#include "rave/direct_line/key_files.hpp"
#include "rave/direct_line/line_server.hpp"
#include "rave/direct_line_testing/page_of_test.hpp"
#include "rave/web_testing/raw_client.hpp"
#include "signed_text.hpp"

namespace rave::cli_test {

/// Whose direct line it is, and who comes with a ticket of which key.
struct LineGuest {
  std::uint16_t port = 0;
  std::string run;
  std::string host;
  std::string user;
  direct_line::SigningKey key;
};

/// Says hello as the page of a commander who may order and stop all robots; false: not let in.
inline bool say_hello(web::testing::RawSocket& socket, const LineGuest& guest) {
  const direct_line::testing::PageKey page;
  direct_line::Ticket ticket;
  ticket.run = guest.run;
  ticket.host = guest.host;
  ticket.user = ticket.nonce = guest.user;
  ticket.role = "commander";
  ticket.origin = "http://gui";
  ticket.orders.all = ticket.stops.all = true;
  ticket.page_key = page.point();
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  ticket.epoch = static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
  ticket.expires_s = std::chrono::duration_cast<std::chrono::seconds>(now).count() + 600;
  const std::string text = direct_line::sign_ticket(ticket, guest.key);
  const std::string first = socket.text_with("\"challenge\":");
  const std::string mark = "\"challenge\":\"";
  const std::size_t at = first.find(mark);
  if (at == std::string::npos) return false;
  const std::size_t begin = at + mark.size();
  const std::string challenge = first.substr(begin, first.find('"', begin) - begin);
  const std::string address = "127.0.0.1:" + std::to_string(guest.port);
  const std::string proof = direct_line::proof_text(challenge, address, text);
  socket.send(R"({"type":"hello","ticket":")" + text + R"(","proof":")" +
              direct_line::base64_of(page.sign(proof)) + "\"}");
  return !socket.text_with("\"welcome\"").empty();
}

}  // namespace rave::cli_test
