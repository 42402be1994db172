// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answer_book.hpp"
#include "history_ring.hpp"
#include "host_part.hpp"
#include "listed_fan.hpp"
#include "order_book.hpp"
#include "outlets.hpp"
#include "pose_reading.hpp"
#include "pose_track.hpp"
#include "rave/base/check.hpp"
#include "rave/base/crash_note.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/thread_pool.hpp"
#include "robot_group.hpp"
#include "robot_guard.hpp"
#include "twin.hpp"
#include "world_truth.hpp"

namespace rave::sim {

class Radio;
struct RadioMoment;

/// Members [begin, end) of a group: what one thread does at a time. Fixed once, so that results do
/// not depend on how many threads there are.
struct Block {
  std::uint32_t group = 0;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

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

/// The state of an engine. The phases are its functions, each in a file of its own.
struct Engine::Impl {
  explicit Impl(EngineSpec s);
  ~Impl();

  Status make();
  Status reset();
  /// The last part of both: the state at the start, and the sensors opened.
  Status begin();
  void set_initial_state();
  /// What drivers did wrong with their samples. Told at the end, since when their threads did it is
  /// chance.
  void tell_complaints() const;
  void tell_complaints(const RobotGroup& group) const;
  void tell_withheld(const RobotGroup& group, const SensorSlots& slots) const;
  /// Tells hardware to stand.
  void halt() noexcept;
  void halt(RobotGroup& group) noexcept;

  Status step_alone();
  /// A step begins: its time, what is asked of it.
  void begin_step();
  /// What each host does for its robots in a step: sense, radio, decide, act.
  void work(PhaseTimer& phase);

  // engine_ingest.cpp: samples of hardware, reported poses, the snapshot of this step
  Status ingest();
  Status ingest_sensors(bool hybrid);
  Status ingest_sensor(RobotGroup& group, SensorSlots& slots, std::size_t member);
  void note_loss(SensorSlots& slots, std::size_t member, RobotId robot);
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
  void sample_virtual_half(const SensorSlots& slots, RobotId robot, const Pose2& X_WR,
                           std::size_t member, ErrorText& error, bool& failed);
  void fail_fusion(const SensorSlots& slots, RobotId robot, std::size_t member,
                   std::string_view driver, const ErrorText& error);

  // engine_sense.cpp: virtual sensors
  void sense();
  void sense_block(const Block& block, Worker& worker);
  void sample_members(RobotGroup& group, SensorSlots& slots, std::uint32_t device,
                      const Block& block, Worker& worker);
  [[nodiscard]] const NearLists* find_places(const RobotGroup& group, SensorSlots& slots,
                                             const Block& block, const SinCos& mounting,
                                             Worker& worker) const;
  void process_members(RobotGroup& group, SensorSlots& slots, std::uint32_t device, Worker& worker);
  void deliver(RobotGroup& group, SensorSlots& slots, std::uint32_t device, std::size_t member,
               Worker& worker);
  void hash_delivery(const RobotGroup& group, SensorSlots& slots, std::uint32_t device,
                     std::size_t member, RunHash& hash);

