// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <netinet/in.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "rave/base/descriptor.hpp"
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
  /// Binds a socket to a port of an address; port 0: any. `shared`: other shared sockets may have
  /// the same port. Errors: kIo with the message of the system, kState if the port is taken.
  [[nodiscard]] static Result<Socket> bind(const Place& place, bool shared = false);

  /// Restricts the socket to one remote address. Messages that it refuses become errors of
  /// receive(). Error kIo.
  [[nodiscard]] Status connect(const Place& place);
  /// Joins a multicast group through the interface with that address. Messages to groups leave
  /// through it and return to this machine as well. Error kIo.
  [[nodiscard]] Status join(const char* group, const std::string& interface_address);

  /// Error kIo with the message of the system, such as `Network is unreachable`.
  [[nodiscard]] Status send(std::string_view bytes, const Place& to) const;
  [[nodiscard]] Status send(std::string_view bytes) const;  ///< After connect().

  struct Received {
    std::size_t size = 0;
    Place from;
  };
  /// Waits for a datagram; empty if none arrives in time. Errors, after connect(): kNotFound (no
  /// process listens at the port), kIo (such as `No route to host`).
  [[nodiscard]] Result<std::optional<Received>> receive(std::span<char> into, int wait_ms) const;

  [[nodiscard]] int descriptor() const noexcept { return descriptor_.get(); }
  [[nodiscard]] std::uint16_t port() const;

 private:
  explicit Socket(int descriptor) : descriptor_(descriptor) {}
  Descriptor descriptor_;
};

}  // namespace rave::doctor
