// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::ros2 {

/// How a participant tells others of its node. The distributions of ROS 2 write it in two forms of
/// one name, and who reads the wrong one logs errors: all of a domain must be of one kind.
enum class NodeForm : std::uint8_t {
  kNone,    ///< Not at all; topics are seen all the same.
  kHumble,  ///< Humble and before: GIDs of 24 bytes.
  kIron,    ///< Iron (2023) and later: GIDs of 16 bytes.
};

/// Tells ROS 2 that a participant is a node and which readers and writers are its own, on the topic
/// `ros_discovery_info`, as rmw_dds_common does it; without it `ros2 node list` shows nothing of
/// us. Owner: a Participant. Any thread.
class NodeList {
 public:
  /// `name`: a word; `name_space`: begins with a slash. Error: kIo.
  [[nodiscard]] static Result<std::unique_ptr<NodeList>> open(dds_entity_t participant,
                                                              NodeForm form, std::string name,
                                                              std::string name_space);
  NodeList(const NodeList&) = delete;
  NodeList& operator=(const NodeList&) = delete;
  ~NodeList();

  void add(dds_entity_t end, bool reads);
  /// Before the end is deleted.
  void remove(dds_entity_t end);
  /// Tells others, if something has changed since it did the last time.
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

  std::mutex mutex_;  // guards what follows
  std::vector<End> ends_;
  bool changed_ = true;
};

}  // namespace rave::ros2
