// SPDX-License-Identifier: Apache-2.0
#include "rave/environment_manager/manager.hpp"

#include <algorithm>
#include <chrono>

#include "manager_habits.hpp"
#include "rave/base/names.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/sim/world_authority.hpp"
#include "sat.hpp"
#include "seats.hpp"
#include "switchboard.hpp"
#include "wishes.hpp"

namespace rave::environment_manager {
namespace {

using Clock = std::chrono::steady_clock;
using config::LostHost;
using std::chrono::milliseconds;

/// A host that has not got a step is sent it again, but not more often than this.
constexpr milliseconds kAgain{20};

std::vector<RosterBook::Robot> planned_robots(const sim::EngineSpec& spec) {
  std::vector<RosterBook::Robot> robots;
  for (const sim::RobotSpec& robot : spec.robots) {
    robots.push_back({robot.name, spec.types[robot.type].simulated});
  }
  return robots;
}

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// One run, from the first report to the last step.
class Run {
 public:
  Run(const ManagerOptions& options, std::unique_ptr<sim::WorldAuthority> authority,
      std::unique_ptr<Switchboard> board)
      : options_(options),
        authority_(std::move(authority)),
        board_(std::move(board)),
        seats_(make_seats(options.hosts)),
        wishes_(options.control, options.log),
        claims_(static_cast<std::uint32_t>(options.hosts.size())),
        roster_(planned_robots(authority_->spec()), options.hosts) {}

  Result<ManagerOutcome> go();
  /// The run cannot go on: tells everybody why, unless another manager has it.
  void give_up(const Error& error);

 private:
  enum class Gathered : std::uint8_t { kAll, kStopped };

  Result<Gathered> gather();
  Status listen();
  Status look();
  void look_at_roster();
  void miss(std::uint64_t writer);
  void see_off(bool awaits_findings);
  void take_findings();
  Status hear(const bus::HostReport& message);
  Status sit_down(Seat& seat, const bus::HostReport& message);
  void lose(Seat& seat, std::string_view why);
  void miss_steps(Seat& seat);
  void look_at_clock(Clock::time_point since);
  Status take_over();
  Status make_step();
  void wait_for_turn();
  void hold();
  Status resend();
  [[nodiscard]] robot_host::RunStatus first_status() const;
  /// Wakes from a wait when somebody asks something.
  [[nodiscard]] std::stop_token asked() const {
    return options_.control != nullptr ? options_.control->asked() : std::stop_token();
  }
  void tell_state(rave_wire_RunPhase phase, std::string_view text);
  void tell_progress(std::string waiting);
  [[nodiscard]] std::string waited_for() const;
  [[nodiscard]] bool complete() const;
  [[nodiscard]] bool stopping() const { return options_.stopping && options_.stopping(); }
  ManagerOutcome outcome();

  template <class... Args>
  void log(LogLevel level, fmt::format_string<Args...> format, Args&&... args) {
    if (options_.log == nullptr) return;
    options_.log->write(level, kSource, fmt::format(format, std::forward<Args>(args)...));
  }

