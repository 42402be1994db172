// SPDX-License-Identifier: Apache-2.0
// Announces a node and its topics on `ros_discovery_info`, as ROS 2 nodes do, so that its tools
// list them.
#include "rave/ros2/node_list.hpp"

#include <algorithm>
#include <cstring>

#include "idl/ros2/rmw_dds_common.h"
#include "make_end.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/ros2/participant.hpp"

namespace rave::ros2 {
namespace {

constexpr const char* kTopic = "ros_discovery_info";  // without the prefix of other topics

struct Iron {
  using Gid = rmw_dds_common_msg_dds__Gid_;
  using Node = rmw_dds_common_msg_dds__NodeEntitiesInfo_;
  using Info = rmw_dds_common_msg_dds__ParticipantEntitiesInfo_;
};

struct Humble {
  using Gid = rmw_dds_common_msg_dds__GidBefore2023_;
  using Node = rmw_dds_common_msg_dds__NodeEntitiesInfoBefore2023_;
  using Info = rmw_dds_common_msg_dds__ParticipantEntitiesInfoBefore2023_;
};

dds_topic_descriptor_t type_of(NodeForm form) {
  dds_topic_descriptor_t type =
      form == NodeForm::kHumble ? rmw_dds_common_msg_dds__ParticipantEntitiesInfoBefore2023__desc
                                : rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc;
  type.m_typename = rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc.m_typename;
  return type;
}

dds_guid_t guid_of(dds_entity_t entity) {
  dds_guid_t guid{};
  (void)dds_get_guid(entity, &guid);
  return guid;
}

/// Shorter ids are padded with zeros.
template <class Gid>
Gid gid_of(const dds_guid_t& guid) {
  Gid gid{};
  std::memcpy(gid.data, guid.v, sizeof guid.v);
  return gid;
}

}  // namespace

Result<std::unique_ptr<NodeList>> NodeList::open(dds_entity_t participant, NodeForm form,
                                                 std::string name, std::string name_space) {
  std::unique_ptr<NodeList> list(
      new NodeList(participant, form, std::move(name), std::move(name_space)));
  RAVE_TRY_ASSIGN(list->writer_, make_end(participant, type_of(form), kTopic, kWriteKept, false));
  return list;
}

NodeList::~NodeList() {
  if (writer_ > 0) dds_delete(writer_);
}

void NodeList::add(dds_entity_t end, bool reads) {
  const std::lock_guard lock(mutex_);
  ends_.push_back({end, reads, guid_of(end)});
  // Announced later and once, because each announcement has the whole list.
  changed_ = true;
}

void NodeList::remove(dds_entity_t end) {
  const std::lock_guard lock(mutex_);
  changed_ =
      std::erase_if(ends_, [end](const End& each) { return each.handle == end; }) > 0 || changed_;
}

void NodeList::announce() {
  const std::lock_guard lock(mutex_);
  if (!changed_) return;
  changed_ = false;
  if (form_ == NodeForm::kHumble) {
    write<Humble>();
  } else {
    write<Iron>();
  }
}

template <class Form>
void NodeList::write() {
  using Gid = typename Form::Gid;
  std::vector<Gid> readers;
  std::vector<Gid> writers;
  for (const End& end : ends_) (end.reads ? readers : writers).push_back(gid_of<Gid>(end.guid));
  std::vector<typename Form::Node> nodes(1);
  (void)bus::put_text(nodes.front().node_namespace, name_space_);
  (void)bus::put_text(nodes.front().node_name, name_);
  bus::borrow(nodes.front().reader_gid_seq, readers);
  bus::borrow(nodes.front().writer_gid_seq, writers);
  typename Form::Info info{};
  info.gid = gid_of<Gid>(guid_of(participant_));
  bus::borrow(info.node_entities_info_seq, nodes);
  // A failure only affects the listing of nodes.
  (void)dds_write(writer_, &info);
}

}  // namespace rave::ros2
