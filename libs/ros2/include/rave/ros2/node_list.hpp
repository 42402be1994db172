// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::ros2 {

/// The format in which a participant announces its node. The distributions of ROS 2 use two formats
/// under one type name, and a process that reads the wrong one logs errors. So all of a domain must
/// use the same.
enum class NodeForm : std::uint8_t {
  kNone,    ///< No announcement; topics are visible all the same.
  kHumble,  ///< Humble and before: GIDs of 24 bytes.
  kIron,    ///< Iron (2023) and later: GIDs of 16 bytes.
};

/// Announces a participant as a ROS 2 node with its readers and writers, on the topic
/// `ros_discovery_info`, like rmw_dds_common. Without it `ros2 node list` does not show the node.
/// Owner: a Participant. Any thread.
class NodeList {
 public:
  /// `name`: a name without slashes; `name_space`: begins with a slash. Error: kIo.
  [[nodiscard]] static Result<std::unique_ptr<NodeList>> open(dds_entity_t participant,
                                                              NodeForm form, std::string name,
                                                              std::string name_space);
  NodeList(const NodeList&) = delete;
  NodeList& operator=(const NodeList&) = delete;
  ~NodeList();

  void add(dds_entity_t end, bool reads);
  /// Call it before the end is deleted.
  void remove(dds_entity_t end);
  /// Publishes the announcement if it has changed since the last call.
  void announce();

 private:
  struct End {
    dds_entity_t handle = 0;
    bool reads = false;
    dds_guid_t guid{};
  };

  NodeList(dds_entity_t participant, NodeForm form, std::string name, std::string name_space)
      : participant_(participant),
        form_(form),
        name_(std::move(name)),
        name_space_(std::move(name_space)) {}
  template <class Form>
  void write();

  dds_entity_t participant_;
  NodeForm form_;
  std::string name_;
  std::string name_space_;
  dds_entity_t writer_ = 0;

  std::mutex mutex_;  // guards the members below
  std::vector<End> ends_;
  bool changed_ = true;
};

}  // namespace rave::ros2
