// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rave/bus/local_transport.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/writer.hpp"
#include "rave/bus_testing/messages.hpp"
#include "rave/bus_testing/peer_process.hpp"

namespace rave::bus::testing {

inline constexpr std::uint8_t kWorldStep = 2;
/// In front of a world.
inline constexpr const char* kHead = "ravesw\1\2";

/// A sample as it is on its way.
inline std::string datagram(const WorldStep& world) {
  const auto bytes = encode(world);
  std::string text = kHead;
  return text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

/// Two processes in one, and a topic between them.
struct Pair {
  TestDomain domain;
  std::unique_ptr<Bus> left;
  std::unique_ptr<Bus> right;
  std::unique_ptr<Writer<WorldStep>> writer;
  std::unique_ptr<Reader<WorldStep>> reader;

  explicit Pair(bool right_short = true, bool left_short = true) {
    BusConfig config = domain.config("left");
    config.beside = true;
    // Nobody is missed because the machine is busy.
    config.lease = from_seconds(20);
    config.local_transport = left_short;
    left = std::move(*Bus::open(config));
    config.participant = "right";
    config.local_transport = right_short;
    right = std::move(*Bus::open(config));
    reader = std::make_unique<Reader<WorldStep>>(std::move(*Reader<WorldStep>::create(*right)));
    writer = std::make_unique<Writer<WorldStep>>(std::move(*Writer<WorldStep>::create(*left)));
  }
  void send(std::uint64_t step, std::size_t bytes = 0) const {
    WorldStep world{};
    std::vector<std::uint64_t> hosts(8);
    std::vector<std::uint8_t> text(bytes, 'x');
    world.epoch = 1;
    world.step = step;
    borrow(world.hosts, hosts);
    borrow(world.sent.bytes, text);
    EXPECT_TRUE(writer->write(world));
  }
  /// Sends until something comes; whether that was by the local transport.
  [[nodiscard]] bool comes_short(std::size_t bytes = 0) const {
    bool local_transport = false;
    std::uint64_t step = 0;
    EXPECT_TRUE(eventually([&] {
      send(++step, bytes);
      return reader->take([&](const WorldStep&, const dds_sample_info_t& info) {
        local_transport = info.publication_handle == 0;
      }) > 0;
    }));
    return local_transport;
  }
  /// Both ends know each other.
  [[nodiscard]] bool connected() const {
    return eventually([&] { return comes_short(); });
  }
  /// Sends bytes to the reader from an address; how many samples came of it. None if the system
  /// does not carry so many bytes.
  [[nodiscard]] std::optional<std::size_t> throw_bytes(const LocalAddress& from,
                                                       const std::string& bytes) const {
    const auto socket = LocalSocket::open(from);
    EXPECT_TRUE(socket) << "somebody has that address";
    if (!socket) return std::nullopt;
    const LocalAddress to(domain.run, right->writer(), kWorldStep);
    const auto sent = ::sendto(socket->descriptor(), bytes.data(), bytes.size(), 0,
                               reinterpret_cast<const sockaddr*>(&to.name), to.size);
    if (sent != static_cast<ssize_t>(bytes.size())) return std::nullopt;
    return reader->take([](const WorldStep&) {});
  }
};

/// This process sends worlds to others, who say how they came.
struct Followed {
  struct Word {
    std::uint64_t step = 0;
    std::string way;
  };
  TestDomain domain;
  std::unique_ptr<Bus> bus = *Bus::open(config());
  Writer<WorldStep> worlds = *Writer<WorldStep>::create(*bus);
  Reader<HostReport> reports = *Reader<HostReport>::create(*bus);
  std::uint64_t step = 0;
  std::map<std::uint32_t, Word> last;  ///< By the number that a process was given.

  [[nodiscard]] BusConfig config() const {
    BusConfig config = domain.config("left");
    config.lease = from_seconds(20);
    return config;
  }
  void send() {
    WorldStep world{};
    world.epoch = 1;
    world.step = ++step;
    EXPECT_TRUE(worlds.write(world));
  }
  void listen() {
    reports.take([this](const HostReport& report) {
      Word& word = last[report.host];
      if (report.step >= word.step) word = {report.step, report.text};
    });
  }
  /// Sends until something comes by the local transport to all of them.
  [[nodiscard]] bool goes_locally(const std::vector<std::uint32_t>& hosts) {
    last.clear();
    return eventually([&] {
      static_cast<void>(bus->take_events());
      send();
      listen();
      return std::ranges::all_of(hosts, [&](auto host) { return last[host].way == "short"; });
    });
  }
};

}  // namespace rave::bus::testing
