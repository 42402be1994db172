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

/// How an obstacle stands that is not as it was at the start, as the manager of the run says.
struct ObstacleSight {
  /// More changes than any run makes.
  static constexpr std::uint64_t kMostRevision = std::uint64_t{1} << 40U;

  std::uint64_t scheduled = 0;  ///< How many changes of the scenario were due by then.
  std::uint64_t revision = 0;   ///< Of all obstacles: each change has the next, from 1.
  sim::ObstacleChange stands;   ///< An addition at the present place, a move, or a removal.
  bool removed = false;         ///< It came, and is gone.
};

/// Whether an obstacle of a run that began in `start` can stand so: its number is that of one of
/// the start, or of one of those that a run may add, and sim::check_obstacle_change(). Error
/// kInvalidArgument says what is wrong.
[[nodiscard]] Status check_sight(const ObstacleSight& sight, const world::WorldModel& start);

/// The world of one host in real time. It is the authority for the robots that run here and knows
/// all others only by what their hosts say, when that arrives: they are where their last velocity
/// has brought them since, for at most the `staleness` of their type, after which they stay there
/// and count as stale. They are placed and never moved, so the robots that run here make way for
/// them as for real ones. A robot that nobody has spoken of is not in the world.
///
/// Stands between propose() and apply() of an engine with EngineSpec::own_authority. One owner
/// thread; uses others inside step().
class LiveWorld {
 public:
  /// `spec`: that of the engine, with `local`; nothing of it is kept but a copy. `alone`: there is
  /// no manager, and the changes of obstacles of the spec are made here. Errors: kInvalidArgument.
  [[nodiscard]] static Result<std::unique_ptr<LiveWorld>> create(const sim::EngineSpec& spec,
                                                                 bool alone = false);

  /// Takes in where a robot of another host was. False, and nothing has changed: it runs here, does
  /// not exist, or more recent things are known of it.
  bool see(const RobotSight& sight);
  /// Takes in how an obstacle stands, for the next step; whoever stands there. False: more recent
  /// things are known of it, or it cannot be.
  bool see(ObstacleSight sight);
  /// check_sight() for the world of this run.
  [[nodiscard]] Status check(const ObstacleSight& sight) const;
  /// The latest revision that was heard of, and that of the last step: all obstacles stand as they
  /// should as far as this.
  [[nodiscard]] std::uint64_t heard_revision() const noexcept { return heard_revision_; }
  [[nodiscard]] std::uint64_t shown_revision() const noexcept { return shown_revision_; }

  /// The clock by which others stamp is another one now: what is heard next is the most recent.
  void clock_changed();
  /// Takes in a message of a robot of another host, for the next step; when it was sent counts only
  /// if that is not in the future. `writer`: the process, whose messages arrive in their order.
  /// False: it was heard before, nobody here can make anything of it, or there is no room for it:
  /// the robot has exceeded its TalkLimit, or all together what one step takes.
  bool hear(std::uint64_t writer, const sim::SentPacket& packet, std::span<const std::byte> bytes);

  /// A robot that runs here has the drivers of another type of the spec, and is there, from the
  /// next report of this host on. Error kInvalidArgument: there is no such robot here, or no such
  /// type.
  Status serve(RobotId robot, std::uint32_t type, const Pose2& X_WR);
  /// Puts a simulated robot that runs here elsewhere, from the next step on. Errors:
  /// kInvalidArgument (it would overlap something, it is real, or of another host).
  Status place(const sim::WorldInput& input);
  /// Its host says of a robot whether it is real. False: it runs here or does not exist.
  bool set_reality(RobotId robot, bool simulated);

  /// A host that comes late begins with a later step than 0: makes `own`, its report of step 0, one
  /// of `step`, in which its simulated robots stand at their start or at a place of `starts`. To be
  /// followed by step() and Engine::join(). Errors: kInvalidArgument.
  Status begin_at(std::uint64_t step, std::span<const RobotSight> starts, sim::HostReport& own);

  /// The world of the step that `own`, the report of this host with the number 0, is for. Errors:
  /// those of WorldAuthority::step().
  Status step(const sim::HostReport& own, sim::WorldStep& world);

  /// Of the last step: contacts, pins and changes of bodies of the robots that run here, changes of
  /// obstacles, and who of the others became stale (kPoseStale) or was heard of again (kPoseBack).
  [[nodiscard]] std::span<const sim::Event> events() const noexcept { return events_; }
  /// How many messages of others were dropped because there were too many in one step.
  [[nodiscard]] std::uint64_t dropped_packets() const noexcept { return dropped_packets_; }
  /// Who has exceeded its TalkLimit since the last call; each robot once in a run.
  [[nodiscard]] std::vector<RobotId> take_flooders() { return std::exchange(flooders_, {}); }
  /// How many robots others run.
  [[nodiscard]] std::size_t others() const noexcept { return others_.size(); }

  /// Most messages of others, and bytes of them, in one step.
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
    bool any_stamp = true;       ///< The next sight counts whatever its stamp.
    std::int64_t sample_ns = 0;  ///< Of the last sample that was handed on.
    TalkLimit talk{TalkLimit::kOnReception};
  };
  /// A change of an obstacle that counts from a step on.
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
  void report_samples(SimTime now);
  void report_packets(std::uint64_t step);
  void adopt_obstacles(std::uint64_t step);
  void adopt(const ObstacleSight& sight, bool is_new);
  void take_events(std::uint64_t step);

  std::unique_ptr<sim::WorldAuthority> authority_;
  std::vector<std::uint8_t> local_;       ///< By robot: it runs here.
  std::vector<RobotId> simulated_;        ///< That run here; ascending.
  std::vector<Other> others_;             ///< By robot, ascending.
  std::vector<std::uint32_t> other_of_;   ///< By robot: its place in `others_`.
  std::vector<sim::PoseSample> samples_;  ///< Of real ones, for the steps to come.
  sim::SentPackets heard_;                ///< For the next step.
  std::map<std::pair<std::uint32_t, std::uint32_t>, Counted> newest_;  ///< By robot, communicator.
  sim::HostReport others_report_;
  std::vector<std::uint32_t> order_;  ///< Of `heard_`.
  std::vector<sim::Event> events_;
  std::uint64_t dropped_packets_ = 0;
  std::vector<RobotId> flooders_;                       ///< Not asked for yet.
  std::map<std::uint32_t, ObstacleSight> news_;         ///< Of obstacles, by number.
  std::map<std::uint32_t, std::uint64_t> revision_of_;  ///< The same, of all that was heard.
  std::vector<Adopted> adopted_;  ///< Of which the events come with the next step.
  std::uint64_t heard_revision_ = 0;
  std::uint64_t shown_revision_ = 0;
};

}  // namespace rave::real_time
