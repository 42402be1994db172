// SPDX-License-Identifier: Apache-2.0
// Everything that comes from another process is checked here before any of it is used. A report or
// world that does not pass changes nothing. Whether numbers are finite is known of what came over
// the bus, by rave/bus/validate.hpp; the checks of it here guard against callers in this process,
// whose messages no bus has seen.
#include "message_checks.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "order_checks.hpp"
#include "rave/math/finite.hpp"

namespace rave::sim {
namespace {

std::int64_t time_ns(const EngineSpec& spec, std::uint64_t step) {
  return static_cast<std::int64_t>(step) * spec.step.ns;
}

tl::unexpected<Error> wrong(const EngineSpec& spec, std::uint32_t robot, std::string_view what) {
  const std::string name =
      robot < spec.robots.size() ? spec.robots[robot].name : fmt::format("number {}", robot);
  return fail(ErrorCode::kInvalidArgument, "robot `{}`: {}", name, what);
}

/// Whether `robots` are those that are expected: all of them, each once, ascending.
template <class Robots, class Number>
Status check_robots(const EngineSpec& spec, std::span<const RobotId> expected,
                    std::span<const std::uint32_t> host_of, std::uint32_t host,
                    const Robots& robots, Number number_of, std::string_view what) {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const std::uint32_t robot = number_of(robots[i]);
    // The rest of the loop finds out what is wrong, for the error: in a right report it is never
    // reached.
    if (i < expected.size() && expected[i].value() == robot) continue;
    if (robot >= host_of.size())
      return wrong(spec, robot, fmt::format("{}, but it does not exist", what));
    if (host_of[robot] != host) {
      return wrong(spec, robot, fmt::format("{}, but it runs on host {}", what, host_of[robot]));
    }
    const bool again = std::any_of(robots.begin(), robots.begin() + static_cast<long>(i),
                                   [&](const auto& one) { return number_of(one) == robot; });
    if (again) return wrong(spec, robot, fmt::format("{} twice", what));
    // An earlier one is missing, or this one should not be here.
    if (i >= expected.size() || expected[i].value() > robot) {
      return wrong(spec, robot, fmt::format("{}, which it was not asked for", what));
    }
    return wrong(spec, expected[i].value(), fmt::format("missing among those that have {}", what));
  }
  if (robots.size() == expected.size()) return {};
  return wrong(spec, expected[robots.size()].value(),
               fmt::format("missing among those that have {}", what));
}

Status check_proposals(const EngineSpec& spec, const HostRobots& own,
                       std::span<const std::uint32_t> host_of, const HostReport& report) {
  const Proposals& all = report.proposals;
  const std::size_t count = all.robots.size();
  if (all.vx_mps.size() != count || all.vy_mps.size() != count || all.wz_radps.size() != count) {
    return fail(ErrorCode::kInvalidArgument, "proposals of unequal length");
  }
  const auto expected =
      report.step > 0 ? std::span<const RobotId>(own.simulated) : std::span<const RobotId>();
  RAVE_TRY(check_robots(
      spec, expected, host_of, report.host, all.robots, [](std::uint32_t robot) { return robot; },
      "a proposal"));
  for (std::size_t i = 0; i < count; ++i) {
    if (is_finite(Twist2{all.vx_mps[i], all.vy_mps[i], all.wz_radps[i]})) continue;
    return wrong(spec, all.robots[i], "proposes a velocity that is not finite");
  }
  return {};
}

Status check_pose(const EngineSpec& spec, std::uint64_t step, const PoseReport& report) {
  const ReportedPose& pose = report.reported;
  const Pose2 X_WR{pose.pose.x_m, pose.pose.y_m, pose.pose.yaw_rad};
  if (!is_finite(X_WR) || !is_finite(pose.velocity)) {
    return wrong(spec, report.robot.value(), "a reported pose that is not finite");
  }
  if (pose.stamp.ns > time_ns(spec, step)) {
    return wrong(spec, report.robot.value(), "a reported pose from the future");
  }
  return {};
}

/// Of robots for which `is_theirs` says that they may have any.
template <class IsTheirs>
Status check_samples(const EngineSpec& spec, std::uint64_t step,
                     const std::vector<PoseSample>& samples, IsTheirs is_theirs) {
  const PoseSample* before = nullptr;
  for (const PoseSample& sample : samples) {
    const std::uint32_t robot = sample.robot.value();
    if (robot >= spec.robots.size() || spec.types[spec.robots[robot].type].simulated ||
        !is_theirs(robot)) {
      return wrong(spec, robot, "a sample of its pose from another host");
    }
    if (!is_finite(sample.X_WR)) return wrong(spec, robot, "a sample that is not finite");
    if (sample.stamp.ns > time_ns(spec, step))
      return wrong(spec, robot, "a sample from the future");
    // Strictly ascending: no sample twice, and the same order on every host.
    if (before != nullptr &&
        std::tie(sample.robot, sample.stamp) <= std::tie(before->robot, before->stamp)) {
      return wrong(spec, robot, "samples out of order");
    }
    before = &sample;
  }
  return {};
}

/// Of a packet by itself.
Status check_packet(const EngineSpec& spec, std::uint64_t step, const SentPackets& sent,
                    const SentPacket& packet) {
  const std::uint32_t robot = packet.robot.value();
  if (packet.communicator >= spec.types[spec.robots[robot].type].communicators.size()) {
    return wrong(spec, robot, "a message of a communicator that it does not have");
  }
  if (packet.size > SentPacket::kMostBytes ||
      // In 64 bits: the sum of two numbers from another process may not fit into 32.
      std::uint64_t{packet.first_byte} + packet.size > sent.bytes.size()) {
    return wrong(spec, robot, "a message with missing bytes");
  }
  if (packet.to.kind > RecipientKind::kTeam)
    return wrong(spec, robot, "a message without receiver");
  if (!(std::isfinite(packet.x_m) && std::isfinite(packet.y_m) && std::isfinite(packet.range_m) &&
        packet.range_m >= 0 && std::isfinite(packet.antenna_z_m))) {
    return wrong(spec, robot, "a message with a position or range that is not finite");
  }
  // The report of step n has what left its sender in step n - 1.
  const std::int64_t begin_ns = time_ns(spec, step) - spec.step.ns;
  if (packet.complete_ns < begin_ns || packet.complete_ns > begin_ns + spec.step.ns ||
      packet.stamp_ns > begin_ns) {
    return wrong(spec, robot, "a message for another step");
  }
  return {};
}

template <class IsTheirs>
Status check_sent(const EngineSpec& spec, std::uint64_t step, const SentPackets& sent,
                  IsTheirs is_theirs) {
  if (step == 0 && !sent.packets.empty()) {
    return fail(ErrorCode::kInvalidArgument, "messages before the first step");
  }
  const SentPacket* before = nullptr;
  for (const SentPacket& packet : sent.packets) {
    const std::uint32_t robot = packet.robot.value();
    if (robot >= spec.robots.size() || !is_theirs(robot)) {
      return wrong(spec, robot, "a message from another host");
    }
    RAVE_TRY(check_packet(spec, step, sent, packet));
    if (before != nullptr && std::tie(packet.robot, packet.communicator, packet.sequence) <=
                                 std::tie(before->robot, before->communicator, before->sequence)) {
      return wrong(spec, robot, "messages out of order");
    }
    before = &packet;
  }
  return {};
}

bool is_any(std::uint32_t /*robot*/) { return true; }

Status check_columns(const EngineSpec& spec, const WorldStep& world) {
  const std::size_t count = spec.robots.size();
  for (const auto* const column :
       {&world.x_m, &world.y_m, &world.yaw_rad, &world.vx_mps, &world.vy_mps, &world.wz_radps}) {
    if (column->size() != count || world.flags.size() != count) {
      return fail(ErrorCode::kInvalidArgument, "a world of {} robots, but there are {}",
                  column->size(), count);
    }
    if (!is_finite(*column)) {
      return fail(ErrorCode::kInvalidArgument, "a world with a pose that is not finite");
    }
  }
  return {};
}

/// What people asked of robots of a host.
template <class IsTheirs>
Status check_asked(const EngineSpec& spec, const HostReport& report, IsTheirs is_theirs) {
  for (const WorldInput& input : report.inputs) {
    const bool may = input.is_hold() || is_order_formed(input);
    const std::uint32_t robot = input.robot.value();
    if (may && robot < spec.robots.size() && is_theirs(robot)) continue;
    return wrong(spec, robot, "an input that its host may not forward");
  }
  return {};
}

Status check_inputs(const EngineSpec& spec, const WorldStep& world) {
  for (const WorldInput& input : world.inputs) {
    // Obstacles are the authority's, and reach hosts otherwise.
    const bool known = input.is_hold() || input.is<Change>() || is_order_formed(input);
    const bool all = !input.robot.valid() && (input.is_hold() || input.is<request::Cancel>());
    if (known && (all || input.robot.value() < spec.robots.size())) {
      continue;
    }
    return wrong(spec, input.robot.value(), "an invalid input");
  }
  return {};
}

/// Which obstacles there are while changes are made one after the other.
/// Numbers depend on the changes before, so a list is checked as a whole, without making one.
class ObstacleRoll {
 public:
  /// As the world is now.
  explicit ObstacleRoll(const world::WorldModel& world)
      : world_(world), added_(world.added.size()) {}
  /// As it was at the start.
  [[nodiscard]] static ObstacleRoll at_start(const world::WorldModel& world) {
    ObstacleRoll roll(world);
    roll.added_ = 0;
    roll.nothing_removed_ = true;
    return roll;
  }

