// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "history_ring.hpp"
#include "host_part.hpp"
#include "listed_fan.hpp"
#include "outlets.hpp"
#include "pose_reading.hpp"
#include "pose_track.hpp"
#include "rave/base/crash_note.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/thread_pool.hpp"
#include "robot_group.hpp"
#include "run_inputs.hpp"
#include "world_truth.hpp"

namespace rave::sim {

class Radio;
struct RadioMoment;

/// What each thread has of its own during a phase.
struct Worker {
  FanScratch fan;
  BlockScratch fans;
  std::array<SensorPlace, kMemberBlock> places;  ///< Of the sensors of a block, and again.
  std::array<Vec2, kMemberBlock> places_W;
  /// What controllers and virtual actuators of a block are given and give, and again: what no later
  /// phase asks for need not go through the memory.
  std::array<ControlInput, kMemberBlock> control_inputs;
  std::vector<std::array<Command, kMemberBlock>> control_outputs;  ///< By controller.
  std::array<MotionInput, kMemberBlock> motion_inputs;
  std::array<Twist2, kMemberBlock> proposals;
  RunHash hash;
  std::vector<Event> events;
  std::vector<RobotId> near;
  std::vector<GuardNeighbour> neighbours;
  std::vector<GuardSensor> sensors;
  std::vector<NoiseItem> noise;  ///< Samples of a block that wait for their noise, and whose.
  std::vector<std::uint32_t> noisy_members;
};

/// The world at the stamp of a real sample, for the virtual halves of hybrid sensors.
struct FusionWorld {
  explicit FusionWorld(const world::WorldModel& model) : world(model) {}
  world::Snapshot world;
  bool valid = false;           ///< Still shows what is known of its time.
  std::uint64_t obstacles = 0;  ///< The revision of the obstacles that it shows.
  std::vector<Mover> movers;    ///< The poses in `world`.
  std::vector<ContactNote> notes;
  FanScratch scratch;
};

/// What sample_at() has looked at last.
struct PastWorld {
  std::unique_ptr<world::Snapshot> world;  ///< Made when it is first asked.
  std::uint64_t obstacles = 0;             ///< The revision of the obstacles that it shows.
  bool valid = false;                      ///< Still shows what is known of its time.
  FanScratch scratch;
};

/// The state of an engine. The phases of a step are its functions, each in a file of its own; what
/// is asked of a run between two steps is carried out by the classes that it holds.
struct Engine::Impl final : private HandOvers::Site {
  explicit Impl(EngineSpec s);
  ~Impl() override;

  Status make();
  Status reset();
  /// The last part of both: the state at the start, and the sensors opened.
  Status begin();
  void set_initial_state();
  /// What drivers did wrong with their samples. Told at the end, since when their threads did it is
  /// chance.
  void tell_complaints() const;
  void before_closing(const RobotGroup& group) const override;
  void tell_withheld(const RobotGroup& group, const SensorSlots& slots) const;
  /// Tells hardware to stand.
  void halt() noexcept;
  void halt(RobotGroup& group) noexcept override;

  Status step_alone();
  /// A step begins: its time, what is asked of it.
  void begin_step();
  void conduct();
  [[nodiscard]] Status make_input(const WorldInput& input);
  void hold(const WorldInput& input);
  /// Samples of a step may change what the past looked like.
  void forget_past();
  /// What each host does for its robots in a step: sense, radio, decide, act.
  void work(PhaseTimer& phase);

  // engine_ingest.cpp: samples of hardware, reported poses, the snapshot of this step
  Status ingest();
  Status ingest_sensors(bool hybrid);
  Status ingest_sensor(RobotGroup& group, SensorSlots& slots, std::size_t member);
  void note_loss(SensorSlots& slots, std::size_t member, RobotId robot);
  // engine_breaks.cpp: samples that were refused, or that do not continue those before
  void note_break(RobotGroup& group, SensorSlots& slots, std::size_t member);
  void note_refused(SensorSlots& slots, std::size_t member, RobotId robot);
  void accept_hardware_sample(RobotGroup& group, SensorSlots& slots, std::size_t member,
                              const SampleHeader& sample);
  void push_hardware_sample(RobotGroup& group, SensorSlots& slots, std::size_t member);
  void process_hardware_samples(RobotGroup& group, SensorSlots& slots, std::size_t member);
  /// Frame of the sensor that says where a robot is.
  [[nodiscard]] Pose2 pose_frame(const RobotGroup& group, RobotId robot) const;
  void note_reported_pose(RobotGroup& group, const SensorSlots& slots, std::size_t member,
                          const SampleHeader& header, const std::byte* record);
  void refresh_reported();
  /// Of robots that have a source of their pose.
  void refresh_told(const Block& block, Worker& worker);
  /// Of the others.
  void refresh_true(std::uint32_t robot);
  void show_world();
  void remember();
  void look_back(SimTime stamp);

