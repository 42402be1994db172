// SPDX-License-Identifier: Apache-2.0
#include "rave/results/shadow_report.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace rave::runtime {

nlohmann::ordered_json shadows_json(const std::vector<ShadowFacts>& shadows) {
  auto all = nlohmann::ordered_json::array();
  for (const ShadowFacts& shadow : shadows) {
    auto report = nlohmann::ordered_json::parse(shadow.report, nullptr, false);
    if (report.is_object()) all.push_back(std::move(report));
  }
  return all;
}

}  // namespace rave::runtime
