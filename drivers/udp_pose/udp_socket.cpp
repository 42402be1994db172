// SPDX-License-Identifier: Apache-2.0
#include "udp_pose/udp_socket.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

namespace rave::udp_pose {

Result<UdpSocket> UdpSocket::listen(const std::string& host, std::uint16_t port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_DGRAM;
  wanted.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) {
    return fail(ErrorCode::kInvalidArgument,
                "`listen` must be a numeric address such as 127.0.0.1, not `{}`", host);
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> target(found, &::freeaddrinfo);
  UdpSocket opened(::socket(target->ai_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0), port);
  if (opened.fd_ < 0 || ::bind(opened.fd_, target->ai_addr, target->ai_addrlen) != 0) {
    return fail(ErrorCode::kIo, "cannot listen on UDP port {} of {}: {}", port, host,
                std::strerror(errno));
  }
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  if (::getsockname(opened.fd_, reinterpret_cast<sockaddr*>(&own), &size) == 0) {
    // The port stands in the same place in both families.
    sockaddr_in as_four{};
    std::memcpy(&as_four, &own, sizeof as_four);
    opened.port_ = ntohs(as_four.sin_port);
  }
  return opened;
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), port_(other.port_) {}

UdpSocket& UdpSocket::operator=(UdpSocket&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(port_, other.port_);
  return *this;
}

UdpSocket::~UdpSocket() {
  if (fd_ >= 0) ::close(fd_);
}

line::ReadResult UdpSocket::receive(std::span<char> room, line::Wait limit,
                                    const line::Wake& wake) const noexcept {
  const line::HostTime end = line::host_now() + limit;
  while (true) {
    const int ready = line::detail::wait_ready(fd_, POLLIN, end, &wake);
    if (ready < 0) return {line::ReadEnd::kWoken, 0};
    if (ready == 0) return {line::ReadEnd::kTimeout, 0};
    const ssize_t size = ::recv(fd_, room.data(), room.size(), 0);
    if (size >= 0) return {line::ReadEnd::kBytes, static_cast<std::size_t>(size)};
  }
}

}  // namespace rave::udp_pose