  // engine_fuse.cpp: hybrid sensors
  bool fuse(RobotGroup& group, SensorSlots& slots, std::size_t member, SampleHeader& sample);
  bool withhold(FusionSlots& fusion, std::size_t member, const SampleHeader& sample);
  [[nodiscard]] std::optional<Pose2> own_pose_at(RobotId robot, SimTime stamp,
                                                 Duration staleness) const;
  void show_past(SimTime stamp);
  Status sample_virtual_half(const SensorSlots& slots, RobotId robot, const Pose2& X_WR,
                             std::size_t member);
  void fail_fusion(const SensorSlots& slots, RobotId robot, std::size_t member,
                   std::string_view driver, std::string_view why);

  // engine_sense.cpp: virtual sensors
  void sense();
  void sense_block(const Block& block, Worker& worker);
  void sample_members(RobotGroup& group, SensorSlots& slots, std::uint32_t device,
                      const Block& block, Worker& worker);
  void sample_device(RobotGroup& group, SensorSlots& slots, std::uint32_t device,
                     std::uint32_t member, SampleHeader& header, std::byte* records,
                     Worker& worker);
  [[nodiscard]] const NearLists* find_places(const RobotGroup& group, SensorSlots& slots,
                                             const Block& block, const SinCos& mounting,
                                             Worker& worker) const;
  void process_members(RobotGroup& group, SensorSlots& slots, std::uint32_t device, Worker& worker);
  void deliver(RobotGroup& group, SensorSlots& slots, std::uint32_t device, std::size_t member,
               Worker& worker);
  void hash_delivery(const RobotGroup& group, SensorSlots& slots, std::uint32_t device,
                     std::size_t member, RunHash& hash);

  [[nodiscard]] GroupContext group_context() noexcept {
    return {spec, roster.logs, radio.get(), nullptr, answers.service()};
  }
  /// What a crash in a plug-in says of it; see CrashScope.
  [[nodiscard]] CrashNote crash_note(RobotId first, RobotId last, const char* part,
                                     const std::string& driver) const {
    return {part, driver.c_str(), spec.robots[first.value()].name.c_str(),
            spec.robots[last.value()].name.c_str()};
  }
  [[nodiscard]] CrashNote crash_note(const Block& block, const char* part,
                                     const std::string& driver) const {
    const std::vector<RobotId>& members = roster.groups[block.group].members;
    return crash_note(members[block.begin], members[block.end - 1], part, driver);
  }

  // engine_decide.cpp: programs
  void decide();
  void decide_block(const Block& block, Worker& worker);
  void decide_isolated();
  void accept_commands(RobotGroup& group, std::size_t member, RunHash& hash);
  void fail_program(RobotGroup& group, std::size_t member, std::string_view text,
                    std::vector<Event>& events);

  // engine_radio.cpp: messages
  [[nodiscard]] RadioMoment radio_moment();
  void deliver_messages();
  void carry_messages();

  // engine_act.cpp: controllers, actuators, the limits of motion
  void act();
  void act_block(const Block& block, Worker& worker);
  void write_hardware(RobotGroup& group, ActuatorSlots& slots, std::size_t member);
  void note_written(const RobotGroup& group, ActuatorSlots& slots, std::size_t member, bool failed,
                    std::string_view text);
  void control(RobotGroup& group, const Block& block, Worker& worker);
  void actuate(RobotGroup& group, const Block& block, Worker& worker);
  void publish();

  // engine_guard.cpp: the limits of commands
  void set_up_guards();
  /// Whether nothing stands between a controller and its actuator.
  [[nodiscard]] bool is_unguarded(const ActuatorSlots& slots, std::uint32_t member,
                                  std::uint32_t robot) const noexcept {
    return robot_guards[robot].is_free() &&
           (slots.obeys[member] == 0 || !guards[spec.robots[robot].type]);
  }
  /// `command` is what the controller gave; nothing if there is none.
  [[nodiscard]] Command guarded(const RobotGroup& group, const ActuatorSlots& slots,
                                std::uint32_t member, const ControllerSlots* controller,
                                const Command& command, Worker& worker);
  void find_neighbours(RobotId robot, double reach_m, Worker& worker) const;
  /// Events of limits that begin to act, as bits. The sensors: as in GuardNews.
  void tell_guard(RobotId robot, const GuardSpec& limits, std::uint32_t begun,
                  std::uint32_t lost_sensor, std::uint32_t frozen_sensor,
                  std::vector<Event>& to) const;

