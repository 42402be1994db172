// SPDX-License-Identifier: Apache-2.0
#include "make_end.hpp"

#include "rave/ros2/names.hpp"
#include "rave/ros2/type_hash.hpp"

namespace rave::ros2 {

Result<dds_entity_t> make_end(dds_entity_t participant, const dds_topic_descriptor_t& type,
                              const std::string& wire_topic, const bus::QosProfile& profile,
                              bool reads) {
  const bus::Qos qos = bus::make_qos(profile);
  // Iron and later log an error for participants without it; Humble ignores it.
  const std::string data = fmt::format("typehash={};", type_hash_of(type.m_typename));
  if (!type_hash_of(type.m_typename).empty())
    dds_qset_userdata(qos.get(), data.data(), data.size());
  const dds_entity_t topic =
      dds_create_topic(participant, &type, wire_topic.c_str(), nullptr, nullptr);
  if (topic < 0) {
    return fail(ErrorCode::kState, "topic `{}`: {}", topic_of_wire(wire_topic),
                dds_strretcode(topic));
  }
  const dds_entity_t entity = reads ? dds_create_reader(participant, topic, qos.get(), nullptr)
                                    : dds_create_writer(participant, topic, qos.get(), nullptr);
  // The reader or writer keeps a reference to the topic.
  dds_delete(topic);
  if (entity < 0) {
    return fail(ErrorCode::kIo, "cannot {} `{}`: {}", reads ? "read" : "write",
                topic_of_wire(wire_topic), dds_strretcode(entity));
  }
  return entity;
}

}  // namespace rave::ros2
