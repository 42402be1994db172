// SPDX-License-Identifier: Apache-2.0
// What hosts leave comes from other processes: whatever is read must be safe to make results of.
#include <cstddef>
#include <cstdint>

#include "facts_sample.hpp"
#include "rave/base/check.hpp"
#include "rave/results/facts_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::runtime;
  const auto bytes = std::as_bytes(std::span(data, size));
  const FactsLimits limits{4, 8};
  auto facts = decode_facts(bytes, testing::sample_whose(), limits);
  if (!facts) {
    RAVE_CHECK(!facts.error().message.empty());
    return 0;
  }
  const auto again = encode_facts(testing::sample_whose(), *facts);
  RAVE_CHECK(decode_facts(again, testing::sample_whose(), limits).has_value());
  RunFacts whole = testing::sample_facts(2);
  merge(*std::move(facts), whole);
  return 0;
}
