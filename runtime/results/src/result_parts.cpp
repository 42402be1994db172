// SPDX-License-Identifier: Apache-2.0
#include "rave/results/result_parts.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace rave::runtime {
namespace {

using Json = nlohmann::ordered_json;

Json transmitters_json(const sim::EngineSpec& spec,
                       const std::vector<InstrumentFacts>& transmitters) {
  Json all = Json::array();
  for (const InstrumentFacts& instrument : transmitters) {
    // A transmitter's report comes from its driver: text that is not JSON is omitted.
    const Json report = Json::parse(instrument.report, nullptr, false);
    if (!report.is_object() || report.empty()) continue;
    Json entry = {{"robot", spec.robots[instrument.robot].name},
                  {"transmitter", instrument.name},
                  {"driver", instrument.driver}};
    for (const auto& [key, value] : report.items()) entry[key] = value;
    all.push_back(std::move(entry));
  }
  return all;
}

Json radio_json(const sim::RadioCounts& c) {
  Json json = {{"offered", c.offered},
               {"sent", c.sent},
               {"addressed", c.addressed},
               {"delivered", c.delivered}};
  json["lost"] = {{"range", c.lost_range}, {"obstacle", c.lost_obstacle}, {"chance", c.lost_chance},
                  {"queue", c.lost_queue}, {"mailbox", c.lost_mailbox},   {"device", c.lost_device},
                  {"refused", c.refused}};
  json["from_devices"] = {{"heard", c.heard},
                          {"foreign", c.foreign},
                          {"repeated", c.repeated},
                          {"garbled", c.garbled},
                          {"overrun", c.overrun}};
  return json;
}

}  // namespace

Json lateness_json(const LatenessFacts& facts) {
  // A run without pace has no deadlines, which is not the same as none missed.
  if (facts.deadlines == 0) return nullptr;
  return {{"deadlines", facts.deadlines},
          {"missed", facts.missed},
          {"missed_pct", std::round(facts.missed_pct() * 1e3) / 1e3},
          {"worst_s", static_cast<double>(facts.worst_ns) * 1e-9},
          {"robots_stopped", facts.stops},
          {"blame", facts.blame}};
}

Json shadows_json(const std::vector<ShadowFacts>& shadows) {
  Json all = Json::array();
  for (const ShadowFacts& shadow : shadows) {
    Json report = Json::parse(shadow.report, nullptr, false);
    if (report.is_object()) all.push_back(std::move(report));
  }
  return all;
}

bool has_radio(const sim::EngineSpec& spec) {
  return std::any_of(spec.robots.begin(), spec.robots.end(), [&](const sim::RobotSpec& robot) {
    return !spec.types[robot.type].communicators.empty();
  });
}

void add_radio(const sim::EngineSpec& spec, const RunFacts& facts, Json& json) {
  if (!has_radio(spec)) return;
  json["radio"] = radio_json(facts.radio);
  json["radio"]["transmitters"] = transmitters_json(spec, facts.transmitters);
}

std::string radio_line(const sim::RadioCounts& c) {
  std::string text = fmt::format("{} sent, {} delivered to {} addressees; lost: {} out of range",
                                 c.sent, c.delivered, c.addressed, c.lost_range);
  const auto add = [&text](std::uint64_t count, const char* why) {
    if (count > 0) text += fmt::format(", {} {}", count, why);
  };
  add(c.lost_obstacle, "behind obstacles");
  add(c.lost_chance, "by chance");
  add(c.lost_queue, "in full queues");
  add(c.lost_mailbox, "at full mailboxes");
  add(c.lost_device, "at transmitters");
  add(c.refused, "refused");
  return text;
}

}  // namespace rave::runtime
