// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <netinet/in.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::doctor {

/// An IPv4 address and a port.
struct Place {
  std::string address;
  std::uint16_t port = 0;
};

[[nodiscard]] std::optional<::sockaddr_in> address_of(const Place& place);
[[nodiscard]] Place place_of(const ::sockaddr_in& address);

/// A UDP socket. Owner: one thread.
class Socket {
 public:
  /// Bound to a port of an address; port 0: any. `shared`: others that share as well may have the
  /// port, too. Errors: kIo with what the system says, kState if the port is taken.
  [[nodiscard]] static Result<Socket> bind(const Place& place, bool shared = false);
  Socket(Socket&& other) noexcept;
  Socket& operator=(Socket&&) = delete;
  ~Socket();

  /// From here on only this place is heard, and what it refuses is an error of receive(). Error
  /// kIo.
  [[nodiscard]] Status connect(const Place& place);
  /// Takes part in a multicast group through the interface of that address, and sends to groups
  /// through it, to itself as well. Error kIo.
  [[nodiscard]] Status join(const char* group, const std::string& interface_address);

  /// Error kIo: what the system says, such as `Network is unreachable`.
  [[nodiscard]] Status send(std::string_view bytes, const Place& to) const;
  [[nodiscard]] Status send(std::string_view bytes) const;  ///< After connect().

  struct Received {
    std::size_t size = 0;
    Place from;
  };
  /// Waits for a datagram for that long; nothing if none comes. Errors, after connect(): kNotFound
  /// (nobody listens at the port), kIo (such as `No route to host`).
  [[nodiscard]] Result<std::optional<Received>> receive(std::span<char> into, int wait_ms) const;

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  [[nodiscard]] std::uint16_t port() const;

 private:
  explicit Socket(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace rave::doctor
