// SPDX-License-Identifier: Apache-2.0
#include "rave/manager/live_manager.hpp"

#include <algorithm>
#include <chrono>

#include "drain.hpp"
#include "live_board.hpp"
#include "live_edits.hpp"
#include "manager_habits.hpp"
#include "rave/base/names.hpp"
#include "rave/bus/sequence.hpp"
#include "sat.hpp"

namespace rave::manager {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// Between the decision that a run begins and its time 0: hosts hear of it and start together.
constexpr milliseconds kLead{300};
constexpr std::size_t kMostNames = 5;
constexpr Duration kDeparture = from_seconds(0.2);

std::int64_t ns_of(Clock::time_point when) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(when.time_since_epoch()).count();
}

class LiveRun {
 public:
  LiveRun(const LiveManagerOptions& options, std::unique_ptr<LiveBoard> board,
          std::unique_ptr<LiveEdits> edits)
      : options_(options), board_(std::move(board)), edits_(std::move(edits)) {}

  Result<LiveManagerOutcome> go();

 private:
  Status listen();
  void hear(const bus::ClockPing& ping);
  void take_over(std::int64_t run_ns);
  void leave_alone(std::int64_t run_ns);
  void begin_if_ready();
  void begin_in(std::chrono::nanoseconds lead);
  void send_world();
  void look_for_stale(SimTime now);
  void tell_silence(const std::vector<std::string_view>& names, std::string_view what);
  void tell_state(rave_wire_RunPhase phase, const std::string& text);
  void tell_progress();
  void drain_hosts();
  LiveManagerOutcome outcome();
  [[nodiscard]] bool stopping() const { return options_.stopping && options_.stopping(); }
  [[nodiscard]] SimTime now() const { return {ns_of(Clock::now()) - zero_ns_}; }
  [[nodiscard]] std::string missing() const;

  template <class... Args>
  void log(LogLevel level, fmt::format_string<Args...> format, Args&&... args) {
    if (options_.log == nullptr) return;
    options_.log->write(level, kSource, fmt::format(format, std::forward<Args>(args)...));
  }

  const LiveManagerOptions& options_;
  std::unique_ptr<LiveBoard> board_;
  std::unique_ptr<LiveEdits> edits_;  ///< Behind the board, which it uses.
  bool begun_ = false;
  std::int64_t zero_ns_ = 0;  ///< Of the run, by the clock here; holds once it has begun.
  Clock::time_point first_host_{};
  Clock::time_point next_world_{};
  Clock::time_point next_tell_{};
  Clock::time_point next_look_{};
  std::uint64_t worlds_ = 0;
  std::vector<std::uint8_t> stale_;  ///< By robot.
  bool ended_ = false;
  std::vector<std::string> problems_;
  std::optional<Error> left_alone_;  ///< Hosts are in a run that this one does not go on with.
};

std::string LiveRun::missing() const {
  std::vector<std::string_view> names;
  for (const LiveSeat& seat : board_->seats()) {
    if (seat.writer == 0) names.emplace_back(seat.name);
  }
  return names.empty() ? std::string() : join_names(names);
}

void LiveRun::begin_in(std::chrono::nanoseconds lead) {
  begun_ = true;
  zero_ns_ = ns_of(Clock::now() + lead);
  next_world_ = Clock::now();
  next_tell_ = {};
}

/// Hosts know the time of a run that began with another manager.
void LiveRun::take_over(std::int64_t run_ns) {
  begin_in(-std::chrono::nanoseconds(run_ns));
  edits_->begin(true);
  log(LogLevel::kWarning, "takes over at {:.2f} s of the run", now().seconds());
}

void LiveRun::begin_if_ready() {
  if (begun_) return;
  const bool any = std::any_of(board_->seats().begin(), board_->seats().end(),
                               [](const LiveSeat& seat) { return seat.writer != 0; });
  if (!any) {
    first_host_ = {};
    return;
  }
  if (first_host_ == Clock::time_point{}) first_host_ = Clock::now();
  const std::string waits_for = missing();
  if (waits_for.empty()) {
    begin_in(kLead);
    edits_->begin(false);
    log(LogLevel::kInfo, "all hosts have joined: the run begins");
  } else if (Clock::now() -
                 std::max(first_host_, board_->endpoint().standstill().silence_counts_from()) >
             std::chrono::nanoseconds(options_.host_timeout.ns)) {
    begin_in(kLead);
    edits_->begin(false);
    log(LogLevel::kWarning, "the run begins without {}", waits_for);
  }
}

