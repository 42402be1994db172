// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/bus/host_claims.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/sim/host_report.hpp"

namespace rave::manager {

/// The state of a host.
enum class SlotState : std::uint8_t {
  kMissing,  ///< No message received yet.
  kRuns,
  kLate,     ///< It has not answered in time, but has not left.
  kLost,     ///< It has left, or the manager has given it up; it may return.
  kDropped,  ///< Like kLost, but permanently.
};

/// The slot of one host of the scenario, whichever process serves it.
struct HostSlot {
  std::string name;
  std::uint32_t robots = 0;
  SlotState state = SlotState::kMissing;
  std::uint64_t writer = 0;       ///< The process that serves it; 0: none.
  std::uint64_t last_writer = 0;  ///< The last process that was lost.
  std::vector<std::uint64_t>
      served_by;        ///< All processes that have served it, in the order of their first time.
  std::string loss;     ///< How it was lost; empty if that had no consequence.
  std::string command;  ///< Command that restarts it; empty: none is needed.
  std::uint64_t last_step = 0;  ///< Step of its last report.
  bool reported = false;        ///< `report` is that of the next step.
  std::uint64_t hash = 0;       ///< Hash of its part of the completed steps.
  sim::HostReport report;

  /// The run waits for it.
  [[nodiscard]] bool needed(bool all) const noexcept {
    return state == SlotState::kMissing || state == SlotState::kRuns || state == SlotState::kLate ||
           (all && state == SlotState::kLost);
  }
};

[[nodiscard]] std::vector<HostSlot> make_slots(const std::vector<config::PlannedHost>& hosts);

/// The names of the slots for which `holds` is true: "`a`, `b` and `c`".
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
