// SPDX-License-Identifier: Apache-2.0
#include "rave/results/lateness_report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace rave::runtime {

nlohmann::ordered_json lateness_json(const LatenessFacts& facts) {
  // A run without pace has no deadlines, which is not the same as none missed.
  if (facts.deadlines == 0) return nullptr;
  nlohmann::ordered_json json = {{"deadlines", facts.deadlines},
                                 {"missed", facts.missed},
                                 {"missed_pct", std::round(facts.missed_pct() * 1e3) / 1e3},
                                 {"worst_s", static_cast<double>(facts.worst_ns) * 1e-9},
                                 {"robots_stopped", facts.stops}};
  json["blame"] = facts.blame;
  return json;
}

}  // namespace rave::runtime
