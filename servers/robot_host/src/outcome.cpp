// SPDX-License-Identifier: Apache-2.0
#include "outcome.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "event_words.hpp"
#include "radio_report.hpp"
#include "rave/base/names.hpp"
#include "rave/report/table.hpp"

namespace rave::robot_host {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, double unit) { return std::round(value / unit) * unit; }

/// Events that mean that something of the run was lost.
bool is_loss(sim::EventKind kind) {
  return kind == sim::EventKind::kProgramFailed || kind == sim::EventKind::kDriverFailed;
}

std::size_t count_events(const Findings& findings, sim::EventKind kind) {
  return static_cast<std::size_t>(
      std::count_if(findings.events.begin(), findings.events.end(),
                    [kind](const sim::Event& event) { return event.kind == kind; }));
}

Json tally_json(const SightingTally& tally) {
  return {{"total", tally.total},
          {"unknown", tally.unknown},
          {"within", tally.within},
          {"within_pct", rounded(tally.within_pct(), 0.01)}};
}

Json sightings_json(const SightingCheck& check) {
  Json json = tally_json(check.all());
  json["limits"] = {{"range_m", check.limits().range_m},
                    {"bearing_deg", check.limits().bearing_deg},
                    {"min_within_pct", check.limits().min_within_pct}};
  json["holds"] = check.holds();
  json["robots"] = Json::object();
  for (const auto& [robot, tally] : check.by_robot()) json["robots"][robot] = tally_json(tally);
  json["unknown_codes"] = Json::array();
  for (const auto& [code, count] : check.unknown_codes()) {
    json["unknown_codes"].push_back({{"code", code}, {"count", count}});
  }
  return json;
}

Json encounters_json(const Findings& findings) {
  Json json = Json::object();
  for (const auto& [pair, encounter] : findings.encounters.closest()) {
    json[pair] = {
        {"gap_m", rounded(encounter.gap_m, 1e-4)},
        {"centres_m", rounded(encounter.centres_m, 1e-4)},
        {"time_s", encounter.time_s},
        {"between", {findings.kinds.name(encounter.a), findings.kinds.name(encounter.b)}}};
  }
  return json;
}

/// A driver's text is not ours: what is no JSON object is kept as text. What its data calls its
/// robot need not be what the scenario calls it.
void add_report(const std::string& text, Json& entry) {
  const Json report = Json::parse(text, nullptr, false);
  if (!report.is_object()) {
    entry["report"] = text;
    return;
  }
  for (const auto& [key, value] : report.items()) {
    entry[entry.contains(key) ? "source_" + key : key] = value;
  }
}

/// What the hardware that robots share between sensors and actuators says of itself.
Json devices_json(const Findings& findings) {
  Json json = Json::array();
  const sim::EngineSpec& spec = findings.engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    for (std::uint32_t d = 0; d < type.devices.size(); ++d) {
      Json device = {{"robot", spec.robots[r].name},
                     {"device", type.devices[d].name},
                     {"driver", type.devices[d].driver}};
      add_report(findings.engine.device_report(RobotId(r), d), device);
      json.push_back(std::move(device));
    }
  }
  return json;
}

/// What the drivers of real sensors say of their streams.
Json streams_json(const Findings& findings) {
  Json json = Json::array();
  const sim::EngineSpec& spec = findings.engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
      if (type.sensors[s].hardware_ops == nullptr) continue;
      Json stream = {{"robot", spec.robots[r].name},
                     {"sensor", type.sensors[s].name},
                     {"driver", type.sensors[s].driver}};
      add_report(findings.engine.sensor_report(RobotId(r), s), stream);
      json.push_back(std::move(stream));
    }
  }
  return json;
}

Json robots_json(const Findings& findings) {
  Json json = Json::array();
  const sim::EngineSpec& spec = findings.engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    const sim::ReportedPose& reported = findings.engine.reported(RobotId(r));
    Json robot = {{"name", spec.robots[r].name},
                  {"reality", type.simulated ? "simulated" : "real"},
                  {"program", type.program ? type.program->driver : ""},
                  {"commands", findings.engine.commands_given(RobotId(r))},
                  {"obeys", findings.engine.obeys(RobotId(r))},
                  {"way_m", rounded(findings.tracks.way_m()[r], 1e-3)}};
    robot["final_pose"] = {{"x_m", rounded(reported.pose.x_m, 1e-4)},
                           {"y_m", rounded(reported.pose.y_m, 1e-4)},
                           {"yaw_rad", rounded(reported.pose.yaw_rad, 1e-4)},
                           {"stamp_s", reported.stamp.seconds()},
                           {"stale", reported.stale}};
    json.push_back(std::move(robot));
  }
  return json;
}

