// SPDX-License-Identifier: Apache-2.0
#include "crowd.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <random>
#include <set>
#include <thread>
#include <vector>

#include "child.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"

namespace rave::bus::bench {
namespace {

/// As many processes of one machine as `rave` looks for.
constexpr int kMostProcesses = 100;

/// The same clock in all processes of a machine.
std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void say_now() {
  std::printf("%lld\n", static_cast<long long>(now_ns()));
  std::fflush(stdout);
}

/// When the last of them said the next thing, in seconds since `begin_ns`.
double last_s(const std::vector<Child>& children, std::int64_t begin_ns) {
  double last_ns = 0;
  for (const Child& child : children) last_ns = std::max(last_ns, number_from(child));
  return 1e-9 * (last_ns - static_cast<double>(begin_ns));
}

void kill_process(const Child& child) {
  ::kill(child.process, SIGKILL);
  ::waitpid(child.process, nullptr, 0);
}

}  // namespace

void attend(const std::string& run, std::size_t others) {
  const auto bus = join(run, "one of many", kMostProcesses);
  auto writer = Writer<HostInfo>::create(*bus);
  auto reader = Reader<HostInfo>::create(*bus);
  auto waits = WaitSet::create(*bus);
  static_cast<void>(waits->add(*reader));
  static_cast<void>(waits->add_events());
  HostInfo info{};
  put_text(info.name, "one");
  static_cast<void>(writer->write(info));
  std::set<std::uint64_t> known;
  bool complete = false;
  while (true) {
    static_cast<void>(waits->wait(Duration{-1}));
    reader->take([&](const HostInfo& other) { known.insert(other.writer); });
    for (const BusEvent& event : bus->take_events()) {
      if (event.kind == EventKind::kParticipantLost && event.writer != 0) say_now();
    }
    if (complete || known.size() < others || writer->readers() < others) continue;
    complete = true;
    say_now();
  }
}

int crowd(std::size_t processes, std::size_t deaths) {
  if (processes < 2 || processes > kMostProcesses || deaths + 2 > processes) {
    std::fprintf(stderr, "2 to %d processes, of which two are left\n", kMostProcesses);
    return 2;
  }
  const std::string run = RunId::random().text();
  const std::int64_t begin_ns = now_ns();
  std::vector<Child> children;
  for (std::size_t i = 0; i < processes; ++i) {
    children.push_back(start({"attend", run, std::to_string(processes - 1)}));
  }
  const double together_s = last_s(children, begin_ns);
  std::printf("{\"processes\": %zu, \"all_know_all_s\": %.3f, \"death_known_s\": [", processes,
              together_s);
  // Its last sign of life is not in step with its death.
  std::mt19937 chance(1);
  for (std::size_t death = 0; death < deaths; ++death) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1000 + chance() % 1000));
    const std::int64_t death_ns = now_ns();
    kill_process(children.back());
    children.pop_back();
    std::printf("%s%.3f", death > 0 ? ", " : "", last_s(children, death_ns));
  }
  std::printf("]}\n");
  for (const Child& child : children) kill_process(child);
  return 0;
}

}  // namespace rave::bus::bench
