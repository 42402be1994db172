// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "programs/testing/plugin_under_test.hpp"
#include "rave/math/scalar.hpp"

namespace rave::testing {

/// A sensor of a test robot, with its latest sample.
struct RigSensor {
  std::string name;
  SensorInfo info;
  std::vector<double> bearings_rad;
  std::vector<std::byte> records;
  SampleHeader header;

  template <class Record>
  void give(const std::vector<Record>& values, std::int64_t stamp_ns) {
    records.resize(values.size() * sizeof(Record));
    if (!values.empty()) std::memcpy(records.data(), values.data(), records.size());
    header.count = static_cast<std::uint32_t>(values.size());
    header.stamp_ns = stamp_ns;
    ++header.sequence;
    header.fresh = 1;
  }
};

/// A communicator of a test robot: what came in, and what went out in the last decision.
struct RigRadio {
  explicit RigRadio(std::string radio_name) : name(std::move(radio_name)) {
    info = {name.c_str(), 64, 4096, 256, 0};
  }
  RigRadio(const RigRadio&) = delete;
  RigRadio& operator=(const RigRadio&) = delete;

  /// Puts a struct into the inbox, as if `from` had sent it at `stamp`.
  template <class T>
  void hear(std::uint32_t from, SimTime stamp, const T& message) {
    MessageHead head;
    head.from = from;
    head.stamp_ns = stamp.ns;
    in.put(head, std::as_bytes(std::span<const T, 1>(&message, 1)));
  }
  /// What was sent, as messages.
  [[nodiscard]] Messages sent() const { return Messages(out); }

  std::string name;
  CommunicatorInfo info;
  std::vector<MessageHead> heads = std::vector<MessageHead>(128);
  std::vector<std::byte> bytes = std::vector<std::byte>(8192);
  Mailbox in{heads.data(), bytes.data(), 64, 4096, 0, 0, 0, 0};
  Mailbox out{heads.data() + 64, bytes.data() + 4096, 64, 4096, 0, 0, 0, 0};
};

/// A test robot: what its program is told, and what it commands.
struct Rig {
  explicit Rig(const DriverInfo& info) : params(info) {}

  /// Sonars (cone_rad > 0) or rays at `bearings_rad`, all in the middle of the robot.
  RigSensor& add_ranges(std::vector<double> bearings_rad, double cone_rad, double max_m) {
    RigSensor& sensor = add(ReadingKind::kRanges, "ranges");
    sensor.bearings_rad = std::move(bearings_rad);
    sensor.info.capacity = static_cast<std::uint32_t>(sensor.bearings_rad.size());
    sensor.info.cone_rad = cone_rad;
    sensor.info.range_max_m = max_m;
    return sensor;
  }
  RigSensor& add(ReadingKind kind, std::string name) {
    sensors.emplace_back();
    sensors.back().name = std::move(name);
    sensors.back().info.kind = kind;
    return sensors.back();
  }
  RigRadio& add_radio(std::string name) { return radios.emplace_back(std::move(name)); }
  [[nodiscard]] const Command& command() const { return commands.front(); }

  ParamSet params;
  LogLines log;
  std::deque<RigSensor> sensors;
  std::deque<RigRadio> radios;
  std::vector<ControllerInfo> controllers{{"velocity", CommandKind::kVelocity, 0}};
  std::vector<Command> commands;
  std::uint64_t state = 0;  ///< Commands::state().
  PoseReading pose;
  std::uint32_t id = 0;
  double radius_m = 0.17;

  // Filled by the harness; the program keeps pointers into them.
  std::vector<SensorInfo> infos;
  std::vector<SensorView> views;
  std::vector<CommunicatorInfo> radio_infos;
  std::vector<CommunicatorView> radio_views;
  ProgramSetup setup;
};

/// Robots with one program, started and asked as the engine does: instances side by side, one call
/// for all of them.
class ProgramUnderTest {
 public:
  static constexpr double kPeriod_s = 0.1;

  ProgramUnderTest(RegisterPlugin register_plugin, std::string_view name)
      : plugin_(register_plugin, DriverKind::kProgram, name) {}
  ProgramUnderTest(const ProgramUnderTest&) = delete;
  ProgramUnderTest& operator=(const ProgramUnderTest&) = delete;
  ~ProgramUnderTest() {
    for (std::size_t i = 0; i < constructed_; ++i) ops().instance.destroy(slot(i));
    ::operator delete(memory_, std::align_val_t{ops().instance.alignment});
  }

  Rig& add_robot() {
    rigs.push_back(std::make_unique<Rig>(plugin_.info()));
    rigs.back()->id = static_cast<std::uint32_t>(rigs.size() - 1);
    return *rigs.back();
  }

  /// The text of the first error; empty if all robots started.
  std::string start(std::uint64_t seed) {
    seed_ = seed;
    memory_ = static_cast<std::byte*>(::operator new(ops().instance.size* rigs.size(),
                                                     std::align_val_t{ops().instance.alignment}));
    ErrorText error;
    for (const std::unique_ptr<Rig>& rig : rigs) {
      prepare(*rig);
      if (ops().instance.construct(slot(constructed_), &error) != 0) return error.text;
      ++constructed_;
      if (ops().start(slot(constructed_ - 1), &rig->setup, &error) != 0) return error.text;
    }
    return {};
  }

  /// Gives robot `i` what its rig's parameters say now; the reason if its program refuses.
  std::string update(std::size_t i = 0) {
    ErrorText error;
    const std::vector<ParamValue>& values = rigs[i]->params.values();
    return ops().update(slot(i), values.data(), values.size(), &error) == 0 ? "" : error.text;
  }

