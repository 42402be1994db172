// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/host_port.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>

#include "rave/bus/event_log.hpp"
#include "rave/bus/request_box.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/standstill.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/findings.hpp"
#include "rave/protocol/pulse.hpp"
#include "rave/protocol/robot_columns.hpp"
#include "rave/protocol/run_words.hpp"
#include "rave/protocol/step_messages.hpp"
#include "rave/sim/obstacle_history.hpp"

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
/// After this process was suspended, a process that is not rediscovered within this time counts as
/// lost.
constexpr std::chrono::seconds kMissedAtOnce{1};
/// The epoch of worlds that hosts hand back: belongs to no authority, but is not 0.
constexpr std::uint64_t kHandedOver = 1;
/// At most this many lost processes are remembered.
constexpr std::size_t kMostGone = 4096;

}  // namespace

struct HostPort::Impl {
  Identity self;
  LogSink* log;
  bus::EventLog foreign;  ///< For messages caused by other processes; writes to `log`.
  std::unique_ptr<bus::Bus> bus;
  bus::Writer<bus::HostReport> reports;
  bus::Writer<bus::HostInfo> own_info;
  bus::Writer<bus::LastWorld> last_worlds;
  bus::Reader<bus::WorldStep> worlds;
  bus::Reader<bus::RunState> states;
  bus::Reader<bus::HostInfo> infos;
  std::unique_ptr<bus::RequestBox> requests;  ///< Null if other processes may not send requests.
  bus::WaitSet waits;
  Pulse pulse;
  Roster roster;
  FindingsSender findings;
  bus::HostInfo introduced;  ///< What this process published about itself.
  Patience patience;
  ReportMessage message{};
  WorldMessage last_message{};
  /// Of the last world; with obstacles only if it brought them.
  sim::WorldStep coming{};  ///< The world being read, before its validity is known; a member to
                            ///< reuse its memory.
  sim::AuthorityState authority{};
  sim::ObstacleHistory obstacles{};                   ///< The obstacles before the last world.
  std::vector<sim::ObstacleChange> last_obstacles{};  ///< The changes of that world.
  bool has_world = false;
  std::uint64_t last_step = 0;  ///< The step of the last world.
  std::uint64_t epoch = 0;      ///< The epoch of the authority that answered last; 0: it is gone.
  std::uint64_t first_epoch = 0;
  bool changed_hands = false;      ///< Another authority than the first has answered.
  std::uint64_t manager = 0;       ///< The process of the manager; 0: none known.
  std::set<std::uint64_t> gone{};  ///< Processes that were lost and have not come back.
  RunWords words{};                ///< The announced states of the run, by process.
  Clock::time_point alone_since = Clock::now();  ///< Valid while there is no manager.
  bool overslept = false;  ///< The manager was lost after this process had been suspended.
  std::string told{};      ///< The last text in the log.
  Ending ending{};
  std::optional<Error> unfit{};
  std::optional<bus::Writer<bus::HostState>> states_out{};  ///< For monitors, together with
  std::optional<HostWord> host_word{};                      ///< this.
  RobotColumns columns{};
  ReportColumns reports_out{};
  Clock::time_point next_show{};

  void tell(LogLevel level, const std::string& text);
  void tell_foreign(LogLevel level, const std::string& text);
  void look_at_processes();
  void lose(std::uint64_t writer);
  void meet(const bus::HostInfo& info);
  void hear(const RunWord& word);
  void look_at_patience();
  void tell_word(std::uint64_t step);
  Status send(const sim::HostReport& report, std::uint64_t hash, const sim::WorldStep& last);
  Status follow_obstacles(const sim::WorldStep& world, sim::AuthorityState& state);
  [[nodiscard]] bool take_world(const sim::HostReport& report, sim::WorldStep& world);

  bool over = false;
};

/// Logs a text once, until a different text follows.
void HostPort::Impl::tell(LogLevel level, const std::string& text) {
  if (text == told) return;
  told = text;
  if (log != nullptr && !text.empty()) log->write(level, "host " + self.name, text);
}

/// The same for texts caused by other processes.
void HostPort::Impl::tell_foreign(LogLevel level, const std::string& text) {
  if (text == told) return;
  told = text;
  if (!text.empty()) foreign.write(level, "host " + self.name, text);
}

void HostPort::Impl::meet(const bus::HostInfo& info) {
  if (info.host == rave_wire_kNone) {
    if (auto fits = check_fits(self, info); !fits) {
      words.shut_out(info.writer);
      if (has_world) {
        return tell_foreign(LogLevel::kError, "refused: " + fits.error().message);
      }
      unfit = std::move(fits).error();
      return;
    }
    words.welcome(info.writer);
    // A further manager is accepted only after the loss of the current one.
    if (manager != 0 || gone.contains(info.writer)) return;
    manager = info.writer;
    tell(LogLevel::kInfo, fmt::format("the environment manager is `{}` on {}", info.name,
                                      *info.machine != '\0' ? info.machine : "this machine"));
    return;
  }
  // A process that is part of the run already stays.
  if (info.host != self.host || epoch != 0 || !gives_way(introduced, info)) return;
  unfit = Error{ErrorCode::kState,
                fmt::format("host `{}` of this run is served already, by a process on {}; end that "
                            "one first, or choose another host",
                            self.name, *info.machine != '\0' ? info.machine : "this machine"),
                {}};
}

