// SPDX-License-Identifier: Apache-2.0
#include "utias/plugins/report_json.hpp"

#include <nlohmann/json.hpp>

#include "rave/base/word_table.hpp"
#include "recording/report_json.hpp"

namespace rave::utias {
namespace {

using Json = nlohmann::ordered_json;

constexpr WordTable<StreamKind, 3> kStreams = {{{"poses", StreamKind::kPoses},
                                                {"odometry", StreamKind::kOdometry},
                                                {"sightings", StreamKind::kSightings}}};

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
  json["stream"] = kStreams.of(report.kind);
  json["folder"] = playback.folder;
  recording::add_file(json, report);
  json["robot"] = report.robot;
  recording::add_timing(json, report,
                        {playback.data.start_ns, playback.data.end_ns, playback.clock_offset_s});
  json["unknown_codes"] = unknown_codes_of(report);
  return recording::text_of(json);
}

}  // namespace rave::utias
