// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "manager_habits.hpp"
#include "rave/base/log.hpp"
#include "rave/base/names.hpp"

namespace rave::manager {

/// How long a manager waits at the end for hosts that are still present, and for a host that has
/// not sent its host_results yet.
struct DrainLimits {
  std::chrono::steady_clock::duration usual = kFarewell;
  std::chrono::steady_clock::duration owing = kLongFarewell;
};

/// Ends a run: hosts are notified before the manager leaves, and send what they know of the run.
/// Waits until all hosts are gone or the limits have passed. `slots`: by host, each with `name` and
/// `writer`. `owes_host_results`: whether a process has yet to send its results. `turn` waits a
/// little and receives what has arrived; false: the bus is no longer usable.
template <class Slots, class Owes, class Turn>
void drain(const Slots& slots, LogSink* log, Owes&& owes_host_results, Turn&& turn,
           const DrainLimits& limits = {}) {
  using Steady = std::chrono::steady_clock;
  const auto began = Steady::now();
  const auto here = [](const auto& slot) { return slot.writer != 0; };
  const auto owes = [&](const auto& slot) {
    return slot.writer != 0 && owes_host_results(slot.writer);
  };
  bool told = false;
  while (std::ranges::any_of(slots, here)) {
    const bool any_owes = std::ranges::any_of(slots, owes);
    const auto waited = Steady::now() - began;
    if (waited >= (any_owes ? limits.owing : limits.usual)) break;
    if (waited >= limits.usual && !std::exchange(told, true)) {
      std::vector<std::string_view> names;
      for (const auto& slot : slots) {
        if (owes(slot)) names.emplace_back(slot.name);
      }
      log->warn(kSource, "waits up to {:.0f} s for the results of {}", seconds(limits.owing),
                join_names(names));
    }
    if (!turn()) break;
  }
}

}  // namespace rave::manager
