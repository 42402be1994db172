// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/control/run_control.hpp"

namespace rave::runtime {

/// The state of a shadow as `rave ps --json` and the page have it. `Json`: an object of
/// nlohmann's library that keeps the order of its keys.
template <class Json>
[[nodiscard]] Json shadow_json(const RunStatus::Shadow& shadow) {
  Json json = {
      {"running", shadow.running}, {"since_s", shadow.since_s}, {"m", shadow.m},
      {"rad", shadow.rad},         {"most_m", shadow.most_m},   {"most_rad", shadow.most_rad},
      {"readings", Json::array()}};
  if (const auto& offset = shadow.offset_W) json["offset"] = {offset->x, offset->y, offset->yaw};
  for (const auto& reading : shadow.readings) {
    json["readings"].push_back({{"sensor", reading.sensor},
                                {"unit", reading.unit},
                                {"last", reading.last},
                                {"most", reading.most}});
  }
  return json;
}

}  // namespace rave::runtime
