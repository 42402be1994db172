// SPDX-License-Identifier: Apache-2.0
// Measures the bus between processes of this machine and prints JSON.
//   bench_bus ping [COUNT]                     64 B there and back, beside UDP in the same run
//   bench_bus world [RECEIVERS [ROBOTS [S]]]   the world at 10 Hz to many processes
// It starts itself for the other processes.
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "rave/bus/reader.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "udp_ping.hpp"

extern char** environ;

namespace {

using namespace rave;
using namespace rave::bus;

constexpr std::size_t kPingBytes = 64;
constexpr Duration kForEver{-1};
/// A robot number that ends a receiver.
constexpr std::uint32_t kEnd = 99;

/// This program in another role, with its output to read.
struct Child {
  pid_t process = -1;
  FILE* output = nullptr;
};

Child start(std::vector<std::string> words) {
  words.insert(words.begin(), "/proc/self/exe");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  int ends[2];
  if (::pipe(ends) != 0) std::exit(1);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_addclose(&actions, ends[0]);
  Child child;
  ::posix_spawn(&child.process, argv[0], &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  child.output = ::fdopen(ends[0], "r");
  return child;
}

double number_from(const Child& child) {
  double value = 0;
  return std::fscanf(child.output, "%lf", &value) == 1 ? value : -1;
}

std::unique_ptr<Bus> join(const std::string& run, const char* name) {
  BusConfig config;
  config.participant = name;
  config.run = *RunId::parse(run);
  config.tag = "bench-" + run;
  config.domain = 77;
  auto bus = Bus::open(config);
  if (!bus) {
    std::fprintf(stderr, "%s\n", bus.error().text().c_str());
    std::exit(1);
  }
  return *std::move(bus);
}

template <class Endpoint>
void wait_for(std::size_t count, const Endpoint& known) {
  while (known() < count) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

double quantile(std::vector<double> values, double part) {
  if (values.empty()) return -1;
  const auto place = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

double cpu_s(int who) {
  rusage usage{};
  ::getrusage(who, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

int serve_bus(const std::string& run) {
  const auto bus = join(run, "pong");
  auto reader = Reader<Packet>::create(*bus);
  auto writer = Writer<Packet>::create(*bus);
  auto waits = WaitSet::create(*bus);
  static_cast<void>(waits->add(*reader));
  bool end = false;
  while (!end) {
    static_cast<void>(waits->wait(kForEver));
    reader->take([&](const Packet& packet) {
      end = packet.from_robot == kEnd;
      Packet answer = packet;
      static_cast<void>(writer->write(answer));
    });
  }
  return 0;
}

/// Round trips of packets whose payload has the size that the UDP packets have.
std::vector<double> bus_round_trips_us(std::size_t count) {
  const std::string run = RunId::random().text();
  const Child server = start({"serve-bus", run});
  const auto bus = join(run, "ping");
  auto reader = Reader<Packet>::create(*bus);
  auto writer = Writer<Packet>::create(*bus);
  auto waits = WaitSet::create(*bus);
  static_cast<void>(waits->add(*reader));
  wait_for(1, [&] { return std::min(writer->readers(), reader->writers()); });
  std::vector<std::uint8_t> payload(kPingBytes, 'p');
  std::vector<double> times_us;
  Packet packet{};
  borrow(packet.payload, payload);
  while (times_us.size() < count) {
    const auto begin = std::chrono::steady_clock::now();
    static_cast<void>(writer->write(packet));
    bool answered = false;
    // What was sent before the server knew of us has no answer.
    while (!answered && waits->wait(Duration{200'000'000}) == Woken::kReady) {
      answered = reader->take([](const Packet&) {}) > 0;
    }
    const auto took = std::chrono::steady_clock::now() - begin;
    if (answered) times_us.push_back(std::chrono::duration<double, std::micro>(took).count());
  }
  packet.from_robot = kEnd;
  static_cast<void>(writer->write(packet));
  ::waitpid(server.process, nullptr, 0);
  return times_us;
}

int ping(std::size_t count) {
  // In turns, so that what else the machine does hits both.
  constexpr std::size_t kTurns = 5;
  std::vector<double> udp_us;
  std::vector<double> bus_us;
  for (std::size_t turn = 0; turn < kTurns; ++turn) {
    const Child server = start({"serve-udp"});
    const auto port = static_cast<int>(number_from(server));
    const auto udp = bench::udp_round_trips_us(port, kPingBytes, count / kTurns);
    ::waitpid(server.process, nullptr, 0);
    const auto ours = bus_round_trips_us(count / kTurns);
    udp_us.insert(udp_us.end(), udp.begin(), udp.end());
    bus_us.insert(bus_us.end(), ours.begin(), ours.end());
  }
  std::printf(
      "{\"payload_B\": %zu, \"round_trips\": %zu, \"udp_median_us\": %.2f, \"bus_median_us\": %.2f,"
      " \"ratio\": %.3f, \"udp_p99_us\": %.2f, \"bus_p99_us\": %.2f}\n",
      kPingBytes, bus_us.size(), quantile(udp_us, 0.5), quantile(bus_us, 0.5),
      quantile(bus_us, 0.5) / quantile(udp_us, 0.5), quantile(udp_us, 0.99),
      quantile(bus_us, 0.99));
  return 0;
}

/// Takes worlds until the step is kLast; prints how many came, how many were missing in between,
/// and the CPU time since the first.
constexpr std::uint64_t kLast = ~0ULL;
int receive(const std::string& run) {
  const auto bus = join(run, "receiver");
  auto reader = Reader<World>::create(*bus);
  auto waits = WaitSet::create(*bus);
  static_cast<void>(waits->add(*reader));
  std::uint64_t first = 0;
  std::uint64_t newest = 0;
  std::uint64_t taken = 0;
  double start_s = 0;
  bool end = false;
  while (!end) {
    static_cast<void>(waits->wait(kForEver));
    reader->take([&](const World& world) {
      end = world.step == kLast;
      if (end) return;
      if (taken == 0) start_s = cpu_s(RUSAGE_SELF);
      if (taken == 0) first = world.step;
      newest = world.step;
      ++taken;
    });
  }
  const std::uint64_t missing = taken == 0 ? 0 : newest - first + 1 - taken;
  std::printf("%llu %llu %.6f\n", static_cast<unsigned long long>(taken),
              static_cast<unsigned long long>(missing), cpu_s(RUSAGE_SELF) - start_s);
  return 0;
}

/// The arrays of a world of robots.
struct Robots {
  explicit Robots(std::uint32_t count) : id(count), values(6, std::vector<double>(count, 0.5)) {
    for (std::uint32_t i = 0; i < count; ++i) id[i] = i;
  }
  void lend(rave_wire_PlanarRobots& robots) {
    borrow(robots.id, id);
    borrow(robots.x_m, values[0]);
    borrow(robots.y_m, values[1]);
    borrow(robots.yaw_rad, values[2]);
    borrow(robots.vx_mps, values[3]);
    borrow(robots.vy_mps, values[4]);
    borrow(robots.wz_radps, values[5]);
  }
  std::vector<std::uint32_t> id;
  std::vector<std::vector<double>> values;
};

int world(std::size_t receivers, std::uint32_t count, std::uint64_t seconds) {
  const std::string run = RunId::random().text();
  const auto bus = join(run, "authority");
  auto writer = Writer<World>::create(*bus);
  std::vector<Child> children;
  for (std::size_t i = 0; i < receivers; ++i) children.push_back(start({"receive", run}));
  wait_for(receivers, [&] { return writer->readers(); });
  std::this_thread::sleep_for(std::chrono::seconds(1));
  Robots robots(count);
  World sample{};
  robots.lend(sample.robots);
  const double own_start_s = cpu_s(RUSAGE_SELF);
  const auto begin = std::chrono::steady_clock::now();
  std::size_t failures = 0;
  for (std::uint64_t step = 1; step <= 10 * seconds; ++step) {
    std::this_thread::sleep_until(begin + std::chrono::milliseconds(100) * step);
    sample.step = step;
    if (!writer->write(sample)) ++failures;
  }
  const double own_s = cpu_s(RUSAGE_SELF) - own_start_s;
  std::this_thread::sleep_for(std::chrono::seconds(1));
  sample.step = kLast;
  static_cast<void>(writer->write(sample));
  double taken = 0;
  double missing = 0;
  double used_s = 0;
  for (const Child& child : children) {
    taken += number_from(child);
    missing += number_from(child);
    used_s += number_from(child);
    ::waitpid(child.process, nullptr, 0);
  }
  const auto all = static_cast<double>(seconds);
  std::printf(
      "{\"receivers\": %zu, \"robots\": %u, \"sent\": %llu, \"write_failures\": %zu, \"taken\": "
      "%.0f,"
      " \"missing\": %.0f, \"receivers_core_percent\": %.2f, \"writer_core_percent\": %.2f}\n",
      receivers, count, static_cast<unsigned long long>(10 * seconds), failures, taken, missing,
      100 * used_s / all, 100 * own_s / all);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string role = argc > 1 ? argv[1] : "";
  const auto argument = [&](int index, unsigned long usual) {
    return argc > index ? std::strtoul(argv[index], nullptr, 10) : usual;
  };
  if (role == "serve-udp") return bench::serve_udp();
  if (role == "serve-bus" && argc > 2) return serve_bus(argv[2]);
  if (role == "receive" && argc > 2) return receive(argv[2]);
  if (role == "ping") return ping(argument(2, 20'000));
  if (role == "world") {
    return world(argument(2, 10), static_cast<std::uint32_t>(argument(3, 10'000)), argument(4, 10));
  }
  std::fprintf(stderr, "usage: %s ping [COUNT] | world [RECEIVERS [ROBOTS [SECONDS]]]\n", argv[0]);
  return 2;
}
