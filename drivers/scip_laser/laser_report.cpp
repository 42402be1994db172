// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/laser_report.hpp"

#include <nlohmann/json.hpp>

namespace rave::scip {

std::string report_json(const std::string& where, const Identity& identity,
                        const ScanRequest& request, const LaserState& state) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["line"] = where;
  json["model"] = identity.parameters.model;
  json["product"] = identity.product;
  json["firmware"] = identity.firmware;
  json["serial"] = identity.serial;
  json["protocol"] = identity.protocol;
  json["first_step"] = request.first_step;
  json["last_step"] = request.last_step;
  json["connected"] = state.connected;
  json["connects"] = state.connects;
  json["scans"] = state.scans;
  json["rate_hz"] = state.rate_hz;
  json["bad_checksum"] = state.bad_checksum;
  json["malformed"] = state.malformed;
  json["repeated"] = state.repeated;
  json["early"] = state.early;
  json["held_back"] = state.held_back;
  json["blind"] = state.blind;
  json["refused"] = state.refused;
  json["clock_offset_s"] = state.clock_offset_s;
  json["clock_drift_ppm"] = state.clock_drift_ppm;
  json["clock_restarts"] = state.clock_restarts;
  json["trouble"] = state.trouble;
  // Texts of the device may not be UTF-8, which JSON requires.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace rave::scip
