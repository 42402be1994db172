// SPDX-License-Identifier: Apache-2.0
#include "page/page_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "rave/base/json_text.hpp"
#include "rave/control/shadow_json.hpp"
#include "run/components.hpp"

namespace rave::gui_server {
namespace {

using Json = nlohmann::ordered_json;

constexpr WordTable<LogEvent::Level, 3> kLevelWords = {{{"info", LogEvent::Level::kInfo},
                                                        {"warn", LogEvent::Level::kWarn},
                                                        {"alert", LogEvent::Level::kAlert}}};

Json person_json(const Person& person) {
  return {{"name", person.name}, {"role", to_string(person.role)}};
}

/// JSON has no word for what is not finite.
std::string number(double value) { return std::isfinite(value) ? fmt::to_string(value) : "null"; }

}  // namespace

std::string hello_text(const Source& source, const Greeting& greeting) {
  const RunAbout& about = source.about();
  Json recording = nullptr;
  if (!about.recording.empty()) {
    recording = {{"name", about.recording.filename().string()},
                 {"bytes", about.recording_bytes},
                 {"whole", about.recording_whole}};
  }
  Powers powers = source.powers();
  if (greeting.user.role == Role::kSuperUser && !greeting.seen_by)
    powers.may.emplace_back("rights");
  if (greeting.conducts) powers.may.emplace_back("conduct");
  Json hello = {{"type", "hello"},
                {"protocol", 1},
                {"server", "rave"},
                {"run",
                 {{"name", about.name},
                  {"source", about.none   ? "none"
                             : about.live ? "live"
                                          : "replay"},
                  {"clock", about.lock_step ? "lock_step" : "real_time"},
                  {"started", about.started},
                  {"step_s", about.step_s},
                  {"seed", about.seed},
                  {"hash", about.hash.empty() ? Json(nullptr) : Json(about.hash)},
                  {"recording", std::move(recording)}}},
                {"user", person_json(greeting.user)},
                {"may", powers.may},
                {"why_not", powers.why_not}};
  const std::vector<PageComponent>& components = source.components();
  for (std::size_t i = 0; i < components.size(); ++i) {
    const PageComponent& component = components[i];
    if (!component.is_for(greeting.user.role)) continue;
    hello["components"].push_back(
        {{"name", component.name}, {"url", component_path(i, component)}});
  }
  if (greeting.foxglove) hello["foxglove"] = true;
  if (greeting.seen_by) hello["seen_by"] = person_json(*greeting.seen_by);
  return json_text(hello);
}

std::string events_text(std::span<const LogEvent> events, std::size_t first) {
  Json message = {
      {"type", "events"}, {"reset", first == 0}, {"first", first}, {"events", Json::array()}};
  for (const LogEvent& event : events.subspan(first)) {
    message["events"].push_back({{"t", event.t_s},
                                 {"until", event.until_s},
                                 {"count", event.count},
                                 {"kind", event.kind},
                                 {"level", kLevelWords.of(event.level)},
                                 {"text", event.text},
                                 {"slots", event.slots}});
  }
  return json_text(message);
}

// Each page gets one each second, so no tree of JSON is built for it.
std::string time_text(const PlayState& state, const RunAbout& about) {
  return fmt::format(
      R"({{"type":"time","now_s":{},"step":{},"begin_s":{},"end_s":{},"duration_s":{},)"
      R"("state":"{}","reason":{},"pace":{},"speed":{}}})",
      number(state.now_s), std::llround(state.now_s / about.step_s), number(state.begin_s),
      number(state.end_s), number(state.duration_s), kStateWords.of(state.kind),
      json_text(Json(state.reason)), number(state.pace), number(state.speed));
}

std::string leases_text(std::span<const DriveState> states, const Author& me, bool all) {
  Json message = {{"type", "leases"}, {"reset", all}, {"robots", Json::array()}};
  for (const DriveState& state : states) {
    message["robots"].push_back({{"slot", state.slot},
                                 {"lease", state.lease},
                                 {"yours", state.is_of(me)},
                                 {"takes", state.takes},
                                 {"order", state.order}});
    Json& robot = message["robots"].back();
    if (state.hand_over) {
      robot["twin"] = {{"simulated", state.simulated},
                       {"under_way", state.hand_over->under_way},
                       {"made", state.hand_over->made},
                       {"refused", state.hand_over->refused},
                       {"last", state.hand_over->last}};
    }
    for (const auto& [key, value] : state.values) robot["values"][key] = Json::parse(value);
    if (state.shadow) robot["shadow"] = runtime::shadow_json(*state.shadow);
  }
  return json_text(message);
}

std::string maps_text(std::span<const MapName> names) {
  Json message = {{"type", "maps"}, {"maps", Json::array()}};
  for (const MapName& name : names) {
    Json map = {{"name", name.name}};
    if (!name.global()) map["slot"] = name.slot;
    message["maps"].push_back(std::move(map));
  }
  return json_text(message);
}

std::string probes_text(std::uint32_t request, std::span<const ProbeAnswer> answers) {
  Json message = {{"type", "probes"}, {"request", request}, {"probes", Json::array()}};
  for (const ProbeAnswer& answer : answers) {
    Json probe = {{"slot", answer.slot}};
    if (answer.error.empty()) {
      probe["block"] = answer.made.text;
      probe["sensor"] = Json::parse(answer.made.sensor_json);
    } else {
      probe["error"] = answer.error;
    }
    message["probes"].push_back(std::move(probe));
  }
  return json_text(message);
}

std::string answer_text(const PageAnswer& answer) {
  Json message = {
      {"type", "answer"}, {"to", answer.to}, {"good", answer.good}, {"text", answer.text}};
  if (answer.request) message["request"] = *answer.request;
  if (!answer.refused.empty()) {
    message["refused"] = Json::array();
    for (const auto& [slot, text] : answer.refused) {
      message["refused"].push_back({{"slot", slot}, {"text", text}});
    }
  }
  return json_text(message);
}

}  // namespace rave::gui_server
