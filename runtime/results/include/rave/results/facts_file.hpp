// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/results/facts.hpp"

namespace rave::runtime {

/// What a host leaves in its folder for the results of the whole run.
inline constexpr const char* kFactsFile = "findings.cdr";

/// Whose facts they are.
struct FactsOf {
  std::uint64_t run_number = 0;  ///< shared_number() of the scenario.
  std::string host;

  friend bool operator==(const FactsOf&, const FactsOf&) = default;
};

/// The facts as bytes: classic CDR, doubles bit by bit.
[[nodiscard]] std::vector<std::byte> encode_facts(const FactsOf& about, const RunFacts& facts);

/// What facts may speak of.
struct FactsLimits {
  std::uint32_t robots = 0;
  std::uint32_t bodies = 0;
};

/// Reads them back; nothing in them is trusted. Errors: kParse (no facts, damaged, of another
/// version of RAVE, of robots or bodies that there are not), kState (of another run or host).
[[nodiscard]] Result<RunFacts> decode_facts(std::span<const std::byte> bytes, const FactsOf& about,
                                            const FactsLimits& limits);

}  // namespace rave::runtime