  Status take(std::span<const ObstacleChange> changes) {
    for (const ObstacleChange& change : changes) RAVE_TRY(take(change));
    return {};
  }

 private:
  [[nodiscard]] std::uint32_t next() const noexcept {
    return static_cast<std::uint32_t>(world_.obstacles.size() + world_.robots.size() + added_);
  }
  [[nodiscard]] bool stands(BodyId id) const {
    if (!id.valid() || world_.is_robot(id.value()) || id.value() >= next()) return false;
    const world::Obstacle* const obstacle = world_.obstacle(id.value());
    const bool was_removed = obstacle != nullptr && obstacle->removed && !nothing_removed_;
    return !was_removed && !removed_.contains(id);
  }
  Status take(const ObstacleChange& change) {
    RAVE_TRY(check_obstacle_change(change));
    const auto wrong_id = [&](std::string_view what) {
      return fail(ErrorCode::kInvalidArgument, "obstacle `{}`, number {}: {}", change.name,
                  change.id.value(), what);
    };
    if (change.kind == ObstacleChange::Kind::kAdd) {
      if (change.id.value() != next()) {
        return wrong_id(fmt::format("added, but number {} comes next", next()));
      }
      ++added_;
      return {};
    }
    if (!stands(change.id)) return wrong_id("changed, but there is no such obstacle");
    if (change.kind == ObstacleChange::Kind::kRemove) removed_.insert(change.id);
    return {};
  }

