// SPDX-License-Identifier: Apache-2.0
#include "rave/sim/world_authority.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "input_notes.hpp"
#include "message_checks.hpp"
#include "rave/sim/obstacle_history.hpp"
#include "spec_checks.hpp"
#include "world_truth.hpp"

namespace rave::sim {
namespace {

Status check_hosts(const EngineSpec& spec, std::span<const std::uint32_t> host_of) {
  if (host_of.size() != spec.robots.size() || host_of.empty()) {
    return fail(ErrorCode::kInvalidArgument, "hosts for {} robots, but there are {}",
                host_of.size(), spec.robots.size());
  }
  const std::uint32_t last = *std::max_element(host_of.begin(), host_of.end());
  for (std::uint32_t host = 0; host < last; ++host) {
    if (last < host_of.size() && std::find(host_of.begin(), host_of.end(), host) != host_of.end()) {
      continue;
    }
    return fail(ErrorCode::kInvalidArgument, "host {} runs no robot, but there is a host {}", host,
                last);
  }
  return {};
}

}  // namespace

struct WorldAuthority::Impl {
  Impl(EngineSpec s, std::vector<std::uint32_t> hosts);

  void begin();
  [[nodiscard]] Status check(const HostReport& report) const;
  [[nodiscard]] Status check(std::span<const HostReport* const> reports);
  void finish_step();
  void take_over(const WorldStep& world);
  void put_refusal_texts(std::uint64_t in_step);
  void make_changes(WorldStep& world);
  void do_input(WorldInput& input, WorldStep& world);
  Status change_body(RobotId robot, std::span<const ParameterChange> changes, Author author,
                     WorldStep& world);
  Status change_obstacle(const ObstacleChange& change, Author author, WorldStep& world);
  void make_obstacle_changes(WorldStep& world);
  void refuse(RobotId robot, const Error& why);
  void take_over_obstacles(WorldStep& world);
  void close_obstacles();
  void place_real_robots();
  void write_poses(WorldStep& world) const;
  void write_contacts(WorldStep& world);
  void write_messages(WorldStep& world);

