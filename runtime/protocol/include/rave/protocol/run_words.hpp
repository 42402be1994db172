// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "rave/bus/topics.hpp"

namespace rave::lock_step {

/// The state of a run according to a process, as far as a host needs it.
struct RunWord {
  std::uint64_t writer = 0;
  rave_wire_RunPhase phase = rave_wire_RUN_GATHERING;
  std::string text;
  bool without_us = false;  ///< The run continues without the host that receives this.
};

/// The end of a run for a host.
struct RunEnding {
  bool good = false;  ///< The run was complete.
  std::string text;   ///< How its manager says it.
};

/// Decodes a sample of the topic rave/run for the host with this number.
[[nodiscard]] RunWord run_word(const bus::RunState& state, std::uint32_t host);

/// Filters the run states that a host receives: only those of Environment Managers that have
/// introduced themselves and are compatible count. The newest state of any other sender is kept
/// until its introduction, and dropped if it is not compatible. The number of remembered senders is
/// bounded. Belongs to one thread.
class RunWords {
 public:
  static constexpr std::size_t kMostKnown = 4096;
  static constexpr std::size_t kMostKept = 64;

  /// A manager has introduced itself and is compatible.
  void welcome(std::uint64_t writer);
  /// A manager is not compatible; permanent.
  void shut_out(std::uint64_t writer);
  void hear(RunWord word);
  /// The states of compatible managers since the last call, in order of arrival.
  [[nodiscard]] std::vector<RunWord> take();

 private:
  std::set<std::uint64_t> fitting_;
  std::set<std::uint64_t> strangers_;
  std::vector<RunWord> said_;
};

}  // namespace rave::lock_step
