// SPDX-License-Identifier: Apache-2.0
#include "ros2/node.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "arguments.hpp"

namespace peer {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

template <class Qos>
void deliver(Qos& qos, const Delivery& delivery) {
  qos.reliability().kind =
      delivery.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind =
      delivery.keeps ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = delivery.depth;
  // Killed processes would leave files of shared memory behind.
  qos.data_sharing().off();
  qos.endpoint().history_memory_policy = rtps::DYNAMIC_RESERVE_MEMORY_MODE;
}

}  // namespace

Node::Node(const std::string& name, std::uint32_t domain,
           dds::DomainParticipantListener* listener) {
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.name(name.c_str());
  qos.transport().use_builtin_transports = false;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.emplace_back("127.0.0.1");
  qos.transport().user_transports.push_back(udp);
  rtps::Locator_t here;
  rtps::IPLocator::setIPv4(here, 127, 0, 0, 1);
  qos.wire_protocol().builtin.initialPeersList.push_back(here);
  participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(
      domain, qos, listener, dds::StatusMask::none());
  if (participant_ == nullptr) give_up("no participant in domain " + std::to_string(domain));
  publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT, nullptr);
  subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT, nullptr);
}

Node::~Node() {
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

dds::Topic* Node::topic(const std::string& name, const dds::TypeSupport& type) {
  type.register_type(participant_);
  dds::Topic* const made =
      participant_->create_topic("rt" + name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
  if (made == nullptr) give_up("no topic " + name);
  return made;
}

dds::DataWriter* Node::writer(const std::string& name, const dds::TypeSupport& type,
                              const Delivery& delivery) {
  dds::DataWriterQos qos = dds::DATAWRITER_QOS_DEFAULT;
  deliver(qos, delivery);
  return publisher_->create_datawriter(topic(name, type), qos, nullptr);
}

dds::DataReader* Node::reader(const std::string& name, const dds::TypeSupport& type,
                              const Delivery& delivery, dds::DataReaderListener* listener) {
  dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
  deliver(qos, delivery);
  return subscriber_->create_datareader(topic(name, type), qos, listener);
}

void Node::raw_reader(const std::string& wire_topic, const std::string& type_name,
                      const dds::TypeSupport& type, const Delivery& delivery,
                      dds::DataReaderListener* listener) {
  type.register_type(participant_, type_name);
  dds::Topic* const made =
      participant_->create_topic(wire_topic, type_name, dds::TOPIC_QOS_DEFAULT);
  dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
  deliver(qos, delivery);
  if (made == nullptr || subscriber_->create_datareader(made, qos, listener) == nullptr) {
    give_up("no topic " + wire_topic);
  }
}

}  // namespace peer
