// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/record/mcap_reader.hpp"

namespace rave::gui_server {

/// What became of bodies in a recorded run: each as JSON at any time. What an obstacle looks like
/// that came during the run is in the scenario's changes, or in what was asked by hand.
class BodyHistory {
 public:
  /// `bodies_json`: those of the start. Errors: those of reading the record.
  Status read(const record::McapReader& reader, const config::ExpandedScenario& scenario,
              const std::string& bodies_json);

  struct Change {
    double t_s = 0;
    std::string json;  ///< Empty: it is not there from then on.
  };
  /// By number of the body; the first is at the start. In order of time.
  [[nodiscard]] const std::map<std::uint32_t, std::vector<Change>>& bodies() const noexcept {
    return bodies_;
  }

 private:
  std::map<std::uint32_t, std::vector<Change>> bodies_;  ///< Those that change.
};

/// What one viewer was told of bodies. Refers to the history.
class ToldBodies {
 public:
  explicit ToldBodies(const BodyHistory& history) : history_(history) {}
  /// The message that leads from what was told to how bodies are at this time; empty: nothing.
  [[nodiscard]] std::string change_to(double time_s);

 private:
  const BodyHistory& history_;
  std::map<std::uint32_t, std::size_t> told_;  ///< By body: which of its changes; missing: 0.
};

}  // namespace rave::gui_server
