// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

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

/// Where the robots of ROS 2 are. A plain value; the defaults stay on this machine.
struct Network {
  /// Shown to others as the name of the participant.
  std::string name = "rave";
  /// That of ROS_DOMAIN_ID: 0 to 230.
  std::uint32_t domain = 0;
  std::string interface = "127.0.0.1";  ///< As of bus::BusConfig, like the next two.
  std::vector<std::string> peers;
  bus::Multicast multicast = bus::Multicast::kOff;
  NodeForm nodes = NodeForm::kIron;
  /// The node that others see: a word, and a namespace such as `/cart`, or empty.
  std::string node = "rave";
  std::string node_namespace;
};

/// Somebody else's reader or writer, by the names of ROS 2.
struct RemoteEnd {
  std::string topic;
  std::string type;
};

/// What ROS 2 asks of its readers and writers. A sensor's reader takes what comes, so it matches
/// every writer; writers promise all, so they match every reader that does not want old samples.
inline constexpr bus::QosProfile kReadNewest{.reliable = false, .depth = 10};
inline constexpr bus::QosProfile kReadMany{.reliable = false, .depth = 100};
inline constexpr bus::QosProfile kReadKept{.durable = true, .depth = 100};
inline constexpr bus::QosProfile kWrite{.depth = 10};
inline constexpr bus::QosProfile kWriteKept{.durable = true, .depth = 1};

/// A participant in a domain of ROS 2: default partition, no run. It has a domain of Cyclone DDS of
/// its own, with its own settings, so a process may have a bus, and participants of several robots,
/// whatever their interfaces. Each costs threads and ports: share one where robots share a network.
///
/// Thread: readers and writers may be made and used in any one thread each; what this class itself
/// does is safe in all. It must outlive what is made on it.
class Participant {
 public:
  /// Errors: kInvalidArgument (a field of the network, no such interface), kIo.
  [[nodiscard]] static Result<std::unique_ptr<Participant>> open(const Network& network);
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;
  ~Participant();

  [[nodiscard]] const Network& network() const noexcept { return network_; }
  [[nodiscard]] dds_entity_t handle() const noexcept { return participant_; }

  /// Makes an end of a topic, whose name is whole (`/cart/scan`). Errors: kState (the topic exists
  /// here with another type), kIo.
  [[nodiscard]] Result<dds_entity_t> add_end(const dds_topic_descriptor_t& type,
                                             std::string_view topic, const bus::QosProfile& profile,
                                             bool reads) const;
  /// Deletes an end that add_end() made.
  void remove_end(dds_entity_t end) const;
  /// Tells others which ends there are, if they have changed; at the latest a moment after the last
  /// of them was made, so that the tools of ROS 2 find all. Costs nothing otherwise.
  void announce() const;

  /// What others write, or read, now.
  [[nodiscard]] std::vector<RemoteEnd> others(bool writers) const;
  /// For a Waiter: has something unseen when others() may have changed.
  [[nodiscard]] dds_entity_t news(bool writers) const noexcept {
    return writers ? seen_writers_ : seen_readers_;
  }
  /// How many other participants there are.
  [[nodiscard]] std::size_t others_here() const;
  /// For a user, why nothing comes from (or, `writers` false, goes to) a topic: another type there,
  /// the same type elsewhere, or nobody at all. The type is that of the wire.
  [[nodiscard]] std::string explain_silence(std::string_view topic, std::string_view type,
                                            bool writers) const;

 private:
  explicit Participant(Network network) : network_(std::move(network)) {}
  [[nodiscard]] Status join();

  Network network_;
  std::unique_ptr<bus::CycloneLog> log_;
  std::unique_ptr<NodeList> nodes_;  ///< Null: nobody is told.
  dds_entity_t domain_ = 0;
  dds_entity_t participant_ = 0;
  dds_entity_t seen_participants_ = 0;
  dds_entity_t seen_writers_ = 0;
  dds_entity_t seen_readers_ = 0;
};

}  // namespace rave::ros2
