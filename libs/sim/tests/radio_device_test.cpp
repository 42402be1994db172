// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "rave/sim_testing/given.hpp"
#include "rave/sim_testing/radio_fixture.hpp"

namespace rave::sim::testing {
namespace {

/// A device that hands each packet to all the others of the process at once; what is sent may be
/// spoilt on the way, and it can be unplugged.
class Cable final : public Transmitter {
 public:
  ~Cable() override { close(); }
  Status configure(const HardwareSetup& setup, TransmitterDeclaration& declaration) override {
    declaration.max_packet_bytes = 200;
    declaration.network =
        static_cast<std::uint32_t>(static_cast<std::int64_t>(given(setup.parameters(), "network")));
    declaration.byte_rate = rate();
    declaration.boot = 1;
    return {};
  }
  Status open(PacketSink& sink) override {
    sink_ = &sink;
    plugs().push_back(&sink);
    return {};
  }
  Status send(std::span<const std::byte> packet) override {
    if (unplugged()) return fail(ErrorCode::kIo, "no cable");
    std::vector<std::byte> bytes(packet.begin(), packet.end());
    if (spoil()) bytes[30] ^= std::byte{4};
    for (PacketSink* plug : plugs()) {
      for (int i = 0; i < copies(); ++i) plug->receive(bytes.data(), bytes.size());
    }
    return {};
  }
  void close() override { std::erase(plugs(), sink_); }

  static std::vector<PacketSink*>& plugs() {
    static std::vector<PacketSink*> all;
    return all;
  }
  static double& rate() {
    static double value = 0;
    return value;
  }
  static bool& unplugged() {
    static bool value = false;
    return value;
  }
  static bool& spoil() {
    static bool value = false;
    return value;
  }
  static int& copies() {
    static int value = 1;
    return value;
  }

