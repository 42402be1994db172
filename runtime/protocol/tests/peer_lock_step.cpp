// SPDX-License-Identifier: Apache-2.0
// The other process of the tests of what processes say to each other: peer_lock_step ROLE
// name=value ...
#include <array>
#include <string>

#include "made_host_results.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/bus_testing/peer_console.hpp"
#include "rave/bus_testing/peer_roles.hpp"
#include "rave/protocol/host_results.hpp"
#include "rave/protocol/pulse.hpp"
#include "rave/protocol/step_messages.hpp"

namespace rave::bus::testing {
namespace {

using namespace lock_step;
using namespace lock_step::testing;

/// A manager that does nothing but collect.
void collect(Bus& bus) {
  HostResultsCollector collector;
  static_cast<void>(collector.open(bus));
  auto waits = WaitSet::create(bus);
  static_cast<void>(collector.wake(*waits));
  say("ready");
  while (!ended(0)) {
    static_cast<void>(waits->wait(Duration{20'000'000}));
    collector.take([](std::uint64_t, std::uint32_t) { return true; });
    for (const HostResults& whole : collector.hand_out()) say(whole_line(whole.host, whole.bytes));
  }
}

/// A host that waits for `managers` to be there. A byte on the input: its run is over; it gives
/// them two seconds to take what it knows.
void deliver(Bus& bus, const Arguments& arguments) {
  HostResultsSender sender;
  static_cast<void>(sender.open(bus));
  while (sender.readers() < std::stoul(arguments.at("managers"))) {
    if (ended(5)) return;
  }
  say("met");
  char byte = 0;
  if (::read(STDIN_FILENO, &byte, 1) != 1) return;
  const auto host = static_cast<std::uint32_t>(std::stoul(arguments.at("host")));
  const auto bytes = made_host_results(host, std::stoul(arguments.at("size")));
  const Status sent = sender.send(host, bytes, from_seconds(2));
  say(sent ? "sent" : sent.error().message);
  while (!ended(-1)) continue;
}

/// A host of three robots that says how it fares only when it has a reason. The first byte on the
/// input: there is who listens. Each other one: one more of its robots is real.
void pulse(Bus& bus) {
  Identity self;
  self.name = "left";
  self.robots = 3;
  Pulse pulse;
  static_cast<void>(pulse.open(bus, self, std::chrono::hours(1)));
  char begin = 0;
  if (::read(STDIN_FILENO, &begin, 1) != 1) return;
  for (bool known = false; !known;) {
    if (ended(5)) return;
    for (const BusEvent& event : bus.take_events()) {
      known = known || event.kind == EventKind::kReaderAppeared;
    }
  }
  std::uint32_t real = 0;
  while (true) {
    pulse.beat({});
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, 5) <= 0) continue;
    char byte = 0;
    if (::read(STDIN_FILENO, &byte, 1) <= 0) return;
    pulse.count_real(++real);
  }
}

/// A manager that knows nothing but to answer each report with an empty world of that step. It says
/// its writer id first.
void answer(Bus& bus, const Arguments& arguments) {
  auto reports = Reader<HostReport>::create(bus);
  auto worlds = Writer<WorldStep>::create(bus);
  auto waits = WaitSet::create(bus);
  static_cast<void>(waits->add(*reports));
  WorldMessage message;
  say(std::to_string(bus.writer()));
  while (!ended(0)) {
    static_cast<void>(waits->wait(Duration{20'000'000}));
    static_cast<void>(bus.take_events());
    reports->take([&](const HostReport& report) {
      sim::WorldStep world;
      world.begin(report.step, 0);
      auto sample = message.fill(world, {}, std::stoull(arguments.at("epoch")));
      message.address(std::array{report.writer});
      static_cast<void>(worlds->write(**sample));
    });
  }
}

}  // namespace

bool play(const std::string& role, Bus& bus, const Arguments& arguments) {
  if (role == "answer") return answer(bus, arguments), true;
  if (role == "collect") return collect(bus), true;
  if (role == "pulse") return pulse(bus), true;
  if (role == "deliver") return deliver(bus, arguments), true;
  return false;
}

}  // namespace rave::bus::testing
