// SPDX-License-Identifier: Apache-2.0
#include "set_values.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace rave::gui_server {
namespace {

/// As JSON; empty: it is no value of this kind.
std::string value_json(std::string_view kind, std::string_view text) {
  using Json = nlohmann::json;
  if (kind == "flag") return text == "1" || text == "true" ? "true" : "false";
  if (kind == "text" || kind == "choice") {
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return Json::parse(text, nullptr, false).is_number() ? std::string(text) : std::string();
}

}  // namespace

SetValues::SetValues(const std::string& robots_json) {
  const auto robots = nlohmann::json::parse(robots_json, nullptr, false);
  if (!robots.is_array()) return;
  for (const auto& robot : robots) {
    auto& known = robots_.emplace_back();
    if (!robot.contains("parameters")) continue;
    for (const auto& parameter : robot["parameters"]) {
      known.push_back({parameter.value("key", ""), parameter.value("kind", "")});
    }
  }
}

bool SetValues::take(std::size_t slot, std::string_view text, Values& values) const {
  if (slot >= robots_.size()) return false;
  // Of the author, whom the engine writes behind all values.
  text = text.substr(0, text.rfind(" (by hand"));
  // Where each known parameter begins. A text value may have commas and arrows of its own.
  std::vector<std::pair<std::size_t, const Known*>> begins;
  for (const Known& known : robots_[slot]) {
    const std::string mark = known.key + ": ";
    const std::size_t at = text.starts_with(mark) ? 0 : text.find(", " + mark);
    if (at != std::string_view::npos) begins.emplace_back(at, &known);
  }
  std::sort(begins.begin(), begins.end());
  bool changed = false;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const auto& [at, known] = begins[i];
    const std::size_t end = i + 1 < begins.size() ? begins[i + 1].first : text.size();
    const std::string_view part = text.substr(at, end - at);
    const std::size_t arrow = part.find(" -> ");
    if (arrow == std::string_view::npos) continue;
    std::string value = value_json(known->kind, part.substr(arrow + 4));
    std::string& present = values[known->key];
    if (value.empty() || present == value) continue;
    present = std::move(value);
    changed = true;
  }
  std::erase_if(values, [](const auto& entry) { return entry.second.empty(); });
  return changed;
}

}  // namespace rave::gui_server
