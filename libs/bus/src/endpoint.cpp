// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/endpoint.hpp"

#include <fmt/format.h>

#include "rave/bus/qos.hpp"

namespace rave::bus {

void take(dds_entity_t reader, Loan& loan) {
  // Null pointers make Cyclone DDS lend its own memory.
  loan.samples.fill(nullptr);
  const dds_return_t count = dds_take(reader, loan.samples.data(), loan.infos.data(), Loan::kBatch,
                                      std::uint32_t{Loan::kBatch});
  loan.size = count > 0 ? static_cast<std::size_t>(count) : 0;
}

void give_back(dds_entity_t reader, Loan& loan) noexcept {
  if (loan.size > 0) {
    dds_return_loan(reader, loan.samples.data(), static_cast<std::int32_t>(loan.size));
  }
  loan.size = 0;
}

std::size_t matched_ends(dds_entity_t entity, bool reads) noexcept {
  const dds_return_t count = reads ? dds_get_matched_publications(entity, nullptr, 0)
                                   : dds_get_matched_subscriptions(entity, nullptr, 0);
  return count < 0 ? 0 : static_cast<std::size_t>(count);
}

std::optional<std::string> take_mismatch(dds_entity_t entity, bool reads, bool all_partitions) {
  std::uint32_t policy = 0;
  std::int32_t fresh = 0;
  if (reads) {
    dds_requested_incompatible_qos_status_t status{};
    dds_get_requested_incompatible_qos_status(entity, &status);
    policy = status.last_policy_id;
    fresh = status.total_count_change;
  } else {
    dds_offered_incompatible_qos_status_t status{};
    dds_get_offered_incompatible_qos_status(entity, &status);
    policy = status.last_policy_id;
    fresh = status.total_count_change;
  }
  // Only what is new since the last call: DDS keeps the total.
  if (fresh == 0) return std::nullopt;
  if (policy == DDS_PARTITION_QOS_POLICY_ID && !all_partitions) return std::nullopt;
  const PolicyAdvice advice = advice_for_policy(policy);
  return fmt::format("a {} gets nothing {} us: {} does not match; {}", reads ? "writer" : "reader",
                     reads ? "through to" : "from", advice.name, advice.remedy);
}

}  // namespace rave::bus
