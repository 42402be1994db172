// SPDX-License-Identifier: Apache-2.0
#include "hybrid_contact.hpp"
#include "hybrid_pose.hpp"
#include "hybrid_ranges.hpp"
#include "rave/robot/plugin_entry.hpp"

RAVE_PLUGIN("hybrid_ranges hybrid_contact hybrid_pose") {
  rave::add_hybrid_sensor<rave::HybridRanges>(
      registry, {.name = "hybrid_ranges",
                 .summary = "One range for each ray of a real and a virtual laser or sonar.",
                 .params = rave::HybridRanges::kParams});
  rave::add_hybrid_sensor<rave::HybridContact>(
      registry, {.name = "hybrid_contact",
                 .summary = "Reports contact if the real or the virtual bumper does.",
                 .params = rave::HybridContact::kParams});
  rave::add_hybrid_sensor<rave::HybridPose>(
      registry, {.name = "hybrid_pose",
                 .summary = "The mean of a real and a virtual pose, weighted by their variances.",
                 .params = rave::HybridPose::kParams});
}
