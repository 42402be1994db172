// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/live_world.hpp"

#include <algorithm>
#include <array>

#include "rave/base/check.hpp"
#include "rave/math/transform.hpp"

namespace rave::real_time {
namespace {

// The authority here sees a run of two hosts: this one, and one that stands for all others. So real
// time uses the same engine and authority as lock-step, only the second report is computed and not
// received.
constexpr std::uint32_t kOwn = 0;
constexpr std::uint32_t kOthers = 1;
constexpr std::uint32_t kNone = RobotId::kNone;

std::vector<std::uint8_t> local_robots(const sim::EngineSpec& spec) {
  std::vector<std::uint8_t> local(spec.robots.size(), spec.local ? 0 : 1);
  if (!spec.local) return local;
  for (const RobotId robot : *spec.local) local[robot.value()] = 1;
  return local;
}

/// The parts of a type that an authority uses.
sim::RobotType outline_of(const sim::RobotType& type) {
  sim::RobotType outline;
  outline.name = type.name;
  outline.simulated = type.simulated;
  outline.pose_from = type.pose_from;
  outline.staleness = type.staleness;
  outline.communicators.resize(type.communicators.size());
  return outline;
}

/// A copy of the world in which the simulated robots of other hosts have types that are only
/// placed. Their bodies keep their layer, so sensors distinguish them from real robots.
sim::EngineSpec world_of(const sim::EngineSpec& spec, const std::vector<std::uint8_t>& local,
                         bool alone) {
  sim::EngineSpec world;
  world.world = spec.world;
  world.robots = spec.robots;
  world.step = spec.step;
  world.seed = spec.seed;
  world.threads = spec.threads;
  world.share_always = spec.share_always;
  for (const sim::RobotType& type : spec.types) world.types.push_back(outline_of(type));
  std::vector<std::uint32_t> placed(spec.types.size(), kNone);
  for (std::size_t r = 0; r < local.size(); ++r) {
    std::uint32_t& type = world.robots[r].type;
    if (local[r] != 0 || !spec.types[type].simulated) continue;
    // One more type per type that has robots elsewhere, with `simulated` off and a pose source:
    // that is what an authority calls a real robot, which it places and never pushes.
    if (placed[type] == kNone) {
      placed[type] = static_cast<std::uint32_t>(world.types.size());
      world.types.push_back(outline_of(spec.types[type]));
      world.types.back().simulated = false;
      world.types.back().pose_from = 0;
    }
    type = placed[type];
  }
  // Otherwise the manager changes the obstacles.
  if (alone) world.obstacle_changes = spec.obstacle_changes;
  // The robots of other hosts are changed by those hosts.
  for (const sim::ScheduledChange& change : spec.changes) {
    if (local[change.robot.value()] != 0) world.changes.push_back(change);
  }
  return world;
}

}  // namespace

Status check_sight(const ObstacleSight& sight, const world::WorldModel& start) {
  const std::uint32_t id = sight.stands.id.value();
  const bool adds = sight.stands.kind == sim::ObstacleChange::Kind::kAdd;
  // Bodies are numbered: obstacles of the start, robots, then obstacles added during the run.
  const std::size_t first_added = start.obstacles.size() + start.robots.size();
  const bool possible =
      adds ? id >= first_added && id - first_added < sim::ObstacleChange::kMostAdded
           : id < start.obstacles.size();
  if (!possible) {
    return fail(ErrorCode::kInvalidArgument, "{} {} does not belong to the run",
                adds ? "an added obstacle with the number" : "obstacle", id);
  }
  // A huge revision from a faulty process would make all later, right ones look old.
  if (sight.revision == 0 || sight.revision > ObstacleSight::kMostRevision) {
    return fail(ErrorCode::kInvalidArgument,
                "obstacle {} has the change number {}; expected 1 to {}", id, sight.revision,
                ObstacleSight::kMostRevision);
  }
  return sim::check_obstacle_change(sight.stands);
}

LiveWorld::LiveWorld(const sim::EngineSpec& spec, std::unique_ptr<sim::WorldAuthority> authority)
    : authority_(std::move(authority)),
      local_(local_robots(spec)),
      other_of_(spec.robots.size(), kNone) {
  others_report_.host = kOthers;
  for (std::uint32_t r = 0; r < local_.size(); ++r) {
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    if (local_[r] != 0) {
      if (type.simulated) simulated_.emplace_back(r);
      continue;
    }
    other_of_[r] = static_cast<std::uint32_t>(others_.size());
    Other& other = others_.emplace_back();
    other.last.robot = RobotId(r);
    const sim::RobotType& twin = spec.types[spec.robots[r].twin.value_or(spec.robots[r].type)];
    other.staleness = type.staleness;
    // The twin may have a different limit. The robot starts with its first set of drivers, so that
    // one overwrites the twin's if both are of one kind.
    other.staleness_of.fill(type.staleness);
    other.staleness_of[twin.simulated ? 1 : 0] = twin.staleness;
    other.staleness_of[type.simulated ? 1 : 0] = type.staleness;
    other.real = !type.simulated;
    // Below any stamp, so that the first sample counts.
    other.sample_ns = INT64_MIN;
  }
}

Result<std::unique_ptr<LiveWorld>> LiveWorld::create(const sim::EngineSpec& spec, bool alone) {
  const std::vector<std::uint8_t> local = local_robots(spec);
  std::vector<std::uint32_t> host_of;
  for (const std::uint8_t here : local) host_of.push_back(here != 0 ? kOwn : kOthers);
  RAVE_TRY_ASSIGN(auto authority,
                  sim::WorldAuthority::create(world_of(spec, local, alone), std::move(host_of)));
  return std::unique_ptr<LiveWorld>(new LiveWorld(spec, std::move(authority)));
}

SimTime LiveWorld::time_of(std::uint64_t step) const noexcept {
  return {static_cast<std::int64_t>(step) * authority_->spec().step.ns};
}

bool LiveWorld::see(const RobotSight& sight) {
  const std::uint32_t r = sight.robot.value();
  if (r >= other_of_.size() || other_of_[r] == kNone) return false;
  Other& other = others_[other_of_[r]];
  // A world repeats the last pose of each robot until its host reports a newer one.
  if (!other.any_stamp && sight.stamp <= other.last.stamp) return false;
  other.last = sight;
  other.known = true;
  other.any_stamp = false;
  // Limits the memory that a sender with a fast clock can use.
  if (other.real && samples_.size() < kMostPackets)
    samples_.push_back({sight.robot, sight.stamp, sight.X_WR});
  return true;
}

Status LiveWorld::check(const ObstacleSight& sight) const {
  return check_sight(sight, authority_->world());
}

bool LiveWorld::see(ObstacleSight sight) {
  if (!check(sight)) return false;
  const std::uint32_t id = sight.stands.id.value();
  std::uint64_t& known = revision_of_[id];
  // A reader that is made anew receives all obstacles again.
  if (sight.revision <= known) return false;
  known = sight.revision;
  heard_revision_ = std::max(heard_revision_, sight.revision);
  news_[id] = std::move(sight);
  return true;
}

/// Adopts received obstacles in the order of their numbers; one whose predecessor is missing waits
/// for it.
void LiveWorld::adopt_obstacles(std::uint64_t step) {
  if (news_.empty()) return;
  // The authority numbers additions itself, by appending. So they must be applied in this order for
  // all hosts to have the same numbers.
  std::uint32_t next = authority_->world().body_count();
  for (auto it = news_.begin(); it != news_.end() && it->first <= next; it = news_.erase(it)) {
    const bool is_new = it->first == next;
    adopt(it->second, is_new);
    adopted_.push_back({step, it->second.stands.id, it->second.revision});
    if (is_new) ++next;
  }
  if (news_.empty()) shown_revision_ = heard_revision_;
}

void LiveWorld::adopt(const ObstacleSight& sight, bool is_new) {
  using Kind = sim::ObstacleChange::Kind;
  const world::Obstacle* const obstacle = authority_->world().obstacle(sight.stands.id.value());
  sim::ObstacleChange change = sight.stands;
  // A removed obstacle never comes back under its number.
  if (!is_new && (obstacle == nullptr || obstacle->removed)) return;
  if (!is_new && change.kind == Kind::kAdd) {
    // The manager publishes an added obstacle with its body each time it changes. Here it exists
    // already, so the rest is a move.
    change.body = {};
    change.kind = Kind::kMove;
    if (!sight.removed) authority_->adopt(change);
  } else {
    authority_->adopt(change);
  }
  if (!sight.removed) return;
  change.body = {};
  change.kind = Kind::kRemove;
  authority_->adopt(change);
}

void LiveWorld::clock_changed() {
  // Otherwise stamps by a clock that is behind the old one would be refused until they had caught
  // up.
  for (Other& other : others_) {
    other.any_stamp = true;
    other.shown = SimTime{INT64_MAX};
  }
}

// Two limits: one for the step, which protects this host from many robots, and one per robot, which
// keeps a flooding robot from using up the room of the others.
bool LiveWorld::has_room_for(Other& other, std::size_t bytes) {
  if (heard_.packets.size() >= kMostPackets || heard_.bytes.size() + bytes > kMostBytes) {
    return false;
  }
  if (other.talk.take(bytes)) return true;
  if (other.talk.name()) flooders_.push_back(other.last.robot);
  return false;
}

bool LiveWorld::hear(std::uint64_t writer, const sim::SentPacket& packet,
                     std::span<const std::byte> bytes) {
  const std::uint32_t r = packet.robot.value();
  if (r >= other_of_.size() || other_of_[r] == kNone) return false;
  const sim::EngineSpec& spec = authority_->spec();
  // The bus has checked the numbers and kinds. The number of communicators depends on the scenario,
  // which the bus does not know.
  const bool sane = packet.communicator < spec.types[spec.robots[r].type].communicators.size() &&
                    bytes.size() <= sim::SentPacket::kMostBytes;
  if (!sane) return false;
  // A restarted process counts from the beginning.
  Counted& newest = newest_[{r, packet.communicator}];
  // Messages of one process arrive in order, so one that is not newer is a duplicate.
  if (newest.writer == writer && packet.sequence <= newest.sequence) return false;
  // Noted before the limits: a packet that was dropped must not be accepted as new when it is
  // repeated.
  newest = {writer, packet.sequence};
  if (!has_room_for(others_[other_of_[r]], bytes.size())) {
    ++dropped_packets_;
    return false;
  }
  heard_.add(packet, bytes);
  return true;
}

Status LiveWorld::serve(RobotId robot, std::uint32_t type, const Pose2& X_WR) {
  const std::uint32_t r = robot.value();
  if (r >= local_.size() || local_[r] == 0) {
    return fail(ErrorCode::kInvalidArgument, "robot {} does not run here", r);
  }
  RAVE_TRY(authority_->change_type(robot, type, X_WR));
  std::erase(simulated_, robot);
  if (!authority_->spec().types[type].simulated) return {};
  // Ascending, as the proposals of a report must be.
  simulated_.insert(std::lower_bound(simulated_.begin(), simulated_.end(), robot), robot);
  return {};
}

Status LiveWorld::place(const sim::WorldInput& input) {
  RAVE_TRY(authority_->check_place(input));
  RAVE_TRY(authority_->ask(input));
  return {};
}

bool LiveWorld::set_reality(RobotId robot, bool simulated) {
  const std::uint32_t r = robot.value();
  if (r >= other_of_.size() || other_of_[r] == kNone) return false;
  Other& other = others_[other_of_[r]];
  other.real = !simulated;
  other.staleness = other.staleness_of[simulated ? 1 : 0];
  // Samples are for looking back in time, which is done for real robots only.
  if (simulated) {
    std::erase_if(samples_, [robot](const sim::PoseSample& one) { return one.robot == robot; });
  }
  return true;
}

Status LiveWorld::begin_at(std::uint64_t step, std::span<const RobotSight> starts,
                           sim::HostReport& own) {
  if (step == 0) return {};
  const sim::EngineSpec& spec = authority_->spec();
  // A world as the authority would have left it one step earlier, so that resume() continues at
  // `step`. Robots of others are absent until their hosts report them.
  sim::WorldStep before;
  before.begin(step - 1, spec.robots.size());
  const auto put = [&before](std::uint32_t robot, const Pose2& X_WR) {
    before.x_m[robot] = X_WR.x;
    before.y_m[robot] = X_WR.y;
    before.yaw_rad[robot] = X_WR.yaw;
  };
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    put(r, spec.robots[r].X_WR);
    const bool simulated = spec.types[spec.robots[r].type].simulated;
    before.flags[r] = simulated ? sim::WorldStep::kPresent : 0;
  }
  for (const RobotSight& start : starts) {
    const std::uint32_t r = start.robot.value();
    if (r < local_.size() && local_[r] != 0) put(r, start.X_WR);
  }
  RAVE_TRY(authority_->resume(before, {}));
  authority_->repeat_schedule();
  own.step = step;
  // Its robots stand: the engine has proposed nothing for a step that it did not compute.
  own.proposals.clear();
  for (const RobotId robot : simulated_) own.proposals.robots.push_back(robot.value());
  own.proposals.vx_mps.assign(simulated_.size(), 0);
  own.proposals.vy_mps.assign(simulated_.size(), 0);
  own.proposals.wz_radps.assign(simulated_.size(), 0);
  return {};
}

Status LiveWorld::step(const sim::HostReport& own, sim::WorldStep& world) {
  RAVE_CHECK(own.host == kOwn);
  events_.clear();
  std::array<const sim::HostReport*, 2> reports = {&own, &others_report_};
  if (!others_.empty()) report_others(own.step);
  adopt_obstacles(own.step);
  RAVE_TRY(authority_->step(std::span(reports).first(others_.empty() ? 1 : 2), world));
  take_events(own.step);
  return {};
}

/// Each host receives a change at its own time; the number identifies it.
void LiveWorld::take_events(std::uint64_t step) {
  for (const sim::Event& event : authority_->events()) {
    if (event.robot.valid() && local_[event.robot.value()] == 0) continue;
    sim::Event& taken = events_.emplace_back(event);
    if (!is_of_obstacle(event.kind)) continue;
    const auto change = std::find_if(adopted_.begin(), adopted_.end(), [&](const Adopted& one) {
      return one.step == event.step && one.id == event.other;
    });
    if (change != adopted_.end()) taken.detail = static_cast<std::uint32_t>(change->revision);
  }
  std::erase_if(adopted_, [step](const Adopted& one) { return one.step < step; });
}

}  // namespace rave::real_time
