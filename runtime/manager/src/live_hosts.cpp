// SPDX-License-Identifier: Apache-2.0
#include "live_hosts.hpp"

#include <algorithm>
#include <chrono>

#include "manager_habits.hpp"
#include "rave/bus/sequence.hpp"
#include "served.hpp"

namespace rave::manager {
namespace {

std::vector<RosterBook::Robot> planned_robots(const LiveManagerOptions& options) {
  std::vector<RosterBook::Robot> robots;
  for (const auto& robot : options.robots) robots.push_back({robot.name, robot.simulated});
  return robots;
}

std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

LiveHosts::LiveHosts(const LiveManagerOptions& options, std::unique_ptr<LiveEndpoint> endpoint)
    : options_(options),
      endpoint_(std::move(endpoint)),
      claims_(static_cast<std::uint32_t>(options.hosts.size())),
      slot_of_(options.robots.size()),
      robots_(options.robots.size()),
      known_(options.robots.size()),
      said_by_(options.robots.size()),
      book_(planned_robots(options), options.hosts) {
  for (std::uint32_t r = 0; r < options.robots.size(); ++r) {
    staleness_.push_back(options.robots[r].staleness);
    // Only robots with two sets of drivers can change their reality.
    if (options.robots[r].twin) twins_.push_back({RobotId(r), options.robots[r].simulated});
  }
  for (std::uint32_t h = 0; h < options.hosts.size(); ++h) {
    const config::PlannedHost& host = options.hosts[h];
    LiveSlot& slot = slots_.emplace_back();
    slot.name = host.name;
    if (h < options.commands.size()) slot.command = options.commands[h];
    slot.robots = static_cast<std::uint32_t>(host.robots.size());
    for (const std::size_t robot : host.robots) {
      slot_of_[robot] = h;
      slot.real += options.robots[robot].simulated ? 0U : 1U;
    }
  }
}

Result<std::unique_ptr<LiveHosts>> LiveHosts::open(const LiveManagerOptions& options) {
  RAVE_TRY_ASSIGN(auto endpoint, LiveEndpoint::open(options));
  return std::make_unique<LiveHosts>(options, std::move(endpoint));
}

Status LiveHosts::look_at_processes(bool running) {
  RAVE_TRY_ASSIGN(const auto gone, endpoint().look_at_processes(running));
  for (const std::uint64_t writer : gone) lose(writer, running);
  return {};
}

// A slot keeps its name and the poses of its robots: others still sense them where they were, until
// they become stale.
void LiveHosts::lose(std::uint64_t writer, bool running) {
  refused_.erase(writer);
  wrong_hands_.erase(writer);
  // The place becomes free for another process of the same host.
  claims_.release(writer);
  book_.lose(writer);
  for (LiveSlot& slot : slots_) {
    if (slot.writer != writer) continue;
    slot.writer = 0;
    // All that follows was measured with the process that is gone.
    slot.bound_ns = -1;
    slot.steps = {};
    slot.obstacle_revision = 0;
    news_ = true;
    if (!running) continue;
    ++slot.losses;
    options_.log->error(kSource, "host `{}` is gone; the others continue{}{}", slot.name,
                        slot.command.empty() ? "" : "; start it again with: ", slot.command);
  }
}

// A host takes its place with its first question for the time. Pings, not introductions, decide,
// because they are addressed to one manager.
bool LiveHosts::claim_slot(const bus::ClockPing& ping) {
  if (ping.target != endpoint().writer()) return false;
  // Unknown without an introduction that fits this run. The host asks again until it is known.
  const auto host = endpoint().host_of(ping.writer);
  if (!host || *host >= slots_.size()) return false;
  LiveSlot& slot = slots_[*host];
  if (slot.writer != ping.writer) {
    const Status claimed = claims_.claim(*host, ping.writer);
    if (!claimed) {
      // A refused process asks several times per second; it is logged once.
      if (refused_.insert(ping.writer).second)
        endpoint().log_fault("refused: " + claimed.error().message);
      return false;
    }
    slot.writer = ping.writer;
    book_.stir();
    note_service(slot.served_by, ping.writer);
    news_ = true;
    all_asked_ = false;
    options_.log->info(kSource, "host `{}` is {}, with {} real and {} simulated robots", slot.name,
                       slot.heard ? "back" : "here", slot.real, slot.robots - slot.real);
    slot.heard = true;
  }
  slot.offset_ns = ping.offset_ns;
  slot.bound_ns = ping.bound_ns;
  // Limited, because shown_revision() decides what a manager that takes over waits for.
  slot.obstacle_revision =
      std::min(ping.obstacle_revision, real_time::ObstacleSight::kMostRevision);
  slot.obstacles_ns = ping.obstacles_ns;
  return true;
}

void LiveHosts::take_roster(runtime::RunControl* control) {
  const auto serving = [this](std::uint32_t host) {
    return host < slots_.size() ? slots_[host].writer : 0;
  };
  endpoint().take_roster(book_, serving);
  show_kinds(book_, serving, control);
}

void LiveHosts::take_states() {
  endpoint_->take_states([this](const bus::HostState& state) { take_in(state); });
}

void LiveHosts::take_in(const bus::HostState& state) {
  if (state.host >= slots_.size() || !endpoint().host_of(state.writer)) return;
  LiveSlot& slot = slots_[state.host];
  // A state may arrive before the first ping of its process; then the slot is still free and the
  // state counts.
  if (slot.writer != 0 && slot.writer != state.writer) {
    endpoint_->refuse(state, fmt::format("host `{}` is served by another process", slot.name));
    return;
  }
  slot.last_step = state.step;
  slot.steps.note(state.step, steady_ns());
  ++states_taken_;
  for (std::size_t i = 0; i < state.resolved.id._length; ++i) {
    const real_time::RobotSight sight = real_time::read_robot(state.resolved, i, {});
    const std::uint32_t robot = sight.robot.value();
    if (robot >= robots_.size() || slot_of_[robot] != state.host) {
      endpoint_->refuse(state, fmt::format("robot {} does not run on host `{}`", robot, slot.name));
      return;
    }
    // A host that was started anew may be a little behind the one before.
    const bool same = said_by_[robot] == state.writer;
    if (known_[robot] && same && sight.stamp <= robots_[robot].stamp) continue;
    robots_[robot] = sight;
    known_[robot] = true;
    said_by_[robot] = state.writer;
  }
}

double LiveHosts::slowest_speed() const {
  // The slowest host gives the speed of the run, since the others only seem to be ahead: their
  // robots meet old poses.
  const std::int64_t now_ns = steady_ns();
  std::optional<double> slowest;
  for (const LiveSlot& slot : slots_) {
    if (slot.writer == 0) continue;
    const auto rate = slot.steps.at(now_ns);
    // The speed of the others would be too fast.
    if (!rate) return 0;
    slowest = std::min(slowest.value_or(*rate), *rate);
  }
  return slowest.value_or(0) * options_.step.seconds();
}

std::vector<real_time::RobotReality> LiveHosts::take_realities() {
  std::vector<real_time::RobotReality> changed;
  for (real_time::RobotReality& twin : twins_) {
    const std::uint32_t r = twin.robot.value();
    const bool simulated = book_.simulated(r, slots_[slot_of_[r]].writer);
    if (std::exchange(twin.simulated, simulated) == simulated) continue;
    const LiveManagerOptions::Robot& robot = options_.robots[r];
    staleness_[r] = simulated == robot.simulated ? robot.staleness : robot.other_staleness;
    changed.push_back(twin);
  }
  return changed;
}

void LiveHosts::send_world(std::uint64_t number, SimTime now, std::span<const std::uint8_t> stale) {
  columns_.clear();
  stale_.clear();
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    if (!known_[r]) continue;
    // The manager does not extrapolate: each host does so for the time at which it uses the pose.
    columns_.add(robots_[r]);
    if (stale[r] != 0) stale_.push_back(r);
  }
  bus::World world{};
  world.step = number;
  world.time_ns = now.ns;
  columns_.lend(world.robots);
  bus::borrow(world.stale, stale_);
  endpoint_->send(world);
}

Status LiveHosts::publish(const real_time::ObstacleSight& sight) {
  RAVE_TRY(parts_.fill(std::span(&sight.stands, 1)));
  bus::Obstacle message{};
  message.id = sight.stands.id.value();
  message.revision = sight.revision;
  message.scheduled = sight.scheduled;
  message.removed = sight.removed;
  message.stands = parts_.changes().front();
  return endpoint_->send(message);
}

Status LiveHosts::ask_for_handed() {
  // Asked again only when another host has joined, which may know more.
  if (std::exchange(all_asked_, true)) return {};
  return endpoint_->ask_for_handed();
}

void LiveHosts::take_handed(const std::function<Status(const real_time::ObstacleSight&)>& check) {
  const auto hear = [this, &check](const bus::LastObstacle& sample) {
    if (!endpoint().host_of(sample.writer)) return;
    auto sight = real_time::read_obstacle(sample);
    const Status fits = sight ? check(*sight) : Status(tl::unexpected(sight.error()));
    if (!fits) {
      refuse_handed(sample.writer, fits.error().message);
      return;
    }
    real_time::ObstacleSight& known = handed_[sight->stands.id.value()];
    // Hosts may have received different parts. The newest state of each obstacle is the last one
    // that the lost manager published.
    if (sight->revision > known.revision) known = *std::move(sight);
  };
  // Enough for all that a run may have; who sends without end is heard of again at the next look.
  constexpr int kMostRounds = 32;
  for (int round = 0; round < kMostRounds && endpoint_->take_handed(hear) > 0; ++round) continue;
}

void LiveHosts::refuse_handed(std::uint64_t writer, std::string_view why) {
  if (!wrong_hands_.insert(writer).second) return;
  endpoint().log_fault(
      fmt::format("refused the hand-over of obstacles by process {:016x}: {}", writer, why));
}

void LiveHosts::end_handing() {
  endpoint_->end_handing();
  handed_.clear();
}

std::uint64_t LiveHosts::shown_revision() const noexcept {
  std::uint64_t revision = 0;
  for (const LiveSlot& slot : slots_) revision = std::max(revision, slot.obstacle_revision);
  return revision;
}

void LiveHosts::publish(const lock_step::RunReport& report) {
  std::vector<rave_wire_HostSight> hosts;
  for (const LiveSlot& slot : slots_) {
    const auto phase = slot.writer != 0
                           ? rave_wire_HOST_RUNS
                           : (slot.heard ? rave_wire_HOST_LOST : rave_wire_HOST_MISSING);
    rave_wire_HostSight& host = hosts.emplace_back(lock_step::process_sight(
        static_cast<std::uint32_t>(hosts.size()), slot.name, phase, slot.last_step, slot.robots));
    host.offset_s = static_cast<double>(slot.offset_ns) * 1e-9;
    if (slot.bound_ns >= 0) host.bound_s = static_cast<double>(slot.bound_ns) * 1e-9;
  }
  bus::RunState state{};
  lock_step::fill(state, report, hosts);
  endpoint().publish(state);
}

}  // namespace rave::manager
