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

/// The latest sample of one sensor of one robot, for observers and records. Views into the engine.
struct SensorSample {
  const SensorInfo* info = nullptr;
  const SampleHeader* header = nullptr;
  const void* records = nullptr;
  std::span<const std::uint32_t> bodies;  ///< Fans: the body each ray met, BodyId::kNone for none.
};

/// What the two halves of a hybrid sensor gave for its newest reading, each with the noise of that
/// half; for observers and records, never for programs. Views into the engine; null if the sensor
/// is not hybrid. Stamp and sequence of both are those of the reading that was made of them, which
/// latency may keep from the program for a while.
struct SensorParts {
  const SampleHeader* real = nullptr;
  const void* real_records = nullptr;
  const SampleHeader* imagined = nullptr;  ///< The virtual half.
  const void* imagined_records = nullptr;
  std::span<const std::uint32_t> bodies;  ///< Ranges: the body each virtual reading met.
};

/// The latest samples of one sensor of all robots of a type, by member: what an observer looks at
/// that takes them all in each step. Views into the engine.
struct SampleColumns {
  std::span<const SampleHeader> headers;
  const std::byte* records = nullptr;  ///< Of the first member.
  std::uint32_t stride_bytes = 0;      ///< To those of the next one.
};

/// The last commands that the programs of a type gave to one controller, and the steps in which
/// they did (-1: never), by member. Views into the engine.
struct CommandColumns {
  std::span<const Command> commands;
  std::span<const std::int64_t> steps;
};

/// Runs the world: sense (const world), decide (const percepts), act (drivers propose motions),
/// resolve (the world limits them), publish. Belongs to one thread; uses others inside step().
/// Between steps everything may be read. Same spec, same run, whatever the number of threads.
///
/// With EngineSpec::local it runs these robots alone, as one host of several. Then propose() and
/// apply() take turns in the place of step(), and a WorldAuthority stands between. What is asked by
/// robot of sensors, commands, programs and devices, and by group, is there for these robots only.
class Engine {
 public:
  /// Makes all instances, opens hardware, starts programs. Errors: whatever a driver or program
  /// says, with the name of robot and device.
  [[nodiscard]] static Result<std::unique_ptr<Engine>> create(EngineSpec spec);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  ~Engine();

  /// One base period. Errors end the run: a stepped driver that does not answer. kState: other
  /// hosts have a part in this world.
  Status step();

  /// One of several hosts: does the step that apply() began (none at first), takes in what hardware
  /// has for the next one, and fills in what the authority needs for it; of `report` the number of
  /// the host is left as it is. Errors: kState (apply() comes first; alone); what step() says,
  /// which ends the run and stands in the report, too.
  Status propose(HostReport& report);
  /// The next step begins: the world is as the authority says. Errors: kState (propose() comes
  /// first; alone), kInvalidArgument (another step or another world; nothing has changed); kPlugin
  /// and what step() says end the run.
  Status apply(const WorldStep& world);
  /// As apply(), but the world may be of a later step than the one that was proposed: the others
  /// went on while this host was away. Its robots go on from where the world says they stand, with
  /// programs and controllers as they are here; messages of the time between are lost to them.
  /// `state`: what the authority knew beside that world; sizes and obstacles count. Errors as of
  /// apply().
  Status join(const WorldStep& world, const AuthorityState& state);
  /// Whether this engine runs the robot.
  [[nodiscard]] bool is_local(RobotId robot) const noexcept;

  /// Back to the exact state after create(): the same steps follow.
  Status reset();