  const world::WorldModel& world_;
  std::size_t added_;
  bool nothing_removed_ = false;
  std::set<BodyId> removed_;
};

Status check_obstacles(const EngineSpec& spec, const WorldStep& world) {
  if (world.obstacles.empty()) return {};
  return ObstacleRoll(spec.world).take(world.obstacles);
}

}  // namespace

void HostRobots::set_type(RobotId robot, const RobotType& type) {
  // Both lists stay ascending, because reports are compared with them element by element.
  const auto put = [robot](std::vector<RobotId>& robots, bool is_one) {
    const auto place = std::lower_bound(robots.begin(), robots.end(), robot);
    const bool was_one = place != robots.end() && *place == robot;
    if (is_one && !was_one) robots.insert(place, robot);
    if (!is_one && was_one) robots.erase(place);
  };
  put(simulated, type.simulated);
  put(told, type.pose_from.has_value());
}

Status check_report(const EngineSpec& spec, const HostRobots& own,
                    std::span<const std::uint32_t> host_of, const HostReport& report) {
  RAVE_TRY(check_proposals(spec, own, host_of, report));
  RAVE_TRY(check_robots(
      spec, own.told, host_of, report.host, report.poses,
      [](const PoseReport& pose) { return pose.robot.value(); }, "a reported pose"));
  for (const PoseReport& pose : report.poses) RAVE_TRY(check_pose(spec, report.step, pose));
  const auto is_theirs = [&](std::uint32_t robot) { return host_of[robot] == report.host; };
  RAVE_TRY(check_samples(spec, report.step, report.samples, is_theirs));
  RAVE_TRY(check_asked(spec, report, is_theirs));
  return check_sent(spec, report.step, report.sent, is_theirs);
}

