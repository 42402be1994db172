// SPDX-License-Identifier: Apache-2.0
#include "utias/plugins/report_json.hpp"

#include <nlohmann/json.hpp>
#include <optional>

namespace rave::utias {
namespace {

using Json = nlohmann::ordered_json;

/// Divided, not multiplied by 1e-9: so that whole milliseconds print as such.
double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

Json stamp(const std::optional<std::int64_t>& ns) { return ns ? Json(seconds(*ns)) : Json(); }

Json gaps_of(const StreamReport& report) {
  Json list = Json::array();
  for (const Gap& gap : report.gaps) {
    list.push_back({{"start_s", seconds(gap.start_ns)},
                    {"length_s", seconds(gap.length_ns)},
                    {"kind", to_string(gap.kind)}});
  }
  return list;
}

Json repairs_of(const StreamReport& report) {
  Json list = Json::array();
  for (const Repair& repair : report.repairs) {
    list.push_back({{"what", to_string(repair.kind)},
                    {"count", repair.count},
                    {"first_line", repair.first_line}});
  }
  return list;
}

Json unknown_codes_of(const StreamReport& report) {
  Json list = Json::array();
  for (const UnknownCode& unknown : report.unknown_codes) {
    list.push_back({{"code", unknown.code}, {"count", unknown.count}});
  }
  return list;
}

}  // namespace

std::string report_json(const Playback& playback) {
  const StreamReport& report = playback.report();
  Json json;
  json["stream"] = to_string(report.kind);
  json["folder"] = playback.folder;
  json["file"] = report.file;
  json["sha256"] = report.sha256;
  json["unchanged"] = report.unchanged ? Json(*report.unchanged) : Json();
  json["robot"] = report.robot;
  json["start_s"] = seconds(playback.data.start_ns);
  json["end_s"] = seconds(playback.data.end_ns);
  json["clock_offset_s"] = playback.clock_offset_s;
  json["first_stamp_s"] = stamp(report.first_ns);
  json["last_stamp_s"] = stamp(report.last_ns);
  json["rows"] = report.rows;
  json["stamps"] = report.stamps;
  json["rate_hz"] = report.mean_rate_hz;
  json["gap_limit_s"] = seconds(report.gap_limit_ns);
  json["gaps"] = gaps_of(report);
  json["largest_age_s"] = seconds(report.largest_age_ns);
  json["repairs"] = repairs_of(report);
  json["unknown_codes"] = unknown_codes_of(report);
  // A folder's name may be no UTF-8, which JSON cannot hold.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace rave::utias