Json events_json(const Findings& findings) {
  Json json = Json::object();
  for (const auto kind : {sim::EventKind::kContact,         sim::EventKind::kPinned,
                          sim::EventKind::kPoseStale,       sim::EventKind::kPoseBack,
                          sim::EventKind::kProgramFailed,   sim::EventKind::kDriverFailed,
                          sim::EventKind::kDriverBack,      sim::EventKind::kGuardSlowed,
                          sim::EventKind::kGuardStopped,    sim::EventKind::kStopped,
                          sim::EventKind::kReleased,        sim::EventKind::kArmed,
                          sim::EventKind::kChanged,         sim::EventKind::kChangeRefused,
                          sim::EventKind::kObstacleAdded,   sim::EventKind::kObstacleMoved,
                          sim::EventKind::kObstacleRemoved, sim::EventKind::kCaptured,
                          sim::EventKind::kHandedOver,      sim::EventKind::kHandOverRefused,
                          sim::EventKind::kShadowReset}) {
    std::string name(to_string(kind));
    std::replace(name.begin(), name.end(), ' ', '_');
    json[name] = count_events(findings, kind);
  }
  return json;
}

/// What the guards did: `slowed 3x by fence, stopped 1x by pose lost`; by robot.
std::map<std::string, std::map<std::string, std::size_t>> guard_counts(const Findings& findings) {
  std::map<std::string, std::map<std::string, std::size_t>> counts;
  for (const sim::Event& event : findings.events) {
    const bool slowed = event.kind == sim::EventKind::kGuardSlowed;
    if (!slowed && event.kind != sim::EventKind::kGuardStopped) continue;
    const std::string_view limit = to_string(static_cast<sim::GuardLimit>(event.detail));
    ++counts[findings.engine.spec().robots[event.robot.value()].name]
            [fmt::format("{} by {}", slowed ? "slowed" : "stopped", limit)];
  }
  return counts;
}

void add_guard_row(const Findings& findings, report::Table& table) {
  std::map<std::string, std::size_t> total;
  for (const auto& [robot, counts] : guard_counts(findings)) {
    for (const auto& [what, count] : counts) total[what] += count;
  }
  std::string text;
  for (const auto& [what, count] : total) {
    const std::size_t space = what.find(' ');
    text += fmt::format("{}{} {}x{}", text.empty() ? "" : ", ", what.substr(0, space), count,
                        what.substr(space));
  }
  if (!text.empty()) table.rows.push_back({"guard", text});
}

Json capture_json(const Findings& findings) {
  const sim::EngineSpec& spec = findings.engine.spec();
  Json json = {{"within_m", findings.capture->check().within_m},
               {"holds", findings.capture->holds()},
               {"captured_at_s", nullptr},
               {"captures", Json::array()}};
  if (findings.capture->closest_m() < 1e9) {
    json["closest_m"] = rounded(findings.capture->closest_m(), 1e-4);
  }
  for (const Capture& capture : findings.capture->captures()) {
    if (json["captured_at_s"].is_null()) json["captured_at_s"] = capture.time_s;
    json["captures"].push_back({{"predator", spec.robots[capture.predator.value()].name},
                                {"prey", spec.robots[capture.prey.value()].name},
                                {"time_s", capture.time_s},
                                {"gap_m", rounded(capture.gap_m, 1e-4)}});
  }
  return json;
}

void add_capture_rows(const Findings& findings, report::Table& table) {
  if (findings.capture == nullptr) return;
  const sim::EngineSpec& spec = findings.engine.spec();
  for (const Capture& capture : findings.capture->captures()) {
    table.rows.push_back(
        {"captured", fmt::format("{} by {} at {:.2f} s", spec.robots[capture.prey.value()].name,
                                 spec.robots[capture.predator.value()].name, capture.time_s)});
  }
  if (findings.capture->captures().empty()) {
    table.rows.push_back(
        {"captured", fmt::format("nobody; nearest {:.2f} m", findings.capture->closest_m())});
  }
}

