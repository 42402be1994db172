// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "closing.hpp"
#include "fusion.hpp"
#include "guard_thread.hpp"
#include "instances.hpp"
#include "near_lists.hpp"
#include "opening_note.hpp"
#include "plugin_call.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/range_engine.hpp"

namespace rave::sim {

class Radio;

/// Members of a group that one thread takes at a time.
inline constexpr std::uint32_t kMemberBlock = 64;

/// One sensor of a type, for all robots of it. Vectors are indexed by member; after creation none
/// changes its size, so views into them stay valid.
/// In SensorSlots::refused_step.
inline constexpr std::int64_t kNeverRefused = INT64_MIN / 2;

struct SensorSlots {
  const SensorSpec* spec = nullptr;
  SensorInfo info;
  InstanceArray instances;  ///< One for all if virtual, one each if hardware.
  bool uses_fan = false;
  FanTable fan;
  std::vector<NearLists> near;  ///< Fans: what each block of members has near.
  std::uint32_t capacity = 0;
  std::uint32_t stride = 0;  ///< Bytes of all records of one member.
  bool collect = false;
  bool live = false;
  std::optional<double> max_age_s;  ///< Hardware that must not fall silent: see sensor_age.hpp.
  std::optional<Processing> processing;

  std::vector<SampleHeader> raw_headers;
  std::vector<std::byte> raw_records;
  std::vector<SampleHeader> headers;
  std::vector<std::byte> records;
  std::vector<std::uint32_t> bodies;  ///< Fans: what each reading met.
  std::vector<std::byte> driver_state;
  std::vector<std::byte> processing_state;
  std::vector<std::uint32_t> sequence;
  std::vector<std::uint8_t> failed;
  std::vector<std::int64_t> heard_ns;       ///< Hardware: stamp of the newest raw sample.
  std::vector<SampleQueue::Before> before;  ///< Hardware: what of it has been told.
  std::vector<std::int64_t> refused_step;   ///< Hardware: when one was refused last.
  std::vector<std::uint8_t> flip;           ///< Test hook: change a bit of the next delivery.
  std::vector<std::unique_ptr<SampleQueue>> queues;
  std::vector<std::uint8_t> open;       ///< Hardware: has to be closed.
  std::vector<std::byte> scratch;       ///< Hardware: one sample on its way.
  std::unique_ptr<FusionSlots> fusion;  ///< Hybrids: what their halves give.

  [[nodiscard]] bool is_virtual() const noexcept { return spec->virtual_ops != nullptr; }
  /// Whether samples wait in the processing chain. Where it is noise alone, a virtual sensor's are
  /// disturbed where they lie.
  [[nodiscard]] bool queued() const noexcept {
    return processing && !(is_virtual() && processing->noise_only());
  }
  [[nodiscard]] std::byte* records_of(std::size_t member) noexcept {
    return records.data() + stride * member;
  }
  [[nodiscard]] std::byte* raw_records_of(std::size_t member) noexcept {
    return raw_records.data() + stride * member;
  }
  [[nodiscard]] std::byte* processing_state_of(std::size_t member) noexcept {
    return processing_state.data() + processing->state_size() * member;
  }
};

struct ControllerSlots {
  const ControllerSpec* spec = nullptr;
  InstanceArray instances;
  std::vector<Command> last;                               ///< Given by the program.
  std::vector<std::int64_t> last_step;                     ///< When; -1: never.
  std::vector<std::unique_ptr<plugin::ParamSet>> changed;  ///< Null: as in the spec.
  std::vector<std::uint8_t> failed;
};

struct ActuatorSlots {
  const ActuatorSpec* spec = nullptr;
  InstanceArray instances;
  std::vector<Command> commands;
  std::vector<std::unique_ptr<plugin::ParamSet>> changed;  ///< Null: as in the spec.
  std::vector<std::uint8_t> failed;
  std::vector<std::string> trouble;  ///< Of hardware that failed: what its driver says.
  std::vector<std::uint8_t> obeys;
  std::vector<std::uint8_t> open;

  /// What its commands do; valid as long as the instances.
  [[nodiscard]] ActuatorDrive drive(std::size_t member) const noexcept {
    return {spec->virtual_ops != nullptr ? spec->virtual_ops->drive : spec->hardware_ops->drive,
            instances.at(member)};
  }
};

struct ProgramSlots {
  const ProgramSpec* spec = nullptr;
  InstanceArray instances;
  std::vector<ProgramSetup> setups;
  std::vector<DecideItem> items;
  std::vector<Command> commands;      ///< Members x controllers.
  std::vector<SensorView> views;      ///< Members x sensors.
  std::vector<std::uint64_t> states;  ///< By member: Commands::state() of this decision.
  std::vector<std::uint8_t> failed;
  std::vector<std::uint64_t> given;
  std::vector<std::unique_ptr<ProgramProcess>> processes;
  std::vector<std::unique_ptr<plugin::ParamSet>> changed;  ///< Null: as in the spec.
};

/// One piece of hardware that sensors and actuators share, for all robots of a type.
struct DeviceSlots {
  const DeviceSpec* spec = nullptr;
  InstanceArray instances;
  std::vector<HardwareDevice*> bases;  ///< The instances as sensors and actuators get them.
  std::vector<std::uint8_t> open;      ///< Has to be closed.
};

/// A real robot of a live run: its guard writes to its actuators.
struct GuardedMember {
  std::unique_ptr<GuardThread> thread;        ///< Null: the engine writes to them.
  std::vector<std::optional<SimTime>> given;  ///< By controller: when its last command was given.
  GuardNews news;                             ///< The last.
};

/// All robots of one type and what serves them.
struct RobotGroup {
  const RobotType* type = nullptr;
  std::vector<RobotId> members;
  std::vector<DeviceSlots> devices;  ///< Before what uses them: they are destroyed after it.
  std::vector<SensorSlots> sensors;
  std::vector<ControllerSlots> controllers;
  std::vector<ActuatorSlots> actuators;
  std::vector<GuardedMember> guards;  ///< Empty: none has a guard of its own.
  ProgramSlots program;
  std::vector<SensorInfo> sensor_infos;
  std::vector<ControllerInfo> controller_infos;
  std::vector<const char*> robot_names;  ///< Of all robots, for programs.
  /// Frame of the pose source since a hand-over, in the place of that of the type.
  std::optional<Pose2> X_WM;

