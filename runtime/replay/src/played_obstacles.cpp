// SPDX-License-Identifier: Apache-2.0
#include "played_obstacles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "rave/codec/diagnostics.hpp"
#include "rave/config/yaml.hpp"
#include "rave/control/obstacle_edits.hpp"
#include "rave/record/run_reader.hpp"

namespace rave::replay {
namespace {

using codec::RawNode;

/// What one kind of change is called: in scenarios and requests, as an event.
struct Words {
  const char* key;
  const char* event;
};
constexpr std::array kWords = {Words{"add_obstacle", "obstacle added"},
                               Words{"move_obstacle", "obstacle moved"},
                               Words{"remove_obstacle", "obstacle removed"}};

/// Step, kind and beginning of the text of what was made.
using Made = std::set<std::tuple<std::uint64_t, std::string, std::string>>;

struct Change {
  std::uint64_t step = 0;
  std::string key;
  RawNode value;
};

std::string name_in(const RawNode& value) {
  const RawNode* const name = value.is_mapping() ? value.find("name") : &value;
  return name == nullptr ? std::string() : std::string(name->as_text().value_or(""));
}

/// A change of a scenario may have been refused; its event says that it was not.
Result<Made> made_changes(const record::McapReader& reader) {
  Made made;
  const auto take = [&](const record::MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(const auto step, record::decode_event(message.bytes));
    for (const record::RunEvent& event : step.items) {
      const std::size_t end = event.text.find('`', 1);
      if (event.text.empty() || event.text[0] != '`' || end == std::string::npos) continue;
      made.emplace(step.step, event.kind, event.text.substr(1, end - 1));
    }
    return {};
  };
  RAVE_TRY(record::for_each_message(reader, record::topic::kEvents, take));
  return made;
}

Status add_by_hand(const record::McapReader& reader, std::vector<Change>& changes) {
  const auto take = [&](const record::MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(const record::RunInput input, record::decode_input(message.bytes));
    const auto edit = runtime::recorded_edit(input.kind, input.key, input.value);
    if (!edit) return {};
    if (!*edit) {
      return fail(ErrorCode::kParse, "step {}: the recording has an unknown `{}`: {}", input.step,
                  input.kind, edit->error().message);
    }
    codec::Diagnostics diagnostics;
    const auto node = config::parse_yaml(config::write_edit(**edit), "edit", diagnostics);
    changes.push_back({input.step, node->key(0), node->child(0)});
    return {};
  };
  return record::for_each_message(reader, record::topic::kInputs, take);
}

void add_scheduled(const record::RunInfo& run, const Made& made, std::vector<Change>& changes) {
  codec::Diagnostics diagnostics;
  const auto scenario = config::parse_yaml(run.expanded_scenario, "scenario.yaml", diagnostics);
  const RawNode* const all = scenario ? scenario->find("changes") : nullptr;
  for (std::size_t i = 0; all != nullptr && i < all->size(); ++i) {
    const RawNode& entry = all->child(i);
    const RawNode* const at = entry.is_mapping() ? entry.find("at_s") : nullptr;
    const auto at_s = at != nullptr ? at->as_double() : std::nullopt;
    if (!at_s) continue;
    const auto step = static_cast<std::uint64_t>(std::llround(*at_s / run.step_s));
    for (const Words& words : kWords) {
      const RawNode* const value = entry.find(words.key);
      if (value == nullptr || value->is_null()) continue;
      if (!made.contains({step, words.event, name_in(*value)})) continue;
      changes.push_back({step, words.key, *value});
    }
  }
}

}  // namespace

Result<RawNode> played_obstacles(const record::McapReader& reader, const record::RunInfo& run,
                                 double start_s) {
  RAVE_TRY_ASSIGN(const Made made, made_changes(reader));
  std::vector<Change> changes;
  // In a step, what is asked by hand comes before what the scenario says.
  RAVE_TRY(add_by_hand(reader, changes));
  add_scheduled(run, made, changes);
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.step < b.step; });
  const auto start = static_cast<std::uint64_t>(std::floor(start_s / run.step_s + 1e-6));
  RawNode entries = RawNode::sequence();
  for (Change& change : changes) {
    const std::uint64_t step = change.step > start ? change.step - start : 0;
    RawNode entry = RawNode::mapping();
    entry.append("at_s",
                 RawNode::number(std::round(static_cast<double>(step) * run.step_s * 1e9) / 1e9));
    entry.append(change.key, std::move(change.value));
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace rave::replay