void HostPort::Impl::hear(const RunWord& word) {
  // The last state that a manager announced before its loss still counts, but does not make it
  // present again.
  if (manager == 0 && !gone.contains(word.writer)) manager = word.writer;
  if (manager != 0 && word.writer != manager) return;
  if (word.without_us) {
    over = true;
    ending = {false, "the run continued without this host, which was late or lost"};
  }
  switch (word.phase) {
    case rave_wire_RUN_GOES:
      told.clear();
      return;
    case rave_wire_RUN_GATHERS:
    case rave_wire_RUN_WAITS:
      tell_foreign(LogLevel::kWarning, word.text);
      return;
    case rave_wire_RUN_ENDED:
    case rave_wire_RUN_FAILED:
      over = true;
      ending = {word.phase == rave_wire_RUN_ENDED, word.text};
      return;
  }
}

void HostPort::Impl::lose(std::uint64_t writer) {
  if (writer == 0) return;
  if (gone.size() >= kMostGone) gone.erase(gone.begin());
  gone.insert(writer);
  if (writer != manager) return;
  manager = 0;
  epoch = 0;
  alone_since = Clock::now();
  // A manager that is not rediscovered counts as lost as soon as its lease has expired. Its lease
  // began when it was last heard, some time before this process was suspended.
  const bus::Standstill& still = bus->standstill();
  overslept = 2 * still.stood().ns > bus->config().lease.ns &&
              alone_since - still.silence_counts_from() < kMissedAtOnce;
  if (over) return;
  tell(LogLevel::kError, "the environment manager is lost; robots stop until one is back");
}

void HostPort::Impl::look_at_processes() {
  using enum bus::EventKind;
  // Events come before messages: a process that returned must count as present when its messages
  // are read, and one that left was read before.
  const std::vector<bus::BusEvent> events = bus->take_events();
  for (const bus::BusEvent& event : events) {
    if (event.kind == kParticipantAppeared) gone.erase(event.writer);
  }
  infos.take([this](const bus::HostInfo& info) { meet(info); });
  states.take([this](const bus::RunState& state) { words.hear(run_word(state, self.host)); });
  for (const RunWord& word : words.take()) hear(word);
  for (const bus::BusEvent& event : events) {
    if (event.kind == kParticipantLost) lose(event.writer);
    if (event.kind == kParticipantAppeared) gone.erase(event.writer);
    foreign.note(event);
  }
}

/// A process started for a run that no longer exists must not wait forever.
void HostPort::Impl::look_at_patience() {
  const bool short_of_it = overslept && patience.after_standstill.ns > 0;
  const Duration longest = short_of_it ? patience.after_standstill : patience.usual;
  if (over || longest.ns <= 0 || manager != 0) return;
  const auto since = std::max(alone_since, bus->standstill().silence_counts_from());
  if (Clock::now() - since < std::chrono::nanoseconds(longest.ns)) return;
  over = true;
  ending = {
      false,
      fmt::format("there was no environment manager for {} s{}", longest.seconds(),
                  short_of_it ? " after this host stood still: the run continued without it" : "")};
  tell(LogLevel::kError, fmt::format("gives up: {}", ending.text));
}

/// For monitors.
void HostPort::Impl::tell_word(std::uint64_t step) {
  const bool stands = manager == 0 || !told.empty();
  const auto phase = stands ? rave_wire_RUN_WAITS : rave_wire_RUN_GOES;
  host_word->tell({has_world ? phase : rave_wire_RUN_GATHERS, step, told, true, manager != 0});
}