  [[nodiscard]] const EngineSpec& spec() const noexcept;
  /// The step that comes next; the last one showed the world at time().
  [[nodiscard]] std::uint64_t steps_done() const noexcept;
  /// Time of the snapshot: when the last step sensed.
  [[nodiscard]] SimTime time() const noexcept;
  /// The world as the last step sensed it.
  [[nodiscard]] const world::Snapshot& snapshot() const noexcept;
  /// Of robots of other hosts: as at the beginning of the last step.
  [[nodiscard]] const ReportedPose& reported(RobotId robot) const noexcept;
  /// True pose of a simulated robot after the last step. One of several hosts: as apply() showed
  /// it.
  [[nodiscard]] Pose2 true_pose(RobotId robot) const noexcept;
  /// Sensors in the order of the robot's type.
  [[nodiscard]] SensorSample sensor(RobotId robot, std::uint32_t index) const noexcept;
  /// The halves of a hybrid sensor's newest reading; nothing for other sensors.
  [[nodiscard]] SensorParts sensor_parts(RobotId robot, std::uint32_t index) const noexcept;
  /// The last command that the program gave to a controller.
  [[nodiscard]] Command command(RobotId robot, std::uint32_t controller) const noexcept;
  /// The step in which it was given; -1 before the first.
  [[nodiscard]] std::int64_t command_step(RobotId robot, std::uint32_t controller) const noexcept;
  /// What the last step gave to an actuator, from the controller that speaks; kNone without one. Of
  /// a real robot of a live run: what its guard had written last when the step was done.
  [[nodiscard]] const Command& actuator_command(RobotId robot,
                                                std::uint32_t actuator) const noexcept;
  // All robots of one type at once; types in use are counted from 0, their robots are members.
  [[nodiscard]] std::uint32_t group_count() const noexcept;
  /// Ascending.
  [[nodiscard]] std::span<const RobotId> members(std::uint32_t group) const noexcept;
  [[nodiscard]] const RobotType& type_of(std::uint32_t group) const noexcept;
  [[nodiscard]] SampleColumns samples(std::uint32_t group, std::uint32_t sensor) const noexcept;
  [[nodiscard]] CommandColumns commands(std::uint32_t group,
                                        std::uint32_t controller) const noexcept;
  /// As actuator_command().
  [[nodiscard]] std::span<const Command> actuator_commands(std::uint32_t group,
                                                           std::uint32_t actuator) const noexcept;

  /// How many commands the program gave in all, and whether the actuator behind obeys.
  [[nodiscard]] std::uint64_t commands_given(RobotId robot) const noexcept;
  [[nodiscard]] bool obeys(RobotId robot) const noexcept;
  /// False once the robot's program has failed.
  [[nodiscard]] bool program_alive(RobotId robot) const noexcept;
  /// What a hardware sensor reports of its stream (JSON); `{}` for virtual ones.
  [[nodiscard]] std::string sensor_report(RobotId robot, std::uint32_t index) const;
  /// What a device (RobotType::devices) reports of itself (JSON).
  [[nodiscard]] std::string device_report(RobotId robot, std::uint32_t index) const;
  /// What a transmitter reports of itself (JSON); `{}` for in-process ones.
  [[nodiscard]] std::string transmitter_report(RobotId robot, std::uint32_t index) const;
  /// What became of all messages so far.
  [[nodiscard]] const RadioCounts& radio_counts() const noexcept;
  /// Messages that were sent or delivered in the last step, in the order in which they were.
  [[nodiscard]] std::span<const RadioTrace> radio() const noexcept;
  /// Events of the last step, ordered by robot. One of several hosts has those of its robots but
  /// contacts, pins and changes of bodies and obstacles, which the authority has.
  [[nodiscard]] std::span<const Event> events() const noexcept;
  /// Of the steps that are done. One of several hosts: percepts, commands, messages and events of
  /// its robots.
  [[nodiscard]] RunHash hash() const noexcept;
  /// What the steps so far took; all zero without EngineSpec::phase_clock.
  [[nodiscard]] const PhaseTimes& phase_times() const noexcept;
  /// Changes one bit of the next percept of a robot's sensor that has records, before it is
  /// delivered and hashed. For the test that the hash notices.
  void flip_percept_bit(RobotId robot, std::uint32_t sensor) noexcept;

  /// What a virtual sensor of `robot` reads at `stamp`, within the history: the world and the
  /// robot's own pose are taken at that instant, between samples interpolated. Processing is not
  /// applied. `records` has room for the sensor's capacity. Errors: kInvalidArgument (not a virtual
  /// sensor, outside the history).
  [[nodiscard]] Result<SampleHeader> sample_at(RobotId robot, std::uint32_t sensor, SimTime stamp,
                                               void* records);
  /// The pose of a robot at an instant within the history.
  [[nodiscard]] Result<Pose2> pose_at(RobotId robot, SimTime stamp) const;