  void decide(SimTime now) { ASSERT_EQ(failure_of(now), ""); }

  /// Decides; the error of a robot whose program failed, empty if none did.
  std::string failure_of(SimTime now) {
    std::vector<DecideItem> items(rigs.size());
    for (std::size_t i = 0; i < rigs.size(); ++i) items[i] = item(*rigs[i], now);
    std::vector<std::uint8_t> failed(rigs.size());
    ErrorText error;
    ops().decide(memory_, ops().instance.size, items.data(), items.size(), failed.data(), &error);
    for (const std::uint8_t one : failed) {
      if (one != 0) return error.text;
    }
    for (auto& rig : rigs) {
      for (RigRadio& radio : rig->radios) radio.in.clear();
    }
    ++decision_;
    return {};
  }

  /// The map that the program of robot `i` keeps.
  [[nodiscard]] MapView map(std::size_t i = 0) const {
    MapView view;
    if (ops().map != nullptr) ops().map(slot(i), &view);
    return view;
  }

  std::vector<std::unique_ptr<Rig>> rigs;

 private:
  [[nodiscard]] const ProgramOps& ops() const { return plugin_.ops<ProgramOps>(); }
  [[nodiscard]] void* slot(std::size_t i) const { return memory_ + i * ops().instance.size; }

  void prepare(Rig& rig) {
    for (RigSensor& sensor : rig.sensors) {
      sensor.info.name = sensor.name.c_str();
      sensor.info.period_s = kPeriod_s;
      if (!sensor.bearings_rad.empty()) sensor.info.bearings_rad = sensor.bearings_rad.data();
      rig.infos.push_back(sensor.info);
    }
    for (RigRadio& radio : rig.radios) {
      rig.radio_infos.push_back(radio.info);
      rig.radio_views.push_back({&radio.in, &radio.out});
    }
    rig.setup.communicators = rig.radio_infos.data();
    rig.setup.communicator_count = rig.radio_infos.size();
    rig.commands.resize(rig.controllers.size());
    rig.views.resize(rig.sensors.size());
    rig.setup.robot.name = "robot";
    rig.setup.robot.id = rig.id;
    rig.setup.robot.radius_m = rig.radius_m;
    rig.setup.robot.seed = seed_;
    rig.setup.host = rig.log.host();
    rig.setup.sensors = rig.infos.data();
    rig.setup.sensor_count = rig.infos.size();
    rig.setup.controllers = rig.controllers.data();
    rig.setup.controller_count = rig.controllers.size();
    rig.setup.params = rig.params.values().data();
    rig.setup.param_count = rig.params.values().size();
    rig.setup.period_s = kPeriod_s;
  }

  DecideItem item(Rig& rig, SimTime now) {
    for (std::size_t i = 0; i < rig.sensors.size(); ++i) {
      rig.views[i] = {&rig.sensors[i].header, rig.sensors[i].records.data()};
    }
    DecideItem item;
    item.sensors = rig.views.data();
    item.commands = rig.commands.data();
    for (RigRadio& radio : rig.radios) radio.out.clear();
    item.communicators = rig.radio_views.data();
    item.now_ns = now.ns;
    item.pose = rig.pose;
    item.decision = decision_;
    item.robot = rig.id;
    item.seed = seed_;
    item.state = &rig.state;
    return item;
  }

  PluginUnderTest plugin_;
  std::byte* memory_ = nullptr;
  std::size_t constructed_ = 0;
  std::uint64_t seed_ = 0;
  std::uint32_t decision_ = 0;
};

/// Nothing is near, and the sensor that says so falls silent: what the one robot of a program
/// commands by a scan that is fresh, by the same when it is older than 0.3 s, when scans come
/// again, by one in which the ray ahead was not measured, and when it is measured again. The
/// program must not have been started; `beside` gives what else it needs to drive.
template <class Beside>
std::array<Command, 5> commands_by_age(ProgramUnderTest& program, const Beside& beside) {
  Rig& rig = *program.rigs.front();
  RigSensor& scanner = rig.add_ranges({-0.4, -0.2, 0, 0.2, 0.4}, 0, 8.0);
  scanner.info.max_age_s = 0.3;
  EXPECT_EQ(program.start(1), "");
  const std::vector<float> free(5, std::numeric_limits<float>::infinity());
  const auto decide = [&](double t_s) {
    beside();
    program.decide({from_seconds(t_s).ns});
    return rig.command();
  };
  std::array<Command, 5> commands;
  scanner.give(free, from_seconds(10).ns);
  (void)decide(10);
  commands[0] = decide(10.25);
  commands[1] = decide(10.4);
  scanner.give(free, from_seconds(10.5).ns);
  commands[2] = decide(10.5);
  std::vector<float> blind = free;
  blind[2] = std::numeric_limits<float>::quiet_NaN();
  scanner.give(blind, from_seconds(10.6).ns);
  commands[3] = decide(10.6);
  scanner.give(free, from_seconds(10.7).ns);
  commands[4] = decide(10.7);
  return commands;
}

/// Expects of commands_by_age() that neither an old scan nor a ray that was not measured is free
/// space. A robot that is blind ahead may turn.
inline void expect_stand_when_old_or_blind(const std::array<Command, 5>& commands) {
  EXPECT_NE(commands[0].value[0], 0);
  EXPECT_EQ(commands[1], velocity_command(0, 0));
  EXPECT_NE(commands[2].value[0], 0);
  EXPECT_NEAR(commands[3].value[0], 0, 1e-12);
  EXPECT_NE(commands[4].value[0], 0);
}

}  // namespace rave::testing
