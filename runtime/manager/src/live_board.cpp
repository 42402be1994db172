// SPDX-License-Identifier: Apache-2.0
#include "live_board.hpp"

#include <algorithm>
#include <chrono>

#include "manager_habits.hpp"
#include "rave/bus/sequence.hpp"
#include "sat.hpp"

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

struct LiveBoard::Parts {
  std::unique_ptr<ManagerEndpoint> endpoint;
  bus::Writer<bus::World> worlds;
  bus::Writer<bus::ClockPong> pongs;
  bus::Writer<bus::Obstacle> obstacles;
  bus::Reader<bus::ClockPing> pings;
  bus::Reader<bus::HostState> states;
};

LiveBoard::LiveBoard(const LiveManagerOptions& options, Parts parts)
    : options_(options),
      endpoint_(std::move(parts.endpoint)),
      worlds_(std::move(parts.worlds)),
      pongs_(std::move(parts.pongs)),
      obstacles_(std::move(parts.obstacles)),
      pings_(std::move(parts.pings)),
      states_(std::move(parts.states)),
      claims_(static_cast<std::uint32_t>(options.hosts.size())),
      seat_of_(options.robots.size()),
      robots_(options.robots.size()),
      known_(options.robots.size()),
      said_by_(options.robots.size()),
      book_(planned_robots(options), options.hosts) {
  for (std::uint32_t r = 0; r < options.robots.size(); ++r) {
    staleness_.push_back(options.robots[r].staleness);
    if (options.robots[r].twin) twins_.push_back({RobotId(r), options.robots[r].simulated});
  }
  for (std::uint32_t h = 0; h < options.hosts.size(); ++h) {
    const config::PlannedHost& host = options.hosts[h];
    LiveSeat& seat = seats_.emplace_back();
    seat.name = host.name;
    if (h < options.commands.size()) seat.command = options.commands[h];
    seat.robots = static_cast<std::uint32_t>(host.robots.size());
    for (const std::size_t robot : host.robots) {
      seat_of_[robot] = h;
      seat.real += options.robots[robot].simulated ? 0U : 1U;
    }
  }
}

Result<std::unique_ptr<LiveBoard>> LiveBoard::open(const LiveManagerOptions& options) {
  RAVE_TRY_ASSIGN(auto endpoint, ManagerEndpoint::open(options.bus, options.identity, options.log,
                                                       options.begin_wish, {}));
  bus::Bus& bus = endpoint->bus();
  RAVE_TRY_ASSIGN(auto worlds, bus::Writer<bus::World>::create(bus));
  RAVE_TRY_ASSIGN(auto pongs, bus::Writer<bus::ClockPong>::create(bus));
  RAVE_TRY_ASSIGN(auto obstacles, bus::Writer<bus::Obstacle>::create(bus));
  RAVE_TRY_ASSIGN(auto pings, bus::Reader<bus::ClockPing>::create(bus));
  RAVE_TRY_ASSIGN(auto states, bus::Reader<bus::HostState>::create(bus));
  std::unique_ptr<LiveBoard> board(
      new LiveBoard(options, {std::move(endpoint), std::move(worlds), std::move(pongs),
                              std::move(obstacles), std::move(pings), std::move(states)}));
  RAVE_TRY_ASSIGN(auto waits, bus::WaitSet::create(bus));
  RAVE_TRY(waits.add(board->pings_));
  RAVE_TRY(waits.add(board->states_));
  RAVE_TRY(board->endpoint_->wake(waits));
  board->waits_.emplace(std::move(waits));
  RAVE_TRY(board->endpoint_->introduce());
  return board;
}

Status LiveBoard::look_at_processes(bool goes) {
  RAVE_TRY_ASSIGN(const auto gone, endpoint_->look_at_processes(goes));
  for (const std::uint64_t writer : gone) lose(writer, goes);
  return {};
}

