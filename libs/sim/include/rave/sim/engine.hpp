// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/hash.hpp"
#include "rave/sim/authority_state.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/event.hpp"
#include "rave/sim/host_report.hpp"
#include "rave/sim/reported_pose.hpp"
#include "rave/sim/world_input.hpp"
#include "rave/sim/world_step.hpp"
#include "rave/world/snapshot.hpp"

namespace rave::sim {

/// The latest sample of one sensor of one robot, for observers and recordings. Views into the
/// engine.
struct SensorSample {
  const SensorInfo* info = nullptr;
  const SampleHeader* header = nullptr;
  const void* records = nullptr;
  /// Fans: the body that each reading hit; BodyId::kNone for none.
  std::span<const std::uint32_t> bodies;
};

/// The readings of both halves of a hybrid sensor behind its newest fused reading, each with the
/// noise of its half; for observers and recordings, never for programs. Views into the engine; null
/// if the sensor is not hybrid. Both have the stamp and sequence of the fused reading, whose
/// delivery to the program may still be delayed by latency.
struct SensorParts {
  const SampleHeader* real = nullptr;
  const void* real_records = nullptr;
  const SampleHeader* imagined = nullptr;  ///< The virtual half.
  const void* imagined_records = nullptr;
  std::span<const std::uint32_t> bodies;  ///< Ranges: the body that each virtual reading hit.
};

/// The latest samples of one sensor of all robots of a type, by member; for observers that read all
/// samples in each step. Views into the engine.
struct SampleColumns {
  std::span<const SampleHeader> headers;
  const std::byte* records = nullptr;  ///< Records of the first member.
  std::uint32_t stride_bytes = 0;      ///< From one member's records to the next.
};

/// The last commands of the programs of a type to one controller, and the steps in which they were
/// given (-1: never), by member. Views into the engine.
struct CommandColumns {
  std::span<const Command> commands;
  std::span<const std::int64_t> steps;
};

/// Runs the world in steps: sense (const world), decide (const percepts), act (drivers propose
/// motions), resolve (the world limits them), publish. Belongs to one thread and uses others inside
/// step(). Between steps everything may be read. The same spec gives the same run with any number
/// of threads.
///
/// With EngineSpec::local it runs only these robots, as one of several hosts. Then propose() and
/// apply() alternate instead of step(), with a WorldAuthority between them. Sensors, commands,
/// programs, devices and groups can then be queried for these robots only.
class Engine {
 public:
  /// Creates all instances, opens hardware, starts programs. Errors: those of drivers and programs,
  /// with the name of robot and device.
  [[nodiscard]] static Result<std::unique_ptr<Engine>> create(EngineSpec spec);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  ~Engine();

  /// Computes one step. Errors end the run: a stepped driver that does not answer; kState (the
  /// world has other hosts).
  Status step();

  /// For one of several hosts: completes the step that apply() began (none at first), reads
  /// hardware samples for the next one, and fills in the report for the authority, except for the
  /// number of the host. Errors: kState (apply() comes first; the engine is alone); those of
  /// step(), which end the run and are also written into the report.
  Status propose(HostReport& report);
  /// Begins the next step with the world of the authority. Errors: kState (propose() comes first;
  /// the engine is alone), kInvalidArgument (another step or another world; nothing changes);
  /// kPlugin and those of step() end the run.
  Status apply(const WorldStep& world);
  /// Like apply(), but the world may be of a later step than the proposed one: the other hosts
  /// continued while this one was away. Its robots continue at their poses in that world, with the
  /// present state of programs and controllers; messages of the skipped steps are lost to them.
  /// `state`: the authority's state for that world; sizes and obstacles are used. Errors: those of
  /// apply().
  Status join(const WorldStep& world, const AuthorityState& state);
  /// Whether this engine runs the robot.
  [[nodiscard]] bool is_local(RobotId robot) const noexcept;

  /// Restores the exact state after create(); the same steps follow.
  Status reset();