  const ManagerOptions& options_;
  std::unique_ptr<sim::WorldAuthority> authority_;
  std::unique_ptr<Switchboard> board_;
  std::vector<Seat> seats_;
  sim::HostReport heard_;  ///< Before it is known whether it can be used.
  Wishes wishes_;
  bus::HostClaims claims_;
  RosterBook roster_;
  std::uint64_t step_ = 0;  ///< For which reports are gathered.
  bool begun_ = false;      ///< All hosts have been there at once.
  bool lost_any_ = false;
  bool ending_ = false;
  bool over_ = false;  ///< Nothing comes any more.
  sim::WorldStep world_;
  sim::AuthorityState state_;
  bool handed_over_ = false;  ///< `world_` and `state_` are of a manager that was here before.
  std::uint64_t newest_report_ = 0;
  std::uint64_t contacts_ = 0;
  std::vector<std::string> problems_;
  Clock::time_point began_;
  Clock::time_point ended_;
  std::uint64_t first_step_ = 0;
  Clock::time_point next_tell_;
  Clock::time_point next_progress_;
  Clock::time_point next_roster_;
  Clock::time_point resend_at_;
  bool asked_again_ = false;
  bool newcomer_ = false;  ///< Somebody has to be told of all obstacles.
  std::optional<Error> failure_;
};

std::string Run::waited_for() const {
  const bool all = options_.on_lost_host == LostHost::kWait;
  const auto names =
      names_of(seats_, [all](const Seat& seat) { return seat.needed(all) && !seat.reported; });
  if (!names.empty() || complete()) return join_names(names);
  return fmt::format("somebody who knows the world of step {}", newest_report_ - 1);
}

bool Run::complete() const {
  const bool all = options_.on_lost_host == LostHost::kWait;
  // Hosts that were in a run before hand over where it stood.
  if (!begun_ && newest_report_ > 0 && (!handed_over_ || world_.step + 1 < newest_report_)) {
    return false;
  }
  return std::all_of(seats_.begin(), seats_.end(),
                     [all](const Seat& seat) { return seat.reported || !seat.needed(all); });
}

void Run::tell_state(rave_wire_RunPhase phase, std::string_view text) {
  bus::RunState state{};
  bus::put_text(state.scenario, options_.scenario);
  state.phase = phase;
  state.step = step_;
  state.steps = options_.steps;
  state.step_s = authority_->spec().step.seconds();
  const double wall_s = begun_ ? seconds(Clock::now() - began_) : 0;
  const auto done = static_cast<double>(step_ - first_step_);
  state.speed = wall_s > 0 ? done * state.step_s / wall_s : 0;
  bus::put_text(state.text, text);
  std::vector<rave_wire_HostSight> hosts(seats_.size());
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    hosts[i].host = static_cast<std::uint32_t>(i);
    bus::put_text(hosts[i].name, seats_[i].name);
    hosts[i].phase = static_cast<rave_wire_HostPhase>(seats_[i].state);
    hosts[i].robots = seats_[i].robots;
    hosts[i].step = seats_[i].last_step;
    hosts[i].bound_s = -1;  // nobody asks for the time here
  }
  bus::borrow(state.hosts, hosts);
  board_->publish(state);
  next_tell_ = Clock::now() + kTell;
}

void Run::tell_progress(std::string waiting) {
  const auto now = Clock::now();
  if (!options_.on_progress || now < next_progress_) return;
  next_progress_ = now + kLook;
  const double wall_s = begun_ ? seconds(now - began_) : 0;
  const double sim_s = static_cast<double>(step_ - first_step_) * authority_->spec().step.seconds();
  options_.on_progress({step_, wall_s > 0 ? sim_s / wall_s : 0, std::move(waiting)});
}

void Run::lose(Seat& seat, std::string_view why) {
  const bool for_good = options_.on_lost_host == LostHost::kDrop;
  seat.state = for_good ? SeatState::kDropped : SeatState::kLost;
  claims_.release(seat.writer);
  seat.last_writer = seat.writer;
  seat.writer = 0;
  roster_.stir();
  constexpr std::string_view kThen[] = {"all wait until it is back",
                                        "its robots stand from this step on",
                                        "its robots stand until it is back"};
  std::string text = fmt::format("host `{}` {} in step {}; {}", seat.name, why, step_,
                                 kThen[static_cast<std::size_t>(options_.on_lost_host)]);
  log(LogLevel::kError, "{}", text);
  seat.loss = std::move(text);
  next_tell_ = {};
}

/// The run is not what it would have been with this host all the time.
void Run::miss_steps(Seat& seat) {
  lost_any_ = true;
  if (!seat.loss.empty()) problems_.push_back(std::exchange(seat.loss, {}));
}

/// A report of one who sits in this seat, or wants to.
Status Run::sit_down(Seat& seat, const bus::HostReport& message) {
  if (seat.writer == message.writer && seat.state != SeatState::kLost) {
    if (seat.state == SeatState::kLate) {
      log(LogLevel::kInfo, "host `{}` answers again, in step {}", seat.name, step_);
      seat.state = SeatState::kRuns;
      next_tell_ = {};
    }
    return {};
  }
  if (seat.state == SeatState::kDropped) {
    return fail(ErrorCode::kState, "host `{}` was dropped from this run", seat.name);
  }
  RAVE_TRY(claims_.claim(message.host, message.writer));
  // A process that was cut off and is in its step still has missed nothing.
  const bool same = seat.last_writer == message.writer && message.step + 1 >= step_;
  if (begun_ && !same) miss_steps(seat);
  newcomer_ = newcomer_ || (begun_ && !same);
  log(LogLevel::kInfo, "host `{}` is {}, with {} robots", seat.name,
      seat.state == SeatState::kLost ? fmt::format("back in step {}", step_) : "here", seat.robots);
  seat.writer = message.writer;
  roster_.stir();
  note_sitting(seat.sat, message.writer);
  seat.state = SeatState::kRuns;
  seat.reported = false;
  next_tell_ = {};
  return {};
}

Status Run::hear(const bus::HostReport& message) {
  if (message.host >= seats_.size() || !board_->knows(message.writer)) return {};
  Seat& seat = seats_[message.host];
  if (const Status sits = sit_down(seat, message); !sits) {
    board_->refuse(message, sits.error().message);
    return {};
  }
  seat.last_step = message.step;
  newest_report_ = std::max(newest_report_, message.step);
  if (message.state == rave_wire_REPORT_FAILED) {
    if (over_) return {};  // nothing depends on it any more, and it still says what it knows
    if (options_.on_lost_host == LostHost::kWait) {
      return fail(ErrorCode::kState, "host `{}` cannot go on: {}", seat.name, message.text);
    }
    lose(seat, fmt::format("cannot go on ({})", message.text));
    return {};
  }
  if (message.step < step_) {
    if (begun_ && !seat.reported) {
      asked_again_ = true;  // it has not got the step that it needs
      newcomer_ = newcomer_ || message.step + 1 < step_;
    }
    return {};
  }
  if (message.step > step_ && begun_) {
    board_->refuse(message,
                   fmt::format("it is of step {}, but step {} comes next", message.step, step_));
    return {};
  }
  if (seat.reported && begun_) return {};  // it was sent twice
  lock_step::read(message, heard_);
  // What the authority cannot use is no reason to end the run of the others. Before the run begins
  // it does not know yet which step comes next.
  if (const Status usable = begun_ || message.step == 0 ? authority_->check(heard_) : Status{};
      !usable) {
    board_->refuse(message, usable.error().text());
    return {};
  }
  std::swap(seat.report, heard_);
  seat.hash = message.hash;
  seat.reported = true;
  return {};
}

Status Run::listen() {
  Status status;
  board_->take_reports([&](const bus::HostReport& message) {
    if (status) status = hear(message);
  });
  board_->serve_wishes();
  return status;
}

/// A process is gone.
void Run::miss(std::uint64_t writer) {
  for (Seat& seat : seats_) {
    if (seat.writer != writer) continue;
    if (begun_ && !over_) {
      lose(seat, "is gone");
      continue;
    }
    if (!begun_) log(LogLevel::kWarning, "host `{}` is gone before the run began", seat.name);
    claims_.release(writer);
    seat.writer = 0;
    seat.state = SeatState::kMissing;
    seat.reported = false;
    seat.last_step = 0;
  }
  if (begun_) return;
  newest_report_ = 0;
  for (const Seat& seat : seats_) newest_report_ = std::max(newest_report_, seat.last_step);
}

void Run::take_findings() {
  board_->findings().take(
      [this](std::uint64_t writer, std::uint32_t host) { return has_sat(seats_, writer, host); });
}

/// What can wait until nothing else is to be done.
Status Run::look() {
  take_findings();
  RAVE_TRY_ASSIGN(const auto gone, board_->look_at_processes(begun_));
  if (!begun_) handed_over_ = board_->take_last_world(world_, state_, handed_over_) || handed_over_;
  for (const std::uint64_t writer : gone) {
    miss(writer);
    roster_.lose(writer);
  }
  look_at_roster();
  if (asked_again_ && Clock::now() >= resend_at_) {
    asked_again_ = false;
    resend_at_ = Clock::now() + kAgain;
    RAVE_TRY(resend());
  }
  return {};
}

void Run::look_at_roster() {
  const auto now = Clock::now();
  if (now < next_roster_) return;
  next_roster_ = now + kLook;
  const auto serving = [this](std::uint32_t host) {
    return host < seats_.size() ? seats_[host].writer : 0;
  };
  board_->take_roster(roster_, serving);
  if (begun_ && !over_) show_kinds(roster_, serving, options_.control);
}

/// The last world again, for whoever has not got it.
Status Run::resend() {
  if (!std::exchange(newcomer_, false)) {
    board_->resend(seats_);
    return {};
  }
  return board_->send(world_, authority_->state(true), seats_);
}

/// Who has not answered for too long.
void Run::look_at_clock(Clock::time_point since) {
  const auto patience = std::chrono::nanoseconds(options_.host_timeout.ns);
  if (!begun_ || Clock::now() - since < patience) return;
  for (Seat& seat : seats_) {
    if (seat.reported || seat.state != SeatState::kRuns) continue;
    if (options_.on_lost_host != LostHost::kWait) {
      lose(seat, fmt::format("has not answered for {:.1f} s", options_.host_timeout.seconds()));
      continue;
    }
    seat.state = SeatState::kLate;
    next_tell_ = {};
    log(LogLevel::kWarning, "host `{}` has not answered for {:.1f} s in step {}; all wait for it",
        seat.name, options_.host_timeout.seconds(), step_);
  }
}

Result<Run::Gathered> Run::gather() {
  const auto since = Clock::now();
  RAVE_TRY(listen());
  while (!complete()) {
    board_->wait(Duration{std::chrono::nanoseconds(kLook).count()}, asked());
    RAVE_TRY(listen());
    wishes_.listen(*authority_);
    if (complete()) break;
    RAVE_TRY(look());
    const auto now = Clock::now();
    // Most steps are done before anybody could ask.
    if (now - since < kLook) continue;
    look_at_clock(since);
    if (now >= next_tell_) {
      tell_state(begun_ ? rave_wire_RUN_WAITS : rave_wire_RUN_GATHERS,
                 fmt::format("waiting for {}", waited_for()));
    }
    tell_progress(waited_for());
    wishes_.put_off(fmt::format("the run waits for {}", waited_for()));
    if (stopping()) return Gathered::kStopped;
  }
  return Gathered::kAll;
}

/// The last step reaches everybody before this process goes, and what hosts know reaches it: until
/// they are gone, or for as long as one can expect of them.
void Run::see_off(bool awaits_findings) {
  const auto began = Clock::now();
  const auto here = [](const Seat& seat) { return seat.writer != 0; };
  const auto owes = [this](const Seat& seat) {
    return seat.writer != 0 && !board_->findings().done_with(seat.writer);
  };
  bool told = false;
  while (std::any_of(seats_.begin(), seats_.end(), here)) {
    const bool any_owes = awaits_findings && std::any_of(seats_.begin(), seats_.end(), owes);
    if (Clock::now() - began >= (any_owes ? kLongFarewell : kFarewell)) break;
    if (Clock::now() - began >= kFarewell && !std::exchange(told, true)) {
      log(LogLevel::kWarning, "waits up to {} s for what {} know of the run", kLongFarewell.count(),
          join_names(names_of(seats_, owes)));
    }
    board_->wait(Duration{std::chrono::nanoseconds(kLook).count()});
    if (!listen() || !look()) break;
  }
  // What a process sent before it went is here.
  take_findings();
}

/// All hosts are there. Where they come from a manager that was here before, its world is taken
/// over.
Status Run::take_over() {
  step_ = newest_report_;
  if (step_ == 0) return {};
  if (!handed_over_ || world_.step + 1 < step_) {
    return fail(ErrorCode::kState,
                "the hosts are in step {} already, and none has handed over the world of the step "
                "before: they belong to another run",
                step_);
  }
  step_ = world_.step + 1;
  RAVE_TRY(authority_->resume(world_, state_));
  log(LogLevel::kWarning, "takes over from a manager that is gone, at step {}", step_);
  for (Seat& seat : seats_) {
    if (!seat.reported || authority_->check(seat.report)) continue;
    seat.reported = false;
    seat.report = {};
  }
  return board_->send(world_, state_, seats_);
}

Status Run::make_step() {
  std::vector<const sim::HostReport*> reports;
  for (std::size_t h = 0; h < seats_.size(); ++h) {
    Seat& seat = seats_[h];
    if (!seat.reported) {
      authority_->speak_for(static_cast<std::uint32_t>(h), seat.report);
      miss_steps(seat);
    }
    reports.push_back(&seat.report);
  }
  RAVE_TRY(authority_->step(reports, world_));
  for (const sim::Event& event : authority_->events()) {
    contacts_ += event.kind == sim::EventKind::kContact ? 1U : 0U;
  }
  world_.last = world_.last || ending_ || step_ >= options_.steps;
  if (options_.on_world && options_.on_world(*authority_)) ending_ = true;
  RAVE_TRY(board_->send(world_, authority_->state(std::exchange(newcomer_, false)), seats_));
  wishes_.after_step(*authority_, world_);
  for (Seat& seat : seats_) seat.reported = false;
  ++step_;
  return {};
}

void Run::wait_for_turn() {
  if (options_.pace <= 0) return;
  const double due_s =
      static_cast<double>(step_ - first_step_) * authority_->spec().step.seconds() / options_.pace;
  const auto due =
      began_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due_s));
  for (auto now = Clock::now(); now < due; now = Clock::now()) {
    const auto left = std::min<Clock::duration>(due - now, kLook);
    board_->wait(Duration{std::chrono::duration_cast<std::chrono::nanoseconds>(left).count()},
                 asked());
    auto status = listen();
    if (status) status = look();
    if (!status) failure_ = std::move(status).error();
    wishes_.listen(*authority_);
    if (failure_ || stopping()) return;
  }
}

