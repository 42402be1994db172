// SPDX-License-Identifier: Apache-2.0
#include "replay/body_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "rave/control/obstacle_edits.hpp"
#include "rave/math/finite.hpp"
#include "rave/record/run_messages.hpp"
#include "rave/record/run_reader.hpp"
#include "run/scene_json.hpp"

namespace rave::gui_server {
namespace {

using BodyJson = nlohmann::ordered_json;

/// A look of an obstacle that may come: what was due or asked for at a time.
struct Coming {
  double t_s = 0;
  BodyJson body;
};
using Comings = std::map<std::string, std::vector<Coming>>;  // by name

struct Named {
  std::string name;
  std::optional<Pose2> X_WB;
};

/// Of the text of an event, such as "`crate` at (1, 2), yaw 0.5 rad (by hand)".
std::optional<Named> read_text(const std::string& text) {
  const std::size_t end = text.find('`', 1);
  if (text.empty() || text.front() != '`' || end == std::string::npos) return std::nullopt;
  Named named{text.substr(1, end - 1), std::nullopt};
  Pose2 X_WB;
  if (std::sscanf(text.c_str() + end + 1, " at (%lf, %lf), yaw %lf rad", &X_WB.x, &X_WB.y,
                  &X_WB.yaw) == 3 &&
      is_finite(X_WB)) {
    named.X_WB = X_WB;
  }
  return named;
}

void add_asked(const record::McapReader& reader, double step_s, Comings& comings) {
  const auto take = [&](const record::MessageView& message) -> Status {
    const auto input = record::decode_input(message.bytes);
    if (!input) return {};
    const auto edit = runtime::recorded_edit(input->kind, input->key, input->value);
    if (!edit || !*edit || !(*edit)->add_obstacle) return {};
    const config::ObstacleFile& added = *(*edit)->add_obstacle;
    comings[added.name.value].push_back(
        {static_cast<double>(input->step) * step_s, BodyJson::parse(body_json(0, added))});
    return {};
  };
  // A recording without inputs, or with damaged ones, shows the rest.
  static_cast<void>(record::for_each_message(reader, record::topic::kInputs, take));
}

Comings comings_of(const record::McapReader& reader, const config::ExpandedScenario& scenario) {
  Comings comings;
  for (const config::ChangeFile& change : scenario.scenario.changes) {
    const auto& added = change.obstacle.add_obstacle;
    if (!added) continue;
    comings[added->name.value].push_back(
        {change.at_s ? **change.at_s : 0, BodyJson::parse(body_json(0, *added))});
  }
  add_asked(reader, scenario.scenario.step_s.value, comings);
  for (auto& [name, looks] : comings) {
    std::ranges::stable_sort(looks, {}, &Coming::t_s);
  }
  return comings;
}

/// The newest look of this name that was known by then.
const BodyJson* look_of(const Comings& comings, const std::string& name, double t_s) {
  const auto found = comings.find(name);
  if (found == comings.end()) return nullptr;
  const BodyJson* look = nullptr;
  for (const Coming& coming : found->second) {
    if (look == nullptr || coming.t_s <= t_s + 1e-9) look = &coming.body;
  }
  return look;
}

}  // namespace

Status BodyHistory::read(const record::McapReader& reader, const config::ExpandedScenario& scenario,
                         const std::string& bodies_json) {
  const Comings comings = comings_of(reader, scenario);
  std::map<std::uint32_t, BodyJson> present;
  for (const BodyJson& body : BodyJson::parse(bodies_json)) {
    present[body.at("id").get<std::uint32_t>()] = body;
  }
  const auto note = [&](const record::RunEvent& event, double t_s) {
    const auto named = read_text(event.text);
    if (!named || event.values.empty() || !(event.values[0] >= 0 && event.values[0] < 4e9)) return;
    const auto id = static_cast<std::uint32_t>(event.values[0]);
    auto& changes = bodies_[id];
    const auto known = present.find(id);
    if (changes.empty()) changes.push_back({0, known == present.end() ? "" : known->second.dump()});
    if (event.kind == "obstacle removed") {
      present.erase(id);
      changes.push_back({t_s, ""});
      return;
    }
    const BodyJson* const look = event.kind == "obstacle added"
                                     ? look_of(comings, named->name, t_s)
                                     : (known == present.end() ? nullptr : &known->second);
    if (look == nullptr || !named->X_WB) return;
    BodyJson body = *look;
    body["id"] = id;
    body["name"] = named->name;
    body["pose"] = {named->X_WB->x, named->X_WB->y, named->X_WB->yaw};
    changes.push_back({t_s, body.dump()});
    present[id] = std::move(body);
  };
  return record::for_each_message(
      reader, record::topic::kEvents, [&](const record::MessageView& message) -> Status {
        RAVE_TRY_ASSIGN(const auto step, record::decode_event(message.bytes));
        for (const record::RunEvent& event : step.items) {
          if (event.kind.starts_with("obstacle ")) note(event, step.time.seconds());
        }
        return {};
      });
}

std::string ToldBodies::change_to(double time_s) {
  std::string set;
  std::string gone;
  for (const auto& [id, changes] : history_.bodies()) {
    std::size_t now = 0;
    while (now + 1 < changes.size() && changes[now + 1].t_s <= time_s + 1e-9) ++now;
    std::size_t& told = told_[id];
    if (told == now) continue;
    told = now;
    std::string& list = changes[now].json.empty() ? gone : set;
    if (!list.empty()) list += ',';
    list += changes[now].json.empty() ? std::to_string(id) : changes[now].json;
  }
  if (set.empty() && gone.empty()) return {};
  return fmt::format(R"({{"type":"scene_change","set":[{}],"gone":[{}]}})", set, gone);
}

}  // namespace rave::gui_server
