// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/host_port.hpp"

#include <algorithm>

#include "host_port_impl.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::lock_step {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kLook{100};
constexpr milliseconds kShowInterval{33};
/// A report without an answer is sent again after this time, then after doubled times up to
/// kLongestPatience.
constexpr milliseconds kFirstPatience{20};
constexpr milliseconds kLongestPatience{1000};
/// The epoch of worlds that hosts hand back: belongs to no authority, but is not 0.
constexpr std::uint64_t kHandedOver = 1;

}  // namespace

/// For monitors.
void HostPort::Impl::tell_word(std::uint64_t step) {
  const bool stands = manager == 0 || !told.empty();
  const auto phase = stands ? rave_wire_RUN_WAITS : rave_wire_RUN_RUNNING;
  host_word.tell({begun ? phase : rave_wire_RUN_GATHERING, step, told, true, manager != 0});
}

Status HostPort::Impl::send(const sim::HostReport& report, std::uint64_t hash,
                            const sim::WorldStep& last) {
  if (begun && epoch == 0) {
    // A manager that replaces a lost one continues from this state.
    sim::AuthorityState whole = authority;
    whole.obstacles = obstacles.changes();
    RAVE_TRY_ASSIGN(bus::LastWorld* const handed, last_message.fill(last, whole, kHandedOver));
    RAVE_TRY(last_worlds.write(*handed));
  }
  return reports.write(message.fill(report, epoch, hash));
}

/// The obstacles before the world that has just arrived. A world for a process that was absent
/// contains them; otherwise they are those before the last world, with its changes applied.
Status HostPort::Impl::follow_obstacles(const sim::WorldStep& world, sim::AuthorityState& state) {
  const std::uint64_t known = obstacles.count() + last_obstacles.size();
  if (!state.obstacles.empty()) {
    obstacles = sim::ObstacleHistory(state.obstacles, state.obstacle_changes);
  } else if (state.obstacle_changes == known) {
    for (const sim::ObstacleChange& change : last_obstacles) obstacles.add(change);
  } else {
    return fail(ErrorCode::kInvalidArgument,
                "obstacles had changed {} times before this world, but this host knows {} changes",
                state.obstacle_changes, known);
  }
  last_obstacles = world.obstacles;
  return {};
}

bool HostPort::Impl::take_world(const sim::HostReport& report, sim::WorldStep& world) {
  bool found = false;
  worlds.take([&](const bus::WorldStep& sample) {
    // This world came late: its manager is lost and would not answer the next report. A new
    // manager, or the same one after its return, sends it again.
    if (gone.contains(sample.writer)) return;
    if (epoch != 0 && sample.epoch != epoch) {
      worlds.refuse(sample, "it comes from another authority than that of this run");
      return;
    }
    if (sample.step < report.step) return;           // Sent again for another host.
    if (found && sample.step <= world.step) return;  // A duplicate.
    const auto hosts = bus::elements(sample.hosts);
    // Addressed to another process.
    if (self.host >= hosts.size() || hosts[self.host] != bus->writer()) return;
    sim::AuthorityState state;
    auto status = read(sample, coming, state);
    if (status) status = follow_obstacles(coming, state);
    if (!status) {
      worlds.refuse(sample, status.error().message);
      return;
    }
    std::swap(world, coming);
    last_step = world.step;
    begun = true;
    authority = std::move(state);
    epoch = sample.epoch;
    if (first_epoch == 0) first_epoch = epoch;
    changed_hands = changed_hands || epoch != first_epoch;
    manager = sample.writer;
    found = true;
  });
  return found;
}

