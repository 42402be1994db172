// SPDX-License-Identifier: Apache-2.0
#include "rave/real_time/host_link.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <vector>

#include "rave/bus/sequence.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/lock_step/findings.hpp"
#include "rave/lock_step/pulse.hpp"
#include "rave/lock_step/run_words.hpp"
#include "rave/math/transform.hpp"
#include "rave/real_time/messages.hpp"
#include "rave/real_time/shared_time.hpp"

namespace rave::real_time {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kLook{100};
/// Of so many processes the packets are counted.
constexpr std::size_t kMostProcesses = 4096;
/// So many readings of the manager's clock are made in a hurry before the start.
constexpr std::uint64_t kFirstReadings = 8;
constexpr milliseconds kHurry{10};
constexpr milliseconds kLeisure{1000};
/// Better readings of one clock move it by less.
constexpr std::int64_t kJump_ns = 1'000'000;

std::int64_t local_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
      .count();
}

/// A writer or reader that is not always there.
template <class End, class... More>
Status make(std::optional<End>& place, bus::Bus& bus, const More&... more) {
  RAVE_TRY_ASSIGN(End end, End::create(bus, more...));
  place.emplace(std::move(end));
  return {};
}

}  // namespace

struct HostLink::Impl {
  Options options;
  LiveWorld& live;
  std::unique_ptr<bus::Bus> bus;
  bus::Writer<bus::HostInfo> own_info;
  bus::Reader<bus::HostInfo> infos;
  bus::Writer<bus::HostState> states;
  lock_step::Roster roster;
  bus::HostInfo introduced{};  ///< What the others were told of this process.
  // Of a managed run.
  std::optional<bus::Writer<bus::ClockPing>> pings{};
  std::optional<bus::Reader<bus::ClockPong>> pongs{};
  std::optional<bus::Reader<bus::RunState>> runs{};
  std::optional<bus::Reader<bus::Obstacle>> obstacles{};  ///< Made anew for each manager.
  std::optional<bus::Writer<bus::LastObstacle>> last_obstacles{};
  std::optional<lock_step::FindingsSender> findings{};
  std::optional<bus::Reader<bus::World>> worlds{};        // if it sees
  std::optional<bus::Writer<bus::Packet>> packets_out{};  // if it talks
  std::optional<bus::Reader<bus::Packet>> packets_in{};
  std::optional<Realities> realities{};  // if drivers may change
  std::optional<bus::WaitSet> waits{};   // behind all that it waits for
  std::optional<lock_step::Pulse> pulse{};
  lock_step::Pulse::Facts facts{};      ///< For those who look on.
  std::uint64_t last_world_number = 0;  ///< Of this manager; 0: none yet.

  SharedTime time{};
  std::vector<bus::HostInfo> managers{};         ///< That are there; the first is listened to.
  std::uint64_t manager = 0;                     ///< Its process; 0: nobody.
  lock_step::RunWords words{};                   ///< What is said of the run, and by whom.
  Clock::time_point alone_since = Clock::now();  ///< While there is no manager.
  std::optional<Error> unfit{};
  std::optional<Ending> ending{};
  std::string told{};
  bool started = false;
  std::int64_t zero_ns = 0;             ///< Of this process; stands once it has started.
  std::uint64_t pings_sent = 0;         ///< To this manager.
  std::uint64_t pongs_heard = 0;        ///< From it.
  std::uint64_t obstacle_revision = 0;  ///< That it says there is.
  bool wrong_obstacles = false;         ///< It has told of some that cannot be.
  std::uint64_t shown_revision = 0;     ///< That the robots here have around them,
  SimTime shown_since{};                ///< by the time of the run.
  Clock::time_point ping_at{};
  std::vector<RobotSight> starts{};
  std::uint64_t world_count = 0;
  std::uint64_t losses = 0;
  bool world_lost = false;
  Clock::time_point last_world{};
  RobotColumns columns{};
  std::uint64_t packets_sent = 0;
  std::map<RobotId, TalkLimit> talk{};  ///< Of robots here that have said something.
  std::vector<RobotId> flooders{};
  std::uint64_t packets_withheld = 0;
  std::uint64_t packets_unsent = 0;
  std::map<std::uint64_t, std::uint64_t> packets_heard{};  ///< By process: the newest number.
  std::uint64_t packets_lost = 0;

