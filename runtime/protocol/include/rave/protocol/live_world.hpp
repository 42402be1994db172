// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/protocol/robot_columns.hpp"
#include "rave/protocol/talk_limit.hpp"
#include "rave/sim/world_authority.hpp"

namespace rave::real_time {

using lock_step::RobotSight;

/// The state of an obstacle that differs from its initial one, as the manager of the run publishes
/// it.
struct ObstacleSight {
  /// A bound that no run reaches.
  static constexpr std::uint64_t kMostRevision = std::uint64_t{1} << 40U;

  std::uint64_t scheduled = 0;  ///< Number of scenario changes that were due by then.
  std::uint64_t revision = 0;   ///< Counts the changes of all obstacles in the run, from 1.
  sim::ObstacleChange stands;   ///< An addition at the present pose, a move, or a removal.
  bool removed = false;         ///< It was added and removed again.
};

/// How old reports of poses of robots of other hosts were in the step that first showed them.
struct PoseDelays {
  std::uint64_t count = 0;
  Duration slowest{};
  Duration sum{};
};

/// Checks that an obstacle of a run that began with `start` can have this state: its id is that of
/// an initial obstacle or of one that a run may add, and sim::check_obstacle_change() accepts it.
/// Error kInvalidArgument.
[[nodiscard]] Status check_sight(const ObstacleSight& sight, const world::WorldModel& start);

/// The world of one host in real time. It is the authority for the local robots. All others it
/// knows only from messages of their hosts: it extrapolates their poses with the last velocity for
/// at most the `staleness` of their type, after which they stay there and count as stale. It never
/// pushes remote robots: like real robots, they push local robots aside. A robot without any
/// message is absent.
///
/// Used between propose() and apply() of an engine with EngineSpec::own_authority. One owner
/// thread; uses others inside step().
class LiveWorld {
 public:
  /// `spec`: that of the engine, with `local`; copied. `alone`: there is no manager, so the
  /// obstacle changes of the spec are made here. Errors: kInvalidArgument.
  [[nodiscard]] static Result<std::unique_ptr<LiveWorld>> create(const sim::EngineSpec& spec,
                                                                 bool alone = false);

  /// Adds a pose of a robot of another host. False, and nothing changes: it runs here, does not
  /// exist, or newer data is known.
  bool see(const RobotSight& sight);
  /// Adds the state of an obstacle, for the next step, even if a robot is in the way. False: newer
  /// data is known, or the state is impossible.
  bool see(ObstacleSight sight);
  /// check_sight() with the world of this run.
  [[nodiscard]] Status check(const ObstacleSight& sight) const;
  /// The latest received revision, and that of the last step: the obstacles are up to date to this
  /// revision.
  [[nodiscard]] std::uint64_t heard_revision() const noexcept { return heard_revision_; }
  [[nodiscard]] std::uint64_t shown_revision() const noexcept { return shown_revision_; }

  /// Call it when other processes begin to use another clock: the next data then counts as the
  /// newest.
  void clock_changed();
  /// Adds a message of a robot of another host, for the next step. Its stamp is used unless it is
  /// in the future. `writer`: the process, whose messages arrive in order. False: it is a
  /// duplicate, cannot be received by any local robot, or exceeds a limit: the robot's TalkLimit,
  /// or that of a step.
  bool hear(std::uint64_t writer, const sim::SentPacket& packet, std::span<const std::byte> bytes);

  /// Sets the type and pose of a local robot from the next report of this host on, after a
  /// hand-over. Error kInvalidArgument: no such local robot, or no such type.
  Status serve(RobotId robot, std::uint32_t type, const Pose2& X_WR);
  /// Places a local simulated robot elsewhere, from the next step on. Errors: kInvalidArgument (it
  /// would overlap something, it is real, or of another host).
  Status place(const sim::WorldInput& input);
  /// Sets whether a robot of another host is simulated. False: it runs here or does not exist.
  bool set_reality(RobotId robot, bool simulated);

  /// Prepares a host that joins later than step 0: changes `own`, its report of step 0, to one of
  /// `step`, in which its simulated robots stand at their start or at a pose of `starts`. Call
  /// step() and Engine::join() next. Errors: kInvalidArgument.
  Status begin_at(std::uint64_t step, std::span<const RobotSight> starts, sim::HostReport& own);