  EngineSpec spec;
  std::vector<std::uint32_t> host_of;  ///< By robot.
  std::vector<HostRobots> hosts;
  std::vector<const HostReport*> by_host;  ///< During step() alone.
  ThreadPool pool;
  WorldTruth truth;
  std::uint64_t step = 0;     ///< The world of this one comes next.
  std::vector<Event> events;  ///< So far, of the step that the hosts are in.
  RunHash hash;
  // Of the steps that are done:
  std::vector<Event> done_events;
  RunHash done_hash;
  std::vector<WorldInput> asked;  ///< For the next step.
  std::uint64_t inputs = 0;
  std::size_t next_change = 0;
  std::size_t next_obstacle = 0;               ///< Of spec.obstacle_changes.
  ObstacleHistory history;                     ///< Before the world that was made last.
  std::vector<ObstacleChange> last_obstacles;  ///< Of that world.
  std::vector<ObstacleChange> adopted;         ///< Of another authority, for the next step.
  std::vector<InputRefusal> refusals;
  std::uint64_t refused_count = 0;  ///< Changes of the scenario, in all steps.
  std::vector<Event> refused;       ///< The first of them.
  std::vector<std::pair<const SentPacket*, const SentPackets*>> sent;  ///< During step() alone.
  std::vector<std::uint32_t> seen;  ///< Robots that were pushed, with repetition.
};

WorldAuthority::Impl::Impl(EngineSpec s, std::vector<std::uint32_t> h)
    : spec(std::move(s)),
      host_of(std::move(h)),
      hosts(1 + *std::max_element(host_of.begin(), host_of.end())),
      pool(spec.threads, spec.share_always),
      truth(spec, pool) {
  for (std::uint32_t r = 0; r < host_of.size(); ++r) {
    const RobotType& type = spec.types[spec.robots[r].type];
    HostRobots& own = hosts[host_of[r]];
    if (type.simulated) own.simulated.emplace_back(r);
    if (type.pose_from) own.told.emplace_back(r);
  }
  begin();
}

void WorldAuthority::Impl::begin() {
  static_cast<void>(truth.restore_obstacles());
  static_cast<void>(truth.restore_bodies());
  truth.begin();
  step = 0;
  events.clear();
  hash = RunHash();
  done_events.clear();
  done_hash = RunHash();
  asked.clear();
  inputs = 0;
  next_change = 0;
  next_obstacle = 0;
  history = {};
  last_obstacles.clear();
  adopted.clear();
  refusals.clear();
  refused_count = 0;
  refused.clear();
}

Status WorldAuthority::Impl::check(const HostReport& report) const {
  if (report.host >= hosts.size()) {
    return fail(ErrorCode::kInvalidArgument, "a report of host {}, but there are {}", report.host,
                hosts.size());
  }
  const auto named = [&](Error error) {
    return tl::unexpected(std::move(error).with_context(fmt::format("host {}", report.host)));
  };
  if (report.state > HostState::kDone) {
    return named({ErrorCode::kState, fmt::format("cannot go on: {}", report.text), {}});
  }
  if (report.step != step) {
    return named({ErrorCode::kInvalidArgument,
                  fmt::format("a report for step {}, but step {} comes next", report.step, step),
                  {}});
  }
  const Status status = check_report(spec, hosts[report.host], host_of, report);
  if (!status) return named(status.error());
  return {};
}

/// Sorts the reports by host, too.
Status WorldAuthority::Impl::check(std::span<const HostReport* const> reports) {
  by_host.assign(hosts.size(), nullptr);
  for (const HostReport* const report : reports) {
    RAVE_TRY(check(*report));
    if (by_host[report->host] != nullptr) {
      return fail(ErrorCode::kInvalidArgument, "host {}: two reports for one step", report->host);
    }
    by_host[report->host] = report;
  }
  for (std::size_t host = 0; host < hosts.size(); ++host) {
    if (by_host[host] == nullptr) {
      return fail(ErrorCode::kState, "host {} has not reported for step {}", host, step);
    }
  }
  return {};
}

/// The step that the hosts have been in: where their robots want to go, and what comes of it.
void WorldAuthority::Impl::finish_step() {
  for (const HostReport* const report : by_host) {
    const Proposals& all = report->proposals;
    for (std::size_t i = 0; i < all.robots.size(); ++i) {
      truth.proposal[all.robots[i]] = {all.vx_mps[i], all.vy_mps[i], all.wz_radps[i]};
    }
  }
  truth.resolve(step - 1, events);
  hash.merge(truth.hash_poses(step - 1));
  finish_events(step - 1, events, hash);
  done_hash = hash;
  done_events.swap(events);
  events.clear();
}

void WorldAuthority::Impl::make_changes(WorldStep& world) {
  for (WorldInput& input : asked) do_input(input, world);
  asked.clear();
  take_over_obstacles(world);
  make_obstacle_changes(world);
  for (; next_change < spec.changes.size() && spec.changes[next_change].step <= step;
       ++next_change) {
    const ScheduledChange& scheduled = spec.changes[next_change];
    if (scheduled.changes.empty() || !is_of_body(scheduled.changes.front())) continue;
    const Status status = change_body(scheduled.robot, scheduled.changes, Author::kRun, world);
    if (status) continue;
    refuse(scheduled.robot, status.error());
  }
}

void WorldAuthority::Impl::make_obstacle_changes(WorldStep& world) {
  for (; next_obstacle < spec.obstacle_changes.size() &&
         spec.obstacle_changes[next_obstacle].step <= step;
       ++next_obstacle) {
    const Status status =
        change_obstacle(spec.obstacle_changes[next_obstacle].change, Author::kRun, world);
    if (status) continue;
    refuse(RobotId(), status.error());
  }
}

/// A change of the scenario that cannot be made.
void WorldAuthority::Impl::refuse(RobotId robot, const Error& why) {
  events.push_back(
      noted_input(step, robot, EventKind::kChangeRefused, why.text(), Author::kRun, hash));
  if (refused_count++ < AuthorityState::kMostRefused) refused.push_back(events.back());
}

Status WorldAuthority::Impl::change_obstacle(const ObstacleChange& change, Author author,
                                             WorldStep& world) {
  std::string note;
  const SimTime from{static_cast<std::int64_t>(step) * spec.step.ns};
  RAVE_TRY_ASSIGN(ObstacleChange made, truth.change_obstacle(change, from, note));
  events.push_back(noted_obstacle(step, made, note, author, hash));
  world.obstacles.push_back(std::move(made));
  return {};
}

/// What another authority has decided already.
void WorldAuthority::Impl::take_over_obstacles(WorldStep& world) {
  truth.put_obstacles(adopted, {static_cast<std::int64_t>(step) * spec.step.ns});
  for (ObstacleChange& change : adopted) {
    const Author author = change.asked.empty() ? Author::kRun : Author::kHand;
    events.push_back(noted_obstacle(step, change, "", author, hash));
    world.obstacles.push_back(std::move(change));
  }
  adopted.clear();
}

/// What the hosts have been told by now.
void WorldAuthority::Impl::close_obstacles() {
  for (const ObstacleChange& change : last_obstacles) history.add(change);
  last_obstacles.clear();
}

void WorldAuthority::Impl::do_input(WorldInput& input, WorldStep& world) {
  if (input.kind == WorldInput::Kind::kObstacle) {
    const Status status = change_obstacle(*input.obstacle, input.author, world);
    if (!status) refusals.push_back({input.sequence, status.error().text()});
    return;
  }
  const bool here = input.kind == WorldInput::Kind::kChange && is_of_body(input.changes.front());
  if (!here) {
    world.inputs.push_back(std::move(input));
    return;
  }
  const Status status = change_body(input.robot, input.changes, input.author, world);
  if (!status) refusals.push_back({input.sequence, status.error().text()});
}

Status WorldAuthority::Impl::change_body(RobotId robot, std::span<const ParameterChange> changes,
                                         Author author, WorldStep& world) {
  for (const ParameterChange& change : changes) {
    const Status checked = check_body_change(change);
    if (!checked) return refused_change(spec, robot, "body", checked.error());
  }
  const double before = truth.scale_of(robot);
  const double after = std::get<double>(changes.back().value);
  const Status resized = truth.resize(robot, after);
  if (!resized) return refused_change(spec, robot, "body", resized.error());
  world.resized.push_back({robot, after});
  events.push_back(
      noted_input(step, robot, EventKind::kChanged, body_change_text(before, after), author, hash));
  return {};
}

void WorldAuthority::Impl::place_real_robots() {
  for (const HostReport* const report : by_host) {
    for (const PoseReport& pose : report->poses) {
      const std::uint32_t r = pose.robot.value();
      if (truth.movers[r].simulated) continue;
      const ReportedPose& reported = pose.reported;
      truth.movers[r].X_WR = {reported.pose.x_m, reported.pose.y_m, reported.pose.yaw_rad};
      truth.movers[r].present = reported.known;
      truth.velocity[r] = reported.velocity;
    }
  }
}

void WorldAuthority::Impl::write_poses(WorldStep& world) const {
  for (std::size_t r = 0; r < truth.movers.size(); ++r) {
    const Mover& mover = truth.movers[r];
    world.x_m[r] = mover.X_WR.x;
    world.y_m[r] = mover.X_WR.y;
    world.yaw_rad[r] = mover.X_WR.yaw;
    world.vx_mps[r] = truth.velocity[r].vx;
    world.vy_mps[r] = truth.velocity[r].vy;
    world.wz_radps[r] = truth.velocity[r].wz;
    world.flags[r] = static_cast<std::uint8_t>((mover.present ? WorldStep::kPresent : 0U) |
                                               (truth.limited[r] != 0 ? WorldStep::kLimited : 0U));
  }
}

void WorldAuthority::Impl::write_contacts(WorldStep& world) {
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  for (const std::uint32_t r : seen) {
    world.pushed.push_back({RobotId(r), truth.movers[r].X_WR});
  }
  for (std::uint32_t r = 0; r < truth.touch.size(); ++r) {
    if (!truth.touch[r].touching) continue;
    world.touches.push_back({RobotId(r), truth.touch[r].direction_W});
  }
}

void WorldAuthority::Impl::write_messages(WorldStep& world) {
  for (const HostReport* const report : by_host) {
    world.last = world.last || report->state == HostState::kDone;
    world.poses.insert(world.poses.end(), report->poses.begin(), report->poses.end());
    world.samples.insert(world.samples.end(), report->samples.begin(), report->samples.end());
    refusals.insert(refusals.end(), report->refusals.begin(), report->refusals.end());
    for (const SentPacket& packet : report->sent.packets) {
      sent.emplace_back(&packet, &report->sent);
    }
  }
  std::sort(world.poses.begin(), world.poses.end(),
            [](const auto& a, const auto& b) { return a.robot < b.robot; });
  std::sort(world.samples.begin(), world.samples.end(), [](const auto& a, const auto& b) {
    return std::tie(a.robot, a.stamp) < std::tie(b.robot, b.stamp);
  });
  std::sort(sent.begin(), sent.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first->robot, a.first->communicator, a.first->sequence) <
           std::tie(b.first->robot, b.first->communicator, b.first->sequence);
  });
  for (const auto& [packet, all] : sent) world.sent.add(*packet, all->bytes_of(*packet));
  sent.clear();
}

