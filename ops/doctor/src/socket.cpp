// SPDX-License-Identifier: Apache-2.0
#include "socket.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace rave::doctor {
namespace {

tl::unexpected<Error> failed(const char* what) {
  // Two reasons matter to callers: the port is taken, or the other machine answers that nothing
  // listens there. The rest is one kind.
  const ErrorCode code = errno == EADDRINUSE     ? ErrorCode::kState
                         : errno == ECONNREFUSED ? ErrorCode::kNotFound
                                                 : ErrorCode::kIo;
  return fail(code, "{}: {}", what, std::strerror(errno));
}

const ::sockaddr* general(const ::sockaddr_in& address) {
  return reinterpret_cast<const ::sockaddr*>(&address);
}

}  // namespace

std::optional<::sockaddr_in> address_of(const Place& place) {
  ::sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = ::htons(place.port);
  if (::inet_pton(AF_INET, place.address.c_str(), &address.sin_addr) != 1) return std::nullopt;
  return address;
}

Place place_of(const ::sockaddr_in& address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  ::inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
  return {text.data(), ::ntohs(address.sin_port)};
}

Result<Socket> Socket::bind(const Place& place, bool shared) {
  const auto address = address_of(place);
  if (!address) return fail(ErrorCode::kInvalidArgument, "`{}` is not an address", place.address);
  Socket socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket.descriptor_) return failed("socket");
  const int on = 1;
  if (shared) ::setsockopt(socket.descriptor_.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (::bind(socket.descriptor_.get(), general(*address), sizeof *address) != 0)
    return failed("bind");
  return socket;
}

Status Socket::connect(const Place& place) {
  const auto address = address_of(place);
  if (!address) return fail(ErrorCode::kInvalidArgument, "`{}` is not an address", place.address);
  // A connected socket reports the ICMP message "port unreachable" as an error; an unconnected one
  // would only stay silent.
  if (::connect(descriptor_.get(), general(*address), sizeof *address) != 0)
    return failed("connect");
  return {};
}

Status Socket::join(const char* group, const std::string& interface_address) {
  ::ip_mreqn request{};
  if (::inet_pton(AF_INET, group, &request.imr_multiaddr) != 1 ||
      ::inet_pton(AF_INET, interface_address.c_str(), &request.imr_address) != 1) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not an address", interface_address);
  }
  const int on = 1;
  if (::setsockopt(descriptor_.get(), IPPROTO_IP, IP_MULTICAST_IF, &request, sizeof request) != 0 ||
      ::setsockopt(descriptor_.get(), IPPROTO_IP, IP_MULTICAST_LOOP, &on, sizeof on) != 0 ||
      ::setsockopt(descriptor_.get(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) !=
          0) {
    return failed("multicast");
  }
  return {};
}

Status Socket::send(std::string_view bytes, const Place& to) const {
  const auto address = address_of(to);
  if (!address) return fail(ErrorCode::kInvalidArgument, "`{}` is not an address", to.address);
  if (::sendto(descriptor_.get(), bytes.data(), bytes.size(), 0, general(*address),
               sizeof *address) < 0) {
    return failed("send");
  }
  return {};
}

Status Socket::send(std::string_view bytes) const {
  if (::send(descriptor_.get(), bytes.data(), bytes.size(), 0) < 0) return failed("send");
  return {};
}

Result<std::optional<Socket::Received>> Socket::receive(std::span<char> into, int wait_ms) const {
  ::pollfd source{descriptor_.get(), POLLIN, 0};
  if (::poll(&source, 1, wait_ms) <= 0) return std::nullopt;
  ::sockaddr_in from{};
  ::socklen_t size = sizeof from;
  const ::ssize_t received = ::recvfrom(descriptor_.get(), into.data(), into.size(), MSG_DONTWAIT,
                                        reinterpret_cast<::sockaddr*>(&from), &size);
  if (received < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  if (received < 0) return failed("receive");
  return Received{static_cast<std::size_t>(received), place_of(from)};
}

std::uint16_t Socket::port() const {
  ::sockaddr_in address{};
  ::socklen_t size = sizeof address;
  ::getsockname(descriptor_.get(), reinterpret_cast<::sockaddr*>(&address), &size);
  return ::ntohs(address.sin_port);
}

}  // namespace rave::doctor
