// SPDX-License-Identifier: Apache-2.0
#include "udp_ping.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace rave::bus::bench {
namespace {

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

}  // namespace

int serve_udp() {
  const int server = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof address;
  if (::bind(server, reinterpret_cast<sockaddr*>(&address), size) != 0) return 1;
  ::getsockname(server, reinterpret_cast<sockaddr*>(&address), &size);
  std::printf("%d\n", ntohs(address.sin_port));
  std::fflush(stdout);
  std::vector<char> packet(65536);
  while (true) {
    sockaddr_in sender{};
    size = sizeof sender;
    const auto got = ::recvfrom(server, packet.data(), packet.size(), 0,
                                reinterpret_cast<sockaddr*>(&sender), &size);
    if (got <= 0) return 0;
    ::sendto(server, packet.data(), static_cast<std::size_t>(got), 0,
             reinterpret_cast<sockaddr*>(&sender), size);
  }
}

std::vector<double> udp_round_trips_us(int port, std::size_t bytes, std::size_t count) {
  const int client = ::socket(AF_INET, SOCK_DGRAM, 0);
  const sockaddr_in address = loopback(port);
  if (::connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    return {};
  std::vector<char> packet(bytes, 'p');
  std::vector<double> times_us(count);
  for (double& time_us : times_us) {
    const auto start = std::chrono::steady_clock::now();
    static_cast<void>(!::send(client, packet.data(), packet.size(), 0));
    static_cast<void>(!::recv(client, packet.data(), packet.size(), 0));
    time_us =
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  }
  ::send(client, packet.data(), 0, 0);
  ::close(client);
  return times_us;
}

}  // namespace rave::bus::bench
