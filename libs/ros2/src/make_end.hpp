// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <string>

#include "rave/base/result.hpp"
#include "rave/bus/qos.hpp"

namespace rave::ros2 {

/// Creates a reader or writer of a topic by its wire name, with the type hash. Errors: those of
/// Participant::add_end().
[[nodiscard]] Result<dds_entity_t> make_end(dds_entity_t participant,
                                            const dds_topic_descriptor_t& type,
                                            const std::string& wire_topic,
                                            const bus::QosProfile& profile, bool reads);

}  // namespace rave::ros2
