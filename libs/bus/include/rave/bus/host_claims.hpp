// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::bus {

/// Which process speaks for which host of the scenario: the first that claimed it. A second process
/// with the same host is refused until the first is lost, so two programs started with the same
/// name do not overwrite each other. One owner thread.
class HostClaims {
 public:
  /// `hosts`: the number of hosts in the scenario.
  explicit HostClaims(std::uint32_t hosts) : writers_(hosts, 0) {}

  /// Assigns the host to the writer, or confirms it. Errors: kState (another writer has it; names
  /// both), kNotFound (no such host in the scenario).
  [[nodiscard]] Status claim(std::uint32_t host, std::uint64_t writer);
  /// Frees the hosts of a writer that was lost.
  void release(std::uint64_t writer);

 private:
  std::vector<std::uint64_t> writers_;  ///< By host; 0: free.
};

}  // namespace rave::bus