/// Changes while the run went, with their times.
Json changes_json(const Findings& findings) {
  Json json = Json::array();
  const sim::EngineSpec& spec = findings.engine.spec();
  for (const sim::Event& event : findings.events) {
    if (event.kind != sim::EventKind::kChanged && event.kind != sim::EventKind::kChangeRefused &&
        !is_of_obstacle(event.kind)) {
      continue;
    }
    json.push_back({{"time_s", static_cast<double>(event.step) * spec.step.seconds()},
                    {"robot", event.robot.valid() ? Json(subject_of(spec, event)) : Json()},
                    {"made", event.kind != sim::EventKind::kChangeRefused},
                    {"what", event.text}});
  }
  return json;
}

/// What became of each hand-over, and of shadows; nothing for a scenario without twins.
void add_hand_overs(const Findings& findings, Json& json) {
  const sim::EngineSpec& spec = findings.engine.spec();
  const bool twins = std::any_of(spec.robots.begin(), spec.robots.end(),
                                 [](const auto& robot) { return robot.twin.has_value(); });
  if (!twins) return;
  json["hand_overs"] = Json::array();
  for (const sim::Event& event : findings.events) {
    const bool made = event.kind == sim::EventKind::kHandedOver;
    if (!made && event.kind != sim::EventKind::kHandOverRefused) continue;
    json["hand_overs"].push_back({{"time_s", static_cast<double>(event.step) * spec.step.seconds()},
                                  {"robot", subject_of(spec, event)},
                                  {"made", made},
                                  {"what", event.text}});
  }
  if (findings.shadows != nullptr) json["shadows"] = Json::parse(findings.shadows->json());
}

std::size_t count_real(const Findings& findings) {
  const sim::EngineSpec& spec = findings.engine.spec();
  return static_cast<std::size_t>(std::count_if(
      spec.robots.begin(), spec.robots.end(),
      [&](const sim::RobotSpec& robot) { return !spec.types[robot.type].simulated; }));
}

/// Simulated time that was run through.
double done_s(const Findings& findings) {
  return static_cast<double>(findings.engine.steps_done()) * findings.engine.spec().step.seconds();
}

/// Real robots whose commands went nowhere, as `a, b and c`.
std::string disobedient(const Findings& findings) {
  std::vector<std::string_view> names;
  const sim::EngineSpec& spec = findings.engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    const bool commanded = findings.engine.commands_given(RobotId(r)) > 0;
    if (commanded && !findings.engine.obeys(RobotId(r))) names.emplace_back(spec.robots[r].name);
  }
  return names.empty() ? std::string() : join_names(names);
}

void add_encounter_rows(const Findings& findings, report::Table& table) {
  for (const auto& [pair, encounter] : findings.encounters.closest()) {
    table.rows.push_back(
        {fmt::format("closest {}", pair),
         fmt::format("{:.3f} m between outlines at {:.2f} s ({} and {})",
                     std::max(encounter.gap_m, 0.0), encounter.time_s,
                     findings.kinds.name(encounter.a), findings.kinds.name(encounter.b))});
  }
}

void add_hit_rows(const Findings& findings, report::Table& table) {
  for (const auto& [who, counts] : findings.hits.counts()) {
    std::string text;
    for (const auto& [what, count] : counts) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", what, count);
    }
    table.rows.push_back({fmt::format("rays of {} robots met", who), text});
  }
}

}  // namespace

