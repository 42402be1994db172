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

#include "line_hello.hpp"

namespace rave::cli_test {
namespace {

/// As a page sends them.
constexpr std::chrono::milliseconds kAgain{33};

int drive(char** words) {
  const auto port = static_cast<std::uint16_t>(std::atoi(words[1]));
  const auto key = direct_line::read_signing_key(words[5]);
  if (!key) return std::fputs(key.error().text().c_str(), stderr), 2;
  web::testing::RawSocket socket(port, {}, "Origin: http://gui\r\n");
  if (!say_hello(socket, {port, words[4], words[2], words[6], *key})) return 3;
  // The answer to each says that the line is there; refused at first, while another has the lease.
  for (std::uint64_t id = 1;; ++id) {
    socket.send(R"({"type":"order","id":)" + std::to_string(id) + R"(,"kind":"drive","robot":")" +
                words[3] + R"(","v":0.3,"w":0.6,"echo":true})");
    if (socket.text_with("\"answer\"").empty()) return 0;
    std::this_thread::sleep_for(kAgain);
  }
}

}  // namespace
}  // namespace rave::cli_test

int main(int count, char** words) { return count == 7 ? rave::cli_test::drive(words) : 1; }
