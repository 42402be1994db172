// SPDX-License-Identifier: Apache-2.0
#include "carmen/plugins/play.hpp"

#include <nlohmann/json.hpp>

#include "rave/base/named_path.hpp"
#include "recording/report_json.hpp"

namespace rave::carmen {

Result<LogPlay> load_play(const HardwareSetup& setup, double range_max_m) {
  const Params params = setup.parameters();
  LogPlay play;
  play.path = params.text("log");
  play.options = recording::play_options(params);
  LoadOptions options;
  options.window = {play.options.start_s, play.options.end_s, 1.0};
  options.clock_offset_s = play.options.clock_offset_s;
  options.accept_cut = play.options.accept_cut;
  options.range_max_m = range_max_m;
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
  json["stamped_by"] = play.log.by_logger ? "logger_timestamp" : "ipc_timestamp";
  json["beams"] = play.log.beams;
  json["no_returns"] = play.log.no_returns;
  json["passed_over"] = play.log.passed_over;
  return recording::text_of(json);
}

}  // namespace rave::carmen
