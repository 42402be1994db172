// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/topics.hpp"
#include "rave/protocol/host_results.hpp"
#include "roster_book.hpp"

namespace rave::manager {

/// The endpoint of a manager, as far as lock-step and real time are alike: which processes are
/// present and fit, the rosters and results of hosts, requests, and the state of the run.
/// BusEndpoint is the real one; tests use others. Belongs to one thread.
class ManagerEndpoint {
 public:
  virtual ~ManagerEndpoint() = default;

  /// Begins the requests that arrived on the bus, and answers those that are complete.
  virtual void serve_requests() = 0;
  /// Updates the present processes and returns those that have left; such a process is unknown
  /// until it introduces itself again. Before the run has `begun`, this manager gives way to one
  /// that started earlier. Errors: kState (there is one).
  [[nodiscard]] virtual Result<std::vector<std::uint64_t>> look_at_processes(bool begun) = 0;
  /// Whether the error was that the run belongs to another manager.
  [[nodiscard]] virtual bool is_second() const = 0;
  /// The host that a process serves; empty: it has not introduced itself, or does not fit.
  [[nodiscard]] virtual std::optional<std::uint32_t> host_of(std::uint64_t writer) const = 0;
  /// Receives the rosters of hosts.
  virtual void take_roster(RosterBook& book, const Serving& serving) = 0;
  /// Receives the results of hosts at the end, from processes that have `served` the slot of their
  /// host.
  virtual void take_host_results(
      const std::function<bool(std::uint64_t, std::uint32_t)>& served) = 0;
  /// Whether a process has not sent its results yet.
  [[nodiscard]] virtual bool owes_host_results(std::uint64_t writer) const = 0;
  /// All results that were received; each is returned once.
  [[nodiscard]] virtual std::vector<lock_step::HostResults> hand_out_host_results() = 0;
  virtual void publish(bus::RunState& state) = 0;

  /// What its messages are signed with.
  [[nodiscard]] virtual std::uint64_t writer() const = 0;
  /// Silence before this time proves nothing: this process stood still (bus::Standstill).
  [[nodiscard]] virtual std::chrono::steady_clock::time_point silence_counts_from() const = 0;
  /// How often this process stood still in a begun run for so long that others may have taken it
  /// for lost.
  [[nodiscard]] virtual std::uint64_t standstills() const = 0;
  /// Logs what another process has done wrong, with a limited rate.
  virtual void log_fault(std::string_view text) = 0;
};

}  // namespace rave::manager
