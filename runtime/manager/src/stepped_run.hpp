// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host_slots.hpp"
#include "manager_run.hpp"
#include "rave/manager/manager.hpp"
#include "rave/pace/lateness.hpp"
#include "rave/sim/world_authority.hpp"
#include "roster_book.hpp"
#include "stepped_endpoint.hpp"
#include "world_requests.hpp"

namespace rave::manager {

/// One run in lock-step, from the first report to the last step. Belongs to one thread.
class SteppedRun final : ManagerRun {
 public:
  /// `options` are not owned.
  SteppedRun(const ManagerOptions& options, std::unique_ptr<sim::WorldAuthority> authority,
             std::unique_ptr<SteppedEndpoint> bus);

  [[nodiscard]] Result<ManagerOutcome> go();
  /// Ends a run that cannot continue: tells all processes why, unless another manager has it.
  void give_up(const Error& error);

 private:
  enum class Gathered : std::uint8_t { kAll, kStopped };

  Result<Gathered> gather();
  Status listen();
  Status look();
  void look_at_roster();
  void miss(std::uint64_t writer);
  void see_end(bool awaits_host_results);
  Status hear(const bus::HostReport& message);
  Status refuse_ahead(const HostSlot& slot, const bus::HostReport& message);
  void count_newest();
  Status claim_slot(HostSlot& slot, const bus::HostReport& message);
  void lose(HostSlot& slot, std::string_view why);
  void miss_steps(HostSlot& slot);
  void look_at_clock(std::chrono::steady_clock::time_point since);
  Status leave_alone(const bus::HostReport& message);
  Status take_over();
  Status make_step();
  void tell_of_the_scenario();
  [[nodiscard]] std::chrono::steady_clock::time_point due_of(std::uint64_t step) const;
  void wait_for_turn();
  void hold();
  Status resend();
  [[nodiscard]] runtime::RunStatus first_status() const;
  void tell_state(rave_wire_RunPhase phase, std::string_view text);
  void tell_progress(std::string waiting);
  void note_waiting(std::string hosts);
  [[nodiscard]] std::string waited_for() const;
  [[nodiscard]] bool complete() const;
  [[nodiscard]] std::string why_ended() const;
  ManagerOutcome outcome();

  const ManagerOptions& options_;
  std::unique_ptr<sim::WorldAuthority> authority_;
  std::unique_ptr<SteppedEndpoint> bus_;
  std::vector<HostSlot> slots_;
  sim::HostReport heard_;  ///< The report being read, before it is accepted.
  WorldRequests requests_;
  bus::HostClaims claims_;
  RosterBook roster_;
  std::uint64_t step_ = 0;  ///< The step whose reports are gathered.
  bool lost_any_ = false;
  bool ending_ = false;
  bool ended_by_hand_ = false;
  bool over_ = false;  ///< The run has ended or was given up; later messages do not matter.
  bool left_alone_ =
      false;  ///< The hosts are in another run, which this manager does not continue.
  sim::WorldStep world_;
  sim::AuthorityState state_;
  bool handed_over_ = false;  ///< `world_` and `state_` are those of the previous manager.
  std::uint64_t newest_report_ = 0;
  std::string waits_for_;  ///< What status requests were told that the run waits for.
  std::chrono::steady_clock::time_point began_;
  std::chrono::steady_clock::time_point ended_;
  std::uint64_t first_step_ = 0;
  runtime::Lateness lateness_;
  sim::PhaseTimes resolved_{};  ///< Times of the authority, which has one of the phases.
  std::chrono::steady_clock::time_point next_progress_;
  std::chrono::steady_clock::time_point next_roster_;
  std::chrono::steady_clock::time_point resend_at_;
  bool asked_again_ = false;
  bool newcomer_ = false;  ///< A host has joined that needs all obstacles.
  std::optional<Error> failure_;
};

}  // namespace rave::manager
