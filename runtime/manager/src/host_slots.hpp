// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/bus/host_claims.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/sim/host_report.hpp"

namespace rave::manager {

/// How it stands with a host.
enum class SlotState : std::uint8_t {
  kMissing,  ///< Not heard of yet.
  kRuns,
  kLate,     ///< It has not answered in time, but is not gone.
  kLost,     ///< Gone, or given up; it may come back.
  kDropped,  ///< The same, for good.
};

/// The place of one host of the scenario, whoever sits in it.
struct HostSlot {
  std::string name;
  std::uint32_t robots = 0;
  SlotState state = SlotState::kMissing;
  std::uint64_t writer = 0;        ///< The process; 0: nobody.
  std::uint64_t last_writer = 0;   ///< Of a lost one.
  std::vector<std::uint64_t> sat;  ///< All that have sat here, in the order of their first times.
  std::string loss;                ///< How it was lost; empty if nothing came of it.
  std::string command;             ///< That starts it again; empty: nobody has to.
  std::uint64_t last_step = 0;     ///< Of its last report.
  bool reported = false;           ///< `report` is what comes next.
  std::uint64_t hash = 0;          ///< Of its part of the steps that are done.
  sim::HostReport report;

  /// The run does not go on without it.
  [[nodiscard]] bool needed(bool all) const noexcept {
    return state == SlotState::kMissing || state == SlotState::kRuns || state == SlotState::kLate ||
           (all && state == SlotState::kLost);
  }
};

[[nodiscard]] std::vector<HostSlot> make_slots(const std::vector<config::PlannedHost>& hosts);

/// "`a`, `b` and `c`", of those for which `holds`.
template <class Holds>
[[nodiscard]] std::vector<std::string_view> names_of(const std::vector<HostSlot>& slots,
                                                     Holds holds) {
  std::vector<std::string_view> names;
  for (const HostSlot& slot : slots) {
    if (holds(slot)) names.emplace_back(slot.name);
  }
  return names;
}

}  // namespace rave::manager
