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

/// Name of the file with a host's facts in its folder, for the results of the whole run.
inline constexpr const char* kFactsFile = "results.cdr";

/// The run and host of facts.
struct FactsOf {
  std::uint64_t run_number = 0;  ///< shared_number() of the scenario.
  std::string host;

  friend bool operator==(const FactsOf&, const FactsOf&) = default;
};

/// Encodes facts as bytes: classic CDR, doubles bit by bit.
[[nodiscard]] std::vector<std::byte> encode_facts(const FactsOf& about, const RunFacts& facts);

/// Bounds of the ids in facts.
struct FactsLimits {
  std::uint32_t robots = 0;
  std::uint32_t bodies = 0;
};

/// Decodes facts from untrusted bytes. Errors: kParse (not facts, damaged, of another version of
/// RAVE, ids out of bounds), kState (of another run or host).
[[nodiscard]] Result<RunFacts> decode_facts(std::span<const std::byte> bytes, const FactsOf& about,
                                            const FactsLimits& limits);

}  // namespace rave::runtime