  /// Makes the world of the step that `own` is for, the report of this host with host number 0.
  /// Errors: those of WorldAuthority::step().
  Status step(const sim::HostReport& own, sim::WorldStep& world);

  /// Events of the last step: contacts, pins and body changes of local robots, obstacle changes,
  /// and other robots that became stale (kPoseStale) or were received again (kPoseBack).
  [[nodiscard]] std::span<const sim::Event> events() const noexcept { return events_; }
  /// Without those by which a robot became known, which may be old.
  [[nodiscard]] const PoseDelays& pose_delays() const noexcept { return pose_delays_; }
  /// The number of received messages dropped because there were too many in one step.
  [[nodiscard]] std::uint64_t dropped_packets() const noexcept { return dropped_packets_; }
  /// Robots that exceeded their TalkLimit since the last call; each once per run.
  [[nodiscard]] std::vector<RobotId> take_flooders() { return std::exchange(flooders_, {}); }

  /// Limits of received messages, and of their bytes, in one step.
  static constexpr std::size_t kMostPackets = 65'536;
  static constexpr std::size_t kMostBytes = 4'194'304;

 private:
  struct Other {
    RobotSight last;
    Duration staleness;
    std::array<Duration, 2> staleness_of;  ///< By whether it is simulated.
    bool real = false;
    bool known = false;
    bool stale = false;
    bool any_stamp = true;       ///< The next sight is accepted whatever its stamp.
    SimTime shown{INT64_MAX};    ///< Stamp of the pose in the last step; INT64_MAX: none.
    std::int64_t sample_ns = 0;  ///< Stamp of the last sample that was passed on.
    TalkLimit talk{TalkLimit::kOnReception};
  };
  /// A change of an obstacle that takes effect at a step.
  struct Adopted {
    std::uint64_t step = 0;
    BodyId id;
    std::uint64_t revision = 0;
  };
  struct Counted {
    std::uint64_t writer = 0;
    std::uint32_t sequence = 0;
  };

  LiveWorld(const sim::EngineSpec& spec, std::unique_ptr<sim::WorldAuthority> authority);
  [[nodiscard]] bool has_room_for(Other& other, std::size_t bytes);
  [[nodiscard]] SimTime time_of(std::uint64_t step) const noexcept;
  void report_others(std::uint64_t step);
  void report_place(Other& other, std::uint64_t step);
  void note_delay(Other& other, Duration age);
  void report_samples(SimTime now);
  void report_packets(std::uint64_t step);
  void adopt_obstacles(std::uint64_t step);
  void adopt(const ObstacleSight& sight, bool is_new);
  void take_events(std::uint64_t step);

  std::unique_ptr<sim::WorldAuthority> authority_;
  std::vector<std::uint8_t> local_;       ///< By robot: whether it runs here.
  std::vector<RobotId> simulated_;        ///< Local ones; ascending.
  std::vector<Other> others_;             ///< By robot, ascending.
  std::vector<std::uint32_t> other_of_;   ///< By robot: its index in `others_`.
  std::vector<sim::PoseSample> samples_;  ///< Of real robots, for later steps.
  sim::SentPackets heard_;                ///< Received messages for the next step.
  std::map<std::pair<std::uint32_t, std::uint32_t>, Counted> newest_;  ///< By robot, communicator.
  sim::HostReport others_report_;
  std::vector<std::uint32_t> order_;  ///< Order of `heard_`.
  std::vector<sim::Event> events_;
  PoseDelays pose_delays_;
  std::uint64_t dropped_packets_ = 0;
  std::vector<RobotId> flooders_;                ///< For the next take_flooders().
  std::map<std::uint32_t, ObstacleSight> news_;  ///< Received states of obstacles, by id.
  /// Latest received revision, by obstacle id.
  std::map<std::uint32_t, std::uint64_t> revision_of_;
  std::vector<Adopted> adopted_;  ///< Changes whose events come with the next step.
  std::uint64_t heard_revision_ = 0;
  std::uint64_t shown_revision_ = 0;
};

}  // namespace rave::real_time