  [[nodiscard]] const EngineSpec& spec() const noexcept;
  /// The number of completed steps, which is the number of the next step.
  [[nodiscard]] std::uint64_t steps_done() const noexcept;
  /// Time of the snapshot, at which the last step sensed.
  [[nodiscard]] SimTime time() const noexcept;
  /// The world that the last step sensed.
  [[nodiscard]] const world::Snapshot& snapshot() const noexcept;
  /// The reported pose. For robots of other hosts: as at the beginning of the last step.
  [[nodiscard]] const ReportedPose& reported(RobotId robot) const noexcept;
  /// True pose of a simulated robot after the last step. With several hosts: as in the world of
  /// apply().
  [[nodiscard]] Pose2 true_pose(RobotId robot) const noexcept;
  /// The latest sample of a sensor; `index` in the order of the robot's type.
  [[nodiscard]] SensorSample sensor(RobotId robot, std::uint32_t index) const noexcept;
  /// The map that the program of a robot keeps; without cells if it keeps none, or if the program
  /// runs in a process of its own or on another host. Valid until the next step.
  [[nodiscard]] MapView program_map(RobotId robot) const noexcept;
  /// The readings of both halves behind a hybrid sensor's newest reading; null for other sensors.
  [[nodiscard]] SensorParts sensor_parts(RobotId robot, std::uint32_t index) const noexcept;
  /// The last command of the program to a controller.
  [[nodiscard]] Command command(RobotId robot, std::uint32_t controller) const noexcept;
  /// The step in which command() was given; -1 before the first.
  [[nodiscard]] std::int64_t command_step(RobotId robot, std::uint32_t controller) const noexcept;
  /// The command that the last step passed from the active controller to an actuator; kNone without
  /// one. For a real robot in a live run: the last one that its guard had written by the end of the
  /// step.
  [[nodiscard]] const Command& actuator_command(RobotId robot,
                                                std::uint32_t actuator) const noexcept;
  // Access to all robots of one type at once. Types in use are numbered from 0; their robots are
  // members.
  [[nodiscard]] std::uint32_t group_count() const noexcept;
  /// RobotIds, ascending.
  [[nodiscard]] std::span<const RobotId> members(std::uint32_t group) const noexcept;
  [[nodiscard]] const RobotType& type_of(std::uint32_t group) const noexcept;
  [[nodiscard]] SampleColumns samples(std::uint32_t group, std::uint32_t sensor) const noexcept;
  [[nodiscard]] CommandColumns commands(std::uint32_t group,
                                        std::uint32_t controller) const noexcept;
  /// Like actuator_command(), by member.
  [[nodiscard]] std::span<const Command> actuator_commands(std::uint32_t group,
                                                           std::uint32_t actuator) const noexcept;

  /// The number of commands of the program so far, and whether its actuator executes them.
  [[nodiscard]] std::uint64_t commands_given(RobotId robot) const noexcept;
  [[nodiscard]] bool obeys(RobotId robot) const noexcept;
  /// False once the robot's program has failed.
  [[nodiscard]] bool program_alive(RobotId robot) const noexcept;
  /// The report() of a hardware sensor (JSON); `{}` for virtual ones.
  [[nodiscard]] std::string sensor_report(RobotId robot, std::uint32_t index) const;
  /// The report() of a device of RobotType::devices (JSON).
  [[nodiscard]] std::string device_report(RobotId robot, std::uint32_t index) const;
  /// The report() of a transmitter (JSON); `{}` for in-process ones.
  [[nodiscard]] std::string transmitter_report(RobotId robot, std::uint32_t index) const;
  /// Counts of all messages so far.
  [[nodiscard]] const RadioCounts& radio_counts() const noexcept;
  /// Messages sent or delivered in the last step, in order of occurrence.
  [[nodiscard]] std::span<const RadioTrace> radio() const noexcept;
  /// Events of the last step, ordered by robot. One of several hosts has the events of its own
  /// robots; the authority has contacts, pins, and changes of bodies and obstacles.
  [[nodiscard]] std::span<const Event> events() const noexcept;
  /// The hash of the completed steps. One of several hosts: of percepts, commands, messages and
  /// events of its robots.
  [[nodiscard]] RunHash hash() const noexcept;
  /// Time that the steps so far took; all zero without EngineSpec::phase_clock.
  [[nodiscard]] const PhaseTimes& phase_times() const noexcept;
  /// Flips one bit of the next percept of a sensor with records, before delivery and hashing. For
  /// the test that the hash detects it.
  void flip_percept_bit(RobotId robot, std::uint32_t sensor) noexcept;

  /// The reading of a virtual sensor of `robot` at `stamp`, within the history: the world and the
  /// robot's pose are interpolated at that time. Noise, latency and filters are not applied.
  /// `records` must have room for the sensor's capacity. Errors: kInvalidArgument (not a virtual
  /// sensor, outside the history).
  [[nodiscard]] Result<SampleHeader> sample_at(RobotId robot, std::uint32_t sensor, SimTime stamp,
                                               void* records);
  /// The pose of a robot at a time within the history.
  [[nodiscard]] Result<Pose2> pose_at(RobotId robot, SimTime stamp) const;

  // Inputs between two steps. They take effect with the next step, are events of it and part of the
  // hash. An invalid `robot` means all robots. With several hosts, call these for robots of this
  // host only; use WorldAuthority::ask() for others.