Status HostPort::Impl::send(const sim::HostReport& report, std::uint64_t hash,
                            const sim::WorldStep& last) {
  if (has_world && epoch == 0) {
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
    has_world = true;
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

Result<std::unique_ptr<HostPort>> HostPort::open(const bus::BusConfig& config, Identity identity,
                                                 LogSink* log, Patience patience,
                                                 bus::BeginRequest begin_request) {
  RAVE_TRY_ASSIGN(auto bus, bus::Bus::open(config));
  RAVE_TRY_ASSIGN(auto reports, bus::Writer<bus::HostReport>::create(*bus));
  RAVE_TRY_ASSIGN(auto own_info, bus::Writer<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto last_worlds, bus::Writer<bus::LastWorld>::create(*bus));
  RAVE_TRY_ASSIGN(auto worlds, bus::Reader<bus::WorldStep>::create(*bus));
  RAVE_TRY_ASSIGN(auto states, bus::Reader<bus::RunState>::create(*bus));
  RAVE_TRY_ASSIGN(auto infos, bus::Reader<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto waits, bus::WaitSet::create(*bus));
  RAVE_TRY_ASSIGN(auto pulse, Pulse::create(*bus, identity));
  RAVE_TRY_ASSIGN(auto roster, Roster::create(*bus, identity.host));
  RAVE_TRY_ASSIGN(auto findings, FindingsSender::create(*bus));
  RAVE_TRY_ASSIGN(auto requests, bus::RequestBox::create(*bus, std::move(begin_request), log));
  RAVE_TRY(waits.add(worlds));
  RAVE_TRY(waits.add(states));
  RAVE_TRY(waits.add(infos));
  if (requests) RAVE_TRY(requests->wake(waits));
  RAVE_TRY(waits.add_events());
  bus::HostInfo info = introduction(identity);
  RAVE_TRY(own_info.write(info));
  std::unique_ptr<Impl> impl(
      new Impl{std::move(identity), log, bus::EventLog(log), std::move(bus), std::move(reports),
               std::move(own_info), std::move(last_worlds), std::move(worlds), std::move(states),
               std::move(infos), std::move(requests), std::move(waits), std::move(pulse),
               std::move(roster), std::move(findings), info, patience});
  RAVE_TRY_ASSIGN(auto states_out, bus::Writer<bus::HostState>::create(*impl->bus));
  impl->states_out.emplace(std::move(states_out));
  RAVE_TRY_ASSIGN(auto word, HostWord::create(*impl->bus, impl->self.host, impl->self.name));
  impl->host_word.emplace(std::move(word));
  return std::unique_ptr<HostPort>(new HostPort(std::move(impl)));
}

Result<HostPort::Answer> HostPort::exchange(const sim::HostReport& report, std::uint64_t hash,
                                            sim::WorldStep& world,
                                            const std::function<bool()>& stopping) {
  Impl& port = *impl_;
  auto patience = kFirstPatience;
  auto send_at = Clock::now();
  // Checked by time, so that constant wake-ups cannot prevent a stop.
  auto next_stop = Clock::now() + kLook;
  for (;;) {
    port.pulse.beat({report.step});
    port.tell_word(report.step);
    if (Clock::now() >= send_at) {
      RAVE_TRY(port.send(report, hash, world));
      send_at = Clock::now() + patience;
      patience = std::min(2 * patience, kLongestPatience);
    }
    static_cast<void>(port.waits.wait(bus::left_until(std::min(send_at, next_stop))));
    if (port.requests) port.requests->serve();
    if (port.take_world(report, world)) {
      port.told.clear();
      return Answer::kWorld;
    }
    port.look_at_processes();
    port.look_at_patience();
    if (port.unfit) return tl::unexpected(*port.unfit);
    if (port.over) return Answer::kEnded;
    // Checked rarely: usually the answer to a step arrives earlier.
    if (Clock::now() < next_stop) continue;
    if (stopping()) return Answer::kStopped;
    next_stop = Clock::now() + kLook;
  }
}

void HostPort::show(const sim::Engine& engine, std::span<const RobotId> robots) {
  Impl& port = *impl_;
  port.reports_out.note_contacts(engine);
  const auto now = Clock::now();
  if (now < port.next_show) return;
  port.next_show = now + kShowInterval;
  if (port.states_out->readers() == 0) return;
  port.columns.clear();
  port.reports_out.clear();
  for (const RobotId robot : robots) {
    port.columns.add(engine, robot, Duration{});
    port.reports_out.add(engine, robot);
  }
  if (robots.empty()) return;
  bus::HostState message{};
  message.host = port.self.host;
  message.step = engine.steps_done();
  port.columns.lend(message.resolved);
  port.reports_out.lend(message.reports);
  // A monitor that is too slow misses some messages.
  static_cast<void>(port.states_out->write(message));
}

HostWord& HostPort::word() noexcept { return *impl_->host_word; }
bus::Bus& HostPort::bus() noexcept { return *impl_->bus; }
Roster& HostPort::roster() noexcept { return impl_->roster; }
const sim::AuthorityState& HostPort::authority() const noexcept { return impl_->authority; }
bool HostPort::changed_hands() const noexcept { return impl_->changed_hands; }
const HostPort::Ending& HostPort::ending() const noexcept { return impl_->ending; }

Status HostPort::deliver(std::span<const std::byte> findings) {
  Impl& port = *impl_;
  if (!port.has_world) return {};
  port.host_word->tell_end(!port.over || port.ending.good, port.last_step, port.ending.text);
  return port.findings.send(port.self.host, findings, kFindingsPatience);
}

void HostPort::farewell(const sim::HostReport& report, std::uint64_t hash) {
  Impl& port = *impl_;
  static_cast<void>(port.reports.write(port.message.fill(report, port.epoch, hash)));
}

}  // namespace rave::lock_step