  Status open_endpoints();
  void tell(LogLevel level, const std::string& text) const;
  void tell_once(LogLevel level, const std::string& text);
  /// What is put on a stamp of this process to make it one of the run.
  [[nodiscard]] Duration shift() const noexcept { return {started ? zero_ns - time.zero_ns() : 0}; }
  void take();
  void take_infos();
  void meet(const bus::HostInfo& info);
  void take_pongs();
  void take_worlds();
  void take_obstacles();
  void hear(const bus::Obstacle& sample);
  void take_packets();
  void note_number(const bus::Packet& packet);
  void hear(const lock_step::RunWord& word);
  void look_at_patience();
  void look();
  void listen_to_first();
  void lose(std::uint64_t writer);
  void ping();
  void start_clock();
  [[nodiscard]] bool ready() const;
  [[nodiscard]] Duration patience() const noexcept;
  void watch_worlds();
};

void HostLink::Impl::tell(LogLevel level, const std::string& text) const {
  if (options.log != nullptr) options.log->write(level, "host " + options.self.name, text);
}

/// Each thing once, until something else is said.
void HostLink::Impl::tell_once(LogLevel level, const std::string& text) {
  if (text == told) return;
  told = text;
  if (!text.empty()) tell(level, text);
}

Status HostLink::Impl::open_endpoints() {
  RAVE_TRY_ASSIGN(auto set, bus::WaitSet::create(*bus));
  RAVE_TRY(set.add(infos));
  if (options.managed) {
    RAVE_TRY(make(pings, *bus));
    RAVE_TRY(make(pongs, *bus));
    RAVE_TRY(make(runs, *bus));
    RAVE_TRY(make(last_obstacles, *bus));
    RAVE_TRY(make(findings, *bus));
    RAVE_TRY(set.add(*pongs));
    RAVE_TRY(set.add(*runs));
  }
  if (options.managed && options.sees) {
    RAVE_TRY(make(worlds, *bus));
    RAVE_TRY(set.add(*worlds));
  }
  if (options.talks) {
    RAVE_TRY(make(packets_out, *bus));
    RAVE_TRY(make(packets_in, *bus));
    RAVE_TRY(set.add(*packets_in));
  }
  if (!options.host_of.empty()) {
    RAVE_TRY_ASSIGN(Realities made, Realities::create(*bus, options.self.host, options.host_of));
    realities.emplace(std::move(made));
  }
  RAVE_TRY(set.add_events());
  waits.emplace(std::move(set));
  RAVE_TRY(make(pulse, *bus, options.self));
  introduced = lock_step::introduction(options.self);
  return own_info.write(introduced);
}

void HostLink::Impl::meet(const bus::HostInfo& info) {
  const char* const machine = *info.machine != '\0' ? info.machine : "this machine";
  if (info.host == rave_wire_kNone) {
    if (!options.managed) return;
    if (auto fits = lock_step::check_fits(options.self, info); !fits) {
      words.shut_out(info.writer);
      if (started) tell_once(LogLevel::kError, "refused: " + fits.error().message);
      unfit = std::move(fits).error();
      return;
    }
    words.welcome(info.writer);
    const auto same = [&](const auto& known) { return known.writer == info.writer; };
    if (std::any_of(managers.begin(), managers.end(), same)) return;
    managers.push_back(info);
    if (managers.size() == 1) listen_to_first();
    return;
  }
  // Who is in the run already stays.
  if (info.host != options.self.host || started || !lock_step::gives_way(introduced, info)) return;
  unfit = Error{ErrorCode::kState,
                fmt::format("host `{}` of this run is served already, by a process on {}; end that "
                            "one first, or choose another host",
                            options.self.name, machine),
                {}};
}

void HostLink::Impl::take_infos() {
  infos.take([this](const bus::HostInfo& info) { meet(info); });
}

void HostLink::Impl::take_pongs() {
  const std::int64_t heard_ns = local_ns();
  pongs->take([&](const bus::ClockPong& pong) {
    if (pong.target != bus->writer() || pong.writer != manager) return;
    const std::int64_t before = time.known() ? time.zero_ns() : 0;
    const bool was_known = time.known();
    const Status heard = time.hear(
        pong.writer, {pong.ping_sent_ns, pong.ping_received_ns, pong.pong_sent_ns, heard_ns},
        pong.begun, pong.zero_ns);
    if (!heard) {
      pongs->refuse(pong, heard.error().message);
    } else {
      facts.round_trip_ns =
          heard_ns - pong.ping_sent_ns - (pong.pong_sent_ns - pong.ping_received_ns);
    }
    ++pongs_heard;
    obstacle_revision = pong.obstacle_revision;
    // A manager that took over may be a little off, and stamps must not seem to stand still.
    if (was_known && std::abs(before - time.zero_ns()) > kJump_ns) live.clock_changed();
  });
}

