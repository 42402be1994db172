// SPDX-License-Identifier: Apache-2.0
#include "run/reading_json.hpp"

#include <string>

#include "rave/robot/reading_type.hpp"

namespace rave::gui_server {

void add_reading_type(nlohmann::ordered_json& sensor, ReadingKind kind) {
  using Json = nlohmann::ordered_json;
  const ReadingType& type = reading_type(kind);
  Json fields = Json::array();
  for (const ReadingField& field : type.columns) {
    Json entry = {{"name", std::string(field.name)},
                  {"label", std::string(field.label)},
                  {"unit", std::string(field.unit)},
                  {"format", std::string(to_string(field.format))}};
    if (!field.variance.empty()) entry["variance"] = std::string(field.variance);
    fields.push_back(std::move(entry));
  }
  sensor["kind"] = std::string(type.name);
  sensor["fields"] = std::move(fields);
  if (type.shape == ReadingShape::kList) sensor["list"] = true;
}

}  // namespace rave::gui_server
