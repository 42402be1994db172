// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edit_limits.hpp"
#include "live_hosts.hpp"
#include "rave/manager/live_manager.hpp"
#include "rave/sim/world_authority.hpp"

namespace rave::manager {

/// The obstacles of a run in real time: makes the changes of the scenario when they are due and
/// those by hand at once, sends them to all hosts, and measures when the robots of all hosts sense
/// them. Belongs to one thread.
class LiveEdits {
 public:
  /// Neither `options` nor `hosts` is owned. Errors: kInvalidArgument (the scenario).
  [[nodiscard]] static Result<std::unique_ptr<LiveEdits>> create(sim::EngineSpec spec,
                                                                 const LiveManagerOptions& options,
                                                                 LiveHosts& hosts);
  LiveEdits(const LiveEdits&) = delete;
  LiveEdits& operator=(const LiveEdits&) = delete;
  ~LiveEdits() { end(); }

  /// Begins: the run has a time, and requests are accepted from here on. `takes_over`: the run
  /// began under an earlier manager, and what hosts hand over counts.
  void begin(bool takes_over);
  /// Makes the changes that are due, and answers requests that are complete.
  Status look(SimTime now);
  void end();
  /// The world, including added obstacles.
  [[nodiscard]] const world::WorldModel& world() const { return authority_->world(); }

  /// The last revision that hosts must have received before they begin; while this manager takes
  /// over, the newest that any host has.
  [[nodiscard]] std::uint64_t revision() const noexcept {
    return takes_over_ ? hosts_.shown_revision() : published_;
  }
  /// Changes of the scenario that could not be made.
  [[nodiscard]] const std::vector<sim::Event>& refused() const noexcept { return refused_; }
  /// Statistics of changes by hand.
  [[nodiscard]] const LiveManagerOutcome::Edits& edits() const noexcept { return edits_; }

 private:
  struct Waiting {
    runtime::RunControl::Asked asked;
    std::uint64_t revision = 0;
    SimTime since;  ///< Time of the request.
    std::string text;
  };

  LiveEdits(const LiveManagerOptions& options, LiveHosts& hosts,
            std::unique_ptr<sim::WorldAuthority> authority)
      : options_(options), hosts_(hosts), authority_(std::move(authority)) {}
  Status gather_handed();
  [[nodiscard]] bool all_may_be_there() const;
  [[nodiscard]] bool handed_over() const;
  Status take_over(SimTime now);
  void drop_orphans();
  Status publish(const real_time::ObstacleSight& sight);
  void make_scheduled(SimTime now);
  void serve(runtime::RunControl::Asked asked, SimTime now);
  Result<std::string> edit(const request::Request& request, SimTime now);
  Result<std::string> make(const sim::ObstacleChange& change, SimTime now);
  void note(const sim::ObstacleChange& made);
  void place_robots(SimTime now);
  void follow_hand_overs();
  void answer_waiting(SimTime now);
  [[nodiscard]] std::vector<std::string_view> hosts_without(std::uint64_t revision) const;

  const LiveManagerOptions& options_;
  LiveHosts& hosts_;
  std::unique_ptr<sim::WorldAuthority> authority_;
  bool begun_ = false;
  bool serves_ = false;
  bool takes_over_ = false;  ///< The hand-over is not complete yet.
  std::chrono::steady_clock::time_point began_{};
  std::uint64_t revision_ = 0;  ///< Revision of the last change, by this manager or an earlier one.
  std::uint64_t published_ = 0;  ///< Revision of the last change that this manager has sent.
  std::size_t next_scheduled_ = 0;
  std::map<std::uint32_t, real_time::ObstacleSight>
      obstacles_;  ///< Obstacles that differ from the start.
  EditLimits limits_;
  std::vector<Waiting> waiting_;
  LiveManagerOutcome::Edits edits_;
  std::vector<sim::Event> refused_;
};

}  // namespace rave::manager
