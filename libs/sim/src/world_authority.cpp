// SPDX-License-Identifier: Apache-2.0
// The authority of a world that several hosts share: resolves the motion of all robots and says
// what each host has to know for its next step.
#include "rave/sim/world_authority.hpp"

#include <algorithm>
#include <tuple>

#include "spec_checks.hpp"
#include "world_authority_impl.hpp"

namespace rave::sim {
namespace {

Status check_hosts(const EngineSpec& spec, std::span<const std::uint32_t> host_of) {
  if (host_of.size() != spec.robots.size() || host_of.empty()) {
    return fail(ErrorCode::kInvalidArgument, "hosts for {} robots, but there are {}",
                host_of.size(), spec.robots.size());
  }
  // Hosts are numbered without gaps: arrays by host have one entry each, and each is waited for.
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
  // After the bodies and obstacles of the start are back: it places them.
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
  if (spec.conductor) spec.conductor->begin();
}

Status WorldAuthority::Impl::check(const HostReport& report) const {
  if (report.host >= hosts.size()) {
    return fail(ErrorCode::kInvalidArgument, "a report of host {}, but there are only {}",
                report.host, hosts.size());
  }
  const auto named = [&](Error error) {
    return tl::unexpected(std::move(error).with_context(fmt::format("host {}", report.host)));
  };
  // Before all else: the report of a host that failed has nothing but the reason.
  if (report.state > HostState::kDone) {
    return named({ErrorCode::kState, fmt::format("cannot continue: {}", report.text), {}});
  }
  if (report.step != step) {
    return named({ErrorCode::kInvalidArgument,
                  fmt::format("a report for step {}, but step {} is next", report.step, step),
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
  // Events of the authority alone; those of the hosts are in their own sums.
  finish_events(step - 1, events, hash);
  done_hash = hash;
  done_events.swap(events);
  events.clear();
}

void WorldAuthority::Impl::place_real_robots() {
  for (const HostReport* const report : by_host) {
    for (const PoseReport& pose : report->poses) {
      const std::uint32_t r = pose.robot.value();
      // A simulated robot with a pose source is believed to be where that says, but is where the
      // resolver put it.
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
  // A robot may have been pushed by several real ones; its last place counts.
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
  // In an order that depends neither on the hosts nor on which report came first.
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
  auto impl = std::make_unique<Impl>(std::move(spec), std::move(host_of));
  RAVE_TRY(check_threads(impl->spec, impl->pool.threads()));
  return std::unique_ptr<WorldAuthority>(new WorldAuthority(std::move(impl)));
}

Status WorldAuthority::step(std::span<const HostReport* const> reports, WorldStep& world) {
  Impl& authority = *impl_;
  // Everything is checked before anything changes: after a refusal the right report may follow.
  RAVE_TRY(authority.check(reports));
  WorldTruth& truth = authority.truth;
  world.begin(authority.step, authority.spec.robots.size());
  authority.refusals.clear();
  authority.close_obstacles();
  // Reports of step n have the proposals of step n - 1 and the real poses of step n. So the last
  // step ends here, and the next one begins below.
  if (authority.step > 0) authority.finish_step();
  authority.make_changes(world);
  authority.last_obstacles = world.obstacles;
  authority.place_real_robots();
  // Before make_way(): the reported pose of a robot without a pose source is that before it was
  // pushed. The places after that are in `pushed`.
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

void WorldAuthority::place(RobotId robot, const Pose2& X_WR, bool present) {
  Mover& mover = impl_->truth.movers[robot.value()];
  mover.X_WR = X_WR;
  mover.present = present;
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
}  // namespace rave::sim
