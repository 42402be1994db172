// SPDX-License-Identifier: Apache-2.0
// What the devices under the radio can do, as a host uses them: packets of 64 bytes of message
// there and back, and as many as go through with a few under way. Both ends are here, over real
// sockets.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <functional>
#include <thread>

#include "rave/live_testing/live_transmitter.hpp"
#include "rave/robot/radio_packet.hpp"

namespace {

using namespace rave;
using rave::testing::LiveTransmitter;
using std::string_literals::operator""s;

/// Calls a function for each packet.
class Hearer final : public PacketSink {
 public:
  explicit Hearer(std::function<void()> heard) : heard_(std::move(heard)) {}
  void receive(const std::byte*, std::uint64_t) noexcept override { heard_(); }
  void fail(const char*, std::uint64_t) noexcept override {}
  void recover() noexcept override {}

 private:
  std::function<void()> heard_;
};

/// Counts what comes back.
class Counter {
 public:
  void add() {
    const std::lock_guard lock(mutex_);
    ++count_;
    changed_.notify_one();
  }
  /// False: what is waited for was lost.
  bool wait_for(std::uint64_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(1), [&] { return count_ >= count; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t count_ = 0;
};

std::string example_packet() {
  const std::array<std::byte, 64> message{};
  RadioPacket packet;
  packet.sender = radio_name_hash("anna");
  packet.channel = radio_name_hash("air");
  packet.payload = message;
  std::array<std::byte, 200> room{};
  const std::size_t size = encode(packet, room);
  return {reinterpret_cast<const char*>(room.data()), size};
}

/// Two UDP ports that nobody has now.
std::pair<double, double> free_ports() {
  LiveTransmitter probes[] = {LiveTransmitter("udp_transmitter"),
                              LiveTransmitter("udp_transmitter")};
  for (LiveTransmitter& probe : probes) probe.configure({{"peers", "127.0.0.1:9"s}});
  return {probes[0].report()["port"], probes[1].report()["port"]};
}

/// Two transmitters of a driver that hear each other; empty, or what went wrong.
std::string connect(LiveTransmitter& a, LiveTransmitter& b, const std::string& driver,
                    PacketSink& at_a, PacketSink& at_b) {
  std::string error;
  const auto expect = [&error](const std::string& found) {
    if (error.empty()) error = found;
  };
  const bool dds = driver == "dds_transmitter";
  if (dds) {
    // With other parameters each has a participant of its own, as in two processes.
    const std::string network = "bench" + std::to_string(::getpid());
    expect(a.configure({{"network", network}, {"queue_bytes", 1'000'000.0}}));
    expect(b.configure({{"network", network}, {"queue_bytes", 2'000'000.0}}));
  } else {
    const auto [here, there] = free_ports();
    expect(a.configure({{"port", here}, {"peers", fmt::format("127.0.0.1:{}", there)}}));
    expect(b.configure({{"port", there}, {"peers", fmt::format("127.0.0.1:{}", here)}}));
  }
  expect(a.open(at_a));
  expect(b.open(at_b));
  const auto met = [&] { return a.report()["others"] == 1 && b.report()["others"] == 1; };
  while (dds && error.empty() && !met()) ::usleep(1000);
  return error;
}

/// `window`: packets that are under way at most.
void transmitter(benchmark::State& state, const std::string& driver, std::uint64_t window) {
  LiveTransmitter a(driver);
  LiveTransmitter b(driver);
  const std::string packet = example_packet();
  Counter there;
  Counter back;
  Hearer at_a([&] { back.add(); });
  Hearer at_b([&] { there.add(); });
  const std::string error = connect(a, b, driver, at_a, at_b);
  if (!error.empty()) {
    state.SkipWithError(error.c_str());
    return;
  }
  // A thread answers, since no host sends while it is handed a packet.
  const std::jthread answerer([&](const std::stop_token& stop) {
    for (std::uint64_t answered = 0; !stop.stop_requested();) {
      if (there.wait_for(answered + 1)) {
        b.send(packet);
        ++answered;
      }
    }
  });
  std::uint64_t sent = 0;
  for (auto _ : state) {
    a.send(packet);
    ++sent;
    if (sent >= window && !back.wait_for(sent - window + 1)) {
      state.SkipWithError("packets were lost");
      break;
    }
  }
  back.wait_for(sent);
  state.counters["messages/s"] =
      benchmark::Counter(static_cast<double>(sent), benchmark::Counter::kIsRate);
  a.close();
  b.close();
}
BENCHMARK_CAPTURE(transmitter, udp_there_and_back, "udp_transmitter", 1)
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(transmitter, dds_there_and_back, "dds_transmitter", 1)
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(transmitter, udp_many, "udp_transmitter", 64)
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(transmitter, dds_many, "dds_transmitter", 64)
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

}  // namespace
