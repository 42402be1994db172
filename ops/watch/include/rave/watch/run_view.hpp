// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rave::watch {

/// The state of a process of a run.
enum class Standing : std::uint8_t {
  kWaiting,  ///< Not present yet, or not admitted yet.
  kHere,
  kLate,     ///< Present, but silent for too long.
  kGone,     ///< It has left.
  kDropped,  ///< It has left, and the run continues without it permanently.
};

enum class Phase : std::uint8_t {
  kUnknown,
  kGathering,
  kRunning,
  kWaits,
  kPaused,
  kEnded,
  kFailed
};

enum class Timing : std::uint8_t {
  kUnknown,
  kLockStep,
  kRealTime,
  kAlone,  ///< One process, known through its control socket.
};

/// The names in lower case, as in tables and JSON.
[[nodiscard]] std::string_view to_string(Standing standing) noexcept;
[[nodiscard]] std::string_view to_string(Phase phase) noexcept;
[[nodiscard]] std::string_view to_string(Timing timing) noexcept;

/// A process of a run as a monitor knows it. Unknown values are empty.
struct HostView {
  std::string name;
  bool manager = false;
  std::uint32_t number = 0;  ///< Number of the host in the scenario; unused for the manager.
  std::string machine;
  Standing standing = Standing::kWaiting;
  std::optional<std::uint32_t> process;  ///< Process id on its machine.
  std::optional<std::uint32_t> robots;
  std::optional<std::uint32_t> real_robots;  ///< Number of real ones among them.
  std::optional<std::uint64_t> step;
  /// In lock-step and alone: steps per second. In real time: reports per second and robot; for the
  /// manager, worlds per second.
  std::optional<double> rate_hz;
  std::optional<double> asked_rate_hz;  ///< Rate according to its files; real time only.
  std::optional<double> age_s;    ///< Age of the newest pose of a robot; in lock-step: of its step.
  std::optional<double> delay_s;  ///< Delay from it to here, by the system clocks of both machines.
  std::optional<double> round_trip_s;    ///< Round-trip time to the manager.
  std::optional<double> offset_s;        ///< Clock of the manager minus its own.
  std::optional<double> bound_s;         ///< Bound of the error of offset_s.
  std::optional<std::uint64_t> lost;     ///< Messages lost on the way from it to here, or to it.
  std::optional<std::uint64_t> refused;  ///< Samples that it refused.
  std::optional<double> missed_pct;      ///< Percentage of missed deadlines, if it has any.
  std::optional<double> worst_late_s;    ///< Largest delay of a step.
  std::optional<double> behind_s;        ///< Delay of its last step.
  std::string late_phase;                ///< Phase that causes late steps; empty: none.
  std::optional<double> cores;           ///< Mean number of busy processor cores.
  std::optional<double> memory_mb;       ///< Resident, 10^6 bytes.
};

/// The state of a robot according to its host.
struct RobotReport {
  double x_m = 0, y_m = 0, yaw_rad = 0;  ///< World frame.
  double variance_xy_m2 = 0;             ///< Variance of x and of y.
  double variance_yaw_rad2 = 0;
  bool known = false;  ///< It has a pose.
  bool stale = false;
  bool stopped = false;
  bool armed = true;
  bool real = false;
  bool touches = false;
};

struct RobotView {
  std::uint32_t number = 0;
  std::string name;    ///< Empty if unknown.
  std::string team;    ///< Empty if unknown or without a team.
  std::string host;    ///< Empty if unknown.
  std::string driver;  ///< Who has its command lease; empty if no person does.
  std::optional<bool> simulated;
  bool stale = false;
  std::optional<double> age_s;
  std::optional<double> rate_hz;  ///< Reports per second.
  std::optional<double> asked_rate_hz;
  std::optional<double> x_m, y_m, yaw_rad;  ///< World frame.
  std::optional<double> speed_mps;          ///< Forward positive.
  /// Only if its host publishes it: always in lock-step, on request in real time.
  std::optional<RobotReport> report;
};

/// Where a process of a run leaves its recording. A process that came back has one for each start.
struct KeptAt {
  std::string name;
  bool manager = false;
  std::string machine;
  std::string folder;  ///< Absolute, on that machine.
  friend auto operator<=>(const KeptAt&, const KeptAt&) = default;
};

/// A run as a monitor knows it at one time. A value.
struct RunView {
  std::string run;       ///< 32 hexadecimal digits, or the name at the control socket.
  std::string scenario;  ///< Empty if unknown.
  Timing timing = Timing::kUnknown;
  Phase phase = Phase::kUnknown;
  std::string text;  ///< What it waits for, or why it failed.
  std::optional<std::uint64_t> step;
  std::optional<std::uint64_t> steps;  ///< Total number.
  std::optional<double> time_s;        ///< Time of the run.
  std::optional<double> duration_s;
  std::optional<double> speed;  ///< Simulated seconds per second.
  std::vector<HostView> hosts;  ///< The manager first, then by number.
  /// Stale ones and those with the oldest data first; empty unless requested.
  std::vector<RobotView> robots;
};

/// The view as one line of JSON with a newline; docs/how-to/watch-a-run.md lists its keys.
[[nodiscard]] std::string to_json(const RunView& view);

}  // namespace rave::watch
