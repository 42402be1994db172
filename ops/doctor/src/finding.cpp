// SPDX-License-Identifier: Apache-2.0
#include "rave/doctor/finding.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "rave/base/json_text.hpp"

namespace rave::doctor {

std::string_view to_string(Verdict verdict) noexcept {
  constexpr std::string_view kWords[] = {"good", "unknown", "advice", "problem"};
  return kWords[static_cast<std::size_t>(verdict)];
}

bool all_well(const Findings& findings) noexcept {
  return std::ranges::none_of(
      findings, [](const Finding& finding) { return finding.verdict == Verdict::kProblem; });
}

std::string to_json(const Findings& findings) {
  nlohmann::ordered_json json;
  json["rave_doctor"] = 1;
  json["well"] = all_well(findings);
  json["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    nlohmann::ordered_json entry;
    entry["check"] = finding.check;
    entry["verdict"] = to_string(finding.verdict);
    entry["what"] = finding.what;
    entry["mend"] = finding.mend;
    json["findings"].push_back(std::move(entry));
  }
  return json_text(json) + "\n";
}

}  // namespace rave::doctor
