// SPDX-License-Identifier: Apache-2.0
#include "rave/watch/run_view.hpp"

#include <nlohmann/json.hpp>

#include "rave/base/json_text.hpp"

namespace rave::watch {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
// Unknown is null and never 0, so a script can tell the two apart. The keys are always there.
Json known(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json known(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json json_of(const HostView& host) {
  Json json;
  json["name"] = host.name;
  json["role"] = host.manager ? "manager" : "host";
  json["number"] = host.manager ? Json(nullptr) : Json(host.number);
  json["machine"] = known(host.machine);
  json["state"] = to_string(host.standing);
  json["process"] = known(host.process);
  json["robots"] = known(host.robots);
  json["real_robots"] = known(host.real_robots);
  json["step"] = known(host.step);
  json["rate_hz"] = known(host.rate_hz);
  json["asked_rate_hz"] = known(host.asked_rate_hz);
  json["age_s"] = known(host.age_s);
  json["delay_s"] = known(host.delay_s);
  json["round_trip_s"] = known(host.round_trip_s);
  json["clock_offset_s"] = known(host.offset_s);
  json["clock_bound_s"] = known(host.bound_s);
  json["lost"] = known(host.lost);
  json["refused"] = known(host.refused);
  json["missed_pct"] = known(host.missed_pct);
  json["worst_late_s"] = known(host.worst_late_s);
  json["behind_s"] = known(host.behind_s);
  json["late_phase"] = known(host.late_phase);
  json["cores"] = known(host.cores);
  json["memory_mb"] = known(host.memory_mb);
  return json;
}

Json json_of(const RobotView& robot) {
  Json json;
  json["number"] = robot.number;
  json["name"] = known(robot.name);
  json["team"] = known(robot.team);
  json["host"] = known(robot.host);
  json["driver"] = known(robot.driver);
  json["simulated"] = known(robot.simulated);
  json["stale"] = robot.stale;
  json["age_s"] = known(robot.age_s);
  json["rate_hz"] = known(robot.rate_hz);
  json["asked_rate_hz"] = known(robot.asked_rate_hz);
  json["x_m"] = known(robot.x_m);
  json["y_m"] = known(robot.y_m);
  json["yaw_rad"] = known(robot.yaw_rad);
  return json;
}

}  // namespace

std::string_view to_string(Standing standing) noexcept {
  constexpr std::string_view kWords[] = {"waiting", "here", "late", "gone", "dropped"};
  return kWords[static_cast<std::size_t>(standing)];
}

std::string_view to_string(Phase phase) noexcept {
  constexpr std::string_view kWords[] = {"unknown", "gathering", "running", "waits",
                                         "paused",  "ended",     "failed"};
  return kWords[static_cast<std::size_t>(phase)];
}

std::string_view to_string(Timing timing) noexcept {
  constexpr std::string_view kWords[] = {"unknown", "lock_step", "real_time", "one_process"};
  return kWords[static_cast<std::size_t>(timing)];
}

std::string to_json(const RunView& view) {
  Json json;
  json["rave_top"] = 1;
  json["run"] = view.run;
  json["scenario"] = known(view.scenario);
  json["timing"] = to_string(view.timing);
  json["phase"] = to_string(view.phase);
  json["text"] = view.text;
  json["step"] = known(view.step);
  json["steps"] = known(view.steps);
  json["time_s"] = known(view.time_s);
  json["duration_s"] = known(view.duration_s);
  json["speed"] = known(view.speed);
  json["hosts"] = Json::array();
  for (const HostView& host : view.hosts) json["hosts"].push_back(json_of(host));
  json["robots"] = Json::array();
  for (const RobotView& robot : view.robots) json["robots"].push_back(json_of(robot));
  // Names come from other processes and need not be UTF-8.
  return json_text(json) + "\n";
}

}  // namespace rave::watch