 private:
  PacketSink* sink_ = nullptr;
};

RobotType cabled_type(Numbers program = {}, Numbers model = {}, double network = 7) {
  static constexpr TransmitterOps kOps = detail::transmitter_ops<Cable>();
  RobotType type = simulated_type();
  TransmitterSpec spec;
  spec.name = spec.driver = "cable";
  spec.ops = &kOps;
  spec.params.add_number("network", network);
  type.transmitters.push_back(std::move(spec));
  add_communicator(type, model);
  type.program = chatter(program);
  return type;
}

class RadioDevice : public RadioTest {
 protected:
  void SetUp() override {
    RadioTest::SetUp();
    Cable::unplugged() = Cable::spoil() = false;
    Cable::copies() = 1;
    Cable::rate() = 0;
  }
};

/// What each robot was told by whom, as a sorted list.
std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> heard_by_all() {
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> all;
  for (const Heard& heard : Chatter::log()) all.emplace_back(heard.to, heard.from, heard.number);
  std::sort(all.begin(), all.end());
  return all;
}

TEST_F(RadioDevice, ChanceTakesTheSameMessagesAsInProcess) {
  const Numbers model = {{"loss", 0.4}};
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> found[2];
  for (const bool device : {false, true}) {
    Chatter::log().clear();
    EngineSpec spec;
    spec.seed = 5;
    RobotType type =
        device ? cabled_type({{"until", 50}}, model) : talking_type({{"until", 50}}, model);
    // Each number of a robot is said over both of its communicators in turn.
    add_communicator(type, model, "wire");
    add_robot(spec, std::move(type));
    add_twin(spec, {1, 0, 0});
    add_twin(spec, {2, 0, 0});
    const auto engine = make_engine(std::move(spec));
    run(*engine, 60);
    EXPECT_GT(engine->radio_counts().lost_chance, 100U);
    expect_balance(engine->radio_counts());
    found[device ? 1 : 0] = heard_by_all();
  }
  EXPECT_GT(found[0].size(), 300U);
  EXPECT_EQ(found[0], found[1]);
}

TEST_F(RadioDevice, ASenderThatDoesNotKnowItsPlaceIsWhereTheWorldHasIt) {
  EngineSpec spec;
  add_robot(spec, cabled_type({{"only", 9}}, {{"range_m", 5}}));
  add_twin(spec, {4, 0, 0});
  add_twin(spec, {-4, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 1);
  RadioPacket packet;
  packet.network = 7;
  packet.channel = radio_name_hash("air");
  packet.sender = radio_name_hash("r1");
  const std::uint32_t number = 4;
  packet.payload = std::as_bytes(std::span(&number, 1));
  std::byte room[100];
  const auto say = [&] {
    ++packet.sequence;
    const std::size_t size = encode(packet, room);
    for (PacketSink* plug : Cable::plugs()) plug->receive(room, size);
  };
  say();
  packet.sender = radio_name_hash("stranger");
  say();
  run(*engine, 2);
  // 4 m to the first, 8 m to the third; nobody knows where the stranger is.
  EXPECT_EQ(listeners(), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(engine->radio_counts().lost_range, 4U);
}

TEST_F(RadioDevice, TheRateOfADeviceHoldsForAllThatShareIt) {
  // 4 bytes over each of two communicators a step of 10 ms are 800 B/s.
  Cable::rate() = 400;
  EngineSpec spec;
  RobotType type = cabled_type({{"only", 0}});
  add_communicator(type, {}, "wire");
  add_robot(spec, std::move(type));
  add_twin(spec, {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 100);
  EXPECT_EQ(engine->radio_counts().offered, 200U);
  EXPECT_EQ(engine->radio_counts().sent, 100U);
}

/// Says a lot in the name of a robot: `count` packets to each in every step.
void flood(Engine& engine, const char* name, int steps, int count) {
  RadioPacket packet;
  packet.network = 7;
  packet.channel = radio_name_hash("air");
  packet.sender = radio_name_hash(name);
  std::byte room[100];
  for (int step = 0; step < steps; ++step) {
    for (int i = 0; i < count; ++i) {
      ++packet.sequence;
      packet.payload = std::as_bytes(std::span(&packet.sequence, 1));
      const std::size_t size = encode(packet, room);
      for (PacketSink* plug : Cable::plugs()) plug->receive(room, size);
    }
    run(engine, 1);
  }
}

TEST_F(RadioDevice, WhoFloodsIsNamedAndLosesItsOwnMessages) {
  Ears ears;
  EngineSpec spec;
  spec.log = &ears;
  add_robot(spec, cabled_type({{"until", 100}}, {{"messages", 8}}));
  add_twin(spec, {1, 0, 0});
  add_twin(spec, {2, 0, 0});
  const auto engine = make_engine(std::move(spec));
  flood(*engine, "stranger", 101, 1000);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const Heard& heard : Chatter::log()) ++count[{heard.to, heard.from}];
  for (std::uint32_t to = 0; to < 3; ++to) {
    for (std::uint32_t from = 0; from < 3; ++from) {
      EXPECT_EQ((count[{to, from}]), to == from ? 0 : 100) << from << " to " << to;
    }
    // Of it each gets what is left of its inbox: 8 messages, two of the others.
    EXPECT_EQ((count[{to, 3}]), 6 * 100 + 8);
  }
  EXPECT_GT(engine->radio_counts().overrun, 0U);
  EXPECT_GT(engine->radio_counts().lost_mailbox, 0U);
  expect_balance(engine->radio_counts());
  // Once for each robot that hears it.
  const std::string told = "transmitter `cable`: an unknown sender";
  std::size_t times = 0;
  for (auto at = ears.heard.find(told); at != std::string::npos;
       at = ears.heard.find(told, at + 1)) {
    ++times;
  }
  EXPECT_EQ(times, 3U) << ears.heard;
}

TEST_F(RadioDevice, RangeAndSightHoldForWhatADeviceCarries) {
  EngineSpec spec;
  add_robot(spec, cabled_type({{"only", 0}, {"until", 1}}, {{"range_m", 5}, {"sight", 1}}));
  add_twin(spec, {4.5, 0, 0});
  add_twin(spec, {0, 5.5, 0});
  add_twin(spec, {-2, 0, 0});
  spec.world.obstacles.push_back(box({-1, 0, 0}, 0.1, 1));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 3);
  EXPECT_EQ(listeners(), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(Chatter::log()[0].from, 0U);
  EXPECT_EQ(engine->radio_counts().lost_range, 1U);
  EXPECT_EQ(engine->radio_counts().lost_obstacle, 1U);
  EXPECT_EQ(engine->radio_counts().foreign, 1U);  // its own echo
  expect_balance(engine->radio_counts());
}

TEST_F(RadioDevice, OnlyTheAddresseeTakesAMessage) {
  for (const double to : {2.0, -2.0}) {
    Chatter::log().clear();
    EngineSpec spec;
    add_robot(spec, cabled_type({{"only", 0}, {"until", 1}, {"to", to}}));
    for (const double x_m : {1.0, 2.0, 3.0}) add_twin(spec, {x_m, 0, 0});
    for (const std::size_t r : {0U, 3U}) spec.robots[r].team = "red";
    const auto engine = make_engine(std::move(spec));
    run(*engine, 3);
    EXPECT_EQ(listeners(), (std::vector<std::uint32_t>{to == 2 ? 2U : 3U}));
  }
}

TEST_F(RadioDevice, RepeatedGarbledAndForeignPacketsAreCountedAndDropped) {
  EngineSpec spec;
  add_robot(spec, cabled_type({{"only", 0}}));
  add_twin(spec, {1, 0, 0});
  add_robot(spec, cabled_type({{"only", 0}}, {}, 8), {2, 0, 0});
  const auto engine = make_engine(std::move(spec));
  Cable::copies() = 3;
  run(*engine, 10);
  EXPECT_EQ(Chatter::log().size(), 9U);
  EXPECT_EQ(engine->radio_counts().repeated, 18U);
  Cable::copies() = 1;
  Cable::spoil() = true;
  run(*engine, 10);
  EXPECT_EQ(Chatter::log().size(), 10U);
  EXPECT_EQ(engine->radio_counts().garbled, 27U);
  const std::byte noise[7] = {};
  for (PacketSink* plug : Cable::plugs()) plug->receive(noise, sizeof noise);
  run(*engine, 1);
  EXPECT_EQ(Chatter::log().size(), 10U);
}

TEST_F(RadioDevice, LossAndReturnAreEvents) {
  EngineSpec spec;
  add_robot(spec, cabled_type({{"only", 0}}));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 2);
  Cable::unplugged() = true;
  Cable::plugs()[0]->fail("pulled", 6);
  auto events = run(*engine, 5);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, EventKind::kDriverFailed);
  EXPECT_EQ(events[0].text, "transmitter `cable`: pulled");
  EXPECT_EQ(engine->radio_counts().lost_device, 5U);
  Cable::unplugged() = false;
  Cable::plugs()[0]->recover();
  events = run(*engine, 5);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, EventKind::kDriverBack);
  EXPECT_EQ(engine->radio_counts().lost_device, 5U);
}

TEST_F(RadioDevice, SendersThatAreNoRobotsHereGetNumbers) {
  EngineSpec spec;
  add_robot(spec, cabled_type({{"only", 0}, {"until", 1}}));
  add_twin(spec, {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 1);
  const std::uint32_t number = 4;
  RadioPacket packet;
  packet.network = 7;
  packet.channel = radio_name_hash("air");
  packet.payload = std::as_bytes(std::span(&number, 1));
  std::byte room[100];
  for (const char* name : {"stranger", "another", "r1", "stranger"}) {
    packet.sender = radio_name_hash(name);
    ++packet.sequence;
    Cable::plugs()[0]->receive(room, encode(packet, room));
  }
  run(*engine, 1);
  std::vector<std::uint32_t> from;
  for (const Heard& heard : Chatter::log()) {
    if (heard.to == 0) from.push_back(heard.from);
  }
  EXPECT_EQ(from, (std::vector<std::uint32_t>{2, 3, 1, 2}));
}

TEST_F(RadioDevice, ACommunicatorWhoseMessagesDoNotFitIsRefused) {
  EngineSpec spec;
  RobotType type = cabled_type();
  static constexpr TransmitterOps kOps = [] {
    TransmitterOps ops = detail::transmitter_ops<Cable>();
    ops.configure = [](void*, const HardwareSetup*, TransmitterDeclaration* declaration,
                       ErrorText*) {
      declaration->max_packet_bytes = 100;
      return 0;
    };
    return ops;
  }();
  type.transmitters[0].ops = &kOps;
  add_robot(spec, std::move(type));
  const auto engine = Engine::create(std::move(spec));
  ASSERT_FALSE(engine);
  EXPECT_EQ(engine.error().text(),
            "robot `r0`, transmitter `cable` (driver `cable`): carries packets of up to 100 bytes, "
            "but communicator `air` sends messages of up to 64 bytes, 120 with their header");
}

}  // namespace
}  // namespace rave::sim::testing
