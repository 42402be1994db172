// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/host_link.hpp"

#include <algorithm>

#include "host_link_impl.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/math/transform.hpp"

namespace rave::real_time {
// A host in real time. After the start it waits for no other process: each step it takes what has
// arrived, and sends without blocking. Only the start is a conversation: the host finds a manager,
// asks for its clock until the offset is known, and learns the time 0 of the run.
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kLook{100};
/// This many clock readings are taken in quick succession before the start.
constexpr std::uint64_t kFirstReadings = 8;
// Several readings at the start, because the one with the shortest round trip has the least error.
// Later ones only correct the drift of the clocks.
constexpr milliseconds kHurry{10};
constexpr milliseconds kLeisure{1000};

}  // namespace

Status HostLink::Impl::open() {
  RAVE_TRY(HostConnection::open(options.bus, options.begin_request, options.begin_command));
  RAVE_TRY_ASSIGN(waits, bus::WaitSet::create(*bus));
  if (managed) {
    // The obstacles are written by hosts and read by a manager that takes the place of a lost one:
    // hosts are then the only processes that still know them.
    RAVE_TRY(bus::open_all(*bus, pings.emplace(), pongs.emplace(), last_obstacles.emplace()));
    RAVE_TRY(waits.add(*pongs));
  }
  if (managed && options.sees) {
    RAVE_TRY(worlds.emplace().open(*bus));
    RAVE_TRY(waits.add(*worlds));
  }
  if (options.talks) {
    RAVE_TRY(bus::open_all(*bus, packets_out.emplace(), packets_in.emplace()));
    RAVE_TRY(waits.add(*packets_in));
  }
  if (!options.host_of.empty()) {
    RAVE_TRY_ASSIGN(realities, Realities::create(*bus, self.host, options.host_of));
  }
  return join(waits);
}

void HostLink::Impl::ping() {
  if (!pings || manager == 0 || Clock::now() < ping_at) return;
  // The manager does not answer until it knows this process.
  const std::uint64_t done = pongs_heard > 0 ? pongs_heard : pings_sent;
  // After a change of the manager the time stays known, but its answers are counted anew.
  const bool knows_it = pongs_heard > 0 && time.known();
  const auto wait = done < kFirstReadings ? kHurry : (knows_it ? kLeisure : kLook);
  bus::ClockPing message{};
  message.target = manager;
  // -1: unknown. The manager publishes offset and bound of each host for monitors.
  message.bound_ns = -1;
  message.run_ns = -1;
  const std::int64_t now_ns = local_ns();
  if (const auto reading = time.reading(now_ns)) {
    message.offset_ns = reading->offset.ns;
    message.bound_ns = reading->bound.ns;
  }
  if (time.known()) message.run_ns = std::max<std::int64_t>(0, time.at(now_ns).ns);
  message.obstacle_revision = shown_revision;
  message.obstacles_ns = shown_since.ns;
  // Read last, so that filling in the message does not count as travel time.
  message.sent_ns = local_ns();
  static_cast<void>(pings->write(message));
  ++pings_sent;
  ping_at = Clock::now() + wait;
}

bool HostLink::Impl::ready() const {
  if (!managed) return true;
  if (!time.known() || pongs_heard < kFirstReadings / 2) return false;
  // Without the obstacles of the run, robots could start inside one that was added.
  if (live.heard_revision() < obstacle_revision) return false;
  return !worlds || world_count > 0;
}

void HostLink::Impl::start_clock() {
  // Fixed from here on: drivers and steps need a time that never jumps. shift() puts later
  // corrections into the stamps of messages.
  if (!managed) time.begin_alone(local_ns());
  zero_ns = time.zero_ns();
  begun = true;
  last_world = Clock::now();
  told.clear();
  if (const auto reading = time.reading(local_ns())) {
    tell(LogLevel::kInfo, fmt::format("the clock of the environment manager differs from the clock "
                                      "here by {:+.6f} s (uncertainty {:.6f} s)",
                                      reading->offset.seconds(), reading->bound.seconds()));
  }
}

Duration HostLink::Impl::patience() const noexcept {
  // Three periods bear two lost worlds. The lower bound keeps a short period from reporting each
  // delay of a busy machine.
  return std::max(options.world_period * 3, from_seconds(0.5));
}

void HostLink::Impl::watch_worlds() {
  if (!worlds) return;
  const Duration age{std::chrono::nanoseconds(Clock::now() - last_world).count()};
  const bool lost = age > patience();
  if (lost == world_lost) return;
  world_lost = lost;
  if (lost) ++losses;
  tell(lost ? LogLevel::kError : LogLevel::kInfo,
       lost ? fmt::format("no world has arrived for {:.1f} s: robots of other hosts stay at their "
                          "last known poses",
                          age.seconds())
            : "worlds arrive again");
}

