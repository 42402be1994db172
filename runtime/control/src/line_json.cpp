// SPDX-License-Identifier: Apache-2.0
#include "line_json.hpp"

#include <set>
#include <string>
#include <vector>

namespace rave::control {

Json parse_line_object(std::string_view line) {
  std::vector<std::set<std::string>> keys;
  bool repeated = false;
  const auto watch = [&](int /*depth*/, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key) {
      repeated |= !keys.back().insert(parsed.get<std::string>()).second;
    }
    return true;
  };
  Json json = Json::parse(line, watch, false);
  if (repeated || !json.is_object()) return Json(Json::value_t::discarded);
  return json;
}

}  // namespace rave::control
