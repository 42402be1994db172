// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/random.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/plugin/params.hpp"
#include "rave/robot/command.hpp"
#include "rave/robot/interface.hpp"
#include "rave/robot/reading.hpp"

namespace rave {

/// One sensor of one robot: the latest sample in memory of the host.
struct SensorView {
  const SampleHeader* header = nullptr;
  const void* records = nullptr;
};

/// What a program is given when it starts, as it crosses the interface. Programs use Setup.
struct ProgramSetup {
  RobotInfo robot;
  HostServices host;
  const SensorInfo* sensors = nullptr;
  std::uint64_t sensor_count = 0;
  const ControllerInfo* controllers = nullptr;
  std::uint64_t controller_count = 0;
  const ParamValue* params = nullptr;
  std::uint64_t param_count = 0;
  double period_s = 0;
};

/// One decision of one robot, as it crosses the interface. Programs use Percepts and Commands.
struct DecideItem {
  const SensorView* sensors = nullptr;  ///< In the order of ProgramSetup::sensors.
  Command* commands = nullptr;          ///< In the order of ProgramSetup::controllers.
  std::int64_t now_ns = 0;
  PoseReading pose;            ///< Reported pose in the world frame.
  std::uint32_t decision = 0;  ///< Counts from 0.
  std::uint32_t robot = 0;
  std::uint64_t seed = 0;
};

/// Names one sensor of a kind; found by name once, used every step.
template <class Record>
class SensorHandle {
 public:
  SensorHandle() = default;
  explicit SensorHandle(std::uint32_t index, const SensorInfo* info) : index_(index), info_(info) {}
  [[nodiscard]] bool valid() const noexcept { return info_ != nullptr; }
  [[nodiscard]] std::uint32_t index() const noexcept { return index_; }
  /// Name, mounting, rays and limits. The handle must be valid.
  [[nodiscard]] const SensorInfo& info() const noexcept { return *info_; }

 private:
  std::uint32_t index_ = 0;
  const SensorInfo* info_ = nullptr;
};

using RangesHandle = SensorHandle<float>;

/// Names one controller.
class ControllerHandle {
 public:
  ControllerHandle() = default;
  explicit ControllerHandle(std::uint32_t index) : index_(index), valid_(true) {}
  [[nodiscard]] bool valid() const noexcept { return valid_; }
  [[nodiscard]] std::uint32_t index() const noexcept { return index_; }

 private:
  std::uint32_t index_ = 0;
  bool valid_ = false;
};

namespace detail {
template <class Record>
constexpr ReadingKind kind_of() noexcept;
template <>
constexpr ReadingKind kind_of<float>() noexcept {
  return ReadingKind::kRanges;
}
template <>
constexpr ReadingKind kind_of<Sighting>() noexcept {
  return ReadingKind::kSightings;
}
template <>
constexpr ReadingKind kind_of<PoseReading>() noexcept {
  return ReadingKind::kPose;
}
template <>
constexpr ReadingKind kind_of<OdometryReading>() noexcept {
  return ReadingKind::kOdometry;
}
template <>
constexpr ReadingKind kind_of<NeighbourReading>() noexcept {
  return ReadingKind::kNeighbours;
}
template <>
constexpr ReadingKind kind_of<ContactReading>() noexcept {
  return ReadingKind::kContact;
}
template <>
constexpr ReadingKind kind_of<VelocityReading>() noexcept {
  return ReadingKind::kVelocity;
}
template <>
constexpr ReadingKind kind_of<double>() noexcept {
  return ReadingKind::kValues;
}
}  // namespace detail

/// What a program may ask when it starts: its robot's sensors, controllers and parameters. Valid
/// during the whole run.
class Setup {
 public:
  explicit Setup(const ProgramSetup& raw) noexcept : raw_(&raw) {}

  [[nodiscard]] std::string_view robot_name() const noexcept { return raw_->robot.name; }
  [[nodiscard]] std::string_view team() const noexcept { return raw_->robot.team; }
  [[nodiscard]] double robot_radius_m() const noexcept { return raw_->robot.radius_m; }
  /// Time between two decisions.
  [[nodiscard]] double period_s() const noexcept { return raw_->period_s; }
  [[nodiscard]] Params params() const noexcept {
    return Params(std::span(raw_->params, raw_->param_count));
  }
  [[nodiscard]] std::span<const SensorInfo> sensors() const noexcept {
    return {raw_->sensors, raw_->sensor_count};
  }

  /// The sensor `name` that gives `Record`s (float for ranges, Sighting, PoseReading, ...); with
  /// an empty name the first one that does. Error: kNotFound, naming those there are.
  template <class Record>
  [[nodiscard]] Result<SensorHandle<Record>> sensor(std::string_view name = {}) const {
    auto index = find_sensor(detail::kind_of<Record>(), name);
    if (!index) return tl::unexpected(index.error());
    return SensorHandle<Record>(*index, &raw_->sensors[*index]);
  }
  /// All sensors that give `Record`s, none is no error: for programs that take any suite.
  template <class Record>
  [[nodiscard]] std::vector<SensorHandle<Record>> all_sensors() const {
    std::vector<SensorHandle<Record>> found;
    for (std::uint32_t i = 0; i < raw_->sensor_count; ++i) {
      if (raw_->sensors[i].kind == detail::kind_of<Record>()) {
        found.emplace_back(i, &raw_->sensors[i]);
      }
    }
    return found;
  }
  /// The controller `name` that accepts `kind`; with an empty name the first one that does.
  [[nodiscard]] Result<ControllerHandle> controller(CommandKind kind,
                                                    std::string_view name = {}) const;