/// Hosts that are in the middle of a run and have lost its manager are not part of a new one.
void LiveRun::leave_alone(std::int64_t run_ns) {
  left_alone_ = Error{
      ErrorCode::kState,
      fmt::format(
          "hosts are at {:.1f} s of a run that lost its environment manager: --resume continues "
          "that run, `rave end {}` ends it, and --run with another name starts a new run",
          Duration{run_ns}.seconds(), options_.scenario),
      {}};
}

void LiveRun::hear(const bus::ClockPing& ping) {
  const std::int64_t received_ns = ns_of(Clock::now());
  if (!board_->sit_down(ping)) {
    next_look_ = {};  // it may have introduced itself just now
    return;
  }
  if (!begun_ && ping.run_ns >= 0) {
    if (!options_.resume) return leave_alone(ping.run_ns);
    take_over(ping.run_ns);
  }
  bus::ClockPong pong{};
  pong.target = ping.writer;
  pong.number = ping.number;
  pong.ping_sent_ns = ping.sent_ns;
  pong.ping_received_ns = received_ns;
  pong.begun = begun_;
  pong.zero_ns = zero_ns_;
  pong.obstacle_revision = edits_->revision();
  pong.pong_sent_ns = ns_of(Clock::now());
  board_->answer(pong);
}

Status LiveRun::listen() {
  board_->take_pings([this](const bus::ClockPing& ping) { hear(ping); });
  if (left_alone_) return tl::unexpected(*left_alone_);
  board_->take_states();
  board_->take_findings();
  board_->endpoint().serve_requests();
  if (Clock::now() < next_look_) return {};
  next_look_ = Clock::now() + kLook;
  // Towards the end each host goes when it is done.
  const bool over = ended_ || (begun_ && options_.duration - Duration{now().ns} < kDeparture);
  RAVE_TRY(board_->look_at_processes(begun_ && !over));
  board_->take_roster(begun_ && !ended_ ? options_.control : nullptr);
  if (board_->take_news()) next_tell_ = {};
  return {};
}

void LiveRun::tell_silence(const std::vector<std::string_view>& names, std::string_view what) {
  const std::size_t told = names.size() <= kMostNames ? names.size() : kMostNames - 1;
  for (std::size_t i = 0; i < told; ++i) log(LogLevel::kWarning, "robot `{}` {}", names[i], what);
  if (told < names.size()) {
    log(LogLevel::kWarning, "and {} other robots: {}", names.size() - told, what);
  }
}

void LiveRun::look_for_stale(SimTime now) {
  std::vector<std::string_view> silent;
  std::vector<std::string_view> back;
  stale_.resize(options_.robots.size());
  for (std::size_t r = 0; r < stale_.size(); ++r) {
    const auto stamp = board_->stamp_of(r);
    if (!stamp) continue;
    const bool stale = now - *stamp > board_->staleness(r);
    if (stale == (stale_[r] != 0)) continue;
    stale_[r] = stale ? 1 : 0;
    (stale ? silent : back).push_back(options_.robots[r].name);
  }
  tell_silence(silent, "is stale: its host has not reported its pose for too long");
  tell_silence(back, "is back");
}

void LiveRun::send_world() {
  const SimTime time = now();
  look_for_stale(time);
  board_->send_world(++worlds_, time, stale_);
  // On a grid of deadlines, so that lateness does not add up; what was missed is left out.
  const auto period = std::chrono::nanoseconds(options_.world_period.ns);
  const auto late = std::max<std::int64_t>(0, (Clock::now() - next_world_) / period);
  next_world_ += period * (late + 1);
}

void LiveRun::tell_state(rave_wire_RunPhase phase, const std::string& text) {
  bus::RunState state{};
  bus::put_text(state.scenario, options_.scenario);
  state.phase = phase;
  const std::int64_t now_ns = begun_ ? std::max<std::int64_t>(0, now().ns) : 0;
  state.step = static_cast<std::uint64_t>(now_ns / options_.step.ns);
  state.steps = static_cast<std::uint64_t>(options_.duration.ns / options_.step.ns);
  state.step_s = options_.step.seconds();
  // The time of the run goes on by the clock; what its robots live through need not.
  state.speed = begun_ ? board_->slowest_speed() : 0;
  bus::put_text(state.text, text);
  board_->publish(state);
  next_tell_ = Clock::now() + kTell;
}

void LiveRun::tell_progress() {
  if (!options_.on_progress) return;
  options_.on_progress(begun_ ? now() : SimTime{}, board_->slowest_speed(), missing());
}