void HostLink::Impl::take_worlds() {
  worlds->take([this](const bus::World& world) {
    if (world.writer != manager) return;
    ++world_count;
    if (last_world_number != 0 && world.step > last_world_number) {
      facts.missed += world.step - last_world_number - 1;
    }
    last_world_number = world.step;
    last_world = Clock::now();
    const Duration back{-shift().ns};
    for (std::size_t i = 0; i < world.robots.id._length; ++i) {
      const RobotSight sight = read_robot(world.robots, i, back);
      if (!live.see(sight) && !started) {
        std::erase_if(starts, [&](const auto& start) { return start.robot == sight.robot; });
        starts.push_back(sight);
      }
    }
  });
}

/// Each process numbers what it sends, so a gap is what was lost on the way.
void HostLink::Impl::note_number(const bus::Packet& packet) {
  if (packets_heard.size() >= kMostProcesses) packets_heard.clear();
  std::uint64_t& newest = packets_heard[packet.writer];
  if (newest != 0 && packet.number > newest + 1) packets_lost += packet.number - newest - 1;
  newest = std::max(newest, packet.number);
}

void HostLink::Impl::take_obstacles() {
  // Before a step all that has come is looked at: of two the later one may stand first.
  while (obstacles->take([this](const bus::Obstacle& sample) { hear(sample); }) > 0) continue;
}

void HostLink::Impl::hear(const bus::Obstacle& sample) {
  if (sample.writer != manager) return;
  auto sight = read_obstacle(sample);
  if (!sight) {
    obstacles->refuse(sample, sight.error().message);
    return;
  }
  if (const Status possible = live.check(*sight); !possible) {
    // Once of each manager: what does not fit comes in numbers.
    if (!std::exchange(wrong_obstacles, true)) {
      tell(LogLevel::kWarning, "refused of the environment manager: " + possible.error().message);
    }
    return;
  }
  if (!live.see(*std::move(sight))) return;
  // For a manager that takes the place of this one.
  bus::LastObstacle kept{};
  static_cast<bus::Obstacle&>(kept) = sample;
  if (auto written = last_obstacles->write(kept); !written) {
    tell(LogLevel::kWarning,
         "an obstacle cannot be kept for another manager: " + written.error().message);
  }
}

void HostLink::Impl::take_packets() {
  packets_in->take([this](const bus::Packet& packet) {
    note_number(packet);
    sim::SentPacket sent = read_packet(packet, Duration{-shift().ns});
    // Clocks that are not related: it counts as sent when it is heard.
    if (!options.managed) sent.stamp_ns = INT64_MAX;
    live.hear(packet.writer, sent, payload_of(packet));
  });
}

void HostLink::Impl::hear(const lock_step::RunWord& word) {
  if (manager != 0 && word.writer != manager) return;
  switch (word.phase) {
    case rave_wire_RUN_GOES:
      return;
    case rave_wire_RUN_GATHERS:
    case rave_wire_RUN_WAITS:
      if (!started) tell_once(LogLevel::kWarning, word.text);
      return;
    case rave_wire_RUN_ENDED:
    case rave_wire_RUN_FAILED:
      ending = Ending{word.phase == rave_wire_RUN_ENDED, word.text};
      return;
  }
}

void HostLink::Impl::listen_to_first() {
  manager = managers.front().writer;
  pings_sent = 0;
  pongs_heard = 0;
  last_world_number = 0;
  wrong_obstacles = false;
  ping_at = {};
  // A new reader is told of all obstacles, also of those that came before anybody listened to this
  // manager.
  obstacles.reset();
  if (auto made = make(obstacles, *bus); !made) unfit = std::move(made).error();
  const char* const machine = managers.front().machine;
  tell_once(LogLevel::kInfo,
            fmt::format("the environment manager is `{}` on {}", managers.front().name,
                        *machine != '\0' ? machine : "this machine"));
}

