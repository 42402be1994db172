// SPDX-License-Identifier: Apache-2.0
#include "ros2/graph.hpp"

#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>

#include <cstdio>

namespace peer {

namespace {

template <class Bytes>
std::string hex(const Bytes& bytes) {
  std::string text;
  for (const auto byte : bytes) {
    char room[3];
    std::snprintf(room, sizeof room, "%02x", static_cast<unsigned>(byte));
    text += room;
  }
  return text;
}

template <class Texts>
std::string texts(const Texts& of) {
  std::string all;
  for (const auto& [name, text] : of) {
    all.append(all.empty() ? "\"" : ",\"").append(name).append("\":\"").append(text).append("\"");
  }
  return "{" + all + "}";
}

template <class Gids>
std::string list(const Gids& gids) {
  std::string all;
  for (const auto& gid : gids) all += (all.empty() ? "\"" : ",\"") + hex(gid.data()) + "\"";
  return "[" + all + "]";
}

template <class UserData>
std::string text_of(const UserData& data) {
  const auto& bytes = data.getValue();
  return std::string(bytes.begin(), bytes.end());
}

}  // namespace

std::string digits_of(const eprosima::fastrtps::rtps::GUID_t& guid) {
  return hex(guid.guidPrefix.value) + hex(guid.entityId.value);
}

void Graph::hear(const rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_& info) { note(info); }
void Graph::hear(const rmw_dds_common::msg::dds_::ParticipantEntitiesInfoBefore2023_& info) {
  note(info);
}

template <class Info>
void Graph::note(const Info& info) {
  const std::string participant = hex(info.gid().data());
  std::string all;
  for (const auto& node : info.node_entities_info_seq()) {
    all += all.empty() ? "" : ",";
    all += "{\"participant\":\"" + participant + "\",\"namespace\":\"" +
           std::string(node.node_namespace().c_str()) + "\",\"name\":\"" +
           node.node_name().c_str() + "\",\"readers\":" + list(node.reader_gid_seq()) +
           ",\"writers\":" + list(node.writer_gid_seq()) + "}";
  }
  const std::lock_guard lock(mutex_);
  nodes_[participant] = all;
}

void Graph::on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* /*participant*/,
                                     eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) {
  const std::lock_guard lock(mutex_);
  enclaves_[digits_of(info.info.m_guid)] = text_of(info.info.m_userData);
}

void Graph::on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* /*participant*/,
                                   eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) {
  const std::lock_guard lock(mutex_);
  hashes_[info.info.topicName().to_string()] = text_of(info.info.m_qos.m_userData);
}

std::string Graph::json() {
  const std::lock_guard lock(mutex_);
  std::string all;
  for (const auto& [participant, nodes] : nodes_) all += (all.empty() ? "" : ",") + nodes;
  return "\"nodes\":[" + all + "],\"hashes\":" + texts(hashes_) +
         ",\"enclaves\":" + texts(enclaves_);
}

}  // namespace peer