/// Hosts hear of the end before this process goes.
void LiveRun::drain_hosts() {
  const auto owes = [this](std::uint64_t writer) {
    return begun_ && !board_->endpoint().findings().done_with(writer);
  };
  drain(board_->seats(), options_.log, owes, [this] {
    board_->wait(Duration{std::chrono::nanoseconds(kLook).count()});
    return listen().has_value();
  });
  // What a process sent before it went is here.
  board_->take_findings();
}

Result<LiveManagerOutcome> LiveRun::go() {
  auto next_ask = Clock::now();
  while (!(begun_ && now().ns >= options_.duration.ns)) {
    auto wake = Clock::now() + kLook;
    if (begun_) wake = std::min(wake, next_world_);
    const auto left =
        std::chrono::duration_cast<std::chrono::nanoseconds>(wake - Clock::now()).count();
    board_->wait(Duration{std::max<std::int64_t>(0, left)},
                 options_.control != nullptr ? options_.control->asked() : std::stop_token());
    RAVE_TRY(listen());
    begin_if_ready();
    if (begun_) RAVE_TRY(edits_->look(now()));
    if (begun_ && Clock::now() >= next_world_) send_world();
    if (Clock::now() >= next_tell_) {
      const std::string waits_for = missing();
      tell_state(begun_ ? rave_wire_RUN_GOES : rave_wire_RUN_GATHERS,
                 waits_for.empty() ? waits_for : fmt::format("waiting for {}", waits_for));
    }
    if (Clock::now() < next_ask) continue;
    next_ask = Clock::now() + kLook;
    tell_progress();
    if (!stopping()) continue;
    problems_.push_back(begun_ ? fmt::format("stopped at {:.2f} s", now().seconds())
                               : fmt::format("stopped while waiting for {}", missing()));
    break;
  }
  return outcome();
}

LiveManagerOutcome LiveRun::outcome() {
  ended_ = true;
  edits_->end();
  if (options_.on_end) options_.on_end(edits_->world());
  LiveManagerOutcome outcome;
  outcome.edits = edits_->edits();
  outcome.refused = edits_->refused();
  if (begun_) outcome.end = now();
  outcome.worlds = worlds_;
  outcome.states = board_->states();
  for (const LiveSeat& seat : board_->seats()) {
    outcome.hosts.push_back({seat.name, seat.heard, static_cast<double>(seat.offset_ns) * 1e-9,
                             seat.bound_ns < 0 ? -1 : static_cast<double>(seat.bound_ns) * 1e-9,
                             seat.losses});
    if (!seat.heard && begun_)
      problems_.push_back(fmt::format("host `{}` never joined", seat.name));
    if (seat.losses > 0) {
      problems_.push_back(
          fmt::format("host `{}` was lost {}", seat.name,
                      seat.losses == 1 ? "once" : fmt::format("{} times", seat.losses)));
    }
  }
  if (board_->endpoint().standstills() > 0) {
    problems_.push_back(
        fmt::format("the environment manager stood still for so long that hosts may have "
                    "considered it lost{}: it sent no worlds meanwhile",
                    board_->endpoint().standstills() == 1
                        ? ""
                        : fmt::format(" ({} times)", board_->endpoint().standstills())));
  }
  const bool over = begun_ && now().ns >= options_.duration.ns;
  outcome.problems = problems_;
  outcome.whole = over && problems_.empty() && outcome.refused.empty();
  // Who only stops managing leaves the hosts to their run.
  const bool ends =
      options_.ends_hosts || (options_.control != nullptr && options_.control->ends_everybody());
  if (!over && !ends) {
    board_->take_findings();
    outcome.findings = board_->endpoint().findings().hand_out();
    order_by_sitting(board_->seats(), outcome.findings);
    return outcome;
  }
  tell_state(over ? rave_wire_RUN_ENDED : rave_wire_RUN_FAILED,
             over || problems_.empty() ? std::string() : problems_.front());
  drain_hosts();
  outcome.saw_off = true;
  outcome.findings = board_->endpoint().findings().hand_out();
  order_by_sitting(board_->seats(), outcome.findings);
  return outcome;
}

}  // namespace

Result<LiveManagerOutcome> manage_live(sim::EngineSpec spec, const LiveManagerOptions& options) {
  RAVE_TRY_ASSIGN(auto board, LiveBoard::open(options));
  RAVE_TRY_ASSIGN(auto edits, LiveEdits::create(std::move(spec), options, *board));
  LiveRun run(options, std::move(board), std::move(edits));
  return run.go();
}

}  // namespace rave::manager
