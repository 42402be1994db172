// SPDX-License-Identifier: Apache-2.0
#include "ping.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numeric>
#include <vector>

#include "child.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "udp_ping.hpp"

namespace rave::bus {

/// A packet on a topic that has the local transport, which that of radio has not.
struct LocalPacket : rave_wire_Packet {};
template <>
inline constexpr TopicSpec kTopic<LocalPacket> = {"bench/short", &rave_wire_Packet_desc, kNewest,
                                                  3};

}  // namespace rave::bus

namespace rave::bus::bench {
namespace {

constexpr std::size_t kPingBytes = 64;
constexpr Duration kForEver{-1};
/// A robot number that ends a server.
constexpr std::uint32_t kEnd = 99;

double mean(const std::vector<double>& values) {
  if (values.empty()) return -1;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile(std::vector<double> values, double part) {
  if (values.empty()) return -1;
  const auto place = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

/// One end of the line: both topics, and what is done with a packet.
template <class Message>
struct EndOf {
  explicit EndOf(Bus& bus)
      : reader(*Reader<Message>::create(bus)),
        writer(*Writer<Message>::create(bus)),
        waits(*WaitSet::create(bus)) {
    static_cast<void>(waits.add(reader));
  }
  Reader<Message> reader;
  Writer<Message> writer;
  WaitSet waits;
};
using End = EndOf<Packet>;

/// Calls `Self::arrived()` on the thread that receives; nothing else may use the reader then.
template <class Self>
void listen(Self& self, dds_entity_t reader) {
  dds_listener_t* const listener = dds_create_listener(&self);
  dds_lset_data_available(listener,
                          [](dds_entity_t, void* it) { static_cast<Self*>(it)->arrived(); });
  dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
  dds_set_listener(reader, listener);
  dds_delete_listener(listener);
}

struct Server {
  End end;
  std::atomic<bool> done = false;
  void arrived() {
    bool last = false;
    end.reader.take([&](const Packet& packet) {
      last = packet.from_robot == kEnd;
      Packet answer = packet;
      static_cast<void>(end.writer.write(answer));
    });
    if (!last) return;
    done = true;
    done.notify_all();
  }
};

struct Client {
  End end;
  std::vector<std::uint8_t> payload = std::vector<std::uint8_t>(kPingBytes, 'p');
  std::vector<double> times_us = {};
  std::size_t count = 0;
  Packet packet = {};
  std::chrono::steady_clock::time_point sent = {};
  std::atomic<bool> done = false;

  void send() {
    borrow(packet.payload, payload);
    sent = std::chrono::steady_clock::now();
    static_cast<void>(end.writer.write(packet));
  }
  bool take() {
    if (end.reader.take([](const Packet&) {}) == 0) return false;
    const auto took = std::chrono::steady_clock::now() - sent;
    times_us.push_back(std::chrono::duration<double, std::micro>(took).count());
    return true;
  }
  void arrived() {
    if (!take()) return;
    if (times_us.size() < count) return send();
    done = true;
    done.notify_all();
  }
  /// Once there and back with the wait set; what was sent before the server knew of us has no
  /// answer.
  void once() {
    send();
    while (end.waits.wait(Duration{200'000'000}) == Woken::kReady) {
      if (take()) return;
    }
  }
};

/// The same with the local transport; `last` ends a server.
struct LocalEnd : EndOf<LocalPacket> {
  explicit LocalEnd(Bus& bus) : EndOf(bus) { borrow(sample.payload, payload); }
  bool write() { return writer.write(sample).has_value(); }
  /// Waits for one sample; whether it came.
  bool take() {
    bool came = false;
    if (waits.wait(Duration{200'000'000}) != Woken::kReady) return false;
    reader.take([&](const LocalPacket& packet) {
      came = true;
      last = packet.from_robot == kEnd;
    });
    return came;
  }
  std::vector<std::uint8_t> payload = std::vector<std::uint8_t>(kPingBytes, 'p');
  LocalPacket sample{};
  bool last = false;
};

int serve_short(Bus& bus) {
  LocalEnd end(bus);
  while (!end.last) {
    if (end.take()) static_cast<void>(end.write());
  }
  return 0;
}

std::vector<double> local_round_trips_us(std::size_t count) {
  const std::string run = RunId::random().text();
  const Child server = start({"serve-short", run});
  const auto bus = join(run, "ping");
  LocalEnd end(*bus);
  wait_for(1, [&] { return std::min(end.writer.readers(), end.reader.writers()); });
  std::vector<double> times_us;
  for (std::size_t number = 0; number <= count;) {
    const auto sent = std::chrono::steady_clock::now();
    if (!end.write() || !end.take()) continue;
    const auto took = std::chrono::steady_clock::now() - sent;
    // The first one tells that both ends know each other.
    if (number++ > 0) times_us.push_back(std::chrono::duration<double, std::micro>(took).count());
  }
  end.sample.from_robot = kEnd;
  static_cast<void>(end.write());
  ::waitpid(server.process, nullptr, 0);
  return times_us;
}

std::vector<double> bus_round_trips_us(std::size_t count, Way way) {
  const std::string run = RunId::random().text();
  const Child server = start({way == Way::kWaitSet ? "serve-bus" : "serve-listener", run});
  const auto bus = join(run, "ping");
  Client client{.end = End(*bus)};
  wait_for(1, [&] { return std::min(client.end.writer.readers(), client.end.reader.writers()); });
  while (client.times_us.empty()) client.once();
  client.times_us.clear();
  client.count = count;
  if (way == Way::kWaitSet) {
    while (client.times_us.size() < count) client.once();
  } else {
    listen(client, client.end.reader.handle());
    client.send();
    client.done.wait(false);
    dds_set_listener(client.end.reader.handle(), nullptr);
  }
  client.packet.from_robot = kEnd;
  client.send();
  ::waitpid(server.process, nullptr, 0);
  return client.times_us;
}

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

void print(const char* name, const std::vector<double>& times_us, double udp_us) {
  std::printf(
      ", \"%s_median_us\": %.2f, \"%s_p99_us\": %.2f, \"%s_mean_us\": %.2f, \"%s_ratio\": %.3f",
      name, quantile(times_us, 0.5), name, quantile(times_us, 0.99), name, mean(times_us), name,
      quantile(times_us, 0.5) / udp_us);
}

}  // namespace

int serve_bus(const std::string& run, Way way) {
  const auto bus = join(run, "pong");
  if (way == Way::kShort) return serve_short(*bus);
  Server server{.end = End(*bus)};
  if (way == Way::kListener) {
    listen(server, server.end.reader.handle());
    server.done.wait(false);
    dds_set_listener(server.end.reader.handle(), nullptr);
    return 0;
  }
  while (!server.done) {
    static_cast<void>(server.end.waits.wait(kForEver));
    server.arrived();
  }
  return 0;
}

int ping(std::size_t count) {
  // In turns, so that what else the machine does hits all.
  constexpr std::size_t kTurns = 5;
  std::vector<double> udp_us;
  std::vector<double> bus_us;
  std::vector<double> listener_us;
  std::vector<double> local_us;
  for (std::size_t turn = 0; turn < kTurns; ++turn) {
    const Child server = start({"serve-udp"});
    const auto port = static_cast<int>(number_from(server));
    append(udp_us, udp_round_trips_us(port, kPingBytes, count / kTurns));
    ::waitpid(server.process, nullptr, 0);
    append(bus_us, bus_round_trips_us(count / kTurns, Way::kWaitSet));
    append(local_us, local_round_trips_us(count / kTurns));
    append(listener_us, bus_round_trips_us(count / kTurns, Way::kListener));
  }
  const double udp = quantile(udp_us, 0.5);
  std::printf("{\"payload_B\": %zu, \"round_trips\": %zu", kPingBytes, bus_us.size());
  print("udp", udp_us, udp);
  print("bus", bus_us, udp);
  print("listener", listener_us, udp);
  print("short", local_us, udp);
  std::printf("}\n");
  return 0;
}

}  // namespace rave::bus::bench