void HostLink::Impl::lose(std::uint64_t writer) {
  std::erase_if(managers, [&](const auto& info) { return info.writer == writer; });
  if (writer != manager) return;
  manager = 0;
  alone_since = Clock::now();
  if (!ending) {
    tell_once(LogLevel::kError,
              started ? "the environment manager is gone; this host goes on without the others "
                        "until one is back"
                      : "the environment manager is gone");
  }
  // The next one may have come before this one was missed.
  if (!managers.empty()) listen_to_first();
}

/// Who was started for a run that is no more does not wait for ever for its beginning.
void HostLink::Impl::look_at_patience() {
  const Duration longest = options.manager_patience;
  if (!options.managed || ending || longest.ns <= 0 || manager != 0) return;
  if (Clock::now() - alone_since < std::chrono::nanoseconds(longest.ns)) return;
  ending =
      Ending{false, fmt::format("there was no environment manager for {} s", longest.seconds())};
  tell(LogLevel::kError, "gives up: " + ending->text);
}

/// What can wait until nothing else is to be done.
void HostLink::Impl::look() {
  take_infos();
  if (runs) {
    runs->take([this](const bus::RunState& state) {
      words.hear(lock_step::run_word(state, options.self.host));
    });
  }
  for (const lock_step::RunWord& word : words.take()) hear(word);
  for (const bus::BusEvent& event : bus->take_events()) {
    using enum bus::EventKind;
    if (event.kind == kParticipantLost && event.writer != 0) {
      if (realities) realities->lose(event.writer);
      lose(event.writer);
      continue;
    }
    const bool worth = event.kind == kRefused || event.kind == kIncompatible ||
                       event.kind == kForeignRun || event.kind == kNotice;
    if (worth && options.log != nullptr) options.log->warn("bus", "{}", event.line());
  }
}

void HostLink::Impl::take() {
  pulse->beat(facts);
  if (pongs) take_pongs();
  if (worlds) take_worlds();
  if (packets_in) take_packets();
  if (realities) realities->hear();
  look();
  if (obstacles) take_obstacles();
}

void HostLink::Impl::ping() {
  if (!pings || manager == 0 || Clock::now() < ping_at) return;
  // Before the manager knows this process it does not answer.
  const std::uint64_t done = pongs_heard > 0 ? pongs_heard : pings_sent;
  const bool knows_it = pongs_heard > 0 && time.known();
  const auto wait = done < kFirstReadings ? kHurry : (knows_it ? kLeisure : kLook);
  bus::ClockPing message{};
  message.target = manager;
  message.number = ++pings_sent;
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
  message.sent_ns = local_ns();
  static_cast<void>(pings->write(message));
  ping_at = Clock::now() + wait;
}

bool HostLink::Impl::ready() const {
  if (!options.managed) return true;
  if (!time.known() || pongs_heard < kFirstReadings / 2) return false;
  if (live.heard_revision() < obstacle_revision) return false;
  return !worlds || world_count > 0;
}

void HostLink::Impl::start_clock() {
  if (!options.managed) time.begin_alone(local_ns());
  zero_ns = time.zero_ns();
  started = true;
  last_world = Clock::now();
  told.clear();
  if (const auto reading = time.reading(local_ns())) {
    tell(LogLevel::kInfo,
         fmt::format("the clock of the environment manager is {:+.6f} s from the one here, give or "
                     "take {:.6f} s",
                     reading->offset.seconds(), reading->bound.seconds()));
  }
}

Duration HostLink::Impl::patience() const noexcept {
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
       lost ? fmt::format("no world has come for {:.1f} s: the robots of other hosts stand where "
                          "they were heard of last",
                          age.seconds())
            : "worlds come again");
}

HostLink::HostLink(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
HostLink::~HostLink() = default;

Result<std::unique_ptr<HostLink>> HostLink::open(Options options, LiveWorld& world) {
  RAVE_TRY_ASSIGN(auto bus, bus::Bus::open(options.bus));
  RAVE_TRY_ASSIGN(auto own_info, bus::Writer<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto infos, bus::Reader<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto states, bus::Writer<bus::HostState>::create(*bus));
  RAVE_TRY_ASSIGN(auto roster, lock_step::Roster::create(*bus, options.self.host));
  std::unique_ptr<Impl> impl(new Impl{std::move(options), world, std::move(bus),
                                      std::move(own_info), std::move(infos), std::move(states),
                                      std::move(roster)});
  RAVE_TRY(impl->open_endpoints());
  return std::unique_ptr<HostLink>(new HostLink(std::move(impl)));
}

Result<bool> HostLink::await_start(const std::function<bool()>& stopping) {
  Impl& link = *impl_;
  if (link.options.managed) {
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
      link.look_at_patience();
      if (stopping() || link.ending) return false;
    }
    static_cast<void>(link.waits->wait(Duration{std::chrono::nanoseconds(kHurry).count()}));
  }
  link.start_clock();
  return true;
}

