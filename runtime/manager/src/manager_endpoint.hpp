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

/// A manager's end of the bus, as far as it is alike in lock-step and in real time: who is there
/// and fits, what hosts say of their robots and know at the end, requests, the state of the run.
/// BusEndpoint is the real one; tests play others. Belongs to one thread.
class ManagerEndpoint {
 public:
  virtual ~ManagerEndpoint() = default;

  /// Begins what others ask on the bus, and answers what is done.
  virtual void serve_requests() = 0;
  /// Learns who is there; returns the processes that are gone. Before the run has `begun`, this
  /// manager gives way to one that started earlier. Errors: kState (there is one).
  [[nodiscard]] virtual Result<std::vector<std::uint64_t>> look_at_processes(bool begun) = 0;
  /// Whether that error was the reason: the run is another manager's.
  [[nodiscard]] virtual bool is_second() const = 0;
  /// The host that a process said it serves; nothing: it did not say who it is, or does not fit.
  [[nodiscard]] virtual std::optional<std::uint32_t> host_of(std::uint64_t writer) const = 0;
  /// It has to say again who it is.
  virtual void forget(std::uint64_t writer) = 0;
  /// Takes in what hosts say of their robots.
  virtual void take_roster(RosterBook& book, const Serving& serving) = 0;
  /// Takes in what hosts know of the run when it is over for them: of processes that have `sat` in
  /// the place of their host.
  virtual void take_host_results(const std::function<bool(std::uint64_t, std::uint32_t)>& sat) = 0;
  /// Whether a process has yet to send what it knows.
  [[nodiscard]] virtual bool owes_host_results(std::uint64_t writer) const = 0;
  /// All that was sent, each once.
  [[nodiscard]] virtual std::vector<lock_step::HostResults> hand_out_host_results() = 0;
  virtual void publish(bus::RunState& state) = 0;

  /// What its messages are signed with.
  [[nodiscard]] virtual std::uint64_t writer() const = 0;
  /// Silence before this time proves nothing: this process stood still (bus::Standstill).
  [[nodiscard]] virtual std::chrono::steady_clock::time_point silence_counts_from() const = 0;
  /// How often this process stood still, in a run that had begun, for so long that others may have
  /// missed it.
  [[nodiscard]] virtual std::uint64_t standstills() const = 0;
  /// For the log, of what another process has done wrong; it cannot fill the log with that.
  virtual void log_fault(std::string_view text) = 0;
};

}  // namespace rave::manager