RunOutcome judge(const Findings& findings) {
  RunOutcome outcome;
  if (findings.ended_early) outcome.problems.emplace_back("the run was ended early");
  if (!findings.record_problem.empty()) outcome.problems.push_back(findings.record_problem);
  const sim::EngineSpec& spec = findings.engine.spec();
  for (const sim::Event& event : findings.events) {
    if (!is_loss(event.kind)) continue;
    outcome.problems.push_back(
        fmt::format("robot `{}` at {:.2f} s: {}", spec.robots[event.robot.value()].name,
                    static_cast<double>(event.step) * spec.step.seconds(), event.text));
  }
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    if (findings.engine.reported(RobotId(r)).known) continue;
    outcome.problems.push_back(
        fmt::format("robot `{}` never said where it is", spec.robots[r].name));
  }
  for (const sim::Event& event : findings.events) {
    if (event.kind != sim::EventKind::kChangeRefused) continue;
    outcome.problems.push_back(fmt::format("the change at {:.2f} s was refused: {}",
                                           static_cast<double>(event.step) * spec.step.seconds(),
                                           event.text));
  }
  for (const sim::Event& event : findings.events) {
    // Whoever asked by hand has been told.
    const bool scheduled = !event.text.ends_with("(by hand)");
    if (event.kind != sim::EventKind::kHandOverRefused || !scheduled) continue;
    outcome.problems.push_back(fmt::format(
        "robot `{}` at {:.2f} s was not handed over: {}", spec.robots[event.robot.value()].name,
        static_cast<double>(event.step) * spec.step.seconds(), event.text));
  }
  outcome.whole = outcome.problems.empty();
  if (findings.capture != nullptr && !findings.capture->holds()) {
    outcome.checks_hold = false;
    outcome.problems.push_back(
        fmt::format("the capture check fails: nobody was captured before "
                    "{} s",
                    *findings.capture->check().before_s));
  }
  if (findings.sightings != nullptr && !findings.sightings->holds()) {
    outcome.checks_hold = false;
    const SightingTally& tally = findings.sightings->all();
    outcome.problems.push_back(fmt::format(
        "the sighting check fails: {} of {} real sightings ({:.2f} %) agree with the virtual "
        "camera within {} m and {} degrees; expected at least {} %",
        tally.within, tally.total, tally.within_pct(), findings.sightings->limits().range_m,
        findings.sightings->limits().bearing_deg, findings.sightings->limits().min_within_pct));
  }
  for (const CheckResult& check : findings.goals) {
    if (check.holds) continue;
    outcome.checks_hold = false;
    outcome.problems.push_back(fmt::format("a check fails: {}: {}", check.name, check.text));
  }
  if (findings.built.live_reason.empty()) {
    outcome.hash = fmt::format("{:016x}", findings.engine.hash().value());
  }
  return outcome;
}

std::string result_json(const Findings& findings, const RunOutcome& outcome) {
  const config::ScenarioFile& scenario = findings.scenario.scenario;
  Json json;
  json["scenario"] = scenario.name.value;
  json["whole"] = outcome.whole;
  json["checks_hold"] = outcome.checks_hold;
  json["problems"] = outcome.problems;
  json["seed"] = scenario.seed;
  json["step_s"] = scenario.step_s.value;
  json["steps"] = findings.engine.steps_done();
  json["simulated_s"] = done_s(findings);
  json["wall_s"] = rounded(findings.wall_s, 1e-3);
  json["threads"] = findings.engine.spec().threads;
  json["hash"] = outcome.hash.empty() ? Json(nullptr) : Json(outcome.hash);
  if (!findings.built.live_reason.empty()) json["no_hash_because"] = findings.built.live_reason;
  if (findings.sightings != nullptr) json["sightings"] = sightings_json(*findings.sightings);
  json["checks"] = Json::array();
  for (const CheckResult& check : findings.goals) {
    json["checks"].push_back({{"check", check.name}, {"holds", check.holds}, {"text", check.text}});
  }
  json["hits"] = findings.hits.counts();
  json["closest"] = encounters_json(findings);
  json["events"] = events_json(findings);
  if (has_radio(findings.engine.spec())) json["radio"] = radio_json(findings.engine);
  json["guard"] = guard_counts(findings);
  json["changes"] = changes_json(findings);
  add_hand_overs(findings, json);
  json["inputs_by_hand"] = findings.engine.inputs_by_hand();
  if (findings.capture != nullptr) json["capture"] = capture_json(findings);
  json["robots"] = robots_json(findings);
  json["devices"] = devices_json(findings);
  json["streams"] = streams_json(findings);
  return json.dump(2) + "\n";
}