HostLink::HostLink(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
HostLink::~HostLink() = default;

Result<std::unique_ptr<HostLink>> HostLink::open(Options options, LiveWorld& world) {
  auto impl = std::make_unique<Impl>(std::move(options), world);
  RAVE_TRY(impl->open());
  return std::unique_ptr<HostLink>(new HostLink(std::move(impl)));
}

Result<bool> HostLink::await_start(const std::function<bool()>& stopping) {
  Impl& link = *impl_;
  if (link.managed) {
    link.tell_once(LogLevel::kInfo, "waits for the environment manager of the run");
  }
  auto look_at = Clock::now() + kLook;
  for (;;) {
    link.take();
    if (link.unfit) return tl::unexpected(*link.unfit);
    if (link.ready()) break;
    link.ping();
    if (Clock::now() >= look_at) {
      look_at += kLook;
      link.look_at_patience(link.options.manager_patience);
      if (stopping() || link.ending) return false;
    }
    // Short, because the first clock readings are 10 ms apart.
    static_cast<void>(link.waits.wait(Duration{std::chrono::nanoseconds(kHurry).count()}));
  }
  link.start_clock();
  return true;
}

std::chrono::steady_clock::time_point HostLink::zero() const noexcept {
  return Clock::time_point(std::chrono::nanoseconds(impl_->zero_ns));
}
void HostLink::count_real(std::uint32_t robots) noexcept { impl_->pulse.count_real(robots); }
lock_step::HostWord& HostLink::word() noexcept { return impl_->host_word; }
bus::Bus& HostLink::bus() noexcept { return *impl_->bus; }
lock_step::Roster& HostLink::roster() noexcept { return impl_->roster; }
std::span<const RobotSight> HostLink::starts() const noexcept { return impl_->starts; }

void HostLink::listen_until(std::chrono::steady_clock::time_point due) {
  Impl& link = *impl_;
  for (;;) {
    link.take();
    link.ping();
    const auto now = Clock::now();
    if (now >= due || link.ending) break;
    const bool pings = link.pings && link.manager != 0;
    // An idle wait ends in time for the next clock reading, too.
    const auto until = pings ? std::min(due, std::max(now, link.ping_at)) : due;
    const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(until - now);
    static_cast<void>(link.waits.wait(Duration{left.count()}));
  }
  link.watch_worlds();
}

void HostLink::tell(const sim::Engine& engine, std::span<const RobotId> robots, bool reports) {
  Impl& link = *impl_;
  // In every step, also if nothing is due: contacts are events of one step.
  link.reports_out.note_contacts(engine);
  link.facts.step = engine.steps_done();
  link.publish(engine, robots, reports, link.shift());
}

void HostLink::send(const sim::SentPackets& sent) {
  Impl& link = *impl_;
  if (!link.packets_out) return;
  // The sender limits itself, so that a robot that floods costs the bus nothing; receivers limit
  // again, with twice the allowance, because they need not trust the sender.
  for (auto& [robot, limit] : link.talk) limit.step();
  for (const sim::SentPacket& packet : sent.packets) {
    TalkLimit& limit = link.talk[packet.robot];
    if (!limit.take(packet.size)) {
      ++link.packets_withheld;
      if (limit.name()) link.flooders.push_back(packet.robot);
      continue;
    }
    // Numbered without gaps by process. What is withheld above gets no number, so it does not look
    // like a loss.
    bus::Packet message =
        packet_of(packet, sent.bytes_of(packet), ++link.packets_sent, link.shift());
    if (link.packets_out->write(message)) continue;
    // Do not wait for a slow reader; the gap in the numbers tells the others of the loss.
    if (link.packets_unsent++ > 0) continue;
    link.tell(LogLevel::kWarning,
              "another process is too slow for the messages of robots here: messages are dropped "
              "until it catches up or counts as lost");
  }
}

void HostLink::note_lateness(lock_step::Pulse::Lateness lateness) {
  impl_->facts.lateness = std::move(lateness);
}

void HostLink::obstacles_shown() {
  Impl& link = *impl_;
  const std::uint64_t shown = link.live.shown_revision();
  if (shown <= link.shown_revision) return;
  link.shown_revision = shown;
  link.shown_since = link.time.at(local_ns());
  // The next ping leaves at once: it carries the confirmation that a person who made an edit waits
  // for.
  link.ping_at = {};
}

Status HostLink::deliver(std::span<const std::byte> host_results) {
  return impl_->deliver(host_results, impl_->facts.step);
}

std::vector<RobotReality> HostLink::take_realities() {
  return impl_->realities ? impl_->realities->take() : std::vector<RobotReality>();
}

Duration HostLink::world_age() const {
  const Impl& link = *impl_;
  if (!link.worlds || !link.begun) return {};
  return {std::chrono::nanoseconds(Clock::now() - link.last_world).count()};
}

std::optional<bus::ClockReading> HostLink::clock() const { return impl_->time.reading(local_ns()); }
const std::optional<lock_step::RunEnding>& HostLink::ending() const noexcept {
  return impl_->ending;
}
std::vector<RobotId> HostLink::take_flooders() { return std::exchange(impl_->flooders, {}); }
std::uint64_t HostLink::withheld_packets() const noexcept { return impl_->packets_withheld; }
std::uint64_t HostLink::unsent_packets() const noexcept { return impl_->packets_unsent; }
std::uint64_t HostLink::lost_packets() const noexcept { return impl_->packets_lost; }
std::uint64_t HostLink::worlds() const noexcept { return impl_->world_count; }
std::uint64_t HostLink::losses() const noexcept { return impl_->losses; }

}  // namespace rave::real_time
