// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rave/bus/config.hpp"
#include "rave/bus/cyclone_log.hpp"
#include "rave/bus/qos.hpp"
#include "rave/ros2/node_list.hpp"

namespace rave::ros2 {

/// The DDS network of ROS 2. A plain value; the defaults stay on this machine.
struct Network {
  /// The participant name shown to others.
  std::string name = "rave";
  /// ROS_DOMAIN_ID: 0 to 230.
  std::uint32_t domain = 0;
  std::string interface = "127.0.0.1";  ///< As in bus::BusConfig, like the next two.
  std::vector<std::string> peers;
  bus::Multicast multicast = bus::Multicast::kNone;
  NodeForm nodes = NodeForm::kIron;
  /// The name of the node, and a namespace such as `/cart`, or empty.
  std::string node = "rave";
  std::string node_namespace;
};

/// A reader or writer of another process, by the names of ROS 2.
struct RemoteEnd {
  std::string topic;
  std::string type;
};

/// Who a reader or writer of another process is.
struct RemoteId {
  using Guid = std::array<std::uint8_t, 16>;
  Guid guid{};
  Guid participant{};
  std::string name;  ///< Of its participant; empty if that has none.
};
/// For users: `cart` (GID 01.0f.37...), as `ros2 topic info --verbose` lists it.
[[nodiscard]] std::string text_of(const RemoteId& id);

/// The QoS of readers and writers. Readers of sensor data are best effort, so they match every
/// writer. Writers are reliable, so they match every reader that does not require old samples.
inline constexpr bus::QosProfile kReadNewest{.reliable = false, .depth = 10};
inline constexpr bus::QosProfile kReadMany{.reliable = false, .depth = 100};
inline constexpr bus::QosProfile kReadKept{.durable = true, .depth = 100};
inline constexpr bus::QosProfile kWrite{.depth = 10};
inline constexpr bus::QosProfile kWriteKept{.durable = true, .depth = 1};

/// A participant in a ROS 2 domain: default partition, no run. It has its own domain object of
/// Cyclone DDS with its own settings, so a process may also have a bus, and participants for
/// several robots with different interfaces. Each costs threads and ports: robots on one network
/// should share one.
///
/// Thread: a reader or writer is created and used in one thread; the functions of this class may be
/// called from any. Destroy it after everything created on it.
class Participant {
 public:
  /// Joins the domain. Errors: kInvalidArgument (a field of the network, no such interface), kIo.
  [[nodiscard]] static Result<std::unique_ptr<Participant>> open(const Network& network);
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;
  ~Participant();

  [[nodiscard]] const Network& network() const noexcept { return network_; }
  [[nodiscard]] dds_entity_t handle() const noexcept { return participant_; }

  /// Creates an end of a topic with an absolute name (`/cart/scan`). Errors: kState (the topic
  /// exists here with another type), kIo.
  [[nodiscard]] Result<dds_entity_t> add_end(const dds_topic_descriptor_t& type,
                                             std::string_view topic, const bus::QosProfile& profile,
                                             bool reads) const;
  /// Deletes an end made by add_end().
  void remove_end(dds_entity_t end) const;
  /// Announces changes of this participant's ends to others. Call it at the latest shortly after
  /// the last end was made, so that ROS 2 tools find all. No cost without changes.
  void announce() const;

  /// The topics that others currently write, or read.
  [[nodiscard]] std::vector<RemoteEnd> others(bool writers) const;
  /// An entity for a Waiter that has unread samples when others() may have changed.
  [[nodiscard]] dds_entity_t news(bool writers) const noexcept {
    return writers ? seen_writers_ : seen_readers_;
  }
  /// The name of a participant; empty if it has none or is gone.
  [[nodiscard]] std::string name_of(const RemoteId::Guid& participant) const;
  /// The number of other participants.
  [[nodiscard]] std::size_t others_here() const;
  /// A message for users: why nothing comes from a topic (or, with `writers` false, no participant
  /// receives it): the topic has another type, another topic has the type, or there is no other
  /// end. `type` is the wire name.
  [[nodiscard]] std::string explain_silence(std::string_view topic, std::string_view type,
                                            bool writers) const;

 private:
  explicit Participant(Network network) : network_(std::move(network)) {}
  [[nodiscard]] Status join();

  Network network_;
  std::unique_ptr<bus::CycloneLog> log_;
  std::unique_ptr<NodeList> nodes_;  ///< Null: no announcement.
  dds_entity_t domain_ = 0;
  dds_entity_t participant_ = 0;
  dds_entity_t seen_participants_ = 0;
  dds_entity_t seen_writers_ = 0;
  dds_entity_t seen_readers_ = 0;
};

}  // namespace rave::ros2
