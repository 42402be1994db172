// SPDX-License-Identifier: Apache-2.0
#include "commands/info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "error_text.hpp"
#include "places.hpp"
#include "rave/base/table.hpp"
#include "rave/record/record_summary.hpp"

namespace rave::cli {
namespace {

std::string size_text(std::uint64_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3);
  if (bytes < 1'000'000'000) return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
  return fmt::format("{:.2f} GB", static_cast<double>(bytes) / 1e9);
}

/// A file may be closed in order by a run that broke off.
bool has_end(const record::RecordSummary& summary) { return !summary.run || summary.end; }

/// Whether nothing is wrong as far as was looked.
bool is_good(const record::RecordSummary& summary) {
  return summary.ended && has_end(summary) && summary.damages.empty() && summary.unsummed.empty() &&
         summary.missing.empty() && summary.lost.empty();
}

/// Only of a record of which every byte was looked at it is said that it is whole.
std::string state_text(const record::RecordSummary& summary) {
  if (!summary.ended) return "truncated; the part that exists is readable";
  if (!summary.damages.empty()) return "damaged";
  if (!summary.lost.empty()) return "not as RAVE wrote it";
  if (!has_end(summary)) return "without the end of its run";
  if (!summary.unsummed.empty()) return "partly checked: some parts have no checksum";
  return summary.checked ? "complete: all checksums are correct"
                         : "complete according to its index; --check verifies the checksums";
}

std::string run_text(const record::RecordSummary& summary) {
  if (!summary.run) {
    return summary.damages.empty() && summary.lost.empty()
               ? "not written by RAVE\n"
               : "the description of the run is not readable\n";
  }
  const record::RunInfo& run = *summary.run;
  const auto real = static_cast<std::size_t>(
      std::count_if(run.robots.begin(), run.robots.end(),
                    [](const record::RecordedRobot& robot) { return robot.kind == "real"; }));
  std::string text =
      fmt::format("{}, seed {}, started {}\n{} robots: {} real, {} simulated\n", run.scenario,
                  run.seed, run.started, run.robots.size(), real, run.robots.size() - real);
  if (!summary.end && !summary.missing.empty()) {
    return text + "the end of the run is unknown, because a part of the recording is missing\n";
  }
  if (!summary.end && summary.ended && !summary.damages.empty()) {
    return text + "the end of the run is not readable\n";
  }
  if (!summary.end) return text + "the run was cut off before its end\n";
  text += fmt::format("{} steps of {} s", summary.end->steps, run.step_s);
  return text + (summary.end->hash ? fmt::format(", run hash {:016x}\n", *summary.end->hash)
                                   : ", live: no run hash\n");
}

nlohmann::ordered_json run_json(const record::RunInfo& run) {
  nlohmann::ordered_json json = {{"scenario", run.scenario},
                                 {"started", run.started},
                                 {"seed", run.seed},
                                 {"step_s", run.step_s},
                                 {"versions", run.versions},
                                 {"inputs", run.inputs},
                                 {"robots", nlohmann::ordered_json::array()}};
  std::map<RobotId, nlohmann::ordered_json> sensors;
  for (const record::RecordedSensor& sensor : run.sensors) {
    sensors[sensor.robot].push_back(sensor.name);
  }
  for (const record::RecordedRobot& robot : run.robots) {
    json["robots"].push_back(
        {{"name", robot.name},
         {"kind", robot.kind},
         {"team", robot.team},
         {"sensors",
          sensors.contains(robot.id) ? sensors[robot.id] : nlohmann::ordered_json::array()}});
  }
  return json;
}

nlohmann::ordered_json info_json(const std::filesystem::path& file,
                                 const record::RecordSummary& summary) {
  nlohmann::ordered_json json = {{"file", file.string()},
                                 {"bytes", summary.file_bytes},
                                 {"chunks", summary.chunks},
                                 {"parts", summary.parts},
                                 {"missing", summary.missing},
                                 {"lost", summary.lost},
                                 {"checked", summary.checked},
                                 {"whole", nullptr},
                                 {"damages", summary.damages},
                                 {"unsummed", summary.unsummed},
                                 {"run", summary.run ? run_json(*summary.run) : nullptr},
                                 {"steps", nullptr},
                                 {"hash", nullptr}};
  if (!summary.ended || !summary.damages.empty() || !summary.missing.empty() ||
      !summary.lost.empty() || !has_end(summary)) {
    // Null, as above, for what was not checked: neither word would be true.
    json["whole"] = false;
  } else if (summary.checked && summary.unsummed.empty()) {
    json["whole"] = true;
  }
  if (summary.end) {
    json["steps"] = summary.end->steps;
    if (summary.end->hash) json["hash"] = fmt::format("{:016x}", *summary.end->hash);
  }
  json["start_s"] = summary.start_s;
  json["end_s"] = summary.end_s;
  json["messages"] = summary.messages;
  json["hybrids"] = summary.hybrids;
  json["channels"] = nlohmann::ordered_json::array();
  for (const record::ChannelSummary& channel : summary.channels) {
    json["channels"].push_back({{"topic", channel.topic},
                                {"type", channel.schema},
                                {"encoding", channel.encoding},
                                {"messages", channel.messages},
                                {"rate_hz", channel.rate_hz}});
  }
  return json;
}

std::string info_text(const record::RecordSummary& summary) {
  std::string text = run_text(summary);
  text += fmt::format("{} messages from {:.2f} to {:.2f} s, {} in {} chunks, {}\n",
                      summary.messages, summary.start_s, summary.end_s,
                      size_text(summary.file_bytes), summary.chunks, state_text(summary));
  for (const auto& [sensor, made_of] : summary.hybrids) {
    text += fmt::format("hybrid {}: {}; both parts and the result are recorded\n", sensor, made_of);
  }
  if (!summary.parts.empty()) {
    text += fmt::format("merged from the recordings of {} processes\n", summary.parts.size());
  }
  for (const std::string& part : summary.lost) text += fmt::format("lost: {}\n", part);
  for (const std::string& damage : summary.damages) text += fmt::format("damaged: {}\n", damage);
  for (const std::string& piece : summary.unsummed) text += fmt::format("not checked: {}\n", piece);
  Table table;
  table.columns = {{"topic"}, {"type"}, {"messages", Align::kRight}, {"rate", Align::kRight}};
  for (const record::ChannelSummary& channel : summary.channels) {
    table.rows.push_back({channel.topic, channel.schema, fmt::format("{}", channel.messages),
                          fmt::format("{:.1f} Hz", channel.rate_hz)});
  }
  return text + render_table(table);
}

}  // namespace

Result<int> info(const InfoCommand& options) {
  RAVE_TRY_ASSIGN(const auto file, record_file(options.file));
  RAVE_TRY_ASSIGN(const auto summary,
                  record::describe_record(
                      file, options.check ? record::RecordLook::kAll : record::RecordLook::kIndex));
  put(stdout, options.json ? info_json(file, summary).dump(2) + "\n" : info_text(summary));
  // Scripts ask with the exit code whether a recording can be relied on.
  return is_good(summary) ? kGood : kNotGood;
}

}  // namespace rave::cli
