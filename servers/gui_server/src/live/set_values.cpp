// SPDX-License-Identifier: Apache-2.0
#include "live/set_values.hpp"

#include <nlohmann/json.hpp>

#include "rave/base/json_text.hpp"

namespace rave::gui_server {
namespace {

/// As JSON; empty: it is no value of this kind.
std::string value_json(std::string_view kind, std::string_view text) {
  using Json = nlohmann::json;
  if (kind == "flag") return text == "true" ? "true" : "false";
  if (kind == "text" || kind == "choice") {
    return json_text(Json(text));
  }
  return Json::parse(text, nullptr, false).is_number() ? std::string(text) : std::string();
}

}  // namespace

SetValues::SetValues(const std::string& robots_json) {
  const auto robots = nlohmann::json::parse(robots_json, nullptr, false);
  if (!robots.is_array()) return;
  for (const auto& robot : robots) {
    auto& kinds = kinds_.emplace_back();
    if (!robot.contains("parameters")) continue;
    for (const auto& parameter : robot["parameters"]) {
      kinds.emplace(parameter.value("key", ""), parameter.value("kind", ""));
    }
  }
}

SetValues::Values SetValues::of(
    std::size_t slot, const std::vector<std::pair<std::string, std::string>>& changed) const {
  Values values;
  if (slot >= kinds_.size()) return values;
  for (const auto& [key, text] : changed) {
    const auto kind = kinds_[slot].find(key);
    if (kind == kinds_[slot].end()) continue;
    std::string value = value_json(kind->second, text);
    if (!value.empty()) values.emplace(key, std::move(value));
  }
  return values;
}

}  // namespace rave::gui_server
