// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "rave/protocol/host_results.hpp"

namespace rave::manager {

/// Notes that a process serves a slot now.
inline void note_sitting(std::vector<std::uint64_t>& sat, std::uint64_t writer) {
  if (std::ranges::find(sat, writer) == sat.end()) sat.push_back(writer);
}

/// Whether a process has ever served a host. `slots`: by host, each with `sat`.
template <class Slots>
bool has_sat(const Slots& slots, std::uint64_t writer, std::uint32_t host) {
  return host < slots.size() && std::ranges::find(slots[host].sat, writer) != slots[host].sat.end();
}

/// HostResults of one host in the order in which its processes served it, because the last one
/// knows most. All of them are of processes that have served it.
template <class Slots>
void order_by_sitting(const Slots& slots, std::vector<lock_step::HostResults>& host_results) {
  std::ranges::stable_sort(host_results, {}, [&slots](const lock_step::HostResults& one) {
    const auto& sat = slots[one.host].sat;
    return std::ranges::find(sat, one.writer) - sat.begin();
  });
}

}  // namespace rave::manager