/// Somebody has paused the run.
void Run::hold() {
  constexpr milliseconds kHeld{20};
  const auto since = Clock::now();
  while (!wishes_.may_step() && !stopping()) {
    board_->wait(Duration{std::chrono::nanoseconds(kHeld).count()});
    auto status = listen();
    if (status) status = look();
    if (!status) failure_ = std::move(status).error();
    if (failure_) return;
    wishes_.listen(*authority_);
    wishes_.put_off("the run is paused");
    if (Clock::now() >= next_tell_) tell_state(rave_wire_RUN_WAITS, "paused");
    tell_progress("somebody who has paused it");
  }
  began_ += Clock::now() - since;
}

robot_host::RunStatus Run::first_status() const {
  robot_host::RunStatus status;
  status.scenario = options_.scenario;
  status.duration_s = static_cast<double>(options_.steps) * authority_->spec().step.seconds();
  status.pace = options_.pace;
  return status;
}

Result<ManagerOutcome> Run::go() {
  tell_state(rave_wire_RUN_GATHERS, fmt::format("waiting for {}", waited_for()));
  RAVE_TRY_ASSIGN(Gathered gathered, gather());
  if (gathered == Gathered::kStopped) {
    problems_.push_back(fmt::format("stopped while waiting for {}", waited_for()));
    return outcome();
  }
  RAVE_TRY(take_over());
  begun_ = true;
  wishes_.begin(*authority_, first_status());
  began_ = Clock::now();
  first_step_ = step_;
  for (;;) {
    RAVE_TRY_ASSIGN(gathered, gather());
    if (gathered == Gathered::kStopped) {
      problems_.push_back(
          fmt::format("stopped in step {} while waiting for {}", step_, waited_for()));
      break;
    }
    hold();
    wait_for_turn();
    wishes_.listen(*authority_);
    if (failure_) return tl::unexpected(*failure_);
    if (stopping() && !ending_) {
      ending_ = true;
      if (step_ < options_.steps) problems_.push_back(fmt::format("stopped in step {}", step_));
    }
    RAVE_TRY(make_step());
    tell_progress({});
    if (Clock::now() >= next_tell_) tell_state(rave_wire_RUN_GOES, {});
    if (world_.last) break;
  }
  return outcome();
}

