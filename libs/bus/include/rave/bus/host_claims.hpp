// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::bus {

/// Which process speaks for which host of the scenario: the first that came. A second one that
/// claims the same host is refused until the first is lost, so that two programs started with the
/// same name do not overwrite each other. One owner thread.
class HostClaims {
 public:
  /// The scenario has the hosts 0 to `hosts` - 1.
  explicit HostClaims(std::uint32_t hosts) : writers_(hosts, 0) {}

  /// Takes the host for the writer, or confirms it. Errors: kState names both writers, kNotFound if
  /// the scenario has no such host.
  [[nodiscard]] Status claim(std::uint32_t host, std::uint64_t writer);
  /// A writer is lost: its hosts are free.
  void release(std::uint64_t writer);
  /// Who has the host; 0: nobody.
  [[nodiscard]] std::uint64_t writer_of(std::uint32_t host) const;

 private:
  std::vector<std::uint64_t> writers_;  ///< By host; 0: free.
};

}  // namespace rave::bus
