// SPDX-License-Identifier: Apache-2.0
#include "rave/line/datagram_socket.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

namespace rave::line {
namespace {

using Found = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

Found look_up(const std::string& host, const std::string& port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_DGRAM;
  // Numeric only: looking up a name may block for seconds.
  wanted.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), port.c_str(), &wanted, &found) != 0) found = nullptr;
  return {found, &::freeaddrinfo};
}

template <class T>
bool set(int fd, int level, int option, const T& value) {
  return ::setsockopt(fd, level, option, &value, sizeof value) == 0;
}

template <class T>
T as(const sockaddr_storage& storage) {
  T address{};
  std::memcpy(&address, &storage, sizeof address);
  return address;
}

/// Joins the group over the interface with address `own`, sends over it, and receives packets of
/// other sockets on this machine.
bool join(int fd, const Peer& group, const addrinfo& own) {
  const int one = 1;
  if (own.ai_family == AF_INET) {
    sockaddr_in here{};
    std::memcpy(&here, own.ai_addr, sizeof here);
    const ip_mreq request{as<sockaddr_in>(group.address).sin_addr, here.sin_addr};
    return set(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, request) &&
           set(fd, IPPROTO_IP, IP_MULTICAST_IF, here.sin_addr) &&
           set(fd, IPPROTO_IP, IP_MULTICAST_LOOP, one);
  }
  sockaddr_in6 here{};
  std::memcpy(&here, own.ai_addr, sizeof here);
  // IPv6 names an interface by number and not by address; the scope of a link-local address has it.
  const unsigned interface = here.sin6_scope_id != 0 ? here.sin6_scope_id : ::if_nametoindex("lo");
  const ipv6_mreq request{as<sockaddr_in6>(group.address).sin6_addr, interface};
  return set(fd, IPPROTO_IPV6, IPV6_ADD_MEMBERSHIP, request) &&
         set(fd, IPPROTO_IPV6, IPV6_MULTICAST_IF, interface) &&
         set(fd, IPPROTO_IPV6, IPV6_MULTICAST_LOOP, one);
}

std::string text_of(const sockaddr_storage& address) {
  std::array<char, INET6_ADDRSTRLEN> host{};
  if (address.ss_family == AF_INET6) {
    const auto six = as<sockaddr_in6>(address);
    ::inet_ntop(AF_INET6, &six.sin6_addr, host.data(), host.size());
    return fmt::format("[{}]:{}", host.data(), ntohs(six.sin6_port));
  }
  const auto four = as<sockaddr_in>(address);
  ::inet_ntop(AF_INET, &four.sin_addr, host.data(), host.size());
  return fmt::format("{}:{}", host.data(), ntohs(four.sin_port));
}

bool is_passing(int error) {
  // ECONNREFUSED tells that an earlier datagram met no receiver. The peer may start later, so this
  // is no error of the socket.
  return error == EINTR || error == EAGAIN || error == ECONNREFUSED || error == ENOBUFS;
}

}  // namespace

Result<Peer> parse_peer(std::string_view text) {
  const auto parts = parse_address("", 0, text);
  if (!parts) {
    return fail(ErrorCode::kInvalidArgument,
                "expected an address such as 127.0.0.1:4711, found `{}`", text);
  }
  const Found found = look_up(parts->host, parts->port);
  if (!found) {
    return fail(ErrorCode::kInvalidArgument,
                "expected a numeric address such as 127.0.0.1:4711, found `{}`", text);
  }
  Peer peer;
  std::memcpy(&peer.address, found->ai_addr, found->ai_addrlen);
  peer.size = found->ai_addrlen;
  peer.text = text;
  return peer;
}

Result<std::vector<Peer>> parse_peers(std::string_view text) {
  std::vector<Peer> peers;
  constexpr std::string_view kBetween = " ,\t";
  while (true) {
    const auto begin = text.find_first_not_of(kBetween);
    if (begin == std::string_view::npos) return peers;
    text.remove_prefix(begin);
    const auto end = std::min(text.find_first_of(kBetween), text.size());
    RAVE_TRY_ASSIGN(auto peer, parse_peer(text.substr(0, end)));
    peers.push_back(std::move(peer));
    text.remove_prefix(end);
  }
}

Result<DatagramSocket> DatagramSocket::open(const std::string& host, std::uint16_t port,
                                            const Peer* group) {
  const Found own = look_up(host, std::to_string(port));
  if (!own) {
    return fail(ErrorCode::kInvalidArgument,
                "`listen` must be a numeric address such as 127.0.0.1, not `{}`", host);
  }
  if (group != nullptr && group->address.ss_family != own->ai_family) {
    return fail(ErrorCode::kInvalidArgument,
                "the group {} and the address {} are of different families", group->text, host);
  }
  DatagramSocket opened(::socket(own->ai_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const auto failed = [&](std::string_view what) {
    return fail(ErrorCode::kIo, "cannot {} UDP port {} of {}: {}", what, port, host,
                std::strerror(errno));
  };
  if (!opened.fd_) return failed("open");
  // Several sockets may listen to one group; a unicast address belongs to one socket.
  const int one = 1;
  const sockaddr* where =
      group != nullptr ? reinterpret_cast<const sockaddr*>(&group->address) : own->ai_addr;
  if (group != nullptr && !set(opened.fd_.get(), SOL_SOCKET, SO_REUSEADDR, one))
    return failed("share");
  if (::bind(opened.fd_.get(), where, own->ai_addrlen) != 0) return failed("listen on");
  if (group != nullptr && !join(opened.fd_.get(), *group, *own)) return failed("join the group on");
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  if (::getsockname(opened.fd_.get(), reinterpret_cast<sockaddr*>(&bound), &size) == 0) {
    // The port is at the same place in both address families.
    opened.port_ = ntohs(as<sockaddr_in>(bound).sin_port);
  }
  return opened;
}

ReadResult DatagramSocket::receive(std::span<std::byte> room, Wait limit, const Wake& wake,
                                   Peer* from) const {
  const HostTime end = host_now() + limit;
  while (true) {
    const int ready = detail::wait_ready(fd_.get(), POLLIN, end, &wake);
    if (ready < 0) return {ReadEnd::kWoken, 0};
    if (ready == 0) return {ReadEnd::kTimeout, 0};
    sockaddr_storage address{};
    socklen_t address_size = sizeof address;
    const ssize_t size = ::recvfrom(fd_.get(), room.data(), room.size(), 0,
                                    reinterpret_cast<sockaddr*>(&address), &address_size);
    if (size >= 0 && from != nullptr) *from = {address, address_size, text_of(address)};
    if (size >= 0) return {ReadEnd::kBytes, static_cast<std::size_t>(size)};
    if (!is_passing(errno)) return {ReadEnd::kLost, 0};
  }
}

Status DatagramSocket::send(std::span<const std::byte> bytes, const Peer& to) const {
  const ssize_t sent = ::sendto(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL,
                                reinterpret_cast<const sockaddr*>(&to.address), to.size);
  if (sent >= 0 || is_passing(errno)) return {};
  return fail(ErrorCode::kIo, "cannot send to {}: {}", to.text, std::strerror(errno));
}

}  // namespace rave::line
