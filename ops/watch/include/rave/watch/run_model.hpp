// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "rave/bus/topics.hpp"
#include "rave/watch/run_view.hpp"

namespace rave::watch {

/// How often something happens, by readings of a number that counts it. One owner thread.
class Rate {
 public:
  /// Readings of the last so many seconds count.
  static constexpr double kWindow_s = 5;

  /// No two readings are kept that are nearer than this but the last: more would cost memory and
  /// say nothing new.
  static constexpr std::int64_t kApart_ns = 100'000'000;

  /// A number below the one before begins anew.
  void add(std::int64_t now_ns, double count);
  /// Per second; nothing before the second reading. Falls when no readings come.
  [[nodiscard]] std::optional<double> at(std::int64_t now_ns) const;
  /// How many readings are kept.
  [[nodiscard]] std::size_t kept() const noexcept { return readings_.size(); }

 private:
  struct Reading {
    std::int64_t at_ns;
    double count;
  };
  std::deque<Reading> readings_;
};

/// What an onlooker makes of the messages of one run. Moments are nanoseconds of one monotonic
/// clock of the caller and do not go back. Samples must have passed bus::validate(). Holds what a
/// table, a page or a window shows, and knows no bus. One owner thread.
class RunModel {
 public:
  explicit RunModel(std::string run) : run_(std::move(run)) {}

  /// A sample that has come. `delay_ns`: how long it was on its way, as the clocks of day say.
  void hear(const bus::HostInfo& info);
  void hear(const bus::RunState& state, std::int64_t now_ns);
  void hear(const bus::ProcessState& state, std::int64_t now_ns, std::int64_t delay_ns);
  void hear(const bus::HostState& state, std::int64_t now_ns, std::int64_t delay_ns);
  void hear(const bus::World& world, std::int64_t now_ns);
  void hear(const bus::RosterEntry& entry);
  /// A process is gone.
  void lose(std::uint64_t writer);

  /// Whether anything is known but the run's number.
  [[nodiscard]] bool knows_any() const noexcept {
    return !processes_.empty() || state_.has_value();
  }
  [[nodiscard]] RunView view(std::int64_t now_ns, bool with_robots) const;

 private:
  /// A robot as its host describes it.
  struct Described {
    std::string name;
    std::string team;
    bool simulated = true;
  };
  /// One start of one process.
  struct Process {
    bool introduced = false;
    bool gone = false;
    std::uint64_t order = 0;  ///< Counts processes as they are heard of.
    std::uint32_t host = 0;   ///< kNone: the manager.
    std::string name;
    std::string machine;
    bool real_time = false;
    std::uint32_t robots = 0;
    std::optional<bus::ProcessState> state;  ///< Its last.
    std::optional<std::int64_t> heard_ns;    ///< Of `state`.
    std::optional<double> cores;
    std::int64_t cores_from_ns = 0;  ///< What its `cores` are counted from: when it came,
    std::int64_t cores_from = 0;     ///< and the time of cores that it said.
    std::optional<std::int64_t> delay_ns;
    std::uint64_t lost = 0;
    Rate steps;
    Rate reports;  ///< Of all its robots together.
    double reported = 0;
    std::optional<std::int64_t> newest_stamp_ns;
    std::optional<std::int64_t> reported_ns;    ///< When its last report came.
    std::optional<std::int64_t> moved_ns;       ///< When it was in a new step.
    std::map<std::uint32_t, Described> roster;  ///< Its robots, by number.
  };
  /// A robot that was said to be somewhere.
  struct Robot {
    std::uint32_t host = 0;  ///< If it has `reported`.
    bool stale = false;
    std::uint64_t last_step = 0;
    std::uint64_t least_gap = 0;  ///< Steps between two reports; 0: not known.
    Rate reports;
    double reported = 0;
    std::optional<std::int64_t> stamp_ns;
    std::optional<std::int64_t> heard_ns;
    double x_m = 0, y_m = 0, yaw_rad = 0, speed_mps = 0;
  };
  /// What the manager says of a host.
  struct Sight {
    std::string name;
    rave_wire_HostPhase phase{};
    std::uint32_t robots = 0;
    std::uint64_t step = 0;
    double offset_s = 0;
    double bound_s = -1;
  };
  struct State {
    std::uint64_t writer = 0;
    std::string scenario;
    rave_wire_RunPhase phase{};
    std::uint64_t step = 0;
    std::uint64_t steps = 0;
    double step_s = 0;
    double speed = 0;
    std::string text;
    std::map<std::uint32_t, Sight> hosts;
  };

  /// Who describes a robot.
  struct Told {
    std::uint32_t host = 0;
    const Described* robot = nullptr;
  };

  Process& process_of(std::uint64_t writer);
  /// By number of the robot: what those say that serve the hosts.
  [[nodiscard]] std::map<std::uint32_t, Told> roster(const std::set<std::uint32_t>& hosts) const;
  void tell_robots(const std::set<std::uint32_t>& hosts, RunView& view, std::int64_t now_ns) const;
  static void count_cores(Process& process, const bus::ProcessState& state, std::int64_t now_ns);
  void place(const rave_wire_PlanarRobots& robots, std::size_t i, std::int64_t now_ns);
  [[nodiscard]] const Process* speaker_of(std::uint32_t host) const;
  [[nodiscard]] bool manager_here() const;
  [[nodiscard]] Standing standing_of(const Process* process, const Sight* sight,
                                     std::int64_t now_ns) const;
  [[nodiscard]] std::optional<std::int64_t> run_ns(std::int64_t now_ns) const;
  [[nodiscard]] Timing timing() const;
  void tell_process(const Process& process, HostView& view, std::int64_t now_ns) const;
  void tell_reports(std::uint32_t host, const Process& process, HostView& view,
                    std::int64_t now_ns) const;
  [[nodiscard]] HostView manager_view(const Process& process, std::int64_t now_ns) const;
  [[nodiscard]] HostView host_view(std::uint32_t host, std::int64_t now_ns) const;
  [[nodiscard]] RobotView robot_view(const Robot& robot, std::int64_t now_ns) const;
  [[nodiscard]] std::string name_of(std::uint32_t host) const;
  [[nodiscard]] std::optional<double> asked_of(const Robot& robot) const;
  void tell_run(RunView& view, std::int64_t now_ns) const;

  std::string run_;
  std::map<std::uint64_t, Process> processes_;  ///< By writer.
  std::uint64_t arrivals_ = 0;
  /// Makes room for those who come; `but`: a process that is not to be forgotten.
  void forget_rosters_of_the_gone(std::uint64_t but);

  std::size_t described_ = 0;  ///< Robots, of all processes.
  std::optional<State> state_;
  Rate run_steps_;
  std::map<std::uint32_t, Robot> robots_;  ///< By number.
  struct Worlds {
    std::uint64_t writer = 0;
    std::uint64_t number = 0;
    std::int64_t time_ns = 0;
    std::int64_t heard_ns = 0;
    std::uint64_t lost = 0;
    Rate rate;
  };
  std::optional<Worlds> worlds_;
};

}  // namespace rave::watch
