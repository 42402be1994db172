// SPDX-License-Identifier: Apache-2.0
#include "live/hosts_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "rave/base/json_text.hpp"

namespace rave::gui_server {
namespace {

template <class T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

template <class T>
void add(nlohmann::json& json, const char* key, const std::optional<T>& value) {
  if (value) json[key] = *value;
}

nlohmann::json json_of(const watch::HostView& host) {
  const std::uint32_t robots = host.robots.value_or(0);
  const std::uint32_t real = std::min(robots, host.real_robots.value_or(0));
  nlohmann::json json = {{"name", host.manager ? "manager" : host.name},
                         {"machine", host.machine},
                         {"state", watch::to_string(host.standing)},
                         {"late_s", host.behind_s.value_or(0)},
                         {"real", real},
                         {"simulated", robots - real},
                         {"step", host.step.value_or(0)},
                         {"steps_per_s", host.rate_hz.value_or(0)},
                         {"delay_s", or_null(host.delay_s)},
                         {"cpu", or_null(host.cores)},
                         {"lost", host.lost.value_or(0)}};
  add(json, "age_s", host.age_s);
  add(json, "trip_s", host.round_trip_s);
  add(json, "clock_s", host.offset_s);
  add(json, "clock_bound_s", host.bound_s);
  add(json, "refused", host.refused);
  add(json, "missed_pct", host.missed_pct);
  if (!host.late_phase.empty()) json["late_phase"] = host.late_phase;
  add(json, "memory_mb", host.memory_mb);
  add(json, "pid", host.process);
  return json;
}

}  // namespace

std::string hosts_json(const watch::RunView& view) {
  nlohmann::json hosts = nlohmann::json::array();
  for (const watch::HostView& host : view.hosts) hosts.push_back(json_of(host));
  return json_text(hosts);
}

}  // namespace rave::gui_server
