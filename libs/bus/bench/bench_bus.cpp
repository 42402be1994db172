// SPDX-License-Identifier: Apache-2.0
// Measures the bus between processes of this machine and prints JSON.
//   bench_bus ping [COUNT]                     64 B there and back, beside UDP in the same run
//   bench_bus world [RECEIVERS [ROBOTS [S]]]   the world at 10 Hz to many processes
//   bench_bus crowd [PROCESSES [DEATHS]]       until all know all, and until a death is known
// It starts itself for the other processes.
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "child.hpp"
#include "crowd.hpp"
#include "ping.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "udp_ping.hpp"

namespace {

using namespace rave;
using namespace rave::bus;
using bench::Child;

/// A receiver waits no longer for the next world.
constexpr Duration kPatience{5'000'000'000};

double cpu_s(int who) {
  rusage usage{};
  ::getrusage(who, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/// Says that it knows the writer, takes worlds up to step `last`, and prints how many came and the
/// CPU time since the first.
int receive(const std::string& run, std::uint64_t last) {
  const auto bus = bench::join(run, "receiver");
  auto reader = Reader<World>::create(*bus);
  auto waits = WaitSet::create(*bus);
  static_cast<void>(waits->add(*reader));
  bench::wait_for(1, [&] { return reader->writers(); });
  std::printf("1\n");
  std::fflush(stdout);
  std::uint64_t newest = 0;
  std::uint64_t taken = 0;
  double start_s = 0;
  while (newest < last && waits->wait(kPatience) == Woken::kReady) {
    reader->take([&](const World& world) {
      if (taken == 0) start_s = cpu_s(RUSAGE_SELF);
      newest = world.step;
      ++taken;
    });
  }
  std::printf("%llu %.6f\n", static_cast<unsigned long long>(taken), cpu_s(RUSAGE_SELF) - start_s);
  return 0;
}

/// The arrays of a world of robots.
struct Robots {
  explicit Robots(std::uint32_t count)
      : id(count), values(6, std::vector<double>(count, 0.5)), stamps_ns(count) {
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
    borrow(robots.stamp_ns, stamps_ns);
  }
  std::vector<std::uint32_t> id;
  std::vector<std::vector<double>> values;
  std::vector<std::int64_t> stamps_ns;
};

int world(std::size_t receivers, std::uint32_t count, std::uint64_t seconds) {
  const std::string run = RunId::random().text();
  const auto bus = bench::join(run, "authority");
  auto writer = Writer<World>::create(*bus);
  std::vector<Child> children;
  const std::uint64_t last = 10 * seconds;
  for (std::size_t i = 0; i < receivers; ++i) {
    children.push_back(bench::start({"receive", run, std::to_string(last)}));
  }
  bench::wait_for(receivers, [&] { return writer->readers(); });
  // Each end finds the other for itself.
  for (const Child& child : children) static_cast<void>(bench::number_from(child));
  Robots robots(count);
  World sample{};
  robots.lend(sample.robots);
  const double own_start_s = cpu_s(RUSAGE_SELF);
  const auto begin = std::chrono::steady_clock::now();
  std::size_t failures = 0;
  for (std::uint64_t step = 1; step <= last; ++step) {
    std::this_thread::sleep_until(begin + std::chrono::milliseconds(100) * step);
    sample.step = step;
    if (!writer->write(sample)) ++failures;
  }
  const double own_s = cpu_s(RUSAGE_SELF) - own_start_s;
  double taken = 0;
  double used_s = 0;
  for (const Child& child : children) {
    taken += bench::number_from(child);
    used_s += bench::number_from(child);
    ::waitpid(child.process, nullptr, 0);
  }
  const auto all = static_cast<double>(seconds);
  std::printf(
      "{\"receivers\": %zu, \"robots\": %u, \"sent\": %llu, \"write_failures\": %zu, \"taken\": "
      "%.0f,"
      " \"missing\": %.0f, \"receivers_core_percent\": %.2f, \"writer_core_percent\": %.2f}\n",
      receivers, count, static_cast<unsigned long long>(last), failures, taken,
      static_cast<double>(receivers * last) - taken, 100 * used_s / all, 100 * own_s / all);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string role = argc > 1 ? argv[1] : "";
  const auto argument = [&](int index, unsigned long usual) {
    return argc > index ? std::strtoul(argv[index], nullptr, 10) : usual;
  };
  if (role == "serve-udp") return bench::serve_udp();
  if (role == "serve-bus" && argc > 2) return bench::serve_bus(argv[2], bench::Way::kWaitSet);
  if (role == "serve-listener" && argc > 2) {
    return bench::serve_bus(argv[2], bench::Way::kListener);
  }
  if (role == "serve-short" && argc > 2) return bench::serve_bus(argv[2], bench::Way::kShort);
  if (role == "receive" && argc > 3) return receive(argv[2], argument(3, 0));
  if (role == "attend" && argc > 4) bench::attend(argv[2], argv[3], argument(4, 0));
  if (role == "crowd") return bench::crowd(argument(2, 50), argument(3, 10));
  if (role == "ping") return bench::ping(argument(2, 20'000));
  if (role == "world") {
    return world(argument(2, 10), static_cast<std::uint32_t>(argument(3, 10'000)), argument(4, 10));
  }
  std::fprintf(stderr,
               "usage: %s ping [COUNT] | world [RECEIVERS [ROBOTS [SECONDS]]] | crowd [PROCESSES "
               "[DEATHS]]\n",
               argv[0]);
  return 2;
}
