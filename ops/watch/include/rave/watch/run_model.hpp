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

/// The rate of events, from readings of a counter. One owner thread.
class Rate {
 public:
  /// Length of the averaging window in seconds.
  static constexpr double kWindow_s = 5;

  /// Least distance of kept readings, except for the newest; bounds the memory.
  static constexpr std::int64_t kApart_ns = 100'000'000;

  /// Adds a reading. A count below the previous one restarts the measurement.
  void add(std::int64_t now_ns, double count);
  /// Events per second; empty before the second reading. Decreases when no readings are added.
  [[nodiscard]] std::optional<double> at(std::int64_t now_ns) const;
  /// The number of kept readings.
  [[nodiscard]] std::size_t kept() const noexcept { return readings_.size(); }

 private:
  struct Reading {
    std::int64_t at_ns;
    double count;
  };
  std::deque<Reading> readings_;
};

/// The state of a run, derived from its messages by a monitor, for a table, a page or a window.
/// Independent of the bus. Times are nanoseconds of one monotonic clock of the caller and must not
/// decrease. Samples must have passed bus::validate(). One owner thread.
class RunModel {
 public:
  explicit RunModel(std::string run) : run_(std::move(run)) {}

  /// Processes a sample. `delay_ns`: its delay according to the system clocks.
  void hear(const bus::HostInfo& info);
  void hear(const bus::RunState& state, std::int64_t now_ns);
  /// Processes the run state of a host, which is used while there is no manager.
  void hear_word(const bus::RunState& state, std::int64_t now_ns);
  void hear(const bus::ProcessState& state, std::int64_t now_ns, std::int64_t delay_ns);
  void hear(const bus::HostState& state, std::int64_t now_ns, std::int64_t delay_ns);
  void hear(const bus::World& world, std::int64_t now_ns);
  void hear(const bus::RosterEntry& entry);
  /// A process was lost.
  void lose(std::uint64_t writer);

  /// Whether anything is known besides the run's number.
  [[nodiscard]] bool knows_any() const noexcept {
    return !processes_.empty() || state_.has_value();
  }
  [[nodiscard]] RunView view(std::int64_t now_ns, bool with_robots) const;
  /// The recordings of all processes that were ever seen: of managers first, then by name.
  [[nodiscard]] std::vector<KeptAt> kept() const;

 private:
  /// A robot according to its host.
  struct Described {
    std::string name;
    std::string team;
    bool simulated = true;
    std::string driver{};
  };
  /// A host according to the manager, or the manager according to a host.
  using Sight = rave_wire_HostSight;
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

  /// One execution of one process.
  struct Process {
    bool introduced = false;
    bool gone = false;
    std::uint64_t order = 0;  ///< Order in which processes were found.
    std::uint32_t host = 0;   ///< kNone: the manager.
    std::string name;
    std::string machine;
    std::string folder;  ///< With its recording; empty: it makes none.
    bool real_time = false;
    std::uint32_t robots = 0;
    std::optional<bus::ProcessState> state;  ///< Its last one.
    std::optional<std::int64_t> heard_ns;    ///< When `state` was received.
    std::optional<double> cores;
    std::int64_t cores_from_ns = 0;  ///< Start of the measurement of `cores`: time ...
    std::int64_t cores_from = 0;     ///< ... and CPU time at that moment.
    std::optional<std::int64_t> delay_ns;
    std::uint64_t lost = 0;
    Rate steps;
    Rate reports;  ///< Of all its robots together.
    double reported = 0;
    std::optional<std::int64_t> newest_stamp_ns;
    std::optional<std::int64_t> reported_ns;    ///< When its last report was received.
    std::optional<std::int64_t> moved_ns;       ///< When it last began a new step.
    std::map<std::uint32_t, Described> roster;  ///< Its robots, by id.
    std::optional<State> word;                  ///< Its run state, if it is a host.
  };
  /// A robot with a known pose.
  struct Robot {
    std::uint32_t host = 0;  ///< Its host, if `reported` is above 0.
    bool stale = false;
    std::uint64_t last_step = 0;
    std::uint64_t least_gap = 0;  ///< Steps between two reports; 0: unknown.
    Rate reports;
    double reported = 0;
    std::optional<std::int64_t> stamp_ns;
    std::optional<std::int64_t> heard_ns;
    double x_m = 0, y_m = 0, yaw_rad = 0, speed_mps = 0;
    std::optional<RobotReport> report;
  };
  /// A robot's description and the host that sent it.
  struct Told {
    std::uint32_t host = 0;
    const Described* robot = nullptr;
  };

  Process& process_of(std::uint64_t writer);
  /// By id of the robot: the descriptions of those that serve the hosts.
  [[nodiscard]] std::map<std::uint32_t, Told> roster(const std::set<std::uint32_t>& hosts) const;
  void tell_robots(const std::set<std::uint32_t>& hosts, RunView& view, std::int64_t now_ns) const;
  static void count_cores(Process& process, const bus::ProcessState& state, std::int64_t now_ns);
  void place(const rave_wire_PlanarRobots& robots, std::size_t i, std::int64_t now_ns);
  void note_reports(const rave_wire_RobotReports& reports);
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
  /// The run states of the hosts that are present.
  struct Words {
    const State* farthest = nullptr;  ///< Null: none.
    const State* waiting = nullptr;
    const State* over = nullptr;
    bool here = false;  ///< A host continues the run.
    bool manager_lost = false;
    std::optional<std::int64_t> newest_ns;  ///< Stamp of a robot.
  };
  [[nodiscard]] Words words() const;
  void tell_words(RunView& view) const;
  [[nodiscard]] std::optional<HostView> manager_by_words() const;
  [[nodiscard]] static State read(const bus::RunState& state);

  std::string run_;
  std::map<std::uint64_t, Process> processes_;  ///< By writer.
  std::uint64_t arrivals_ = 0;
  /// Forgets descriptions of lost processes to make room; `but`: a process to keep.
  void forget_rosters_of_the_gone(std::uint64_t but);

  std::size_t described_ = 0;  ///< Number of described robots, of all processes.
  std::optional<State> state_;
  Rate run_steps_;
  std::map<std::uint32_t, Robot> robots_;  ///< By id.
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
