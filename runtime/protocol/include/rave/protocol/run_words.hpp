// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "rave/bus/topics.hpp"

namespace rave::lock_step {

/// What a process says of how a run goes, as far as a host needs it.
struct RunWord {
  std::uint64_t writer = 0;
  rave_wire_RunPhase phase = rave_wire_RUN_GATHERS;
  std::string text;
  bool without_us = false;  ///< The run goes on without the host that hears it.
};

/// Of a sample of the topic rave/run, for the host of this number.
[[nodiscard]] RunWord run_word(const bus::RunState& state, std::uint32_t host);

/// Whose word on the run a host listens to: that of environment managers that said who they are and
/// fit. The word of others is kept until they do, the newest of each, and dropped if they do not
/// fit. Of processes without end that make themselves known some stay unknown. Belongs to one
/// thread.
class RunWords {
 public:
  static constexpr std::size_t kMostKnown = 4096;
  static constexpr std::size_t kMostKept = 64;

  /// A manager has introduced itself, and fits.
  void welcome(std::uint64_t writer);
  /// ... or does not; for good.
  void shut_out(std::uint64_t writer);
  void hear(RunWord word);
  /// What those who fit have said since the last call, in the order in which they said it.
  [[nodiscard]] std::vector<RunWord> take();

 private:
  std::set<std::uint64_t> fitting_;
  std::set<std::uint64_t> strangers_;
  std::vector<RunWord> said_;
};

}  // namespace rave::lock_step
