// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rave::watch {

/// How it stands with a process of a run.
enum class Standing : std::uint8_t {
  kWaiting,  ///< It has not come yet, or is not let in yet.
  kHere,
  kLate,     ///< It is there, but has not said anything for too long.
  kGone,     ///< It was there.
  kDropped,  ///< It was there, and the run goes on without it for good.
};

enum class Phase : std::uint8_t { kUnknown, kGathers, kGoes, kWaits, kPaused, kEnded, kFailed };

enum class Timing : std::uint8_t {
  kUnknown,
  kLockStep,
  kRealTime,
  kAlone,  ///< One process; known through its control socket.
};

/// One word in lower case each, as in tables and JSON.
[[nodiscard]] std::string_view to_string(Standing standing) noexcept;
[[nodiscard]] std::string_view to_string(Phase phase) noexcept;
[[nodiscard]] std::string_view to_string(Timing timing) noexcept;

/// A process of a run as an onlooker knows it. What is not known is nothing.
struct HostView {
  std::string name;
  bool manager = false;
  std::uint32_t number = 0;  ///< Of the host in the scenario; not of the manager.
  std::string machine;
  Standing standing = Standing::kWaiting;
  std::optional<std::uint32_t> process;  ///< As its machine numbers it.
  std::optional<std::uint32_t> robots;
  std::optional<std::uint32_t> real_robots;  ///< Of these.
  std::optional<std::uint64_t> step;
  /// In lock-step and alone: steps per second. In real time: reports per second and robot; of the
  /// manager, worlds per second.
  std::optional<double> rate_hz;
  std::optional<double> asked_rate_hz;  ///< What its files want; in real time only.
  std::optional<double> age_s;    ///< Of the newest place of a robot; in lock-step: of its step.
  std::optional<double> delay_s;  ///< From it to here, by the clocks of day of both machines.
  std::optional<double> round_trip_s;    ///< To the manager and back.
  std::optional<double> offset_s;        ///< Clock of the manager minus its own.
  std::optional<double> bound_s;         ///< Give or take this.
  std::optional<std::uint64_t> lost;     ///< Messages that never came: from it to here, or to it.
  std::optional<std::uint64_t> refused;  ///< Samples that it could not use.
  std::optional<double> missed_pct;      ///< Share of its deadlines that it missed, if it has any.
  std::optional<double> worst_late_s;    ///< How late a step was at most.
  std::optional<double> behind_s;        ///< How late its last step was.
  std::string late_phase;                ///< What takes the time of late steps; empty: nothing.
  std::optional<double> cores;           ///< That it keeps busy.
  std::optional<double> memory_mb;       ///< Resident, 10^6 bytes.
};

struct RobotView {
  std::uint32_t number = 0;
  std::string name;  ///< Empty if nobody has said it.
  std::string team;  ///< The same; a robot need not have one.
  std::string host;  ///< The same.
  std::optional<bool> simulated;
  bool stale = false;
  std::optional<double> age_s;
  std::optional<double> rate_hz;  ///< Reports per second.
  std::optional<double> asked_rate_hz;
  std::optional<double> x_m, y_m, yaw_rad;  ///< World frame.
  std::optional<double> speed_mps;          ///< Forward positive.
};

/// A run as an onlooker knows it at one moment. A value.
struct RunView {
  std::string run;       ///< 32 hexadecimal digits, or the name at the control socket.
  std::string scenario;  ///< Empty if nobody has said it.
  Timing timing = Timing::kUnknown;
  Phase phase = Phase::kUnknown;
  std::string text;  ///< What it waits for, or why it failed.
  std::optional<std::uint64_t> step;
  std::optional<std::uint64_t> steps;  ///< In all.
  std::optional<double> time_s;        ///< Of the run.
  std::optional<double> duration_s;
  std::optional<double> speed;    ///< Simulated seconds per second.
  std::vector<HostView> hosts;    ///< The manager first, then by number.
  std::vector<RobotView> robots;  ///< Stale ones and the oldest first; empty unless asked for.
};

/// The view as one line of JSON with a newline at its end; docs/how-to/watch-a-run.md has its keys.
[[nodiscard]] std::string to_json(const RunView& view);

}  // namespace rave::watch
