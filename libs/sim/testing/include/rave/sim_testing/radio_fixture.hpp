// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>

#include "rave/sim_testing/engine_fixture.hpp"
#include "rave/sim_testing/given.hpp"

/// Robots that talk, for tests of the radio.
namespace rave::sim::testing {

/// One message as its receiver saw it.
struct Heard {
  std::uint32_t to = 0;
  std::uint32_t from = 0;
  std::int64_t step = 0;  ///< Of 10 ms.
  std::int64_t stamp_ns = 0;
  std::uint32_t number = 0;  ///< First four bytes.
  std::size_t size = 0;
};

/// Sends `count` messages of `size` bytes in decisions 0 to `until` - 1 (0: always) over each of
/// its communicators and writes down all that it hears. `to`: -1 everyone, -2 its team, else a
/// robot.
class Chatter final : public DecisionProcess {
 public:
  /// Belongs to the one test that runs an engine.
  static std::vector<Heard>& log() {
    static std::vector<Heard> all;
    return all;
  }
  static std::mutex& mutex() {
    static std::mutex guard;
    return guard;
  }
  Status start(const Setup& setup) override {
    const Params params = setup.params();
    for (const char* name : {"air", "wire"}) {
      const auto found = setup.communicator(name);
      if (found) radios_.push_back(*found);
    }
    own_ = setup.own_id();
    count_ = static_cast<std::int64_t>(given(params, "count"));
    size_ = static_cast<std::size_t>(static_cast<std::int64_t>(given(params, "size")));
    until_ = static_cast<std::int64_t>(given(params, "until"));
    to_ = static_cast<std::int64_t>(given(params, "to"));
    only_ = static_cast<std::int64_t>(given(params, "only"));
    throw_at_ = static_cast<std::int64_t>(given(params, "throw_at"));
    return {};
  }
  void decide(const Percepts& percepts, Commands& commands) override {
    const std::int64_t step = percepts.now().ns / 10'000'000;
    for (const CommunicatorHandle radio : radios_) {
      for (const Message message : percepts.messages(radio)) {
        Heard heard{own_, message.from, step, message.stamp.ns, 0, message.bytes.size()};
        std::memcpy(&heard.number, message.bytes.data(), 4);
        const std::lock_guard lock(mutex());
        log().push_back(heard);
      }
    }
    const std::int64_t decision = decision_++;
    if (until_ > 0 && decision >= until_) return;
    if (only_ >= 0 && own_ != static_cast<std::uint32_t>(only_)) return;
    std::vector<std::byte> bytes(size_);
    for (const CommunicatorHandle radio : radios_) {
      for (std::int64_t i = 0; i < count_; ++i) {
        ++number_;
        std::memcpy(bytes.data(), &number_, 4);
        commands.send(radio, std::span<const std::byte>(bytes), recipient());
      }
    }
    if (throw_at_ > 0 && decision == throw_at_) throw std::runtime_error("out of words");
  }

 private:
  [[nodiscard]] Recipient recipient() const {
    if (to_ == -1) return Recipient::everyone();
    return to_ == -2 ? Recipient::team() : Recipient::one(static_cast<std::uint32_t>(to_));
  }
  std::vector<CommunicatorHandle> radios_;
  std::uint32_t own_ = 0;
  std::int64_t count_ = 0;
  std::size_t size_ = 4;
  std::int64_t until_ = 0;
  std::int64_t to_ = -1;
  std::int64_t only_ = -1;
  std::int64_t throw_at_ = 0;
  std::int64_t decision_ = 0;
  std::uint32_t number_ = 0;
};

inline ProgramSpec chatter(Numbers values) {
  std::map<std::string, double> all{{"count", 1}, {"size", 4},  {"until", 0},
                                    {"to", -1},   {"only", -1}, {"throw_at", 0}};
  for (const auto& [name, value] : values) all[name] = value;
  ProgramSpec spec;
  spec.driver = "chatter";
  spec.ops = program_table<Chatter>();
  for (const auto& [name, value] : all) spec.params.add_number(name, value);
  return spec;
}

/// Says one thing to all in each decision.
class Beaconing final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    RAVE_TRY_ASSIGN(radio_, setup.communicator());
    return {};
  }
  void decide(const Percepts& percepts, Commands& commands) override {
    const PoseReading& pose = percepts.pose();
    const double message[] = {pose.x_m, pose.y_m, 0, 0};
    commands.send(radio_, std::as_bytes(std::span<const double>(message)));
  }

 private:
  CommunicatorHandle radio_;
};