std::string summary_text(const Findings& findings, const RunOutcome& outcome) {
  report::Table table;
  table.title = findings.scenario.scenario.name.value;
  table.columns = {{"what", report::Align::kLeft, false}, {"result", report::Align::kLeft, true}};
  const std::size_t count = findings.engine.spec().robots.size();
  const std::size_t real = count_real(findings);
  const double simulated_s = done_s(findings);
  table.rows.push_back(
      {"robots", fmt::format("{}: {} real, {} simulated", count, real, count - real)});
  table.rows.push_back(
      {"time", fmt::format("{:.2f} s simulated in {:.2f} s ({:.1f}x)", simulated_s, findings.wall_s,
                           simulated_s / std::max(findings.wall_s, 1e-9))});
  if (findings.sightings != nullptr) {
    const SightingTally& tally = findings.sightings->all();
    table.rows.push_back(
        {"sighting check",
         fmt::format("{}: {:.2f} % of {} real sightings agree with the virtual camera ({} with "
                     "unknown codes)",
                     findings.sightings->holds() ? "holds" : "FAILS", tally.within_pct(),
                     tally.total, tally.unknown)});
  }
  for (const CheckResult& check : findings.goals) {
    table.rows.push_back(
        {check.name, fmt::format("{}: {}", check.holds ? "holds" : "FAILS", check.text)});
  }
  table.rules_before.push_back(table.rows.size());
  add_encounter_rows(findings, table);
  table.rules_before.push_back(table.rows.size());
  add_hit_rows(findings, table);
  table.rules_before.push_back(table.rows.size());
  table.rows.push_back(
      {"contacts, pins", fmt::format("{}, {}", count_events(findings, sim::EventKind::kContact),
                                     count_events(findings, sim::EventKind::kPinned))});
  if (has_radio(findings.engine.spec())) {
    table.rows.push_back({"messages", radio_line(findings.engine.radio_counts())});
  }
  add_guard_row(findings, table);
  add_capture_rows(findings, table);
  if (const auto by_hand = findings.engine.inputs_by_hand(); by_hand > 0) {
    table.rows.push_back({"changed by hand", fmt::format("{} inputs; the scenario alone gives "
                                                         "another run",
                                                         by_hand)});
  }
  const std::string deaf = disobedient(findings);
  if (!deaf.empty()) {
    table.rows.push_back({"did not obey", deaf + ": a recording cannot; its commands were logged"});
  }
  table.rows.push_back(
      {"run hash", outcome.hash.empty() ? "none: " + findings.built.live_reason : outcome.hash});
  for (const std::string& problem : outcome.problems) table.rows.push_back({"problem", problem});
  return report::render_table(table, {100, false});
}

report::Picture make_picture(const Findings& findings, const RunOutcome& outcome) {
  report::Picture picture;
  const config::ScenarioFile& scenario = findings.scenario.scenario;
  picture.title = scenario.picture && !scenario.picture->title.empty() ? scenario.picture->title
                                                                       : scenario.name.value;
  const std::size_t count = findings.engine.spec().robots.size();
  const std::size_t real = count_real(findings);
  picture.subtitle = fmt::format("{} real and {} simulated robots in one world, {:.0f} s", real,
                                 count - real, done_s(findings));
  if (findings.sightings != nullptr) {
    const SightingTally& tally = findings.sightings->all();
    picture.caption.push_back(
        fmt::format("{:.2f} % of {} real camera sightings agree with the virtual camera within "
                    "{} m and {}\u00b0.",
                    tally.within_pct(), tally.total, findings.sightings->limits().range_m,
                    findings.sightings->limits().bearing_deg));
  }
  if (!outcome.hash.empty()) picture.caption.push_back("Run hash " + outcome.hash);
  const world::WorldModel& world = findings.engine.spec().world;
  for (std::size_t number = 0; number < world.obstacle_count(); ++number) {
    const std::uint32_t body = world.obstacle_id(number);
    const world::Obstacle& obstacle = *world.obstacle(body);
    if (obstacle.removed) continue;
    for (std::size_t i = 0; i < obstacle.body.shapes.size(); ++i) {
      report::PictureBody shown;
      shown.outline_W = outline_of(obstacle.body.shapes[i], obstacle.X_WB);
      shown.kind = findings.kinds.kind(body);
      // Tubes are known by their number, walls of a map are too many to be named.
      if (i == 0 && shown.kind == report::Kind::kLandmark) {
        const std::size_t dash = obstacle.body.name.rfind('-');
        shown.label =
            dash == std::string::npos ? obstacle.body.name : obstacle.body.name.substr(dash + 1);
      } else if (i == 0 && shown.kind == report::Kind::kVirtualObstacle) {
        shown.label = obstacle.body.name;
      }
      shown.colour = obstacle.body.colour;
      picture.bodies.push_back(std::move(shown));
    }
  }
  picture.tracks = findings.tracks.tracks();
  if (findings.instant != nullptr) picture.instant = findings.instant->instant();
  return picture;
}

}  // namespace rave::robot_host
