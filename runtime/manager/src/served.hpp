// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "rave/protocol/host_results.hpp"

namespace rave::manager {

/// Notes that a process serves a slot now.
inline void note_service(std::vector<std::uint64_t>& served_by, std::uint64_t writer) {
  if (std::ranges::find(served_by, writer) == served_by.end()) served_by.push_back(writer);
}

/// Whether a process has ever served a host. `slots`: by host, each with `served_by`.
template <class Slots>
bool has_served(const Slots& slots, std::uint64_t writer, std::uint32_t host) {
  return host < slots.size() &&
         std::ranges::find(slots[host].served_by, writer) != slots[host].served_by.end();
}

/// HostResults of one host in the order in which its processes served it, because the last one
/// knows most. All of them are of processes that have served it.
template <class Slots>
void order_by_service(const Slots& slots, std::vector<lock_step::HostResults>& host_results) {
  std::ranges::stable_sort(host_results, {}, [&slots](const lock_step::HostResults& one) {
    const auto& served_by = slots[one.host].served_by;
    return std::ranges::find(served_by, one.writer) - served_by.begin();
  });
}

}  // namespace rave::manager
