// SPDX-License-Identifier: Apache-2.0
#include "rave/watch/run_model.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "moments.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::watch {
namespace {

/// Bounds the memory if processes or robots are forged.
constexpr std::size_t kMostProcesses = 2 * rave_wire_kMaxHosts;
constexpr std::size_t kMostRobots = rave_wire_kMaxRobots;
/// Shortest time over which processor use is measured.
constexpr std::int64_t kCoresApart_ns = 200'000'000;

}  // namespace

void Rate::add(std::int64_t now_ns, double count) {
  // A counter that steps back is that of a new process.
  if (!readings_.empty() && count < readings_.back().count) readings_.clear();
  const std::size_t size = readings_.size();
  // Readings that follow closely replace each other, so the memory does not grow with the rate of
  // messages.
  if (size > 1 && now_ns - readings_[size - 2].at_ns < kApart_ns) {
    readings_.back() = {now_ns, count};
  } else {
    readings_.push_back({now_ns, count});
  }
  const auto window_ns = static_cast<std::int64_t>(kWindow_s * 1e9);
  while (readings_.size() > 2 && readings_.front().at_ns < now_ns - window_ns) {
    readings_.pop_front();
  }
}

std::optional<double> Rate::at(std::int64_t now_ns) const {
  if (readings_.size() < 2) return std::nullopt;
  const Reading& first = readings_.front();
  const Reading& last = readings_.back();
  const std::int64_t span_ns = last.at_ns - first.at_ns;
  // A longer silence than usual lowers the rate.
  const std::int64_t usual_ns = span_ns / static_cast<std::int64_t>(readings_.size() - 1);
  const std::int64_t until_ns = std::max(last.at_ns, now_ns - 2 * usual_ns);
  if (until_ns <= first.at_ns) return std::nullopt;
  return (last.count - first.count) / seconds_of(until_ns - first.at_ns);
}

RunModel::Process& RunModel::process_of(std::uint64_t writer) {
  const auto found = processes_.find(writer);
  if (found != processes_.end()) return found->second;
  if (processes_.size() >= kMostProcesses) {
    // Makes room by forgetting one process. If it is present, its next message brings it back.
    described_ -= processes_.begin()->second.roster.size();
    processes_.erase(processes_.begin());
  }
  Process& process = processes_[writer];
  process.order = ++arrivals_;
  return process;
}

void RunModel::hear(const bus::HostInfo& info) {
  Process& process = process_of(info.writer);
  process.introduced = true;
  process.gone = false;
  process.host = info.host;
  process.name = info.name;
  process.machine = info.machine;
  process.folder = info.folder;
  process.real_time = info.clock == rave_wire_CLOCK_REAL_TIME;
  process.robots = info.robots;
}

void RunModel::hear(const bus::RunState& state, std::int64_t now_ns) {
  const auto writer = processes_.find(state.writer);
  // The first sample may be of some time ago, so no rate begins with it.
  const bool fresh = state_ && state_->writer == state.writer;
  const bool of_the_dead = writer != processes_.end() && writer->second.gone;
  if (state_ && state_->writer != state.writer && of_the_dead) return;
  state_ = read(state);
  if (fresh) run_steps_.add(now_ns, static_cast<double>(state.step));
}

void RunModel::hear_word(const bus::RunState& state, std::int64_t now_ns) {
  Process& process = process_of(state.writer);
  process.gone = false;
  process.word = read(state);
  process.heard_ns = std::max(process.heard_ns.value_or(now_ns), now_ns);
}

RunModel::State RunModel::read(const bus::RunState& state) {
  State now;
  now.writer = state.writer;
  now.scenario = state.scenario;
  now.phase = state.phase;
  now.step = state.step;
  now.steps = state.steps;
  now.step_s = state.step_s;
  now.speed = state.speed;
  now.text = state.text;
  for (const Sight& host : bus::elements(state.hosts)) now.hosts[host.host] = host;
  return now;
}

/// Two messages may follow one another closely, as after a hand-over. Their delays differ, and the
/// difference is then most of their distance.
void RunModel::count_cores(Process& process, const bus::ProcessState& state, std::int64_t now_ns) {
  const std::int64_t span_ns = now_ns - process.cores_from_ns;
  if (process.state && state.cpu_ns >= process.cores_from) {
    if (span_ns < kCoresApart_ns) return;
    process.cores =
        static_cast<double>(state.cpu_ns - process.cores_from) / static_cast<double>(span_ns);
  }
  process.cores_from_ns = now_ns;
  process.cores_from = state.cpu_ns;
}

void RunModel::hear(const bus::ProcessState& state, std::int64_t now_ns, std::int64_t delay_ns) {
  Process& process = process_of(state.writer);
  process.gone = false;
  if (!process.introduced) process.host = state.host;
  // The first message after joining may be any number, so only later gaps count as lost.
  if (process.state && process.heard_ns && now_ns > *process.heard_ns) {
    const bus::ProcessState& before = *process.state;
    if (state.number > before.number) process.lost += state.number - before.number - 1;
  }
  count_cores(process, state, now_ns);
  if (!process.state || process.state->step != state.step) process.moved_ns = now_ns;
  process.steps.add(now_ns, static_cast<double>(state.step));
  process.state = state;
  process.heard_ns = now_ns;
  process.delay_ns = delay_ns;
}