Status check_world_step(const EngineSpec& spec, const WorldStep& world) {
  // First, since the rest takes the lengths of the columns for granted.
  RAVE_TRY(check_columns(spec, world));
  const std::size_t count = spec.robots.size();
  for (const PushedRobot& pushed : world.pushed) {
    if (pushed.robot.value() < count && is_finite(pushed.X_WR)) continue;
    return wrong(spec, pushed.robot.value(), "pushed to an invalid pose");
  }
  for (const TouchPoint& point : world.touches) {
    if (point.robot.value() < count && is_finite(point.direction_W)) continue;
    return wrong(spec, point.robot.value(), "touches something at an invalid place");
  }
  for (const PoseReport& pose : world.poses) {
    if (pose.robot.value() >= count) return wrong(spec, pose.robot.value(), "a reported pose");
    RAVE_TRY(check_pose(spec, world.step, pose));
  }
  for (const ResizedRobot& resized : world.resized) {
    if (resized.robot.value() < count && std::isfinite(resized.scale)) continue;
    return wrong(spec, resized.robot.value(), "an impossible size of a body");
  }
  RAVE_TRY(check_obstacles(spec, world));
  RAVE_TRY(check_inputs(spec, world));
  RAVE_TRY(check_samples(spec, world.step, world.samples, is_any));
  return check_sent(spec, world.step, world.sent, is_any);
}

Status check_told_obstacles(const EngineSpec& spec, const WorldStep& world,
                            const AuthorityState& state) {
  // A manager leaves them out of most worlds, because they are long. A late host needs a world that
  // has them.
  if (state.obstacles.empty() && state.obstacle_changes > 0) {
    return fail(ErrorCode::kInvalidArgument,
                "obstacles had changed {} times before this world, but the changes are missing",
                state.obstacle_changes);
  }
  if (state.obstacles.size() > state.obstacle_changes) {
    return fail(ErrorCode::kInvalidArgument, "{} changes of obstacles, but only {} were made",
                state.obstacles.size(), state.obstacle_changes);
  }
  ObstacleRoll roll = ObstacleRoll::at_start(spec.world);
  RAVE_TRY(roll.take(state.obstacles));
  return roll.take(world.obstacles);
}

Status check_taken_over(const EngineSpec& spec, const WorldStep& world, const AuthorityState& state,
                        bool needs_obstacles) {
  WorldStep bare = world;
  // These are relative to the obstacles of `state` and not to those that this process has now.
  bare.obstacles.clear();
  RAVE_TRY(check_world_step(spec, bare));
  if (needs_obstacles) RAVE_TRY(check_told_obstacles(spec, world, state));
  const std::size_t robots = spec.robots.size();
  const bool pinned = std::all_of(state.pinned.begin(), state.pinned.end(),
                                  [&](RobotId robot) { return robot.value() < robots; });
  const bool sizes = std::all_of(state.scales.begin(), state.scales.end(), [&](const auto& robot) {
    return robot.robot.value() < robots && std::isfinite(robot.scale);
  });
  const auto exists = [&](const Event& event) {
    return !event.robot.valid() || event.robot.value() < robots;
  };
  const std::size_t bodies =
      spec.world.body_count() + state.obstacles.size() + world.obstacles.size();
  const auto whole = [&](const Event& event) {
    return exists(event) && (!event.other.valid() || event.other.value() < bodies);
  };
  const bool events =
      std::ranges::all_of(state.events, exists) && std::ranges::all_of(state.done, whole);
  const bool refused = std::ranges::all_of(
      state.refused, [&](const Event& event) { return exists(event) && event.step <= world.step; });
  if (state.refused.size() > std::min<std::uint64_t>(state.refused_count, state.kMostRefused)) {
    return fail(ErrorCode::kInvalidArgument, "{} refused changes, but only {} were made",
                state.refused.size(), state.refused_count);
  }
  if (pinned && sizes && events && refused) return {};
  return fail(ErrorCode::kInvalidArgument, "a state with robots that do not exist");
}

}  // namespace rave::sim
