// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../src/manager_endpoint.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::manager {

/// What managers of both kinds have in common of a bus that the test plays.
class FakeEndpoint final : public ManagerEndpoint {
 public:
  static constexpr std::uint64_t kManager = 1000;  ///< What its messages are signed with.

  void serve_requests() override {}
  Result<std::vector<std::uint64_t>> look_at_processes(bool /*begun*/) override {
    for (const std::uint64_t writer : gone) hosts.erase(writer);
    return std::exchange(gone, {});
  }
  bool is_second() const override { return false; }
  std::optional<std::uint32_t> host_of(std::uint64_t writer) const override {
    const auto found = hosts.find(writer);
    if (found == hosts.end()) return std::nullopt;
    return found->second;
  }
  void take_roster(RosterBook& /*book*/, const Serving& /*serving*/) override {}
  void take_host_results(
      const std::function<bool(std::uint64_t, std::uint32_t)>& /*served*/) override {}
  bool owes_host_results(std::uint64_t /*writer*/) const override { return false; }
  std::vector<lock_step::HostResults> hand_out_host_results() override { return {}; }
  void publish(bus::RunState& state) override {
    phases.push_back(state.phase);
    for (const auto& host : bus::elements(state.hosts)) {
      seen.emplace_back(host.host, host.phase);
    }
  }
  std::uint64_t writer() const override { return kManager; }
  std::chrono::steady_clock::time_point silence_counts_from() const override {
    ++silence_asked;
    return stands_still ? std::chrono::steady_clock::now()
                        : std::chrono::steady_clock::time_point{};
  }
  std::uint64_t standstills() const override { return stood; }
  void log_fault(std::string_view text) override { faults.emplace_back(text); }

  [[nodiscard]] bool over() const {
    return !phases.empty() &&
           (phases.back() == rave_wire_RUN_ENDED || phases.back() == rave_wire_RUN_FAILED);
  }
  [[nodiscard]] bool saw(std::uint32_t host, rave_wire_HostPhase phase) const {
    return std::ranges::find(seen, std::pair(host, phase)) != seen.end();
  }

  std::map<std::uint64_t, std::uint32_t> hosts;  ///< Numbers of hosts by process.
  std::vector<std::uint64_t> gone;               ///< Told at the next look.
  bool stands_still = false;                     ///< Silence proves nothing.
  std::uint64_t stood = 0;
  mutable int silence_asked = 0;
  std::vector<rave_wire_RunPhase> phases;  ///< As published.
  std::vector<std::pair<std::uint32_t, rave_wire_HostPhase>> seen;
  std::vector<std::string> faults;
};

}  // namespace rave::manager
