// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <map>
#include <mutex>
#include <string>

#include "ros2_messages.h"

namespace peer {

/// What `ros2 node list` and `ros2 topic info --verbose` would know of others: their nodes, and
/// what participants and writers say beside their data. Called on threads of Fast DDS.
class Graph final : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  void hear(const rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_& info);
  void hear(const rmw_dds_common::msg::dds_::ParticipantEntitiesInfoBefore2023_& info);
  /// `"nodes":[{"participant","name","readers":[],"writers":[]}],"hashes":{topic: text},
  /// "enclaves":{participant: text}`, with GUIDs as 32 digits or, in the older form, 48.
  [[nodiscard]] std::string json();

 private:
  template <class Info>
  void note(const Info& info);
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;
  void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override;

  std::mutex mutex_;                           // guards what follows
  std::map<std::string, std::string> nodes_;   // by participant
  std::map<std::string, std::string> hashes_;  // by topic
  std::map<std::string, std::string> enclaves_;
};

/// The digits of a GUID.
[[nodiscard]] std::string digits_of(const eprosima::fastrtps::rtps::GUID_t& guid);

}  // namespace peer
