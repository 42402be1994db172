// SPDX-License-Identifier: Apache-2.0
// Hashes of message types (REP 2016), which ROS 2 compares from Iron on.
#include "rave/ros2/type_hash.hpp"

namespace rave::ros2 {
namespace {

struct TypeHash {
  std::string_view type;
  std::string_view hash;
};

constexpr TypeHash kHashes[] = {
#include "type_hashes.inc"
};

}  // namespace

std::string_view type_hash_of(std::string_view wire_type) noexcept {
  for (const TypeHash& each : kHashes) {
    if (each.type == wire_type) return each.hash;
  }
  return {};
}

}  // namespace rave::ros2