  /// A line in the log of the run, marked with the robot's name. May be called at any time.
  void log(std::string_view text) const noexcept { raw_->host.write(LogLevel::kInfo, text); }

 private:
  [[nodiscard]] Result<std::uint32_t> find_sensor(ReadingKind kind, std::string_view name) const;
  const ProgramSetup* raw_;
};

/// What a robot knows when it decides. A view: valid during decide().
class Percepts {
 public:
  explicit Percepts(const DecideItem& item) noexcept : item_(&item) {}

  [[nodiscard]] SimTime now() const noexcept { return {item_->now_ns}; }
  /// Where the robot is told to be, world frame, with its covariance.
  [[nodiscard]] const PoseReading& pose() const noexcept { return item_->pose; }

  /// The records of the latest sample; empty if none has come yet.
  template <class Record>
  [[nodiscard]] std::span<const Record> operator[](SensorHandle<Record> sensor) const noexcept {
    const SensorView& view = item_->sensors[sensor.index()];
    return {static_cast<const Record*>(view.records), view.header->count};
  }
  /// Stamp, sequence number and freshness of the latest sample.
  template <class Record>
  [[nodiscard]] const SampleHeader& header(SensorHandle<Record> sensor) const noexcept {
    return *item_->sensors[sensor.index()].header;
  }
  /// Random numbers of this decision: the same in every repetition of the run.
  [[nodiscard]] RandomStream random() const noexcept {
    return {item_->seed, item_->robot, kProgramDevice, item_->decision};
  }

  /// The device number under which programs draw random numbers.
  static constexpr std::uint32_t kProgramDevice = 0xffff0000U;

 private:
  const DecideItem* item_;
};

/// Where a program puts its decision. A controller that is given nothing keeps its last command
/// until its watchdog stops it.
class Commands {
 public:
  explicit Commands(const DecideItem& item) noexcept : item_(&item) {}

  void set(ControllerHandle controller, const Command& command) noexcept {
    item_->commands[controller.index()] = command;
  }
  /// Forward speed and turning rate (counter-clockwise positive).
  void velocity(ControllerHandle controller, double v_mps, double w_radps) noexcept {
    set(controller, velocity_command(v_mps, w_radps));
  }
  /// A point in the world frame to drive to; speed 0 leaves it to the controller.
  void goal(ControllerHandle controller, Vec2 p_WG, double speed_mps = 0) noexcept {
    set(controller, goal_command(p_WG.x, p_WG.y, speed_mps));
  }

 private:
  const DecideItem* item_;
};

/// The one class that the author of a robot program writes. One object per robot; start() comes
/// once before the first decide(); all calls of one object come from one thread at a time. A
/// program sees readings and gives commands; nothing tells it what is real and what is virtual.
class DecisionProcess {
 public:
  virtual ~DecisionProcess() = default;
  /// Looks up sensors and controllers. An error keeps the run from starting.
  virtual Status start(const Setup& setup) = 0;
  virtual void decide(const Percepts& percepts, Commands& commands) = 0;
};

/// The function table of a program.
struct ProgramOps {
  InstanceOps instance;
  int (*start)(void* instance, const ProgramSetup* setup, ErrorText* error) = nullptr;
  /// Decides for `count` robots whose instances lie side by side, `stride` bytes apart. Sets
  /// `failed[i]` to 1 and `error` for instances that threw, and goes on with the others.
  void (*decide)(void* first, std::uint64_t stride, const DecideItem* items, std::uint64_t count,
                 std::uint8_t* failed, ErrorText* error) = nullptr;
};

namespace detail {
template <class Program>
constexpr ProgramOps program_ops() noexcept {
  ProgramOps ops;
  ops.instance = instance_ops<Program>();
  ops.start = [](void* instance, const ProgramSetup* setup, ErrorText* error) {
    return guarded(error, [&] { return static_cast<Program*>(instance)->start(Setup(*setup)); });
  };
  ops.decide = [](void* first, std::uint64_t stride, const DecideItem* items, std::uint64_t count,
                  std::uint8_t* failed, ErrorText* error) {
    for (std::size_t i = 0; i < count; ++i) {
      if (failed[i] != 0) continue;
      const int status = guarded(error, [&]() -> Status {
        Commands commands(items[i]);
        instance_at<Program>(first, stride, i).Program::decide(Percepts(items[i]), commands);
        return {};
      });
      if (status != 0) {
        failed[i] = 1;
        error->slot = static_cast<std::uint32_t>(i);
      }
    }
  };
  return ops;
}
}  // namespace detail
}  // namespace rave