void RunModel::place(const rave_wire_PlanarRobots& robots, std::size_t i, std::int64_t now_ns) {
  const std::uint32_t number = robots.id._buffer[i];
  if (robots_.size() >= kMostRobots && !robots_.contains(number)) return;
  Robot& robot = robots_[number];
  const std::int64_t stamp_ns = robots.stamp_ns._buffer[i];
  // A world repeats poses that a host has reported already, possibly after a newer report.
  if (robot.stamp_ns && stamp_ns < *robot.stamp_ns) return;
  robot.stamp_ns = stamp_ns;
  robot.heard_ns = now_ns;
  robot.x_m = robots.x_m._buffer[i];
  robot.y_m = robots.y_m._buffer[i];
  robot.yaw_rad = robots.yaw_rad._buffer[i];
  const double vx_mps = robots.vx_mps._buffer[i];
  const double vy_mps = robots.vy_mps._buffer[i];
  // The sign tells driving backward: it is that of the component along the heading.
  robot.speed_mps = std::copysign(std::hypot(vx_mps, vy_mps), vx_mps * std::cos(robot.yaw_rad) +
                                                                  vy_mps * std::sin(robot.yaw_rad));
}

void RunModel::note_reports(const rave_wire_RobotReports& reports) {
  const auto ids = bus::elements(reports.id);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (robots_.size() >= kMostRobots && !robots_.contains(ids[i])) return;
    const std::uint8_t flags = reports.flags._buffer[i];
    const auto has = [flags](unsigned bit) { return (flags & bit) != 0; };
    robots_[ids[i]].report = {reports.x_m._buffer[i],
                              reports.y_m._buffer[i],
                              reports.yaw_rad._buffer[i],
                              reports.variance_xy_m2._buffer[i],
                              reports.variance_yaw_rad2._buffer[i],
                              has(1),
                              has(2),
                              has(4),
                              !has(8),
                              has(16),
                              has(32)};
  }
}

void RunModel::hear(const bus::HostState& state, std::int64_t now_ns, std::int64_t delay_ns) {
  Process& process = process_of(state.writer);
  process.gone = false;
  if (!process.introduced) process.host = state.host;
  const auto ids = bus::elements(state.resolved.id);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    place(state.resolved, i, now_ns);
    const auto found = robots_.find(ids[i]);
    if (found == robots_.end()) continue;
    Robot& robot = found->second;
    robot.host = state.host;
    if (robot.last_step != 0 && state.step > robot.last_step) {
      const std::uint64_t gap = state.step - robot.last_step;
      // The period of reports is not on the wire. The smallest distance of two reports in steps
      // shows it, since lost ones only make it larger.
      robot.least_gap = robot.least_gap == 0 ? gap : std::min(robot.least_gap, gap);
    }
    robot.last_step = state.step;
    robot.reports.add(now_ns, ++robot.reported);
    const std::int64_t stamp_ns = state.resolved.stamp_ns._buffer[i];
    process.newest_stamp_ns = std::max(process.newest_stamp_ns.value_or(stamp_ns), stamp_ns);
  }
  note_reports(state.reports);
  process.reported += static_cast<double>(ids.size());
  process.reports.add(now_ns, process.reported);
  process.reported_ns = now_ns;
  process.delay_ns = delay_ns;
}

void RunModel::hear(const bus::World& world, std::int64_t now_ns) {
  if (!worlds_ || worlds_->writer != world.writer) {
    worlds_ = Worlds{};
    worlds_->writer = world.writer;
  } else if (world.step > worlds_->number) {
    worlds_->lost += world.step - worlds_->number - 1;
  }
  worlds_->number = world.step;
  worlds_->time_ns = world.time_ns;
  worlds_->heard_ns = now_ns;
  worlds_->rate.add(now_ns, static_cast<double>(world.step));
  for (std::size_t i = 0; i < world.robots.id._length; ++i) place(world.robots, i, now_ns);
  for (auto& [number, robot] : robots_) robot.stale = false;
  for (const std::uint32_t number : bus::elements(world.stale)) {
    const auto found = robots_.find(number);
    if (found != robots_.end()) found->second.stale = true;
  }
}

void RunModel::hear(const bus::RosterEntry& entry) {
  Process& process = process_of(entry.writer);
  if (!process.introduced) process.host = entry.host;
  const auto known = process.roster.find(entry.robot);
  if (known == process.roster.end()) {
    if (described_ >= kMostRobots) forget_rosters_of_the_gone(entry.writer);
    if (described_ >= kMostRobots) return;
    ++described_;
  }
  process.roster[entry.robot] = {entry.name, entry.team, entry.kind != rave_wire_ROBOT_REAL,
                                 entry.driver};
}

void RunModel::forget_rosters_of_the_gone(std::uint64_t but) {
  for (auto& [writer, process] : processes_) {
    if (!process.gone || writer == but) continue;
    described_ -= process.roster.size();
    process.roster.clear();
  }
}

void RunModel::lose(std::uint64_t writer) {
  const auto found = processes_.find(writer);
  if (found != processes_.end()) found->second.gone = true;
}

std::vector<KeptAt> RunModel::kept() const {
  std::vector<KeptAt> kept;
  std::set<KeptAt> known;
  const auto add = [&](KeptAt one) {
    if (!one.folder.empty() && known.insert(one).second) kept.push_back(std::move(one));
  };
  for (const auto& [writer, process] : processes_) {
    add({process.name, process.host == rave_wire_kNone, process.machine, process.folder});
    if (!process.word) continue;
    const auto told = process.word->hosts.find(rave_wire_kNone);
    if (told == process.word->hosts.end()) continue;
    add({told->second.name, true, told->second.machine, told->second.folder});
  }
  std::ranges::stable_sort(kept, [](const KeptAt& a, const KeptAt& b) {
    return std::tie(b.manager, a.name) < std::tie(a.manager, b.name);
  });
  return kept;
}

}  // namespace rave::watch