void LiveBoard::lose(std::uint64_t writer, bool goes) {
  endpoint_->forget(writer);
  refused_.erase(writer);
  wrong_hands_.erase(writer);
  claims_.release(writer);
  book_.lose(writer);
  for (LiveSeat& seat : seats_) {
    if (seat.writer != writer) continue;
    seat.writer = 0;
    seat.bound_ns = -1;
    seat.steps = {};
    seat.obstacle_revision = 0;
    news_ = true;
    if (!goes) continue;
    ++seat.losses;
    if (options_.log != nullptr) {
      options_.log->error(kSource, "host `{}` is gone; the others continue{}{}", seat.name,
                          seat.command.empty() ? "" : "; start it again with: ", seat.command);
    }
  }
}

bool LiveBoard::sit_down(const bus::ClockPing& ping) {
  if (ping.target != endpoint_->writer()) return false;
  const auto host = endpoint_->host_of(ping.writer);
  if (!host || *host >= seats_.size()) return false;
  LiveSeat& seat = seats_[*host];
  if (seat.writer != ping.writer) {
    const Status claimed = claims_.claim(*host, ping.writer);
    if (!claimed) {
      if (refused_.insert(ping.writer).second)
        endpoint_->log_fault("refused: " + claimed.error().message);
      return false;
    }
    seat.writer = ping.writer;
    book_.stir();
    note_sitting(seat.sat, ping.writer);
    news_ = true;
    all_asked_ = false;
    if (options_.log != nullptr) {
      options_.log->info(kSource, "host `{}` is {}, with {} real and {} simulated robots",
                         seat.name, seat.heard ? "back" : "here", seat.real,
                         seat.robots - seat.real);
    }
    seat.heard = true;
  }
  seat.offset_ns = ping.offset_ns;
  seat.bound_ns = ping.bound_ns;
  seat.obstacle_revision =
      std::min(ping.obstacle_revision, real_time::ObstacleSight::kMostRevision);
  seat.obstacles_ns = ping.obstacles_ns;
  return true;
}

void LiveBoard::take_roster(runtime::RunControl* control) {
  const auto serving = [this](std::uint32_t host) {
    return host < seats_.size() ? seats_[host].writer : 0;
  };
  endpoint_->take_roster(book_, serving);
  show_kinds(book_, serving, control);
}

void LiveBoard::take_findings() {
  endpoint_->findings().take(
      [this](std::uint64_t writer, std::uint32_t host) { return has_sat(seats_, writer, host); });
}

void LiveBoard::take_states() {
  states_.take([this](const bus::HostState& state) { take_in(state); });
}

