// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/qos.hpp"

namespace rave::bus {
namespace {

/// Limit of instances or writers of one topic: twice the largest number of robots. It bounds the
/// memory if a sender invents new ones.
constexpr std::int32_t kMostInstances = 2 * 65536;

}  // namespace

Qos make_qos(const QosProfile& profile) {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(),
                       profile.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       profile.waits ? DDS_MSECS(500) : 0);
  // Keep-last: a reader that is slow gets the newest samples.
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, profile.depth);
  dds_qset_resource_limits(qos.get(), DDS_LENGTH_UNLIMITED, kMostInstances, DDS_LENGTH_UNLIMITED);
  if (profile.durable) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    // This policy, not the history, determines the samples for late readers.
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, profile.depth,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  // The end of a process does not remove its robots or obstacles; dispose() does.
  dds_qset_writer_data_lifecycle(qos.get(), false);
  // A process does not receive its own samples.
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &representation);
  return qos;
}

PolicyAdvice advice_for_policy(std::uint32_t policy_id) noexcept {
  constexpr std::pair<std::uint32_t, PolicyAdvice> kAdvice[] = {
      {DDS_RELIABILITY_QOS_POLICY_ID,
       {"reliability", "make the writer reliable, or the reader best effort"}},
      {DDS_DURABILITY_QOS_POLICY_ID,
       {"durability", "make the writer transient-local, or the reader volatile"}},
      {DDS_DEADLINE_QOS_POLICY_ID,
       {"deadline", "give the writer a shorter deadline than the reader, or the reader none"}},
      {DDS_LATENCYBUDGET_QOS_POLICY_ID,
       {"latency budget", "give the reader a latency budget no less than the writer's"}},
      {DDS_LIVELINESS_QOS_POLICY_ID,
       {"liveliness", "give the reader automatic liveliness and no shorter a lease"}},
      {DDS_OWNERSHIP_QOS_POLICY_ID, {"ownership", "make both shared or both exclusive"}},
      {DDS_DESTINATIONORDER_QOS_POLICY_ID,
       {"destination order", "let the reader order by time of reception"}},
      {DDS_PRESENTATION_QOS_POLICY_ID,
       {"presentation", "leave the reader's access scope at instance"}},
      {DDS_DATA_REPRESENTATION_QOS_POLICY_ID,
       {"data representation", "let the other side use XCDR1, as ROS 2 does"}},
      {DDS_TYPE_CONSISTENCY_ENFORCEMENT_QOS_POLICY_ID,
       {"type consistency", "use the same version of RAVE on both sides"}},
      {DDS_PARTITION_QOS_POLICY_ID, {"partition", "let both take part in the same run"}},
  };
  for (const auto& [policy, advice] : kAdvice) {
    if (policy == policy_id) return advice;
  }
  return {"an unnamed policy", "compare the qualities of service of both ends"};
}

}  // namespace rave::bus
