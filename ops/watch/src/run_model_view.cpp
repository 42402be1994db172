// SPDX-License-Identifier: Apache-2.0
// The view of a run that a model derives.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "moments.hpp"
#include "rave/base/open_end.hpp"
#include "rave/watch/run_model.hpp"

namespace rave::watch {
namespace {

/// Processes send their state every second.
constexpr std::int64_t kPatience_ns = 2'500'000'000;
/// A host without a new step for this long is late, and not only between two messages.
constexpr std::int64_t kStands_ns = 2'000'000'000;

void tell_length(std::uint64_t steps, double step_s, RunView& view) {
  const double duration_s = static_cast<double>(steps) * step_s;
  if (is_open_end(duration_s)) return;
  view.steps = steps;
  view.duration_s = duration_s;
}

}  // namespace

/// The process that serves a host: the present one that was heard last, else the last that was
/// present.
const RunModel::Process* RunModel::speaker_of(std::uint32_t host) const {
  const Process* best = nullptr;
  for (const auto& [writer, process] : processes_) {
    if (process.host != host) continue;
    const auto rank = [](const Process& p) {
      // Compared in this order: present ones first, then the one heard last, then the one that came
      // last.
      return std::tuple(!p.gone, p.heard_ns.value_or(-1), p.order);
    };
    if (best == nullptr || rank(process) > rank(*best)) best = &process;
  }
  return best;
}

bool RunModel::manager_here() const {
  const Process* const manager = speaker_of(rave_wire_kNone);
  return manager != nullptr && !manager->gone;
}

Standing RunModel::standing_of(const Process* process, const Sight* sight,
                               std::int64_t now_ns) const {
  // A manager that has left knows nothing of the others any more.
  const bool told = sight != nullptr && manager_here();
  if (sight != nullptr && sight->phase == rave_wire_HOST_DROPPED) return Standing::kDropped;
  if (process == nullptr) {
    return sight != nullptr && sight->phase != rave_wire_HOST_MISSING ? Standing::kGone
                                                                      : Standing::kWaiting;
  }
  if (process->gone) return Standing::kGone;
  const bool silent = process->heard_ns && now_ns - *process->heard_ns > kPatience_ns;
  if (silent || (told && sight->phase == rave_wire_HOST_LATE)) return Standing::kLate;
  // The process has returned, but the run has not admitted it yet.
  const bool out = told && sight->phase != rave_wire_HOST_RUNS;
  return out ? Standing::kWaiting : Standing::kHere;
}

std::optional<std::int64_t> RunModel::run_ns(std::int64_t now_ns) const {
  if (!worlds_) return std::nullopt;
  // The time of the newest world, continued by the clock here; the delay of that message is
  // neglected.
  return worlds_->time_ns + (now_ns - worlds_->heard_ns);
}

Timing RunModel::timing() const {
  for (const auto& [writer, process] : processes_) {
    if (process.introduced) return process.real_time ? Timing::kRealTime : Timing::kLockStep;
  }
  return Timing::kUnknown;
}

std::optional<double> RunModel::asked_of(const Robot& robot) const {
  if (robot.least_gap == 0 || !state_ || state_->step_s <= 0) return std::nullopt;
  return 1 / (static_cast<double>(robot.least_gap) * state_->step_s);
}

void RunModel::tell_process(const Process& process, HostView& view, std::int64_t now_ns) const {
  view.machine = process.machine;
  view.lost = process.lost;
  const bool here = view.standing != Standing::kGone && view.standing != Standing::kDropped;
  if (here && process.delay_ns) view.delay_s = seconds_of(*process.delay_ns);
  if (process.moved_ns && now_ns - *process.moved_ns > kStands_ns) {
    view.age_s = seconds_of(now_ns - *process.moved_ns);
  }
  if (!process.state) return;
  const bus::ProcessState& state = *process.state;
  view.process = state.process;
  view.robots = state.robots;
  view.real_robots = state.real_robots;
  view.step = state.step;
  view.lost = process.lost + state.missed;
  view.refused = state.refused;
  if (!here) return;
  if (state.deadlines > 0) {
    view.missed_pct =
        100.0 * static_cast<double>(state.missed_deadlines) / static_cast<double>(state.deadlines);
    view.worst_late_s = seconds_of(state.worst_late_ns);
    view.behind_s = seconds_of(state.behind_ns);
    view.late_phase = state.late_phase;
  }
  view.cores = process.cores;
  if (state.memory_bytes > 0) view.memory_mb = static_cast<double>(state.memory_bytes) * 1e-6;
  if (state.round_trip_ns >= 0) view.round_trip_s = seconds_of(state.round_trip_ns);
}

/// Fills in the values that a host in real time reports for its robots.
void RunModel::tell_reports(std::uint32_t host, const Process& process, HostView& view,
                            std::int64_t now_ns) const {
  double asked_hz = 0;
  std::size_t robots = 0;
  std::size_t with_period = 0;
  for (const auto& [number, robot] : robots_) {
    if (robot.host != host || robot.reported == 0) continue;
    ++robots;
    if (const auto asked = asked_of(robot)) {
      asked_hz += *asked;
      ++with_period;
    }
  }
  if (const auto rate = process.reports.at(now_ns); rate && robots > 0) {
    view.rate_hz = *rate / static_cast<double>(robots);
  }
  if (with_period > 0) view.asked_rate_hz = asked_hz / static_cast<double>(with_period);
  const auto now = run_ns(now_ns);
  if (now && process.newest_stamp_ns) {
    view.age_s = std::max(0.0, seconds_of(*now - *process.newest_stamp_ns));
  } else if (process.reported_ns) {
    view.age_s = seconds_of(now_ns - *process.reported_ns);
  }
}

/// Without messages from the manager, the values that its hosts report about it are used.
std::optional<HostView> RunModel::manager_by_words() const {
  std::optional<HostView> view;
  for (const auto& [writer, process] : processes_) {
    if (!process.word) continue;
    const auto manager = process.word->hosts.find(rave_wire_kNone);
    if (manager == process.word->hosts.end()) continue;
    const bool here = !process.gone && manager->second.phase == rave_wire_HOST_RUNS;
    if (view && !here) continue;
    view.emplace();
    view->name = manager->second.name;
    view->manager = true;
    view->machine = manager->second.machine;
    view->standing = here ? Standing::kHere : Standing::kGone;
    view->step = process.word->step;
  }
  return view;
}

HostView RunModel::manager_view(const Process& process, std::int64_t now_ns) const {
  HostView view;
  view.name = "environment manager";
  view.manager = true;
  view.standing = standing_of(&process, nullptr, now_ns);
  tell_process(process, view, now_ns);
  // The manager runs no robots and no steps in real time; zeros would look like a fault.
  view.robots.reset();
  view.real_robots.reset();
  view.age_s.reset();
  if (process.real_time) {
    view.step.reset();
    if (worlds_) {
      view.rate_hz = worlds_->rate.at(now_ns);
      view.lost = view.lost.value_or(0) + worlds_->lost;
      view.age_s = seconds_of(now_ns - worlds_->heard_ns);
    }
    return view;
  }
  if (state_) view.step = state_->step;
  view.rate_hz = run_steps_.at(now_ns);
  return view;
}

std::string RunModel::name_of(std::uint32_t host) const {
  if (state_) {
    const auto sight = state_->hosts.find(host);
    if (sight != state_->hosts.end() && sight->second.name[0] != 0) return sight->second.name;
  }
  const Process* const process = speaker_of(host);
  return process != nullptr && !process->name.empty() ? process->name
                                                      : fmt::format("host {}", host);
}

HostView RunModel::host_view(std::uint32_t host, std::int64_t now_ns) const {
  HostView view;
  view.number = host;
  view.name = name_of(host);
  const Sight* sight = nullptr;
  if (state_ && state_->hosts.contains(host)) sight = &state_->hosts.at(host);
  const Process* const process = speaker_of(host);
  view.standing = standing_of(process, sight, now_ns);
  if (process != nullptr) {
    tell_process(*process, view, now_ns);
    if (process->introduced && !view.robots) view.robots = process->robots;
    // Kinds as they are now, once all robots are known.
    if (view.real_robots && process->roster.size() == view.robots) {
      view.real_robots = static_cast<std::uint32_t>(std::ranges::count_if(
          process->roster, [](const auto& r) { return !r.second.simulated; }));
    }
    view.rate_hz = process->steps.at(now_ns);
    // In real time the rate of steps is that of the wall clock and says nothing; the rate of
    // reports does.
    if (process->real_time) view.rate_hz.reset();
    // In lock-step reports are sent for observers and say nothing about the host.
    const bool counts = process->real_time || !process->introduced;
    if (counts && process->reported > 0) tell_reports(host, *process, view, now_ns);
  }
  if (sight == nullptr) return view;
  view.robots = sight->robots;
  view.step = std::max(view.step.value_or(0), sight->step);
  if (sight->bound_s >= 0 && view.standing != Standing::kGone) {
    view.offset_s = sight->offset_s;
    view.bound_s = sight->bound_s;
  }
  return view;
}

RobotView RunModel::robot_view(const Robot& robot, std::int64_t now_ns) const {
  RobotView view;
  view.stale = robot.stale;
  view.rate_hz = robot.reports.at(now_ns);
  view.asked_rate_hz = asked_of(robot);
  view.report = robot.report;
  if (!robot.stamp_ns) return view;
  const auto now = run_ns(now_ns);
  view.age_s = seconds_of(now ? *now - *robot.stamp_ns : now_ns - *robot.heard_ns);
  view.age_s = std::max(0.0, *view.age_s);
  view.x_m = robot.x_m;
  view.y_m = robot.y_m;
  view.yaw_rad = robot.yaw_rad;
  view.speed_mps = robot.speed_mps;
  return view;
}

std::map<std::uint32_t, RunModel::Told> RunModel::roster(
    const std::set<std::uint32_t>& hosts) const {
  std::map<std::uint32_t, Told> roster;
  for (const std::uint32_t host : hosts) {
    const Process* const process = speaker_of(host);
    if (process == nullptr) continue;
    for (const auto& [number, robot] : process->roster) roster.emplace(number, Told{host, &robot});
  }
  return roster;
}

void RunModel::tell_robots(const std::set<std::uint32_t>& hosts, RunView& view,
                           std::int64_t now_ns) const {
  std::map<std::uint32_t, std::string> names;
  const auto name = [&](std::uint32_t host) {
    const auto [place, fresh] = names.try_emplace(host);
    if (fresh) place->second = name_of(host);
    return place->second;
  };
  const std::map<std::uint32_t, Told> described = roster(hosts);
  const auto add = [&](std::uint32_t number, RobotView robot, std::optional<std::uint32_t> host) {
    robot.number = number;
    const auto told = described.find(number);
    if (told != described.end() && (!host || *host == told->second.host)) {
      host = told->second.host;
      robot.name = told->second.robot->name;
      robot.team = told->second.robot->team;
      robot.driver = told->second.robot->driver;
      robot.simulated = told->second.robot->simulated;
    }
    if (host) robot.host = name(*host);
    view.robots.push_back(std::move(robot));
  };
  for (const auto& [number, robot] : robots_) {
    const bool reported = robot.reported > 0;
    add(number, robot_view(robot, now_ns), reported ? std::optional(robot.host) : std::nullopt);
  }
  for (const auto& [number, told] : described) {
    if (!robots_.contains(number)) add(number, {}, told.host);
  }
  // Stale and old ones come first: what needs a look must not be below the edge of the terminal.
  std::ranges::stable_sort(view.robots, [](const RobotView& a, const RobotView& b) {
    return std::tuple(a.stale, a.age_s.value_or(0)) > std::tuple(b.stale, b.age_s.value_or(0));
  });
}

void RunModel::tell_run(RunView& view, std::int64_t now_ns) const {
  view.run = run_;
  view.timing = timing();
  if (!knows_any()) view.text = "no process of the run was found";
  if (!state_) return tell_words(view);
  view.scenario = state_->scenario;
  constexpr Phase kPhases[] = {Phase::kGathering, Phase::kRunning, Phase::kWaits, Phase::kEnded,
                               Phase::kFailed};
  view.phase = kPhases[static_cast<std::size_t>(state_->phase)];
  view.text = state_->text;
  view.step = state_->step;
  view.time_s = static_cast<double>(state_->step) * state_->step_s;
  tell_length(state_->steps, state_->step_s, view);
  view.speed = state_->speed;
  if (view.timing == Timing::kRealTime && manager_here()) {
    if (const auto now = run_ns(now_ns)) view.time_s = std::max(0.0, seconds_of(*now));
  } else if (const auto steps = run_steps_.at(now_ns)) {
    view.speed = *steps * state_->step_s;
  }
  const bool over = view.phase == Phase::kEnded || view.phase == Phase::kFailed;
  if (!over && !manager_here() && view.timing == Timing::kLockStep) {
    view.phase = Phase::kWaits;
    view.text = "the environment manager is lost";
    view.speed = 0;
  }
}

/// The state of the run according to its hosts: one that waits counts for all, and the most
/// advanced one gives the step.
RunModel::Words RunModel::words() const {
  Words words;
  for (const auto& [writer, process] : processes_) {
    if (!process.word) continue;
    const State& word = *process.word;
    const bool ended = word.phase == rave_wire_RUN_ENDED || word.phase == rave_wire_RUN_FAILED;
    const bool failed = word.phase == rave_wire_RUN_FAILED;
    if (ended && (words.over == nullptr || failed)) words.over = &word;
    const bool here = !process.gone && !ended;
    // A host that continues counts more than those of an earlier run with this name.
    if (words.here && !here) continue;
    if (here && !words.here) words.farthest = nullptr;
    if (here && !words.here) words.newest_ns.reset();
    if (words.farthest == nullptr || word.step > words.farthest->step) words.farthest = &word;
    if (process.newest_stamp_ns) {
      words.newest_ns = std::max(words.newest_ns.value_or(0), *process.newest_stamp_ns);
    }
    if (!here) continue;
    words.here = true;
    if (word.phase != rave_wire_RUN_RUNNING) words.waiting = &word;
    const auto manager = word.hosts.find(rave_wire_kNone);
    words.manager_lost |=
        manager != word.hosts.end() && manager->second.phase != rave_wire_HOST_RUNS;
  }
  return words;
}

void RunModel::tell_words(RunView& view) const {
  const Words words = this->words();
  if (words.farthest == nullptr) return;
  const State& farthest = *words.farthest;
  view.scenario = farthest.scenario;
  view.step = farthest.step;
  tell_length(farthest.steps, farthest.step_s, view);
  view.time_s = words.newest_ns ? seconds_of(*words.newest_ns)
                                : static_cast<double>(farthest.step) * farthest.step_s;
  view.speed = words.here ? farthest.speed : 0;
  if (!words.here) {
    // A killed process did not report its end.
    const bool done = words.over != nullptr || farthest.step + 1 >= farthest.steps;
    const bool failed = words.over != nullptr && words.over->phase == rave_wire_RUN_FAILED;
    view.phase = failed ? Phase::kFailed : (done ? Phase::kEnded : Phase::kWaits);
    view.text = failed ? words.over->text : (done ? "" : "no process of the run was found");
    return;
  }
  view.phase = Phase::kRunning;
  if (words.waiting != nullptr) {
    const bool gathering = words.waiting->phase == rave_wire_RUN_GATHERING;
    view.phase = gathering ? Phase::kGathering : Phase::kWaits;
    view.text = words.waiting->text;
  }
  if (!words.manager_lost || view.timing != Timing::kLockStep) return;
  view.phase = Phase::kWaits;
  if (view.text.empty()) view.text = "the environment manager is lost";
}

RunView RunModel::view(std::int64_t now_ns, bool with_robots) const {
  RunView view;
  tell_run(view, now_ns);
  std::set<std::uint32_t> hosts;
  if (state_) {
    for (const auto& [number, sight] : state_->hosts) hosts.insert(number);
  }
  for (const auto& [writer, process] : processes_) {
    // A process that has only described robots is not counted as a host yet.
    const bool speaks = process.introduced || process.state || process.reported > 0;
    if (speaks && process.host != rave_wire_kNone) hosts.insert(process.host);
  }
  if (const Process* const manager = speaker_of(rave_wire_kNone)) {
    view.hosts.push_back(manager_view(*manager, now_ns));
  } else if (const auto seen = manager_by_words()) {
    view.hosts.push_back(*seen);
  }
  for (const std::uint32_t host : hosts) view.hosts.push_back(host_view(host, now_ns));
  if (!with_robots) return view;
  tell_robots(hosts, view, now_ns);
  return view;
}

}  // namespace rave::watch
