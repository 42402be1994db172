// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// As much of a node of ROS 2 as the peer needs, on Fast DDS alone: no ROS, and none of RAVE's bus.
namespace peer {

/// How an end of a topic is delivered.
struct Delivery {
  bool reliable = true;
  bool keeps = false;  ///< Transient-local: late readers are given what there was.
  int depth = 10;
};

/// A participant on the loopback. Its lease is as long as that of a robot of ROS 2, 20 s, so nobody
/// learns from DDS that it was killed.
class Node {
 public:
  /// Of others it tells the listener, which must outlive it.
  Node(const std::string& name, std::uint32_t domain,
       eprosima::fastdds::dds::DomainParticipantListener* listener = nullptr);
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  ~Node();

  [[nodiscard]] eprosima::fastdds::dds::DataWriter* writer(
      const std::string& topic, const eprosima::fastdds::dds::TypeSupport& type,
      const Delivery& delivery);
  /// The listener must outlive the node.
  [[nodiscard]] eprosima::fastdds::dds::DataReader* reader(
      const std::string& topic, const eprosima::fastdds::dds::TypeSupport& type,
      const Delivery& delivery, eprosima::fastdds::dds::DataReaderListener* listener);
  /// The same of a topic by its name on the wire, whose type goes by another name than here.
  void raw_reader(const std::string& wire_topic, const std::string& type_name,
                  const eprosima::fastdds::dds::TypeSupport& type, const Delivery& delivery,
                  eprosima::fastdds::dds::DataReaderListener* listener);

 private:
  eprosima::fastdds::dds::Topic* topic(const std::string& name,
                                       const eprosima::fastdds::dds::TypeSupport& type);

  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
};

/// Calls `visit(message, writer)` on a thread of Fast DDS for each message that comes.
template <class Message>
class Ear final : public eprosima::fastdds::dds::DataReaderListener {
 public:
  using Visit = std::function<void(const Message&, const eprosima::fastrtps::rtps::GUID_t&)>;
  explicit Ear(Visit visit) : visit_(std::move(visit)) {}

  void on_data_available(eprosima::fastdds::dds::DataReader* reader) override {
    Message message;
    eprosima::fastdds::dds::SampleInfo info;
    while (reader->take_next_sample(&message, &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) visit_(message, info.sample_identity.writer_guid());
    }
  }

 private:
  Visit visit_;
};

}  // namespace peer
