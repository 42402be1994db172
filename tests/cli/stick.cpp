// SPDX-License-Identifier: Apache-2.0
// A stick at the direct line of a host, until it is killed or the line ends:
//
//     line_stick PORT HOST ROBOT RUN KEY USER
//
// KEY is the secret half of the key of tickets, so that it can make its own.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "page_key.hpp"
#include "rave/direct_line/key_files.hpp"
#include "rave/direct_line/line_server.hpp"
#include "rave/direct_line_testing/page_of_test.hpp"
#include "rave/web_testing/raw_client.hpp"
#include "signed_text.hpp"

namespace rave::direct_line {
namespace {

using web::testing::RawSocket;

/// As a page sends them.
constexpr std::chrono::milliseconds kAgain{33};

int drive(char** words) {
  const auto port = static_cast<std::uint16_t>(std::atoi(words[1]));
  const auto key = read_signing_key(words[5]);
  if (!key) return std::fputs(key.error().text().c_str(), stderr), 2;
  const testing::PageKey page;
  Ticket ticket;
  ticket.run = words[4];
  ticket.host = words[2];
  ticket.user = words[6];
  ticket.nonce = words[6];
  ticket.role = "commander";
  ticket.origin = "http://gui";
  ticket.orders.all = ticket.stops.all = true;
  ticket.page_key = page.point();
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  ticket.epoch = static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
  ticket.expires_s = std::chrono::duration_cast<std::chrono::seconds>(now).count() + 600;
  const std::string text = sign_ticket(ticket, *key);
  RawSocket socket(port, {}, "Origin: http://gui\r\n");
  const std::string first = socket.text_with("\"challenge\":");
  const std::string mark = "\"challenge\":\"";
  const std::size_t at = first.find(mark);
  if (at == std::string::npos) return 3;
  const std::size_t begin = at + mark.size();
  const std::string challenge = first.substr(begin, first.find('"', begin) - begin);
  const std::string address = "127.0.0.1:" + std::to_string(port);
  socket.send(R"({"type":"hello","ticket":")" + text + R"(","proof":")" +
              base64_of(page.sign(proof_text(challenge, address, text))) + "\"}");
  if (socket.text_with("\"welcome\"").empty()) return 4;
  // The answer to each says that the line is there; refused at first, while another has the lease.
  for (std::uint64_t id = 1;; ++id) {
    socket.send(R"({"type":"order","id":)" + std::to_string(id) + R"(,"kind":"drive","robot":")" +
                words[3] + R"(","v":0.3,"w":0.6,"echo":true})");
    if (socket.text_with("\"answer\"").empty()) return 0;
    std::this_thread::sleep_for(kAgain);
  }
}

}  // namespace
}  // namespace rave::direct_line

int main(int count, char** words) { return count == 7 ? rave::direct_line::drive(words) : 1; }