WorldAuthority::WorldAuthority(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
WorldAuthority::~WorldAuthority() = default;

Result<std::unique_ptr<WorldAuthority>> WorldAuthority::create(EngineSpec spec,
                                                               std::vector<std::uint32_t> host_of) {
  RAVE_TRY(check_world(spec));
  RAVE_TRY(check_shared(spec));
  RAVE_TRY(check_hosts(spec, host_of));
  return std::unique_ptr<WorldAuthority>(
      new WorldAuthority(std::make_unique<Impl>(std::move(spec), std::move(host_of))));
}

Status WorldAuthority::step(std::span<const HostReport* const> reports, WorldStep& world) {
  Impl& authority = *impl_;
  RAVE_TRY(authority.check(reports));
  WorldTruth& truth = authority.truth;
  world.begin(authority.step, authority.spec.robots.size());
  authority.refusals.clear();
  authority.close_obstacles();
  if (authority.step > 0) authority.finish_step();
  authority.make_changes(world);
  authority.last_obstacles = world.obstacles;
  authority.place_real_robots();
  authority.write_poses(world);
  truth.make_way();
  authority.seen.clear();
  for (const ContactNote& note : truth.notes) authority.seen.push_back(note.robot);
  truth.note_contacts(authority.step, authority.events);
  truth.show(SimTime{static_cast<std::int64_t>(authority.step) * authority.spec.step.ns});
  authority.write_contacts(world);
  authority.write_messages(world);
  ++authority.step;
  return {};
}

Status WorldAuthority::check(const HostReport& report) const { return impl_->check(report); }

AuthorityState WorldAuthority::state(bool with_obstacles) const {
  const Impl& authority = *impl_;
  AuthorityState state;
  state.hash = authority.hash;
  state.events = authority.events;
  state.pinned = authority.truth.pinned();
  for (const auto& [robot, scale] : authority.truth.scales()) {
    state.scales.push_back({RobotId(robot), scale});
  }
  state.inputs = authority.inputs;
  state.obstacle_changes = authority.history.count();
  if (with_obstacles) state.obstacles = authority.history.changes();
  state.refused_count = authority.refused_count;
  state.refused = authority.refused;
  std::ranges::copy_if(authority.done_events, std::back_inserter(state.done), [](const Event& e) {
    return e.kind == EventKind::kContact || e.kind == EventKind::kPinned;
  });
  return state;
}

void WorldAuthority::repeat_schedule() noexcept {
  impl_->next_change = 0;
  impl_->next_obstacle = 0;
}

Status WorldAuthority::resume(const WorldStep& world, const AuthorityState& state) {
  Impl& authority = *impl_;
  RAVE_TRY(check_taken_over(authority.spec, world, state, true));
  authority.begin();
  for (const ResizedRobot& resized : state.scales) {
    RAVE_TRY(authority.truth.put_scale(resized.robot, resized.scale));
  }
  const SimTime now{static_cast<std::int64_t>(world.step) * authority.spec.step.ns};
  authority.truth.put_obstacles(state.obstacles, now);
  authority.truth.put_obstacles(world.obstacles, now);
  authority.history = ObstacleHistory(state.obstacles, state.obstacle_changes);
  authority.last_obstacles = world.obstacles;
  authority.take_over(world);
  authority.truth.take_over(SimTime{static_cast<std::int64_t>(world.step) * authority.spec.step.ns},
                            state.pinned);
  authority.step = world.step + 1;
  authority.hash = state.hash;
  authority.done_hash = state.hash;
  authority.done_events = state.done;  // who gets that world again is told them again
  authority.events = state.events;
  authority.refused_count = state.refused_count;
  authority.refused = state.refused;
  authority.put_refusal_texts(world.step);
  authority.inputs = state.inputs;
  const auto& changes = authority.spec.changes;
  while (authority.next_change < changes.size() &&
         changes[authority.next_change].step <= world.step) {
    ++authority.next_change;
  }
  const auto& obstacles = authority.spec.obstacle_changes;
  while (authority.next_obstacle < obstacles.size() &&
         obstacles[authority.next_obstacle].step <= world.step) {
    ++authority.next_obstacle;
  }
  return {};
}

/// Of events the texts are not told, but those of changes that were refused are, and in their
/// order.
void WorldAuthority::Impl::put_refusal_texts(std::uint64_t in_step) {
  auto next = std::ranges::find_if(refused, [&](const Event& one) { return one.step == in_step; });
  for (Event& event : events) {
    if (event.kind != EventKind::kChangeRefused) continue;
    event.text = next != refused.end() ? next++->text : "refused; why was told to nobody else";
  }
}

/// Where everybody is, as its own write_poses() and write_contacts() told it.
void WorldAuthority::Impl::take_over(const WorldStep& world) {
  for (std::uint32_t r = 0; r < truth.movers.size(); ++r) {
    truth.movers[r].X_WR = {world.x_m[r], world.y_m[r], world.yaw_rad[r]};
    truth.movers[r].present = (world.flags[r] & WorldStep::kPresent) != 0;
    truth.velocity[r] = {world.vx_mps[r], world.vy_mps[r], world.wz_radps[r]};
    truth.touch[r] = {};
  }
  for (const PushedRobot& pushed : world.pushed) {
    truth.movers[pushed.robot.value()].X_WR = pushed.X_WR;
  }
  for (const TouchPoint& point : world.touches) {
    truth.touch[point.robot.value()] = {true, point.direction_W};
  }
}

void WorldAuthority::speak_for(std::uint32_t host, HostReport& report) const {
  const Impl& authority = *impl_;
  // Poses stay: the last that its host told, from now on too old to be believed.
  std::vector<PoseReport> poses = std::move(report.poses);
  report.begin(authority.step);
  report.host = host;
  report.poses = std::move(poses);
  const std::vector<RobotId>& told = authority.hosts[host].told;
  report.poses.resize(told.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    report.poses[i].robot = told[i];
    report.poses[i].reported.stale = report.poses[i].reported.known;
    report.poses[i].reported.velocity = {};
  }
  if (authority.step == 0) return;
  for (const RobotId robot : authority.hosts[host].simulated) {
    report.proposals.robots.push_back(robot.value());
  }
  const std::size_t count = report.proposals.robots.size();
  report.proposals.vx_mps.assign(count, 0);
  report.proposals.vy_mps.assign(count, 0);
  report.proposals.wz_radps.assign(count, 0);
}

Result<std::uint64_t> WorldAuthority::ask(WorldInput input) {
  Impl& authority = *impl_;
  if (input.kind == WorldInput::Kind::kObstacle) {
    if (!input.obstacle) return fail(ErrorCode::kInvalidArgument, "nothing to change");
    RAVE_TRY(check_obstacle_change(*input.obstacle));
  }
  const bool change = input.kind == WorldInput::Kind::kChange;
  if ((input.robot.valid() || change) && input.robot.value() >= authority.spec.robots.size()) {
    return fail(ErrorCode::kInvalidArgument, "there is no robot {}", input.robot.value());
  }
  if (change && input.changes.empty()) {
    return fail(ErrorCode::kInvalidArgument, "nothing to change");
  }
  const auto of_body = std::count_if(input.changes.begin(), input.changes.end(), is_of_body);
  if (of_body != 0 && static_cast<std::size_t>(of_body) != input.changes.size()) {
    return fail(ErrorCode::kInvalidArgument,
                "robot `{}`: its body and other parts cannot change at once while several hosts "
                "share the world; ask for one after the other",
                authority.spec.robots[input.robot.value()].name);
  }
  input.sequence = ++authority.inputs;
  authority.asked.push_back(std::move(input));
  return authority.inputs;
}

void WorldAuthority::adopt(ObstacleChange change) { impl_->adopted.push_back(std::move(change)); }

void WorldAuthority::place(RobotId robot, const Pose2& X_WR, bool present) {
  Mover& mover = impl_->truth.movers[robot.value()];
  mover.X_WR = X_WR;
  mover.present = present;
}

Result<ObstacleChange> WorldAuthority::decide(const ObstacleChange& change, SimTime at,
                                              std::string& note) {
  RAVE_TRY_ASSIGN(ObstacleChange made, impl_->truth.change_obstacle(change, at, note));
  impl_->history.add(made);
  return made;
}

Status WorldAuthority::put_obstacles(std::span<const ObstacleChange> changes, SimTime at) {
  AuthorityState state;
  state.obstacle_changes = changes.size();
  state.obstacles.assign(changes.begin(), changes.end());
  RAVE_TRY(check_told_obstacles(impl_->spec, WorldStep(), state));
  static_cast<void>(impl_->truth.restore_obstacles());
  impl_->truth.put_obstacles(changes, at);
  impl_->history = ObstacleHistory(state.obstacles, state.obstacle_changes);
  return {};
}

Status WorldAuthority::change_type(RobotId robot, std::uint32_t type, const Pose2& X_WR) {
  Impl& authority = *impl_;
  EngineSpec& spec = authority.spec;
  const std::uint32_t r = robot.value();
  if (r >= spec.robots.size() || type >= spec.types.size()) {
    return fail(ErrorCode::kInvalidArgument,
                "robot {} of type {}: there are {} robots and {} types", r, type,
                spec.robots.size(), spec.types.size());
  }
  const RobotType& its = spec.types[type];
  // As in an engine, the other type stays known.
  std::uint32_t& twin = spec.robots[r].twin.emplace(spec.robots[r].twin.value_or(type));
  if (twin == type) twin = spec.robots[r].type;
  spec.robots[r].type = type;
  authority.hosts[authority.host_of[r]].set_type(robot, its);
  authority.truth.set_reality(robot, its.simulated, X_WR);
  return {};
}

std::span<const Event> WorldAuthority::refused() const noexcept { return impl_->refused; }
std::uint64_t WorldAuthority::refused_count() const noexcept { return impl_->refused_count; }
std::span<const InputRefusal> WorldAuthority::refusals() const noexcept { return impl_->refusals; }
void WorldAuthority::reset() { impl_->begin(); }
const EngineSpec& WorldAuthority::spec() const noexcept { return impl_->spec; }
std::uint64_t WorldAuthority::steps_done() const noexcept {
  return impl_->step > 0 ? impl_->step - 1 : 0;
}
std::uint64_t WorldAuthority::next_step() const noexcept { return impl_->step; }
Pose2 WorldAuthority::pose(RobotId robot) const noexcept {
  return impl_->truth.movers[robot.value()].X_WR;
}
std::span<const Event> WorldAuthority::events() const noexcept { return impl_->done_events; }
RunHash WorldAuthority::hash() const noexcept { return impl_->done_hash; }
const world::Snapshot& WorldAuthority::snapshot() const noexcept { return impl_->truth.snapshot; }
const world::WorldModel& WorldAuthority::world() const noexcept { return impl_->spec.world; }
std::uint32_t WorldAuthority::host_count() const noexcept {
  return static_cast<std::uint32_t>(impl_->hosts.size());
}

}  // namespace rave::sim
