// SPDX-License-Identifier: Apache-2.0
#include "carmen/plugins/play.hpp"

#include <nlohmann/json.hpp>

#include "carmen/notes.hpp"
#include "rave/base/named_path.hpp"
#include "rave/base/word_table.hpp"
#include "recording/report_json.hpp"

namespace rave::carmen {
namespace {

constexpr WordTable<StampedBy, 3> kClocks = {{{"ipc_timestamp", StampedBy::kMessage},
                                              {"logger_timestamp", StampedBy::kLogger},
                                              {"rate_hz", StampedBy::kRate}}};

}  // namespace

Result<LogPlay> load_play(const HardwareSetup& setup, const RangeLimits& limits) {
  const Params params = setup.parameters();
  LogPlay play;
  play.path = params.text("log");
  play.options = recording::play_options(params);
  LoadOptions options;
  options.window = {play.options.start_s, play.options.end_s, 1.0};
  options.clock_offset_s = play.options.clock_offset_s;
  options.accept_cut = play.options.accept_cut;
  options.side = params.text("laser") == "rear" ? LaserSide::kRear : LaserSide::kFront;
  options.range_max_m = limits.range_max_m;
  options.no_return_m = limits.no_return_m;
  options.rate_hz = params.number("rate_hz");
  RAVE_TRY_ASSIGN(play.log, load(named_path(setup.folder, play.path), options));
  return play;
}

std::string report_json(const LogPlay& play, std::string_view stream,
                        const recording::StreamReport& report) {
  nlohmann::ordered_json json;
  json["stream"] = stream;
  json["log"] = play.path;
  recording::add_file(json, report);
  recording::add_timing(json, report,
                        {play.log.start_ns, play.log.end_ns, play.options.clock_offset_s});
  json["message"] = play.log.message->name;
  json["stamped_by"] = kClocks.of(play.log.stamped_by);
  json["beams"] = play.log.beams;
  json["no_returns"] = play.log.no_returns;
  json["unknown_rays"] = play.log.unknown_rays;
  json["passed_over"] = nlohmann::ordered_json::object();
  for (const PassedOver& other : play.log.passed_over)
    json["passed_over"][other.name] = other.count;
  json["refusals"] = play.log.refusals;
  json["notes"] = notes(play.log, play.path, report);
  return recording::text_of(json);
}

}  // namespace rave::carmen
