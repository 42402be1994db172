// SPDX-License-Identifier: Apache-2.0
#include "status_json.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "rave/control/shadow_json.hpp"

namespace rave::control {
namespace {

Json hand_over_json(const runtime::RunStatus::HandOver& hand_over) {
  return {
      {"under_way", hand_over.under_way}, {"made", hand_over.made}, {"refused", hand_over.refused},
      {"last", hand_over.last},           {"x_m", hand_over.x_m},   {"y_m", hand_over.y_m},
      {"yaw_rad", hand_over.yaw_rad}};
}

Json lateness_json(const runtime::RunStatus::Lateness& late) {
  return {{"deadlines", late.deadlines},
          {"missed", late.missed},
          {"worst_s", late.worst_s},
          {"behind_s", late.behind_s},
          {"phase", late.phase}};
}

bool read_number(const Json& json, const char* key, double& value) {
  if (!json.contains(key) || !json.at(key).is_number()) return false;
  value = json.at(key).get<double>();
  return true;
}

bool read_count(const Json& json, const char* key, std::uint32_t& value) {
  if (!json.contains(key) || !json.at(key).is_number_unsigned()) return false;
  const auto whole = json.at(key).get<std::uint64_t>();
  value = static_cast<std::uint32_t>(whole);
  return whole <= UINT32_MAX;
}

bool read_count(const Json& json, const char* key, std::uint64_t& value) {
  if (!json.contains(key) || !json.at(key).is_number_unsigned()) return false;
  value = json.at(key).get<std::uint64_t>();
  return true;
}

bool read_lateness(const Json& json, runtime::RunStatus::Lateness& late) {
  return json.is_object() && read_count(json, "deadlines", late.deadlines) &&
         read_count(json, "missed", late.missed) && read_number(json, "worst_s", late.worst_s) &&
         read_number(json, "behind_s", late.behind_s) && read_text(json, "phase", late.phase);
}

bool read_hand_over(const Json& json, runtime::RunStatus::HandOver& hand_over) {
  return json.is_object() && read_bool(json, "under_way", hand_over.under_way) &&
         read_count(json, "made", hand_over.made) &&
         read_count(json, "refused", hand_over.refused) &&
         read_text(json, "last", hand_over.last) && read_number(json, "x_m", hand_over.x_m) &&
         read_number(json, "y_m", hand_over.y_m) && read_number(json, "yaw_rad", hand_over.yaw_rad);
}

/// Older processes do not say where it is.
bool read_offset(const Json& json, std::optional<Pose2>& offset_W) {
  if (!json.contains("offset")) return true;
  const Json& values = json.at("offset");
  const bool good = values.is_array() && values.size() == 3 &&
                    std::ranges::all_of(values, [](const Json& v) { return v.is_number(); });
  if (good) offset_W = Pose2{values[0], values[1], values[2]};
  return good;
}

bool read_shadow(const Json& json, runtime::RunStatus::Shadow& shadow) {
  bool good = json.is_object() && read_bool(json, "running", shadow.running) &&
              read_number(json, "since_s", shadow.since_s) && read_number(json, "m", shadow.m) &&
              read_number(json, "rad", shadow.rad) && read_number(json, "most_m", shadow.most_m) &&
              read_number(json, "most_rad", shadow.most_rad) &&
              read_offset(json, shadow.offset_W) && json.contains("readings") &&
              json.at("readings").is_array();
  if (!good) return false;
  for (const Json& item : json.at("readings")) {
    runtime::RunStatus::Shadow::Reading reading;
    good = good && item.is_object() && read_text(item, "sensor", reading.sensor) &&
           read_text(item, "unit", reading.unit) && read_number(item, "last", reading.last) &&
           read_number(item, "most", reading.most);
    shadow.readings.push_back(std::move(reading));
  }
  return good;
}

/// Who commands a robot and what; older processes do not report that.
bool read_orders(const Json& item, runtime::RunStatus::Robot& robot) {
  if (item.contains("lease") && !read_text(item, "lease", robot.lease)) return false;
  if (item.contains("lease_page") && !read_count(item, "lease_page", robot.lease_page))
    return false;
  if (item.contains("order") && !read_text(item, "order", robot.order)) return false;
  return true;
}

bool read_takes(const Json& item, runtime::RunStatus::Robot& robot) {
  if (!item.contains("takes")) return true;
  if (!item.at("takes").is_array()) return false;
  for (const Json& word : item.at("takes")) {
    if (!word.is_string()) return false;
    robot.takes.push_back(word.get<std::string>());
  }
  return true;
}

/// Parameters that the run has changed; older processes do not report them.
bool read_changed(const Json& item, runtime::RunStatus::Robot& robot) {
  if (!item.contains("changed")) return true;
  if (!item.at("changed").is_object()) return false;
  for (const auto& [key, value] : item.at("changed").items()) {
    if (!value.is_string()) return false;
    robot.changed.emplace_back(key, value.get<std::string>());
  }
  return true;
}

}  // namespace

bool read_bool(const Json& json, const char* key, bool& value) {
  if (!json.contains(key) || !json.at(key).is_boolean()) return false;
  value = json.at(key).get<bool>();
  return true;
}

bool read_text(const Json& json, const char* key, std::string& value) {
  if (!json.contains(key) || !json.at(key).is_string()) return false;
  value = json.at(key).get<std::string>();
  return true;
}

Json status_json(const runtime::RunStatus& status) {
  Json json = {
      {"scenario", status.scenario}, {"sim_s", status.sim_s}, {"duration_s", status.duration_s},
      {"pace", status.pace},         {"live", status.live},   {"paused", status.paused},
      {"robots", Json::array()}};
  if (status.lateness) json["lateness"] = lateness_json(*status.lateness);
  if (!status.run.empty()) json["run"] = status.run;
  if (!status.waits_for.empty()) json["waits_for"] = status.waits_for;
  for (const runtime::RunStatus::Robot& robot : status.robots) {
    json["robots"].push_back({{"name", robot.name},
                              {"simulated", robot.simulated},
                              {"armed", robot.armed},
                              {"stopped", robot.stopped}});
    Json& last = json["robots"].back();
    if (robot.hand_over) last["hand_over"] = hand_over_json(*robot.hand_over);
    if (robot.shadow) last["shadow"] = runtime::shadow_json<Json>(*robot.shadow);
    if (!robot.lease.empty()) last["lease"] = robot.lease;
    if (robot.lease_page != 0) last["lease_page"] = robot.lease_page;
    if (!robot.takes.empty()) last["takes"] = robot.takes;
    if (!robot.order.empty()) last["order"] = robot.order;
    for (const auto& [key, value] : robot.changed) last["changed"][key] = value;
  }
  return json;
}

bool read_status(const Json& json, runtime::RunStatus& status) {
  bool good = json.is_object() && read_text(json, "scenario", status.scenario) &&
              read_number(json, "sim_s", status.sim_s) &&
              read_number(json, "duration_s", status.duration_s) &&
              read_number(json, "pace", status.pace) && read_bool(json, "live", status.live) &&
              read_bool(json, "paused", status.paused) && json.contains("robots") &&
              json.at("robots").is_array();
  if (good && json.contains("run")) good = read_text(json, "run", status.run);
  if (good && json.contains("waits_for")) good = read_text(json, "waits_for", status.waits_for);
  if (!good) return false;
  if (json.contains("lateness")) {
    good = read_lateness(json.at("lateness"), *(status.lateness = runtime::RunStatus::Lateness{}));
  }
  for (const Json& item : json.at("robots")) {
    runtime::RunStatus::Robot robot;
    good = good && item.is_object() && read_text(item, "name", robot.name) &&
           read_bool(item, "simulated", robot.simulated) && read_bool(item, "armed", robot.armed) &&
           read_bool(item, "stopped", robot.stopped);
    if (good && item.contains("hand_over")) {
      good =
          read_hand_over(item.at("hand_over"), *(robot.hand_over = runtime::RunStatus::HandOver{}));
    }
    if (good && item.contains("shadow")) {
      good = read_shadow(item.at("shadow"), *(robot.shadow = runtime::RunStatus::Shadow{}));
    }
    good = good && read_orders(item, robot) && read_takes(item, robot) && read_changed(item, robot);
    status.robots.push_back(std::move(robot));
  }
  return good;
}

}  // namespace rave::control
