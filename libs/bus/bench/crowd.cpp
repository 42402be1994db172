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

/// As many processes of one machine as `rave` looks for, with 50 hosts and some who look on.
constexpr int kMostProcesses = 64;

/// The same clock in all processes of a machine.
std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void say_now(const std::string& whom) {
  std::printf("%lld %s\n", static_cast<long long>(now_ns()), whom.c_str());
  std::fflush(stdout);
}

/// When the last of them says that `whom` is gone, or, of itself, that it knows all; in seconds
/// since `begin_ns`. On a machine that is too busy others are missed as well, for a while.
double last_s(const std::vector<Child>& children, std::int64_t begin_ns, double whom = -1) {
  double last_ns = 0;
  for (std::size_t i = 0; i < children.size(); ++i) {
    const double wanted = whom < 0 ? static_cast<double>(i) : whom;
    double when_ns = 0;
    double who = 0;
    do {
      when_ns = number_from(children[i]);
      who = number_from(children[i]);
    } while (who >= 0 && who != wanted);
    last_ns = std::max(last_ns, when_ns);
  }
  return 1e-9 * (last_ns - static_cast<double>(begin_ns));
}

void kill_process(const Child& child) {
  ::kill(child.process, SIGKILL);
  ::waitpid(child.process, nullptr, 0);
}

}  // namespace

void attend(const std::string& run, const std::string& name, std::size_t others) {
  const auto bus = join(run, name.c_str(), kMostProcesses);
  auto writer = Writer<HostInfo>::create(*bus);
  auto reader = Reader<HostInfo>::create(*bus);
  auto waits = WaitSet::create(*bus);
  static_cast<void>(waits->add(*reader));
  static_cast<void>(waits->add_events());
  HostInfo info{};
  put_text(info.name, name);
  static_cast<void>(writer->write(info));
  std::set<std::uint64_t> known;
  bool complete = false;
  while (true) {
    static_cast<void>(waits->wait(Duration{-1}));
    reader->take([&](const HostInfo& other) { known.insert(other.writer); });
    for (const BusEvent& event : bus->take_events()) {
      if (event.kind == EventKind::kParticipantLost) say_now(event.participant);
    }
    if (complete || known.size() < others || writer->readers() < others) continue;
    complete = true;
    say_now(name);
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
    children.push_back(start({"attend", run, std::to_string(i), std::to_string(processes - 1)}));
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
    const auto whom = static_cast<double>(children.size());
    std::printf("%s%.3f", death > 0 ? ", " : "", last_s(children, death_ns, whom));
  }
  std::printf("]}\n");
  for (const Child& child : children) kill_process(child);
  return 0;
}

}  // namespace rave::bus::bench