/// All of a declaration by its name; draws losses and delays.
class Model final : public Communicator {
 public:
  Status start(const DeviceSetup& setup, RadioDeclaration& radio) override {
    const Params params = setup.parameters();
    const auto whole = [&](const char* name) {
      return static_cast<std::uint32_t>(params.integer(name));
    };
    radio.range_m = given(params, "range_m");
    radio.line_of_sight = whole("sight");
    radio.byte_rate = given(params, "rate");
    radio.max_queue_bytes = whole("queue");
    radio.overhead_bytes = whole("overhead");
    radio.max_messages = whole("messages");
    radio.max_message_bytes = 64;
    radio.max_mailbox_bytes = 64 * radio.max_messages;
    delay_s_ = given(params, "delay_s");
    jitter_s_ = given(params, "jitter_s");
    loss_ = given(params, "loss");
    throws_ = (given(params, "throws") != 0);
    return {};
  }
  [[nodiscard]] LinkAnswer link(const LinkQuery& query) const override {
    if (throws_) throw std::runtime_error("no idea");
    RandomStream random = query.random();
    LinkAnswer answer;
    answer.arrives = query.obstructed == 0 && random.uniform() >= loss_ ? 1 : 0;
    answer.delay_s = delay_s_ + jitter_s_ * random.uniform();
    return answer;
  }

 private:
  double delay_s_ = 0;
  double jitter_s_ = 0;
  double loss_ = 0;
  bool throws_ = false;
};

/// Carried by the host.
class Ether final : public Transmitter {
 public:
  Status configure(const HardwareSetup& setup, TransmitterDeclaration& declaration) override {
    declaration.in_process = 1;
    declaration.byte_rate = given(setup.parameters(), "rate");
    return {};
  }
  Status open(PacketSink&) override { return {}; }
  Status send(std::span<const std::byte>) override { return {}; }
  void close() override {}
};

inline void add_transmitter(RobotType& type, double rate = 0) {
  static constexpr TransmitterOps kOps = detail::transmitter_ops<Ether>();
  TransmitterSpec spec;
  spec.name = spec.driver = "ether";
  spec.ops = &kOps;
  spec.params.add_number("rate", rate);
  type.transmitters.push_back(std::move(spec));
}

inline void add_communicator(RobotType& type, Numbers values = {},
                             const std::string& name = "air") {
  static constexpr CommunicatorOps kOps = detail::communicator_ops<Model>();
  std::map<std::string, double> all{
      {"range_m", 0},    {"sight", 0},   {"rate", 0},     {"queue", 0}, {"overhead", 0},
      {"messages", 256}, {"delay_s", 0}, {"jitter_s", 0}, {"loss", 0},  {"throws", 0}};
  for (const auto& [key, value] : values) all[key] = value;
  CommunicatorSpec spec;
  spec.name = name;
  spec.driver = "model";
  spec.ops = &kOps;
  for (const auto& [key, value] : all) spec.params.add_number(key, value);
  spec.transmitter = static_cast<std::uint32_t>(type.transmitters.size() - 1);
  type.communicators.push_back(std::move(spec));
}

/// A simulated robot that talks.
inline RobotType talking_type(Numbers program = {}, Numbers model = {}) {
  RobotType type = simulated_type();
  add_transmitter(type);
  add_communicator(type, model);
  type.program = chatter(program);
  return type;
}

/// Those who heard something, without repetition.
inline std::vector<std::uint32_t> listeners() {
  std::vector<std::uint32_t> all;
  for (const Heard& heard : Chatter::log()) all.push_back(heard.to);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// What the header promises of the counts, for a run in which all has arrived.
inline void expect_balance(const RadioCounts& c) {
  EXPECT_EQ(c.offered, c.sent + c.lost_queue + c.lost_device);
  EXPECT_EQ(c.addressed,
            c.delivered + c.lost_range + c.lost_obstacle + c.lost_chance + c.lost_mailbox);
}

class RadioTest : public ::testing::Test {
 protected:
  void SetUp() override { Chatter::log().clear(); }
};

}  // namespace rave::sim::testing