  /// Stops robots, whatever their programs command, until release(). Applies to real and simulated
  /// robots.
  void stop(RobotId robot, const Author& author = Author::kHand);
  /// Ends a stop. A robot with `arm` must then be armed again.
  void release(RobotId robot, const Author& author = Author::kHand);
  /// Permits robots with `arm` to move; does not end a stop.
  void arm(RobotId robot, const Author& author = Author::kHand);
  [[nodiscard]] bool stopped(RobotId robot) const noexcept;
  /// False: the robot does not move until it is armed.
  [[nodiscard]] bool armed(RobotId robot) const noexcept;
  /// What else keeps a robot of this process from moving, for people: a sensor without samples, a
  /// lost pose, a failed driver or program. Empty: nothing.
  [[nodiscard]] std::string lacks(RobotId robot) const;
  /// Why hardware of the robot takes no commands, as its driver says; empty: it takes them, or
  /// there is none here.
  [[nodiscard]] std::string drive_trouble(RobotId robot) const;
  /// Changes parameters of one robot, all or none. Errors: kInvalidArgument and kNotFound (unknown,
  /// out of range, refused by the driver or program, a body that would overlap something), kState
  /// (its program has failed; the authority changes bodies). After an error nothing has changed.
  Status set_parameters(RobotId robot, std::span<const ParameterChange> changes,
                        const Author& author = Author::kHand);
  /// Adds, moves or removes an obstacle. spec().world and snapshot() show the change at once;
  /// queries of the history show it from the next step on. Errors: kInvalidArgument and kNotFound
  /// (see ObstacleChange; it would overlap a simulated robot), kState (with several hosts the
  /// authority changes obstacles). After an error nothing has changed.
  Result<ChangedObstacle> change_obstacle(const ObstacleChange& change,
                                          const Author& author = Author::kHand);
  /// Begins a hand-over of a robot to its other drivers, RobotSpec::twin. It opens them, stops the
  /// robot, and switches between two steps once the robot stands and the new drivers report its
  /// pose. Program and controllers continue. The result is an event, kHandedOver or
  /// kHandOverRefused. Errors: kInvalidArgument (it has one set of drivers), kState (a hand-over is
  /// in progress; the set is already active; its body is scaled).
  Status hand_over(RobotId robot, DriverSet to, const Author& author = Author::kHand);
  /// The hand-over state; empty for a robot with one set of drivers.
  [[nodiscard]] std::optional<HandOverState> hand_over_state(RobotId robot) const;
  /// Sets whether the real or the simulated drivers of a robot of another host are active. Sensors
  /// use it from the next step on. Call it between two steps. Returns false, and nothing changes,
  /// if the robot has no such drivers.
  bool show_reality(RobotId robot, bool simulated);
  /// Gives a robot an order of a user (request::Order). A velocity replaces the commands of
  /// its program. Goals, paths and texts go to the program if it takes them, otherwise a goal goes
  /// to a controller that accepts it. kPlace moves a simulated robot. A stop ends orders. Errors:
  /// kInvalidArgument (non-finite numbers, points out of range, an order that the robot does not
  /// take, a place where it would overlap something), kState (it is stopped, not armed, in a
  /// hand-over, lost, or of another host; with several hosts the authority places). After an error
  /// nothing has changed.
  Status order(const WorldInput& input);
  /// Whether order() would accept it now; of kPlace with several hosts only what needs no
  /// authority. Errors as there.
  [[nodiscard]] Status check_order(const WorldInput& input) const;
  /// The orders that a robot takes now; none if it runs elsewhere.
  [[nodiscard]] OrderSet takes(RobotId robot) const noexcept;
  /// The current order of a robot in words; empty: none.
  [[nodiscard]] std::string order_of(RobotId robot) const;
  /// The current value of a parameter; empty if it does not exist.
  [[nodiscard]] std::string parameter(RobotId robot, ParameterChange::Part part,
                                      std::uint32_t index, std::string_view name) const;
  /// Whether a parameter of the robot or of its body was changed; false if it runs elsewhere.
  [[nodiscard]] bool has_changed_parameters(RobotId robot) const;
  /// The number of inputs by hand.
  [[nodiscard]] std::uint64_t inputs_by_hand() const noexcept;
  /// Sets the age of the virtual world that sensors and guards see: 0 in one process. Guards
  /// compare it with their timeout.
  void set_world_age(Duration age) noexcept;
  /// Commands all hardware actuators to stop until the next step; for the end of a run. In a live
  /// run guards do so in their threads, without waiting for them.
  void halt() noexcept;
  /// Current radius of a robot's body about its origin.
  [[nodiscard]] double body_radius_m(RobotId robot) const noexcept;

 private:
  struct Impl;
  explicit Engine(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::sim