  /// Whether an actuator of this robot executes commands.
  [[nodiscard]] bool obeys(std::size_t member) const noexcept {
    return std::any_of(actuators.begin(), actuators.end(),
                       [&](const ActuatorSlots& slots) { return slots.obeys[member] != 0; });
  }
  [[nodiscard]] bool is_pose_source(const SensorSlots& slots) const noexcept {
    return type->pose_from == static_cast<std::uint32_t>(&slots - sensors.data());
  }
  /// Whether its robots drive by this sensor, as far as the guard knows: its samples may neither
  /// fall silent nor begin anew.
  [[nodiscard]] bool relies_on(const SensorSlots& slots) const noexcept {
    return is_pose_source(slots) || slots.max_age_s.has_value();
  }
  [[nodiscard]] bool has_guard(std::size_t member) const noexcept {
    return !guards.empty() && guards[member].thread != nullptr;
  }
  /// The controller that speaks to an actuator: the one that was given a command last; before
  /// that, the first. Null: there is none.
  [[nodiscard]] const ControllerSlots* speaker(std::uint32_t actuator,
                                               std::size_t member) const noexcept {
    const ControllerSlots* active = nullptr;
    for (const ControllerSlots& controller : controllers) {
      if (controller.spec->actuator != actuator) continue;
      if (active == nullptr || controller.last_step[member] > active->last_step[member]) {
        active = &controller;
      }
    }
    return active;
  }
  [[nodiscard]] std::size_t index_of(const ControllerSlots& controller) const noexcept {
    return static_cast<std::size_t>(&controller - controllers.data());
  }
};

/// Where messages of one robot's drivers and program go.
struct RobotLog {
  LogSink* sink = nullptr;
  std::string source;
};

/// A driver or program of a robot, as messages name it.
struct NamedPart {
  const char* kind;  ///< "device", "sensor", ...
  const std::string& name;
  const std::string& driver;
  const SourceLocation& where;  ///< Of its driver in the robot file.
};

[[nodiscard]] inline NamedPart named_part(const char* kind, const DriverSpec& spec) {
  return {kind, spec.name, spec.driver, spec.where};
}

/// `status`; an error also names the robot, the part and its driver, and the place of the driver in
/// the robot file.
[[nodiscard]] Status of_part(const RobotSpec& robot, const NamedPart& part, Status status);

/// What a group needs to know of its engine while it is made.
struct GroupContext {
  const EngineSpec& spec;
  std::vector<RobotLog>& logs;  ///< By RobotId.
  const Radio* radio = nullptr;
  OpeningNote* opening = nullptr;          ///< Told of each driver that is about to be opened.
  const AnswerService* answers = nullptr;  ///< For programs that take orders.

  void note(const NamedPart& part) const {
    if (opening != nullptr) opening->set(part.kind, part.name, part.driver);
  }
};

/// The services and the description of one robot, for its drivers.
[[nodiscard]] HostServices services_of(RobotLog& log);
[[nodiscard]] RobotInfo info_of(const GroupContext& context, RobotId id);

/// The data for starting a driver or program of one robot.
template <class Setup>
[[nodiscard]] Setup setup_of(const GroupContext& context, RobotId id,
                             const plugin::ParamSet& params) {
  auto setup = setup_with<Setup>(params, services_of(context.logs[id.value()]));
  setup.robot = info_of(context, id);
  return setup;
}

[[nodiscard]] DeviceSetup device_setup(const GroupContext& context, RobotId id,
                                       const plugin::ParamSet& params);

/// Makes the devices, sensors and actuators of a group, but opens nothing. Errors name robot and
/// device; then the group is to be thrown away.
Status make_body(GroupContext context, RobotGroup& group);
/// Opens them as new; what was opened before an error is closed by close_group().
Status open_body(GroupContext context, RobotGroup& group);
/// Points programs to the samples of the group's sensors.
void show_sensors(RobotGroup& group);

/// Makes all instances of a group and starts them, except that hardware sensors are not opened yet.
/// Errors name robot and device.
Status make_group(GroupContext context, RobotGroup& group);
/// Puts everything back to how make_group left it. Hardware must be closed.
Status reset_group(GroupContext context, RobotGroup& group);
/// Opens the hardware sensors: from now on samples come.
Status open_sensors(GroupContext context, RobotGroup& group);
/// All that is open, in the order in which it has to be closed: devices after what uses them. It
/// counts as closed from now on.
[[nodiscard]] std::vector<ToClose> take_open(RobotGroup& group);
/// Closes hardware; after that nothing of the group runs any more.
void close_group(RobotGroup& group) noexcept;

}  // namespace rave::sim
