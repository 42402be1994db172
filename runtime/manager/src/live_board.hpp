// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "live_endpoint.hpp"
#include "rave/bus/host_claims.hpp"
#include "rave/manager/live_manager.hpp"
#include "rave/protocol/live_messages.hpp"
#include "rave/protocol/obstacle_messages.hpp"
#include "rave/protocol/realities.hpp"
#include "rave/protocol/run_state.hpp"
#include "step_rate.hpp"

namespace rave::manager {

/// The place of one host of a run in real time, whoever sits in it.
struct LiveSlot {
  std::string name;
  std::string command{};  ///< That starts it again; empty: nobody has to.
  std::uint32_t robots = 0;
  std::uint32_t real = 0;    ///< Of these.
  std::uint64_t writer = 0;  ///< The process; 0: nobody.
  bool heard = false;        ///< Somebody was there.
  /// All that have sat here, in the order of their first times.
  std::vector<std::uint64_t> sat{};
  std::uint64_t losses = 0;
  std::uint64_t last_step = 0;
  StepRate steps{};
  std::int64_t offset_ns = 0;  ///< Our clock minus its own, as it says.
  std::int64_t bound_ns = -1;
  std::uint64_t obstacle_revision = 0;  ///< That it has around its robots,
  std::int64_t obstacles_ns = 0;        ///< since then.
};

/// What a manager in real time knows of hosts and robots, and its end of the bus. Belongs to one
/// thread.
class LiveBoard {
 public:
  /// `options` must outlive it. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<LiveBoard>> open(const LiveManagerOptions& options);
  /// The same with an end of the bus that is there.
  LiveBoard(const LiveManagerOptions& options, std::unique_ptr<LiveEndpoint> endpoint);

  /// Sleeps until something has come, the time is over or `stop` is set.
  void wait(Duration timeout, const std::stop_token& stop = {}) { endpoint_->wait(timeout, stop); }
  /// What it has in common with the managers of other runs.
  [[nodiscard]] ManagerEndpoint& endpoint() noexcept { return endpoint_->common(); }
  /// Learns who is there and who is gone; that counts as a loss if the run `goes`. Errors: kState
  /// (another manager).
  Status look_at_processes(bool goes);
  void take_pings(const std::function<void(const bus::ClockPing&)>& visit) {
    endpoint_->take_pings(visit);
  }
  /// Whether a process that asks for the time sits in its host's place, as it does now if that was
  /// free.
  bool claim_slot(const bus::ClockPing& ping);
  void answer(bus::ClockPong& pong) { endpoint_->answer(pong); }
  /// Takes in where hosts say that their robots are.
  void take_states();
  /// Simulated seconds per second of the slowest host that is there; 0: none is, or nobody knows.
  [[nodiscard]] double slowest_speed() const;
  /// Takes in what hosts say of their robots, and tells it those who ask for the status; `control`
  /// has begun, or is null.
  void take_roster(runtime::RunControl* control);
  /// What hosts have said since the last call of robots with two sets of drivers.
  [[nodiscard]] std::vector<real_time::RobotReality> take_realities();
  /// After which a robot that is not heard of counts as stale, with the drivers that it has.
  [[nodiscard]] Duration staleness(std::size_t robot) const { return staleness_[robot]; }
  /// Sends where all robots are that were heard of. `stale`: by robot.
  void send_world(std::uint64_t number, SimTime now, std::span<const std::uint8_t> stale);
  /// Tells all processes how the run goes, and how it stands with the hosts.
  void publish(const lock_step::RunReport& report);

  [[nodiscard]] const std::vector<LiveSlot>& slots() const noexcept { return slots_; }
  /// When a robot was where it was said to be last; nothing before it was heard of.
  [[nodiscard]] std::optional<SimTime> stamp_of(std::size_t robot) const noexcept {
    if (!known_[robot]) return std::nullopt;
    return robots_[robot].stamp;
  }
  /// The robot as it was heard of last; null before.
  [[nodiscard]] const real_time::RobotSight* sight_of(std::size_t robot) const noexcept {
    return known_[robot] ? &robots_[robot] : nullptr;
  }
  /// Tells all hosts, those that come later too, how an obstacle stands. Errors: kInvalidArgument
  /// (larger than the bus carries), kIo.
  Status publish(const real_time::ObstacleSight& sight);
  /// Takes in what hosts know of the run when it is over for them.
  void take_host_results();
  /// Asks the hosts that sit here what they know of the obstacles of the manager that was here
  /// before; again if others have sat down since the last call. Errors: kState, kIo.
  Status ask_for_handed();
  /// Takes in what has come of that, of processes that fit. `check` says what cannot be; a process
  /// that hands over such is named once in the log.
  void take_handed(const std::function<Status(const real_time::ObstacleSight&)>& check);
  /// Nothing is handed over any more, and what was is forgotten.
  void end_handing();
  /// All that was handed over, by number.
  [[nodiscard]] const std::map<std::uint32_t, real_time::ObstacleSight>& handed_obstacles()
      const noexcept {
    return handed_;
  }
  /// The latest change of obstacles that any host says it has.
  [[nodiscard]] std::uint64_t shown_revision() const noexcept;
  [[nodiscard]] std::uint64_t states() const noexcept { return states_taken_; }
  /// Whether a host has come or gone since the last call.
  [[nodiscard]] bool take_news() noexcept { return std::exchange(news_, false); }

 private:
  void lose(std::uint64_t writer, bool goes);
  void take_in(const bus::HostState& state);
  void refuse_handed(std::uint64_t writer, std::string_view why);

  const LiveManagerOptions& options_;
  std::unique_ptr<LiveEndpoint> endpoint_;
  std::vector<LiveSlot> slots_;
  bus::HostClaims claims_;
  std::set<std::uint64_t> refused_;            ///< Processes whose place is taken; told once.
  std::vector<std::uint32_t> slot_of_;         ///< By robot.
  std::vector<real_time::RobotSight> robots_;  ///< By robot, as heard last.
  std::vector<bool> known_;
  std::vector<std::uint64_t> said_by_;  ///< By robot: the process that spoke of it last.
  RosterBook book_;
  std::vector<Duration> staleness_;             ///< By robot.
  std::vector<real_time::RobotReality> twins_;  ///< Robots with two sets of drivers, as told last.
  real_time::RobotColumns columns_;
  std::vector<std::uint32_t> stale_;
  lock_step::ObstacleParts parts_;
  std::map<std::uint32_t, real_time::ObstacleSight> handed_;
  bool all_asked_ = false;               ///< Who sits here, what it has to hand over.
  std::set<std::uint64_t> wrong_hands_;  ///< Processes that handed over what cannot be.
  std::uint64_t states_taken_ = 0;
  bool news_ = false;
};

}  // namespace rave::manager
