// SPDX-License-Identifier: Apache-2.0
#include "rave/bus_testing/peer_roles.hpp"

#include <poll.h>

#include <cmath>
#include <limits>

#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/bus_testing/peer_console.hpp"
#include "rave/bus_testing/sample_messages.hpp"

namespace rave::bus::testing {
namespace {

std::uint32_t number(const Arguments& arguments, const char* name) {
  const auto found = arguments.find(name);
  return found == arguments.end() ? 0 : static_cast<std::uint32_t>(std::stoul(found->second));
}

template <class Message>
bool await_reader(const Writer<Message>& writer) {
  while (writer.readers() == 0) {
    if (ended(5)) return false;
  }
  return true;
}

void idle(Bus& bus) {
  const auto writer = Writer<HostState>::create(bus);
  say("ready");
  while (!ended(-1)) continue;
}

/// Sends every packet back to who sent it, with its payload.
void echo(Bus& bus) {
  auto reader = Reader<Packet>::create(bus);
  auto writer = Writer<Packet>::create(bus);
  auto waits = WaitSet::create(bus);
  static_cast<void>(waits->add(*reader));
  say("ready");
  while (!ended(0)) {
    static_cast<void>(waits->wait(Duration{20'000'000}));
    reader->take([&](const Packet& packet) {
      Packet answer = packet;
      answer.to_robot = packet.from_robot;
      answer.from_robot = 77;
      static_cast<void>(writer->write(answer));
    });
  }
}

/// Five obstacles and robots, or as many as told, before anybody listens.
void furnish(Bus& bus, const Arguments& arguments) {
  auto obstacles = Writer<Obstacle>::create(bus);
  auto roster = Writer<RosterEntry>::create(bus);
  for (std::uint32_t i = 0; i < number(arguments, "count"); ++i) {
    NewBox obstacle(i);
    static_cast<void>(obstacles->write(obstacle.sample));
    RosterEntry entry{};
    entry.robot = i;
    put_text(entry.name, "robot" + std::to_string(i));
    static_cast<void>(roster->write(entry));
  }
  say("ready");
  pollfd input{STDIN_FILENO, POLLIN, 0};
  // A sign of life now and then, as every process gives it.
  while (::poll(&input, 1, 100) == 0) static_cast<void>(bus.take_events());
  // A byte on the input: the first obstacle is no more.
  char byte = 0;
  if (::read(STDIN_FILENO, &byte, 1) != 1) return;
  Obstacle first{};
  static_cast<void>(obstacles->dispose(first));
  say("disposed");
  while (!ended(-1)) continue;
}

/// A host of two robots that writes its steps as fast as it can.
void host(Bus& bus, const Arguments& arguments) {
  auto writer = Writer<HostState>::create(bus);
  say("ready");
  if (!await_reader(*writer)) return;
  const std::uint32_t which = number(arguments, "host");
  for (std::uint32_t step = 1; step <= number(arguments, "count"); ++step) {
    RobotArrays robots(2, step, 2 * which);
    HostState state{};
    state.host = which;
    state.step = step;
    robots.lend(state.resolved);
    static_cast<void>(writer->write(state));
  }
  say("written");
  while (!ended(-1)) continue;
}

/// Worlds of many robots, ten a second. With `nan`, the second robot is nowhere.
void world(Bus& bus, const Arguments& arguments) {
  auto writer = Writer<World>::create(bus);
  say("ready");
  if (!await_reader(*writer)) return;
  for (std::uint32_t step = 1; !ended(100); ++step) {
    RobotArrays robots(number(arguments, "robots"), step);
    if (arguments.contains("nan")) robots.x[1] = std::numeric_limits<double>::quiet_NaN();
    World sample{};
    sample.step = step;
    robots.lend(sample.robots);
    static_cast<void>(writer->write(sample));
  }
}

/// In the partition of the run, but with samples of another one, ten a second.
void stray(Bus& bus) {
  const auto writer = Writer<World>::create(bus);
  say("ready");
  if (!await_reader(*writer)) return;
  for (std::uint64_t step = 1; !ended(100); ++step) {
    World sample{};
    sample.run[0] = 1;
    sample.writer = 5;
    sample.step = step;
    dds_write(writer->handle(), &sample);
  }
}

/// A writer of the world that does not resend what gets lost.
void unreliable(Bus& bus) {
  const auto ours = Writer<World>::create(bus);
  const Qos qos = make_qos({.reliable = false});
  dds_create_writer(dds_get_publisher(ours->handle()), dds_get_topic(ours->handle()), qos.get(),
                    nullptr);
  say("ready");
  while (!ended(-1)) continue;
}

/// Tells of each world that has come, in a report of that step, whether that was by the local
/// transport.
void follow(Bus& bus, const Arguments& arguments) {
  auto worlds = Reader<WorldStep>::create(bus);
  auto reports = Writer<HostReport>::create(bus);
  auto waits = WaitSet::create(bus);
  static_cast<void>(waits->add(*worlds));
  say("ready");
  while (!ended(0)) {
    static_cast<void>(waits->wait(Duration{20'000'000}));
    worlds->take([&](const WorldStep& world, const dds_sample_info_t& info) {
      HostReport report{};
      report.host = number(arguments, "host");
      report.step = world.step;
      put_text(report.text, info.publication_handle == 0 ? "short" : "dds");
      static_cast<void>(reports->write(report));
    });
  }
}

}  // namespace

bool play(const std::string& role, Bus& bus, const Arguments& arguments) {
  if (role == "idle") return idle(bus), true;
  if (role == "echo") return echo(bus), true;
  if (role == "furnish") return furnish(bus, arguments), true;
  if (role == "host") return host(bus, arguments), true;
  if (role == "world") return world(bus, arguments), true;
  if (role == "follow") return follow(bus, arguments), true;
  if (role == "stray") return stray(bus), true;
  if (role == "unreliable") return unreliable(bus), true;
  return false;
}

}  // namespace rave::bus::testing
