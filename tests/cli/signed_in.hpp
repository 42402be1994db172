// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "rave/web_testing/raw_client.hpp"

namespace rave::cli_test {

/// A person who came in by the link that a process with a page printed.
class SignedIn {
 public:
  /// `said`: what it printed, with the link.
  explicit SignedIn(const std::string& said) {
    const std::string begin = "http://127.0.0.1:";
    const std::string place = said.substr(said.find(begin) + begin.size());
    port_ = static_cast<std::uint16_t>(std::stoi(place));
    const std::string target =
        place.substr(place.find('/'), place.find_first_of(" \n") - place.find('/'));
    web::testing::RawClient client(port_, {});
    client.send(fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n\r\n",
                            target, port_));
    const std::string answer = client.read_all();
    const std::size_t at = answer.find("Set-Cookie: ");
    EXPECT_NE(at, std::string::npos) << answer;
    if (at != std::string::npos) {
      cookie_ = answer.substr(at + 12, answer.find(';', at) - at - 12);
    }
  }
  /// Whether a process has printed its link.
  [[nodiscard]] static bool is_in(const std::string& said) {
    return said.find("/enter") != std::string::npos;
  }

  [[nodiscard]] web::testing::RawSocket page() const {
    return {
        port_, {}, fmt::format("Cookie: {}\r\nOrigin: http://127.0.0.1:{}\r\n", cookie_, port_)};
  }

 private:
  std::uint16_t port_ = 0;
  std::string cookie_;
};

}  // namespace rave::cli_test