void LiveBoard::take_in(const bus::HostState& state) {
  if (state.host >= seats_.size() || !endpoint_->host_of(state.writer)) return;
  LiveSeat& seat = seats_[state.host];
  if (seat.writer != 0 && seat.writer != state.writer) {
    states_.refuse(state, fmt::format("host `{}` is served by another process", seat.name));
    return;
  }
  seat.last_step = state.step;
  seat.steps.note(state.step, steady_ns());
  ++states_taken_;
  for (std::size_t i = 0; i < state.resolved.id._length; ++i) {
    const real_time::RobotSight sight = real_time::read_robot(state.resolved, i, {});
    const std::uint32_t robot = sight.robot.value();
    if (robot >= robots_.size() || seat_of_[robot] != state.host) {
      states_.refuse(state, fmt::format("robot {} does not run on host `{}`", robot, seat.name));
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

double LiveBoard::slowest_speed() const {
  const std::int64_t now_ns = steady_ns();
  std::optional<double> slowest;
  for (const LiveSeat& seat : seats_) {
    if (seat.writer == 0) continue;
    const auto rate = seat.steps.at(now_ns);
    // The speed of the others would be too fast.
    if (!rate) return 0;
    slowest = std::min(slowest.value_or(*rate), *rate);
  }
  return slowest.value_or(0) * options_.step.seconds();
}

std::vector<real_time::RobotReality> LiveBoard::take_realities() {
  std::vector<real_time::RobotReality> changed;
  for (real_time::RobotReality& twin : twins_) {
    const std::uint32_t r = twin.robot.value();
    const bool simulated = book_.simulated(r, seats_[seat_of_[r]].writer);
    if (std::exchange(twin.simulated, simulated) == simulated) continue;
    const LiveManagerOptions::Robot& robot = options_.robots[r];
    staleness_[r] = simulated == robot.simulated ? robot.staleness : robot.other_staleness;
    changed.push_back(twin);
  }
  return changed;
}

void LiveBoard::send_world(std::uint64_t number, SimTime now, std::span<const std::uint8_t> stale) {
  columns_.clear();
  stale_.clear();
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    if (!known_[r]) continue;
    columns_.add(robots_[r]);
    if (stale[r] != 0) stale_.push_back(r);
  }
  bus::World world{};
  world.epoch = endpoint_->writer();
  world.step = number;
  world.time_ns = now.ns;
  columns_.lend(world.robots);
  bus::borrow(world.stale, stale_);
  static_cast<void>(worlds_.write(world));
  worlds_sent_ = number;
}

Status LiveBoard::publish(const real_time::ObstacleSight& sight) {
  RAVE_TRY(parts_.fill(std::span(&sight.stands, 1)));
  bus::Obstacle message{};
  message.id = sight.stands.id.value();
  message.revision = sight.revision;
  message.scheduled = sight.scheduled;
  message.removed = sight.removed;
  message.stands = parts_.changes().front();
  return obstacles_.write(message);
}

Status LiveBoard::ask_for_handed() {
  if (std::exchange(all_asked_, true)) return {};
  // A new reader is told all that hosts keep, also what came before they were known.
  handed_in_.reset();
  RAVE_TRY_ASSIGN(auto reader, bus::Reader<bus::LastObstacle>::create(endpoint_->bus()));
  handed_in_.emplace(std::move(reader));
  return {};
}

void LiveBoard::take_handed(const std::function<Status(const real_time::ObstacleSight&)>& check) {
  if (!handed_in_) return;
  const auto hear = [this, &check](const bus::LastObstacle& sample) {
    if (!endpoint_->host_of(sample.writer)) return;
    auto sight = real_time::read_obstacle(sample);
    const Status fits = sight ? check(*sight) : Status(tl::unexpected(sight.error()));
    if (!fits) {
      refuse_handed(sample.writer, fits.error().message);
      return;
    }
    real_time::ObstacleSight& known = handed_[sight->stands.id.value()];
    if (sight->revision > known.revision) known = *std::move(sight);
  };
  // Enough for all that a run may have; who sends without end is heard of again at the next look.
  constexpr int kMostRounds = 32;
  for (int round = 0; round < kMostRounds && handed_in_->take(hear) > 0; ++round) continue;
}

void LiveBoard::refuse_handed(std::uint64_t writer, std::string_view why) {
  if (!wrong_hands_.insert(writer).second) return;
  endpoint_->log_fault(
      fmt::format("refused the hand-over of obstacles by process {:016x}: {}", writer, why));
}

void LiveBoard::end_handing() {
  handed_in_.reset();
  handed_.clear();
}

std::uint64_t LiveBoard::shown_revision() const noexcept {
  std::uint64_t revision = 0;
  for (const LiveSeat& seat : seats_) revision = std::max(revision, seat.obstacle_revision);
  return revision;
}

void LiveBoard::publish(bus::RunState& state) {
  std::vector<rave_wire_HostSight> hosts(seats_.size());
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    const LiveSeat& seat = seats_[i];
    hosts[i].host = static_cast<std::uint32_t>(i);
    bus::put_text(hosts[i].name, seat.name);
    hosts[i].phase = seat.writer != 0 ? rave_wire_HOST_RUNS
                                      : (seat.heard ? rave_wire_HOST_LOST : rave_wire_HOST_MISSING);
    hosts[i].robots = seat.robots;
    hosts[i].step = seat.last_step;
    hosts[i].offset_s = static_cast<double>(seat.offset_ns) * 1e-9;
    hosts[i].bound_s = seat.bound_ns < 0 ? -1 : static_cast<double>(seat.bound_ns) * 1e-9;
  }
  bus::borrow(state.hosts, hosts);
  endpoint_->publish(state);
}

}  // namespace rave::manager