void Run::give_up(const Error& error) {
  over_ = true;
  // The hosts are in good hands.
  if (board_->is_second()) return;
  tell_state(rave_wire_RUN_FAILED, error.message);
  see_off(false);
}

ManagerOutcome Run::outcome() {
  ended_ = Clock::now();
  if (options_.on_end) options_.on_end(*authority_);
  wishes_.end();
  ManagerOutcome outcome;
  outcome.steps = authority_->steps_done();
  outcome.contacts = contacts_;
  outcome.wall_s = begun_ ? seconds(ended_ - began_) : 0;
  for (Seat& seat : seats_) {
    if (seat.state == SeatState::kLost && begun_) miss_steps(seat);
  }
  outcome.problems = problems_;
  outcome.whole = begun_ && world_.last && problems_.empty();
  if (begun_ && world_.last && !lost_any_) {
    RunHash hash = authority_->hash();
    for (const Seat& seat : seats_) hash.merge(RunHash::of_value(seat.hash));
    outcome.hash = hash.value();
  }
  over_ = true;
  tell_state(outcome.whole ? rave_wire_RUN_ENDED : rave_wire_RUN_FAILED,
             problems_.empty() ? std::string() : problems_.back());
  see_off(begun_);
  outcome.findings = board_->findings().hand_out();
  order_by_sitting(seats_, outcome.findings);
  return outcome;
}

}  // namespace

std::vector<Seat> make_seats(const std::vector<config::PlannedHost>& hosts) {
  std::vector<Seat> seats;
  for (const config::PlannedHost& host : hosts) {
    Seat seat;
    seat.name = host.name;
    seat.robots = static_cast<std::uint32_t>(host.robots.size());
    seats.push_back(std::move(seat));
  }
  return seats;
}

Result<ManagerOutcome> manage(sim::EngineSpec spec, const ManagerOptions& options) {
  std::vector<std::uint32_t> host_of(spec.robots.size());
  for (std::uint32_t h = 0; h < options.hosts.size(); ++h) {
    for (const std::size_t robot : options.hosts[h].robots) host_of[robot] = h;
  }
  RAVE_TRY(check_scheduled(spec));
  RAVE_TRY_ASSIGN(auto authority, sim::WorldAuthority::create(std::move(spec), std::move(host_of)));
  RAVE_TRY_ASSIGN(auto board, Switchboard::open(options.bus, options.identity, options.log,
                                                options.begin_wish));
  Run run(options, std::move(authority), std::move(board));
  auto outcome = run.go();
  if (!outcome) run.give_up(outcome.error());
  return outcome;
}

}  // namespace rave::environment_manager