HostPort::HostPort(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
HostPort::~HostPort() = default;

Status HostPort::Impl::open(const bus::BusConfig& config, bus::BeginRequest begin_request,
                            bus::BeginCommand begin_command) {
  RAVE_TRY(HostConnection::open(config, std::move(begin_request), std::move(begin_command)));
  RAVE_TRY(bus::open_all(*bus, reports, last_worlds, worlds));
  RAVE_TRY_ASSIGN(waits, bus::WaitSet::create(*bus));
  RAVE_TRY(waits.add(worlds));
  return join(waits);
}

Result<std::unique_ptr<HostPort>> HostPort::open(const bus::BusConfig& config, Identity identity,
                                                 LogSink* log, Patience patience,
                                                 bus::BeginRequest begin_request,
                                                 bus::BeginCommand begin_command) {
  auto impl = std::make_unique<Impl>(std::move(identity), log, patience);
  RAVE_TRY(impl->open(config, std::move(begin_request), std::move(begin_command)));
  return std::unique_ptr<HostPort>(new HostPort(std::move(impl)));
}

Result<HostPort::Answer> HostPort::exchange(const sim::HostReport& report, std::uint64_t hash,
                                            sim::WorldStep& world,
                                            const std::function<bool()>& stopping,
                                            const std::function<Look()>& look) {
  Impl& port = *impl_;
  auto patience = kFirstPatience;
  auto send_at = Clock::now();
  Look next = look ? look() : Look{.within = kLook};
  // Checked by time, so that constant wake-ups cannot prevent a stop.
  auto next_stop = Clock::now() + next.within;
  for (;;) {
    port.pulse.beat({report.step});
    port.tell_word(report.step);
    if (Clock::now() >= send_at) {
      RAVE_TRY(port.send(report, hash, world));
      send_at = Clock::now() + patience;
      patience = std::min(2 * patience, kLongestPatience);
    }
    static_cast<void>(port.waits.wait(bus::left_until(std::min(send_at, next_stop)), next.asked));
    port.serve();
    if (port.take_world(report, world)) {
      port.told.clear();
      return Answer::kWorld;
    }
    port.look();
    port.look_at_patience();
    if (port.unfit) return tl::unexpected(*port.unfit);
    if (port.ending) return Answer::kEnded;
    // Checked rarely: usually the answer to a step arrives earlier.
    if (Clock::now() < next_stop && !next.asked.stop_requested()) continue;
    const std::size_t inputs = report.inputs.size();
    if (stopping()) return Answer::kStopped;
    port.serve();
    next = look ? look() : Look{.within = kLook};
    next_stop = Clock::now() + next.within;
    if (report.inputs.size() == inputs) continue;
    // They are to count from the step that everybody waits for.
    send_at = Clock::now();
    patience = kFirstPatience;
  }
}

void HostPort::show(const sim::Engine& engine, std::span<const RobotId> robots) {
  Impl& port = *impl_;
  port.reports_out.note_contacts(engine);
  port.show_due = true;
  show_rest(engine, robots);
}

void HostPort::show_rest(const sim::Engine& engine, std::span<const RobotId> robots) {
  Impl& port = *impl_;
  const auto now = Clock::now();
  if (!port.show_due || now < port.next_show) return;
  port.show_due = false;
  port.next_show = now + kShowInterval;
  if (port.states.readers() > 0) port.publish(engine, robots, true, Duration{});
}

void HostPort::serve() { impl_->serve(); }
const std::string& HostPort::waits_for() const noexcept { return impl_->told; }
HostWord& HostPort::word() noexcept { return impl_->host_word; }
bus::Bus& HostPort::bus() noexcept { return *impl_->bus; }
Roster& HostPort::roster() noexcept { return impl_->roster; }
const sim::AuthorityState& HostPort::authority() const noexcept { return impl_->authority; }
bool HostPort::changed_hands() const noexcept { return impl_->changed_hands; }
const std::optional<RunEnding>& HostPort::ending() const noexcept { return impl_->ending; }

Status HostPort::deliver(std::span<const std::byte> host_results) {
  return impl_->deliver(host_results, impl_->last_step);
}

void HostPort::farewell(const sim::HostReport& report, std::uint64_t hash) {
  Impl& port = *impl_;
  static_cast<void>(port.reports.write(port.message.fill(report, port.epoch, hash)));
}

}  // namespace rave::lock_step
