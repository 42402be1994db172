// SPDX-License-Identifier: Apache-2.0
// The seeds of the bus fuzzer. One that begins with bytes which no reader accepts hardly comes past
// the first check, so they are made by the code that ships. After a change of a type, this test
// with RAVE_WRITE_SEEDS=1 in the environment writes those of the messages that it makes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "rave/base/file.hpp"
#include "rave/bus_testing/sample_messages.hpp"
#include "receive_any.hpp"

namespace rave::bus::testing {
namespace {

const std::filesystem::path kCorpus = RAVE_SOURCE_DIR "/libs/bus/tests/corpus_bus";

template <class Message>
Message sample() {
  Message message{};
  message.run[0] = 7;
  message.writer = 11;
  return message;
}

/// The seeds by name, each with its topic in front.
class Seeds {
 public:
  Seeds() {
    add_states();
    add_lock_step();
    add_processes();
  }
  [[nodiscard]] const std::map<std::string, std::string>& all() const { return all_; }

 private:
  template <class Message>
  void add(const std::string& name, const Message& message, std::string_view head = {}) {
    Receive receiver = receive<Message>;
    if constexpr (std::is_same_v<Message, HostReport> || std::is_same_v<Message, WorldStep>) {
      if (!head.empty()) receiver = receive_local<Message>;
    }
    const auto* const topic = std::find(std::begin(kTopics), std::end(kTopics), receiver);
    std::string bytes(1, static_cast<char>(topic - std::begin(kTopics)));
    bytes += head;
    for (const std::byte b : encode(message)) bytes += static_cast<char>(b);
    all_[name] = bytes;
  }
  void add_states() {
    RobotArrays robots(3, 1);
    auto world = sample<World>();
    robots.lend(world.robots);
    add("world", world);
    auto state = sample<HostState>();
    state.step = 3;
    robots.lend(state.resolved);
    add("host_state", state);
    auto robot = sample<RosterEntry>();
    put_text(robot.name, "r1");
    put_text(robot.team, "blue");
    add("roster", robot);
    const NewBox box(4);
    add("obstacle", box.sample);
    auto look = sample<Look>();
    std::vector<std::uint32_t> ids = {0, 2};
    borrow(look.maps, ids);
    add("look", look);
  }
  void add_lock_step() {
    RobotArrays robots(2, 1);
    std::vector<rave_wire_PoseReport> poses(1);
    std::vector<rave_wire_PoseSample> samples(1);
    std::vector<rave_wire_OrderPoint> points = {{1.5, -2}};
    std::vector<rave_wire_WorldInput> inputs(1);
    inputs[0].number = 1;
    inputs[0].author = 1;
    put_text(inputs[0].by, "lisa");
    borrow(inputs[0].points, points);
    auto report = sample<HostReport>();
    report.epoch = 5;
    report.step = 8;
    robots.lend(report.proposals);
    borrow(report.poses, poses);
    borrow(report.samples, samples);
    borrow(report.inputs, inputs);
    add("host_report", report);
    add("short_host_report", report, {"ravesw\1\1", 8});
    auto world = sample<WorldStep>();
    world.epoch = 5;
    world.step = 8;
    std::vector<std::uint8_t> flags(2);
    borrow(world.x_m, robots.x);
    borrow(world.y_m, robots.y);
    borrow(world.yaw_rad, robots.yaw);
    borrow(world.vx_mps, robots.vx);
    borrow(world.vy_mps, robots.vy);
    borrow(world.wz_radps, robots.wz);
    borrow(world.flags, flags);
    borrow(world.poses, poses);
    borrow(world.samples, samples);
    borrow(world.inputs, inputs);
    NewBox box(4);
    std::vector<rave_wire_ObstacleChange> changes = {box.sample.stands};
    borrow(world.obstacles, changes);
    add("world_step", world);
    add("short_world_step", world, {"ravesw\1\2", 8});
    auto run = sample<RunState>();
    put_text(run.scenario, "flock");
    run.step_s = 0.01;
    std::vector<rave_wire_HostSight> hosts(1);
    put_text(hosts[0].name, "left");
    borrow(run.hosts, hosts);
    add("run", run);
  }
  void add_processes() {
    auto host = sample<HostInfo>();
    put_text(host.name, "left");
    put_text(host.machine, "lab");
    add("host", host);
    auto process = sample<ProcessState>();
    process.number = 1;
    add("process", process);
    auto pong = sample<ClockPong>();
    pong.target = 12;
    pong.ping_received_ns = 1000;
    pong.pong_sent_ns = 2000;
    add("clock_pong", pong);
  }

  std::map<std::string, std::string> all_;
};

std::string content_of(const std::filesystem::path& file) {
  const auto text = read_file(file);
  return text ? *text : "";
}

TEST(BusSeeds, AreWhatTheCodeMakes) {
  const Seeds seeds;
  for (const auto& [name, bytes] : seeds.all()) {
    if (std::getenv("RAVE_WRITE_SEEDS") != nullptr) {
      std::ofstream(kCorpus / name, std::ios::binary) << bytes;
    }
    EXPECT_TRUE(content_of(kCorpus / name) == bytes)
        << name << " is of an older type; see the comment at the top of this file";
  }
}

TEST(BusSeeds, AreValidSamplesOfEveryTopic) {
  std::set<std::size_t> seeded;
  for (const auto& entry : std::filesystem::directory_iterator(kCorpus)) {
    const std::string seed = content_of(entry.path());
    ASSERT_FALSE(seed.empty()) << entry.path();
    EXPECT_TRUE(receive_any(std::as_bytes(std::span(seed)))) << entry.path();
    seeded.insert((static_cast<unsigned char>(seed[0]) & 0x7fU) % std::size(kTopics));
  }
  for (std::size_t topic = 0; topic < std::size(kTopics); ++topic) {
    EXPECT_TRUE(seeded.contains(topic)) << "no seed for topic " << topic << " of receive_any.hpp";
  }
}

}  // namespace
}  // namespace rave::bus::testing
