// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "rave/observe/event_words.hpp"
#include "rave/results/capture_watch.hpp"
#include "rave/results/map_result.hpp"
#include "rave/results/outcome.hpp"
#include "rave/results/result_parts.hpp"
#include "rave/results/sighting_check.hpp"

namespace rave::runtime {
namespace {

using Json = nlohmann::ordered_json;

/// `digits` decimals. The quotient by a power of ten is the double nearest to the decimal, which
/// prints without further digits; a product by 0.001 is not.
double rounded(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

Json tally_json(const SightingTally& tally) {
  return {{"total", tally.total},
          {"unknown", tally.unknown},
          {"within", tally.within},
          {"within_pct", rounded(tally.within_pct(), 2)}};
}

Json sightings_json(const config::SightingsCheckFile& limits, const SightingFacts& facts,
                    bool whole) {
  const SightingTally all = facts.all();
  Json json = tally_json(all);
  // Robots may misread a code occasionally; so the limit is applied to all readings together.
  json["counted"] = counted(limits, all);
  json["within_pct"] = rounded(within_pct(limits, all), 2);
  json["limits"] = {{"range_m", limits.range_m},
                    {"bearing_deg", limits.bearing_deg},
                    {"min_within_pct", limits.min_within_pct},
                    {"min_compared", limits.min_compared},
                    {"max_unknown", limits.max_unknown}};
  json["holds"] = whole ? Json(holds(limits, all)) : Json();
  json["robots"] = Json::object();
  for (const auto& [robot, tally] : facts.by_robot) json["robots"][robot] = tally_json(tally);
  json["unknown_codes"] = Json::array();
  for (const auto& [code, count] : facts.unknown_codes) {
    json["unknown_codes"].push_back({{"code", code}, {"count", count}});
  }
  return json;
}

Json encounters_json(const RunResults& results) {
  Json json = Json::object();
  for (const auto& [pair, encounter] : results.facts.closest) {
    json[pair] = {{"gap_m", rounded(encounter.gap_m, 4)},
                  {"centres_m", rounded(encounter.centres_m, 4)},
                  {"time_s", encounter.time_s},
                  {"between", {results.kinds.name(encounter.a), results.kinds.name(encounter.b)}}};
  }
  return json;
}

/// The report comes from a driver: text that is not a JSON object is kept as text. The data set may
/// use another name for the robot than the scenario.
void add_report(const std::string& text, Json& entry) {
  const Json report = Json::parse(text, nullptr, false);
  if (!report.is_object()) {
    entry["report"] = text;
    return;
  }
  for (const auto& [key, value] : report.items()) {
    // The driver cannot overwrite the names that the scenario gives.
    entry[entry.contains(key) ? "source_" + key : key] = value;
  }
}

/// The reports of the drivers of one kind of part; `part` is the key of its name in the JSON.
Json instruments_json(const RunResults& results, const std::vector<InstrumentFacts>& instruments,
                      const char* part) {
  Json json = Json::array();
  for (const InstrumentFacts& instrument : instruments) {
    Json entry = {{"robot", results.spec.robots[instrument.robot].name},
                  {part, instrument.name},
                  {"driver", instrument.driver}};
    add_report(instrument.report, entry);
    json.push_back(std::move(entry));
  }
  return json;
}

/// A transmitter's report comes from its driver: text that is not JSON is omitted.
Json robot_json(const RunResults& results, const RobotFacts& robot) {
  const sim::RobotSpec& spec = results.spec.robots[robot.robot];
  const bool simulated = results.spec.types[spec.type].simulated;
  Json json = {{"name", spec.name},        {"reality", simulated ? "simulated" : "real"},
               {"program", robot.program}, {"commands", robot.commands},
               {"obeys", robot.obeys},     {"way_m", rounded(robot.way_m, 3)}};
  json["final_pose"] = {{"x_m", rounded(robot.x_m, 4)},
                        {"y_m", rounded(robot.y_m, 4)},
                        {"yaw_rad", rounded(robot.yaw_rad, 4)},
                        {"stamp_s", SimTime{robot.stamp_ns}.seconds()},
                        {"stale", robot.stale}};
  return json;
}

Json robots_json(const RunResults& results) {
  Json json = Json::array();
  for (const RobotFacts& robot : results.facts.robots) {
    json.push_back(robot_json(results, robot));
  }
  return json;
}

/// For each host, the source of the facts about its robots.
Json hosts_json(const RunResults& results) {
  const auto value = [](const auto& optional) { return optional ? Json(*optional) : Json(); };
  Json json = Json::array();
  for (const HostShare& host : results.hosts) {
    Json entry = {{"name", host.name}, {"found", host.found}, {"folders", host.folders}};
    if (!results.live_reason.empty()) {
      if (host.heard) entry["heard"] = *host.heard;
      if (host.losses) entry["losses"] = *host.losses;
      entry["clock_offset_s"] = value(host.offset_s);
      entry["clock_bound_s"] = value(host.bound_s);
    }
    json.push_back(std::move(entry));
  }
  return json;
}

Json events_json(const RunResults& results) {
  Json json = Json::object();
  // Each run has all keys, with 0 for what did not happen.
  for (std::uint32_t number = 0; number < sim::kEventKindEnd; ++number) {
    const auto kind = static_cast<sim::EventKind>(number);
    if (to_string(kind) == "unknown") continue;
    std::string name(to_string(kind));
    // Keys of JSON without spaces are easier to use in queries.
    std::replace(name.begin(), name.end(), ' ', '_');
    json[name] = results.count(kind);
  }
  return json;
}

Json capture_json(const RunResults& results) {
  const sim::EngineSpec& spec = results.spec;
  const config::CaptureCheckFile& check = *results.scenario.scenario.checks.capture;
  Json json = {{"within_m", check.within_m},
               {"holds", nullptr},
               {"captured_at_s", nullptr},
               {"captures", Json::array()}};
  if (!results.facts.capture) return json;
  const CaptureFacts& facts = *results.facts.capture;
  // A capture that is known holds. Without one, an unknown beginning leaves the answer open (null).
  const std::vector<sim::Event>& events = results.facts.events;
  const bool held = holds(check, facts, events, spec.step);
  if (held || results.facts.world_from == 0) json["holds"] = held;
  if (facts.closest_m.value_or(1e9) < 1e9) json["closest_m"] = rounded(*facts.closest_m, 4);
  for (const Capture& capture : facts.captures) {
    if (json["captured_at_s"].is_null()) json["captured_at_s"] = capture.time_s;
    json["captures"].push_back({{"predator", spec.robots[capture.predator.value()].name},
                                {"prey", spec.robots[capture.prey.value()].name},
                                {"time_s", capture.time_s},
                                {"gap_m", rounded(capture.gap_m, 4)}});
    for (const RobotId robot : lost_poses(capture, events, spec.step)) {
      json["captures"].back()["lost_poses"].push_back(spec.robots[robot.value()].name);
    }
  }
  return json;
}

/// The changes made during the run, with their times.
Json changes_json(const RunResults& results) {
  Json json = Json::array();
  const sim::EngineSpec& spec = results.spec;
  for (const sim::Event& event : results.facts.events) {
    if (event.kind != sim::EventKind::kChanged && event.kind != sim::EventKind::kChangeRefused &&
        !is_of_obstacle(event.kind)) {
      continue;
    }
    json.push_back({{"time_s", results.time_s(event)},
                    {"robot", event.robot.valid() ? Json(subject_of(spec, event)) : Json()},
                    {"made", event.kind != sim::EventKind::kChangeRefused},
                    {"what", event.text}});
  }
  return json;
}

/// The outcome of each hand-over, and the shadows; nothing is added for a scenario without twins.
void add_hand_overs(const RunResults& results, Json& json) {
  const sim::EngineSpec& spec = results.spec;
  const bool twins = std::any_of(spec.robots.begin(), spec.robots.end(),
                                 [](const auto& robot) { return robot.twin.has_value(); });
  if (!twins) return;
  json["hand_overs"] = Json::array();
  for (const sim::Event& event : results.facts.events) {
    const bool made = event.kind == sim::EventKind::kHandedOver;
    if (!made && event.kind != sim::EventKind::kHandOverRefused) continue;
    json["hand_overs"].push_back({{"time_s", results.time_s(event)},
                                  {"robot", subject_of(spec, event)},
                                  {"made", made},
                                  {"what", event.text}});
  }
  if (!results.facts.shadows.empty()) json["shadows"] = shadows_json(results.facts.shadows);
}

void add_edits(const SharedEdits& edits, Json& json) {
  const auto confirmed = static_cast<double>(edits.confirmed);
  const bool measured = edits.confirmed > 0;
  json["edits"] = edits.made;
  json["edits_confirmed_by_all"] = edits.confirmed;
  json["edit_slowest_s"] = measured ? Json(edits.slowest_s) : Json();
  json["edit_mean_s"] = measured ? Json(edits.sum_s / confirmed) : Json();
}

void add_poses(const PoseDelayFacts& poses, Json& json) {
  const bool measured = poses.count > 0;
  json["poses_of_others"] = poses.count;
  json["pose_slowest_s"] = measured ? Json(1e-9 * static_cast<double>(poses.slowest_ns)) : Json();
  json["pose_mean_s"] =
      measured ? Json(1e-9 * static_cast<double>(poses.sum_ns) / static_cast<double>(poses.count))
               : Json();
}

double percent(std::size_t part, std::size_t all) {
  return all == 0 ? 0 : rounded(100 * static_cast<double>(part) / static_cast<double>(all), 2);
}

Json accuracy_json(const MapAccuracy& map) {
  return {{"known_m2", rounded(map.known_m2, 2)},
          {"free", map.free},
          {"free_right_pct", percent(map.free_right, map.free)},
          {"occupied", map.occupied},
          {"occupied_right_pct", percent(map.occupied_right, map.occupied)},
          {"wall_error_m", rounded(map.wall_error_m, 4)},
          {"undecided", map.undecided},
          {"unknown", map.unknown}};
}

/// The maps that programs kept, and their combination, against the world model.
void add_maps(const RunResults& results, Json& json) {
  const auto maps = map_results(results.spec, results.facts);
  if (!maps) return;
  Json& all = json["maps"];
  all["cell_m"] = maps->cell_m;
  for (const MapAccuracy& map : maps->locals) all["robots"][map.name] = accuracy_json(map);
  all["global"] = maps->global ? accuracy_json(*maps->global) : Json();
  if (!maps->problem.empty()) all["problem"] = maps->problem;
}

}  // namespace

std::string result_json(const RunResults& results, const RunOutcome& outcome) {
  const config::ScenarioFile& scenario = results.scenario.scenario;
  Json json;
  json["scenario"] = scenario.name.value;
  json["whole"] = outcome.whole;
  json["checks_hold"] = outcome.checks_hold;
  json["problems"] = outcome.problems;
  json["seed"] = scenario.seed;
  json["step_s"] = scenario.step_s.value;
  json["steps"] = results.facts.steps;
  // Contacts, changes of the world and captures before this step are unknown.
  if (results.facts.world_from > 0) json["world_from_step"] = results.facts.world_from;
  json["simulated_s"] = results.done_s();
  json["ended_by_hand_s"] =
      outcome.ended_by_hand_s ? Json(*outcome.ended_by_hand_s) : Json(nullptr);
  json["wall_s"] = rounded(results.wall_s, 3);
  json["lateness"] = lateness_json(results.facts.lateness);
  json["threads"] = results.spec.threads;
  json["hash"] = outcome.hash.empty() ? Json(nullptr) : Json(outcome.hash);
  if (outcome.hash.empty()) json["no_hash_because"] = why_no_hash(results, outcome);
  if (scenario.checks.sightings) {
    json["sightings"] =
        sightings_json(*scenario.checks.sightings,
                       results.facts.sightings.value_or(SightingFacts()), !results.any_lost());
  }
  json["checks"] = Json::array();
  for (const CheckResult& check : goal_results(results.scenario, results.spec, results.facts,
                                               results.lost, results.ended_by_hand)) {
    json["checks"].push_back({{"check", check.name},
                              {"holds", check.made ? Json(check.holds) : Json()},
                              {"text", check.text}});
  }
  json["hits"] = results.facts.hits;
  json["closest"] = encounters_json(results);
  json["events"] = events_json(results);
  add_radio(results.spec, results.facts, json);
  json["guard"] = guard_counts(results);
  json["changes"] = changes_json(results);
  json["inputs_by_hand"] = results.facts.inputs_by_hand;
  add_hand_overs(results, json);
  if (scenario.checks.capture) json["capture"] = capture_json(results);
  json["robots"] = robots_json(results);
  add_maps(results, json);
  json["devices"] = instruments_json(results, results.facts.devices, "device");
  json["streams"] = instruments_json(results, results.facts.streams, "sensor");
  if (results.worlds) json["worlds"] = *results.worlds;
  if (results.states) json["states"] = *results.states;
  if (results.edits) {
    add_edits(*results.edits, json);
    add_poses(results.facts.poses, json);
  }
  if (!results.hosts.empty()) json["hosts"] = hosts_json(results);
  // Text from other processes may be invalid UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rave::runtime
