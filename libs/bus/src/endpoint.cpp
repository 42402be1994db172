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

void read_new(dds_entity_t reader, Loan& loan) {
  loan.samples.fill(nullptr);
  const dds_return_t count = dds_read_mask(
      reader, loan.samples.data(), loan.infos.data(), Loan::kBatch, std::uint32_t{Loan::kBatch},
      DDS_NOT_READ_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ANY_INSTANCE_STATE);
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

std::vector<dds_instance_handle_t> matched(dds_entity_t entity, bool reads) {
  const auto list = reads ? dds_get_matched_publications : dds_get_matched_subscriptions;
  std::vector<dds_instance_handle_t> handles(16);
  // The number may grow between two calls, so it is asked again with more room.
  while (true) {
    const dds_return_t count = list(entity, handles.data(), handles.size());
    if (count < 0) return {};
    const auto size = static_cast<std::size_t>(count);
    const bool all = size <= handles.size();
    handles.resize(size);
    if (all) return handles;
  }
}

dds_guid_t participant_of(dds_entity_t entity, bool reads, dds_instance_handle_t handle) {
  const auto data_of = reads ? dds_get_matched_publication_data : dds_get_matched_subscription_data;
  dds_builtintopic_endpoint_t* const data = data_of(entity, handle);
  if (data == nullptr) return {};
  const dds_guid_t guid = data->participant_key;
  dds_builtintopic_free_endpoint(data);
  return guid;
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