  // Inputs between two steps. They count from the next step on, are events of it and part of the
  // hash. `robot` invalid: all robots; one of several hosts asks its own only, and what is for
  // others goes through WorldAuthority::ask().

  /// Makes robots stand, whatever their programs say, until they are released. Any robot can be
  /// stopped, simulated ones too.
  void stop(RobotId robot, const Author& author = Author::kHand);
  /// Ends a stop. A robot that must be armed has to be armed anew.
  void release(RobotId robot, const Author& author = Author::kHand);
  /// Lets robots move that must be armed; of a stopped one the stop stays.
  void arm(RobotId robot, const Author& author = Author::kHand);
  [[nodiscard]] bool stopped(RobotId robot) const noexcept;
  /// False: it stands until it is armed.
  [[nodiscard]] bool armed(RobotId robot) const noexcept;
  /// Changes parameters of one robot, all or none. Errors: kInvalidArgument and kNotFound (unknown,
  /// out of range, refused by the driver or program, a body that would overlap something), kState
  /// (its program has failed; a body, which the authority
  /// changes); then everything is as it was.
  Status set_parameters(RobotId robot, std::span<const ParameterChange> changes,
                        const Author& author = Author::kHand);
  /// Adds, moves or removes an obstacle. From the call on spec().world and snapshot() have it; what
  /// looks back does not see it before the next step. Errors: kInvalidArgument and kNotFound (see
  /// ObstacleChange; it would overlap a simulated robot), kState (one of several hosts: it is the
  /// authority's to change); then everything is as it was.
  Result<ChangedObstacle> change_obstacle(const ObstacleChange& change,
                                          const Author& author = Author::kHand);
  /// Begins to give a robot its other drivers, by RobotSpec::twin: opens them, makes the robot
  /// stand, and changes between two steps when it stands and they say where it is. Program and
  /// controllers go on as they are. What came of it is an event, kHandedOver or kHandOverRefused.
  /// Errors: kInvalidArgument (it has one set), kState (one is under way; it has these; its body is
  /// scaled).
  Status hand_over(RobotId robot, DriverSet to, const Author& author = Author::kHand);
  /// Nothing for a robot with one set of drivers.
  [[nodiscard]] std::optional<HandOverState> hand_over_state(RobotId robot) const;
  /// What somebody says of a robot of another host: whether its real or its simulated drivers serve
  /// it. From the next step on sensors see it so. Between two steps; false, and nothing has
  /// changed, if it has no such drivers.
  bool show_reality(RobotId robot, bool simulated);
  /// Gives a robot an order of people (is_order(input.kind)): a velocity takes the place of what
  /// its program gives; goals, paths and texts go to the program if that takes them, else a goal to
  /// a controller that does; kPlace puts a simulated robot elsewhere. A stop ends orders. Errors:
  /// kInvalidArgument (numbers, points that no robot can be sent to, a robot that does not take it,
  /// a place where it would overlap something), kState (it is stopped, not armed, being handed
  /// over, lost, or of another host; one of several hosts does not place); then everything is as it
  /// was.
  Status order(const WorldInput& input);
  /// Which orders a robot takes now; none of one that runs elsewhere.
  [[nodiscard]] OrderSet takes(RobotId robot) const noexcept;
  /// The order of people that a robot is carrying out, for people; empty: none.
  [[nodiscard]] std::string order_of(RobotId robot) const;
  /// The present value of a parameter; empty if there is none of this name.
  [[nodiscard]] std::string parameter(RobotId robot, ParameterChange::Part part,
                                      std::uint32_t index, std::string_view name) const;
  /// How many inputs came by hand.
  [[nodiscard]] std::uint64_t inputs_by_hand() const noexcept;
  /// How old the virtual world is that sensors and guards see: 0 in one process. Guards act on it.
  void set_world_age(Duration age) noexcept;
  /// Tells all hardware actuators to stand, now, and until the next step; for the end of a run. In
  /// a live run guards do so in their threads, and nobody waits for them.
  void halt() noexcept;
  /// Radius of a robot's body about its origin, as it is now.
  [[nodiscard]] double body_radius_m(RobotId robot) const noexcept;

 private:
  struct Impl;
  explicit Engine(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::sim