std::chrono::steady_clock::time_point HostLink::zero() const noexcept {
  return Clock::time_point(std::chrono::nanoseconds(impl_->zero_ns));
}
void HostLink::count_real(std::uint32_t robots) noexcept { impl_->pulse->count_real(robots); }
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
    const auto until = pings ? std::min(due, std::max(now, link.ping_at)) : due;
    const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(until - now);
    static_cast<void>(link.waits->wait(Duration{left.count()}));
  }
  link.watch_worlds();
}

void HostLink::tell(const sim::Engine& engine, std::span<const RobotId> robots) {
  Impl& link = *impl_;
  const Duration shift = link.shift();
  link.columns.clear();
  for (const RobotId robot : robots) {
    const world::RobotState state = engine.snapshot().robot(robot);
    if (!state.present) continue;
    const bool simulated = engine.spec().types[engine.spec().robots[robot.value()].type].simulated;
    const SimTime stamp = simulated ? engine.time() : engine.reported(robot).stamp;
    const Vec2 v_B = rotate(-state.X_WR.yaw, {state.velocity_W.vx, state.velocity_W.vy});
    link.columns.add({robot, stamp + shift, state.X_WR, {v_B.x, v_B.y, state.velocity_W.wz}});
  }
  if (link.columns.size() == 0) return;
  bus::HostState message{};
  message.host = link.options.self.host;
  message.step = engine.steps_done();
  link.facts.step = message.step;
  link.columns.lend(message.resolved);
  static_cast<void>(link.states.write(message));
}

void HostLink::send(const sim::SentPackets& sent) {
  Impl& link = *impl_;
  if (!link.packets_out) return;
  for (auto& [robot, limit] : link.talk) limit.step();
  for (const sim::SentPacket& packet : sent.packets) {
    TalkLimit& limit = link.talk[packet.robot];
    if (!limit.take(packet.size)) {
      ++link.packets_withheld;
      if (limit.name()) link.flooders.push_back(packet.robot);
      continue;
    }
    bus::Packet message =
        packet_of(packet, sent.bytes_of(packet), ++link.packets_sent, link.shift());
    if (link.packets_out->write(message)) continue;
    // Nobody waits for a reader that is stuck; the others miss the number.
    if (link.packets_unsent++ > 0) continue;
    link.tell(LogLevel::kWarning,
              "some other process is too slow for what robots here say: messages are dropped until "
              "it is faster, or taken for dead");
  }
}

void HostLink::obstacles_shown() {
  Impl& link = *impl_;
  const std::uint64_t shown = link.live.shown_revision();
  if (shown <= link.shown_revision) return;
  link.shown_revision = shown;
  link.shown_since = link.time.at(local_ns());
  link.ping_at = {};
}

Status HostLink::deliver(std::span<const std::byte> findings) {
  Impl& link = *impl_;
  if (!link.findings || !link.started) return {};
  return link.findings->send(link.options.self.host, findings, lock_step::kFindingsPatience);
}

std::vector<RobotReality> HostLink::take_realities() {
  return impl_->realities ? impl_->realities->take() : std::vector<RobotReality>();
}

Duration HostLink::world_age() const {
  const Impl& link = *impl_;
  if (!link.worlds || !link.started) return {};
  return {std::chrono::nanoseconds(Clock::now() - link.last_world).count()};
}

std::optional<bus::ClockReading> HostLink::clock() const { return impl_->time.reading(local_ns()); }
const std::optional<HostLink::Ending>& HostLink::ending() const noexcept { return impl_->ending; }
std::vector<RobotId> HostLink::take_flooders() { return std::exchange(impl_->flooders, {}); }
std::uint64_t HostLink::withheld_packets() const noexcept { return impl_->packets_withheld; }
std::uint64_t HostLink::unsent_packets() const noexcept { return impl_->packets_unsent; }
std::uint64_t HostLink::lost_packets() const noexcept { return impl_->packets_lost; }
std::uint64_t HostLink::worlds() const noexcept { return impl_->world_count; }
std::uint64_t HostLink::losses() const noexcept { return impl_->losses; }

}  // namespace rave::real_time