  /// What a crash in a plug-in says of it; see CrashScope.
  [[nodiscard]] CrashNote crash_note(RobotId first, RobotId last, const char* part,
                                     const std::string& driver) const {
    return {part, driver.c_str(), spec.robots[first.value()].name.c_str(),
            spec.robots[last.value()].name.c_str()};
  }
  [[nodiscard]] CrashNote crash_note(const Block& block, const char* part,
                                     const std::string& driver) const {
    const std::vector<RobotId>& members = groups[block.group].members;
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
  /// Events of limits that begin to act, as bits. `lost_sensor`: as in GuardOutput.
  void tell_guard(RobotId robot, const GuardSpec& limits, std::uint32_t begun,
                  std::uint32_t lost_sensor, std::vector<Event>& to) const;
  /// Whether a robot with the drivers that it has now need not be armed.
  [[nodiscard]] bool is_armed_at_first(std::uint32_t robot) const;

  // engine_live.cpp: guards with threads of their own
  [[nodiscard]] Status start_guards();
  [[nodiscard]] Status start_guards(RobotGroup& group);
  [[nodiscard]] Result<std::unique_ptr<GuardThread>> start_guard(RobotGroup& group,
                                                                 std::size_t member);
  void tell_of_guards() const;
  /// Gives the guard of a robot what the step wants, and takes what it has to say.
  void serve_guard(RobotGroup& group, std::uint32_t member);
  void give_order(RobotGroup& group, std::uint32_t member);
  void fill_neighbours(RobotId robot, const RobotGroup& group, GuardOrder& order);
  void hear_guard(RobotGroup& group, std::uint32_t member);
  [[nodiscard]] std::shared_ptr<const world::Body> guard_body(RobotId robot);

  // engine_exchange.cpp: robots with two sets of drivers
  struct Arrival {
    Pose2 X_WR;
    PoseReading variance;
    std::optional<Pose2> X_WM;
    SimTime stamp;
  };
  void make_twins();
  Status restore_twins();
  Status open_other(Twin& twin);
  void close_other(Twin& twin);
  [[nodiscard]] Arrival arrival(const Twin& twin) const;
  [[nodiscard]] Status check_near(const Twin& twin) const;
  void exchange(Twin& twin);
  void change_drivers(Twin& twin);
  [[nodiscard]] Twin* find_twin(RobotId robot) noexcept;
  [[nodiscard]] RobotGroup& group_of_twin(const Twin& twin) noexcept;

  // engine_end.cpp
  [[nodiscard]] bool shut() noexcept;
  /// False: some of the drivers do not come to an end. The log is told which.
  [[nodiscard]] bool close_all(std::vector<ToClose> drivers);
  /// Of those that serve.
  [[nodiscard]] std::vector<ToClose> take_open();
  [[nodiscard]] bool close_twins() noexcept;
  void leave_behind() noexcept;
  [[nodiscard]] std::string still_busy(const Twin& twin) const;

  // engine_hand_over.cpp: how they come to that
  Status hand_over(RobotId robot, DriverSet to, const Author& author);
  void begin_hand_overs();
  void advance_hand_overs();
  void advance(Twin& twin);
  void close_late(Twin& twin);
  void begin_stage(Twin& twin, Twin::Stage stage);
  Status listen(Twin& twin);
  [[nodiscard]] bool is_heard(const Twin& twin) const noexcept;
  [[nodiscard]] bool stands(Twin& twin);
  [[nodiscard]] bool moves_seen(const RobotGroup& group, std::uint32_t robot) const;
  void refuse(Twin& twin, const std::string& why);
  void end_hand_over(Twin& twin, EventKind kind, std::string text);

  // engine_inputs.cpp: what is asked of a run between two steps
  void note_input(RobotId robot, EventKind kind, std::string text, const Author& author);
  void make_changes();
  void make_change(const ScheduledChange& scheduled);
  void stop(RobotId robot, const Author& author);
  void release(RobotId robot, const Author& author);
  void arm(RobotId robot, const Author& author);
  Status change(RobotId robot, std::span<const ParameterChange> changes, const Author& author);
  Result<ChangedObstacle> change_obstacle(const ObstacleChange& change, const Author& author);
  void make_obstacle_changes();
  /// The same for the snapshots of the past.
  void obstacle_changed(const ObstacleChange& change);
  void restore_obstacles();
  /// One of several hosts: what may be changed without the authority.
  [[nodiscard]] Status check_own(RobotId robot, std::span<const ParameterChange> changes) const;
  void body_changed(RobotId robot);
  void tell_program_of_body(RobotId robot);
  void restore_bodies();

  // engine_orders.cpp: what people ask of robots
  [[nodiscard]] OrderSet takes(RobotId robot) const;
  Status order(const WorldInput& input);
  Status check_moved(const WorldInput& input);
  Status order_text_for(const WorldInput& input);
  Status order_motion(const WorldInput& input);
  Status place(const WorldInput& input);
  void steer_by(const WorldInput& input, std::uint32_t controller);
  void tell_cancelled(const WorldInput& input, OrderedRobot& robot);
  void give_back(RobotId id, OrderedRobot& robot);
  /// False: there was none.
  bool end_orders(const WorldInput& input, RobotId id);
  void cancel_orders(const WorldInput& input);
  void note_order(const WorldInput& input, EventKind kind);
  [[nodiscard]] OrderedRobot& orders_of(RobotId robot);
  void show_orders();
  void hide_orders();
  void take_answers();
  void steer();
  void look_at_goal(RobotId id, OrderedRobot& robot);

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
  void do_order(const WorldInput& input);
  void adopt(const WorldStep& world);
  Status take_newer_samples();
  [[nodiscard]] bool is_local(std::uint32_t robot) const noexcept { return local[robot] != 0; }

  void note(Event event) { events.push_back(std::move(event)); }
  [[nodiscard]] bool due(std::uint32_t period, std::uint32_t phase) const noexcept {
    return step >= phase && (step - phase) % period == 0;
  }
  [[nodiscard]] SimTime step_time(std::uint64_t k) const noexcept {
    return SimTime{static_cast<std::int64_t>(k) * spec.step.ns};
  }
  /// Of a robot that runs here.
  [[nodiscard]] const RobotGroup& group_of(RobotId robot) const noexcept {
    RAVE_CHECK(is_local(robot.value()));
    return groups[group_index[robot.value()]];
  }

  EngineSpec spec;
  LogOutlet log_outlet;                     ///< Of the drivers.
  std::optional<ClockOutlet> clock_outlet;  ///< In live runs.
  bool is_shut = false;
  bool is_in_use = false;           ///< By drivers that were closed and have not come to an end.
  std::vector<std::uint8_t> local;  ///< By robot: runs here.
  std::unique_ptr<HostPart> host;   ///< Null if all run here.
  std::vector<RobotLog> logs;
  std::deque<RobotGroup> groups;  ///< Deque: groups never move, views into them stay valid.
  std::deque<Twin> twins;
  std::vector<std::uint32_t> group_index;   ///< By robot; those that run elsewhere have none.
  std::vector<std::uint32_t> member_index;  ///< By robot.
  std::vector<Block> blocks;
  ThreadPool pool;
  ThreadPool::Effort refresh_effort, sense_effort, decide_effort, act_effort;
  std::vector<Worker> workers;
  WorldTruth truth;
  std::unique_ptr<Radio> radio;  ///< Always there after make().

  std::uint64_t step = 0;
  SimTime now;
  std::unique_ptr<world::Snapshot> past;  ///< For sample_at(); made when it is first asked.
  std::uint64_t past_obstacles = 0;       ///< The revision of the obstacles that it shows.
  bool past_valid = false;                ///< Still shows what is known of its time.
  HistoryRing history;
  std::vector<ReportedPose> reported;
  std::vector<PoseTrack> tracks;
  MotionWatch motion_watch;
  double moves_m = 0;  ///< How far pieces of robots have moved since sensors looked last.
  std::vector<Event> events;
  std::vector<Event> pending;                    ///< Of inputs, for the next step.
  std::vector<std::optional<GuardSpec>> guards;  ///< By type.
  std::vector<RobotGuard> robot_guards;          ///< By robot.
  SimTime work_began;                            ///< Of this step, by the clock of a live run.
  /// By robot, as far as guards with threads of their own know them. Shared with these.
  std::vector<std::shared_ptr<const world::Body>> guard_bodies;
  Duration world_age;
  std::uint64_t by_hand = 0;
  std::size_t next_change = 0;
  std::size_t next_hand_over = 0;  ///< Of spec.hand_overs.
  std::size_t next_obstacle = 0;   ///< Of spec.obstacle_changes.
  RunHash hash;
  PhaseTimes phase_times;
  FanScratch past_scratch;
  std::unique_ptr<OrderBook> orders;  ///< Null: nobody has asked anything of a robot yet.
  AnswerBook answers;
  std::unique_ptr<FusionWorld> fusion_world;  ///< Null without hybrid sensors.
};

}  // namespace rave::sim
