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
/// findings.
struct DrainLimits {
  std::chrono::steady_clock::duration usual = kFarewell;
  std::chrono::steady_clock::duration owing = kLongFarewell;
};

/// The end of a run: hosts hear of it before the manager goes, and what they know of the run
/// reaches it. Until all are gone, or the limits are over. `seats`: by host, each with `name` and
/// `writer`. `owes_findings`: whether a process has yet to send what it knows, and is waited for.
/// `turn` waits a little and takes in what has come; false: the bus is of no use any more.
template <class Seats, class Owes, class Turn>
void drain(const Seats& seats, LogSink* log, Owes&& owes_findings, Turn&& turn,
           const DrainLimits& limits = {}) {
  using Steady = std::chrono::steady_clock;
  const auto began = Steady::now();
  const auto here = [](const auto& seat) { return seat.writer != 0; };
  const auto owes = [&](const auto& seat) {
    return seat.writer != 0 && owes_findings(seat.writer);
  };
  bool told = false;
  while (std::ranges::any_of(seats, here)) {
    const bool any_owes = std::ranges::any_of(seats, owes);
    const auto waited = Steady::now() - began;
    if (waited >= (any_owes ? limits.owing : limits.usual)) break;
    if (waited >= limits.usual && !std::exchange(told, true) && log != nullptr) {
      std::vector<std::string_view> names;
      for (const auto& seat : seats) {
        if (owes(seat)) names.emplace_back(seat.name);
      }
      log->warn(kSource, "waits up to {:.0f} s for the results of {}", seconds(limits.owing),
                join_names(names));
    }
    if (!turn()) break;
  }
}

}  // namespace rave::manager
