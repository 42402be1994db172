// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "rave/base/result.hpp"

namespace rave::bus {

/// Which process speaks for which host of the scenario: the first that came. A second one that
/// claims the same host is refused until the first is lost, so that two programs started with the
/// same name do not overwrite each other. One owner thread.
class HostClaims {
 public:
  /// Takes the host for the writer, or confirms it. Error kState names both writers.
  [[nodiscard]] Status claim(std::uint32_t host, std::uint64_t writer);
  /// A writer is lost: its hosts are free.
  void release(std::uint64_t writer);
  /// Who has the host; 0: nobody.
  [[nodiscard]] std::uint64_t writer_of(std::uint32_t host) const;

 private:
  std::unordered_map<std::uint32_t, std::uint64_t> writers_;
};

}  // namespace rave::bus
