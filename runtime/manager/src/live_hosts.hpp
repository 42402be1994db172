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

/// The slot of one host of a run in real time, whichever process serves it.
struct LiveSlot {
  std::string name;
  std::string command{};  ///< Command that restarts it; empty: none is needed.
  std::uint32_t robots = 0;
  std::uint32_t real = 0;    ///< Number of real robots among them.
  std::uint64_t writer = 0;  ///< The process that serves it; 0: none.
  bool heard = false;        ///< A process has served it at some time.
  /// All processes that have served it, in the order of their first time.
  std::vector<std::uint64_t> served_by{};
  std::uint64_t losses = 0;
  std::uint64_t last_step = 0;
  StepRate steps{};
  std::int64_t offset_ns = 0;  ///< Clock of the manager minus its own, as the host measures it.
  std::int64_t bound_ns = -1;
  std::uint64_t obstacle_revision = 0;  ///< Newest obstacle revision that its robots sense,
  std::int64_t obstacles_ns = 0;        ///< since then.
};

/// What a manager in real time knows of hosts and robots, and its endpoint on the bus. Belongs to
/// one thread.
class LiveHosts {
 public:
  /// `options` must outlive it. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<LiveHosts>> open(const LiveManagerOptions& options);
  /// The same with an existing endpoint; for tests.
  LiveHosts(const LiveManagerOptions& options, std::unique_ptr<LiveEndpoint> endpoint);

  /// Sleeps until a message arrives, the time has passed or `stop` is set.
  void wait(Duration timeout, const std::stop_token& stop = {}) { endpoint_->wait(timeout, stop); }
  /// The part of the endpoint that both kinds of run share.
  [[nodiscard]] ManagerEndpoint& endpoint() noexcept { return endpoint_->common(); }
  /// Learns which processes are present and which have left; leaving counts as a loss while
  /// the run is `running`. Errors: kState (another manager).
  Status look_at_processes(bool running);
  void take_pings(const std::function<void(const bus::ClockPing&)>& visit) {
    endpoint_->take_pings(visit);
  }
  /// Whether a process that asks for the time serves its host. It takes the slot now if that is
  /// free.
  bool claim_slot(const bus::ClockPing& ping);
  void answer(bus::ClockPong& pong) { endpoint_->answer(pong); }
  /// Receives the poses that hosts report for their robots.
  void take_states();
  /// Simulated seconds per second of the slowest present host; 0: no host, or unknown.
  [[nodiscard]] double slowest_speed() const;
  /// Receives the rosters of hosts and passes them to status requests. `control` has begun, or is
  /// null.
  void take_roster(runtime::RunControl* control);
  /// News since the last call of robots with two sets of drivers.
  [[nodiscard]] std::vector<real_time::RobotReality> take_realities();
  /// Time without a report after which the robot is stale with its present drivers.
  [[nodiscard]] Duration staleness(std::size_t robot) const { return staleness_[robot]; }
  /// Sends the last reported poses of all robots. `stale`: by robot.
  void send_world(std::uint64_t number, SimTime now, std::span<const std::uint8_t> stale);
  /// Publishes the state of the run and of its hosts.
  void publish(const lock_step::RunReport& report);

  [[nodiscard]] const std::vector<LiveSlot>& slots() const noexcept { return slots_; }
  /// Time of the last reported pose of a robot; empty before the first.
  [[nodiscard]] std::optional<SimTime> stamp_of(std::size_t robot) const noexcept {
    if (!known_[robot]) return std::nullopt;
    return robots_[robot].stamp;
  }
  /// The last report of a robot; null before the first.
  [[nodiscard]] const real_time::RobotSight* sight_of(std::size_t robot) const noexcept {
    return known_[robot] ? &robots_[robot] : nullptr;
  }
  /// Sends the state of an obstacle to all hosts, also to those that join later. Errors:
  /// kInvalidArgument (larger than the bus carries), kIo.
  Status publish(const real_time::ObstacleSight& sight);
  /// Asks the present hosts for the obstacles that the previous manager had published; again if
  /// others have joined since the last call. Errors: kState, kIo.
  Status ask_for_handed();
  /// Receives the answers of processes that fit. `check` refuses impossible ones; a process that
  /// sends such an answer is named once in the log.
  void take_handed(const std::function<Status(const real_time::ObstacleSight&)>& check);
  /// Ends the hand-over and forgets what was received.
  void end_handing();
  /// All obstacles that were handed over, by id.
  [[nodiscard]] const std::map<std::uint32_t, real_time::ObstacleSight>& handed_obstacles()
      const noexcept {
    return handed_;
  }
  /// The newest obstacle revision that any host reports.
  [[nodiscard]] std::uint64_t shown_revision() const noexcept;
  [[nodiscard]] std::uint64_t states() const noexcept { return states_taken_; }
  /// Whether a host has joined or left since the last call.
  [[nodiscard]] bool take_news() noexcept { return std::exchange(news_, false); }

 private:
  void lose(std::uint64_t writer, bool running);
  void take_in(const bus::HostState& state);
  void refuse_handed(std::uint64_t writer, std::string_view why);

  const LiveManagerOptions& options_;
  std::unique_ptr<LiveEndpoint> endpoint_;
  std::vector<LiveSlot> slots_;
  bus::HostClaims claims_;
  std::set<std::uint64_t> refused_;     ///< Processes whose slot is taken; each is logged once.
  std::vector<std::uint32_t> slot_of_;  ///< By robot.
  std::vector<real_time::RobotSight> robots_;  ///< Last report, by robot.
  std::vector<bool> known_;
  std::vector<std::uint64_t> said_by_;  ///< By robot: the process that reported it last.
  RosterBook book_;
  std::vector<Duration> staleness_;  ///< By robot.
  std::vector<real_time::RobotReality>
      twins_;  ///< Robots with two sets of drivers, as last published.
  real_time::RobotColumns columns_;
  std::vector<std::uint32_t> stale_;
  lock_step::ObstacleParts parts_;
  std::map<std::uint32_t, real_time::ObstacleSight> handed_;
  bool all_asked_ = false;               ///< All present hosts were asked for their obstacles.
  std::set<std::uint64_t> wrong_hands_;  ///< Processes that handed over something impossible.
  std::uint64_t states_taken_ = 0;
  bool news_ = false;
};

}  // namespace rave::manager
