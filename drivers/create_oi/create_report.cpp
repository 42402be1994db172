// SPDX-License-Identifier: Apache-2.0
#include "create_oi/create_report.hpp"

#include <nlohmann/json.hpp>

namespace rave::oi {

std::string report_json(const std::string& where, const DeviceState& state) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["line"] = where;
  json["connected"] = state.connected;
  json["mode"] = to_string(state.robot.mode);
  json["connects"] = state.connects;
  json["frames"] = state.frames;
  json["bad_checksum"] = state.bad_checksum;
  json["bad_layout"] = state.bad_layout;
  json["skipped_bytes"] = state.skipped_bytes;
  json["missing_frames"] = state.missing_frames;
  json["period_ms"] = state.period_ms;
  json["clock_drift_ppm"] = state.clock_drift_ppm;
  json["drive_commands"] = state.drive_commands;
  json["watchdog_stops"] = state.watchdog_stops;
  json["mode_losses"] = state.mode_losses;
  json["trouble"] = state.trouble;
  return json.dump();
}

}  // namespace rave::oi
