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

/// How long a manager waits at the end for hosts that are still there, and for one that owes its
/// host_results.
struct DrainLimits {
  std::chrono::steady_clock::duration usual = kFarewell;
  std::chrono::steady_clock::duration owing = kLongFarewell;
};

/// The end of a run: hosts hear of it before the manager goes, and what they know of the run
/// reaches it. Until all are gone, or the limits are over. `slots`: by host, each with `name` and
/// `writer`. `owes_host_results`: whether a process has yet to send what it knows, and is waited
/// for. `turn` waits a little and takes in what has come; false: the bus is of no use any more.
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
    if (waited >= limits.usual && !std::exchange(told, true) && log != nullptr) {
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