  // engine_live.cpp: guards with threads of their own
  [[nodiscard]] Status start_guards();
  [[nodiscard]] Status start_guards(RobotGroup& group) override;
  [[nodiscard]] Result<std::unique_ptr<GuardThread>> start_guard(RobotGroup& group,
                                                                 std::size_t member);
  void tell_of_guards() const;
  /// Gives the guard of a robot what the step wants, and takes what it has to say.
  void serve_guard(RobotGroup& group, std::uint32_t member);
  void give_order(RobotGroup& group, std::uint32_t member);
  void fill_neighbours(RobotId robot, const RobotGroup& group, GuardOrder& order);
  void hear_guard(RobotGroup& group, std::uint32_t member);
  [[nodiscard]] std::shared_ptr<const world::Body> guard_body(RobotId robot);

  // engine_end.cpp
  [[nodiscard]] bool shut() noexcept;
  /// False: some drivers do not close. The log names them.
  [[nodiscard]] bool close_all(std::vector<ToClose> drivers) override;
  /// Of those that serve.
  [[nodiscard]] std::vector<ToClose> take_open();
  void leave_behind() noexcept;

  // engine_inputs.cpp: what follows for the engine from what is asked between two steps
  void body_changed(RobotId robot);
  void obstacle_changed(const ObstacleChange& change);
  /// Bodies and obstacles as they were at the start.
  void restore_world();
  void drivers_changed(RobotId robot, const Arrival& place) override;
  void drivers_restored(RobotId robot) override;
  Status order(const WorldInput& input);
  [[nodiscard]] Status may_order(const WorldInput& input) const;
  Status place(const WorldInput& input, const request::Place& there);
  /// One of several hosts: what may be changed without the authority.
  [[nodiscard]] Status check_own(RobotId robot, std::span<const ParameterChange> changes) const;
  [[nodiscard]] OrderMoment order_moment() noexcept { return {step, now, reported, hash, events}; }

  // engine_split.cpp: one of several hosts
  Status propose(HostReport& report, PhaseTimer& phase);
  void fill_report(HostReport& report);
  /// `was_there`: in the step before, too, so that its messages are heard.
  Status apply(const WorldStep& world, bool was_there, PhaseTimer& phase);
  [[nodiscard]] Status check(const WorldStep& world) const;
  Status make_changes(const WorldStep& world);
  Status catch_up(const WorldStep& world, const AuthorityState& state);
  void put_obstacles(std::span<const ObstacleChange> changes);
  void do_input(const WorldInput& input);
  void adopt(const WorldStep& world);
  Status take_newer_samples();

  void note(Event event) { events.push_back(std::move(event)); }
  [[nodiscard]] bool due(std::uint32_t period, std::uint32_t phase) const noexcept {
    return is_due(step, period, phase);
  }
  [[nodiscard]] SimTime step_time(std::uint64_t k) const noexcept {
    return SimTime{static_cast<std::int64_t>(k) * spec.step.ns};
  }
  EngineSpec spec;
  LogOutlet log_outlet;                     ///< Of the drivers.
  std::optional<ClockOutlet> clock_outlet;  ///< In live runs.
  bool is_shut = false;
  bool is_in_use = false;  ///< By drivers that were closed and have not come to an end.
  Roster roster;
  std::unique_ptr<HostPart> host;  ///< Null if all run here.
  ThreadPool pool;
  ThreadPool::Effort refresh_effort, sense_effort, decide_effort, act_effort;
  std::vector<Worker> workers;
  WorldTruth truth;
  std::unique_ptr<Radio> radio;  ///< Always there after make().

  std::uint64_t step = 0;
  SimTime now;
  PastWorld past;
  HistoryRing history;
  std::vector<ReportedPose> reported;
  std::vector<PoseTrack> tracks;
  MotionWatch motion_watch;
  double moves_m = 0;  ///< How far pieces of robots have moved since sensors looked last.
  std::vector<Event> events;
  std::vector<std::optional<GuardSpec>> guards;  ///< By type.
  std::vector<RobotGuard> robot_guards;          ///< By robot.
  SimTime work_began;                            ///< Of this step, by the clock of a live run.
  /// By robot, as far as guards with threads of their own know them. Shared with these.
  std::vector<std::shared_ptr<const world::Body>> guard_bodies;
  Duration world_age;
  RunHash hash;
  PhaseTimes phase_times;
  AnswerBook answers;
  InputLog input_log{hash};
  OrderBook orders{spec, roster, input_log};
  HandOvers hand_overs;
  RunInputs inputs;
  Conducted conducted;                        ///< In the step that began last.
  std::unique_ptr<FusionWorld> fusion_world;  ///< Null without hybrid sensors.
};

}  // namespace rave::sim
