// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "rave/bus/bus.hpp"

namespace rave::bus {

/// What readers and writers have in common: their entity of the bus, which ends with them. Movable.
class EndpointOwner {
 public:
  /// Owns nothing.
  EndpointOwner() = default;
  EndpointOwner(EndpointOwner&& other) noexcept { *this = std::move(other); }
  EndpointOwner& operator=(EndpointOwner&& other) noexcept {
    std::swap(bus_, other.bus_);
    std::swap(topic_, other.topic_);
    std::swap(entity_, other.entity_);
    return *this;
  }
  ~EndpointOwner() {
    if (entity_ > 0) bus_->remove_endpoint(entity_);
  }

  [[nodiscard]] Bus& bus() const noexcept { return *bus_; }
  [[nodiscard]] dds_entity_t handle() const noexcept { return entity_; }

 protected:
  /// Makes the entity. Precondition: owns nothing.
  [[nodiscard]] Result<Bus::Endpoint*> add(Bus& bus, const TopicSpec& topic, bool reads) {
    RAVE_TRY_ASSIGN(entity_, bus.add_endpoint(topic, reads));
    bus_ = &bus;
    topic_ = topic.name;
    return bus.endpoint(entity_);
  }

  Bus* bus_ = nullptr;
  const char* topic_ = nullptr;
  dds_entity_t entity_ = 0;
};

}  // namespace rave::bus
