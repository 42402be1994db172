// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rave::gui_server {

/// Values that parameters were given during the run, as its status has them: text, whatever their
/// kind. The roster says the kind.
class SetValues {
 public:
  /// Values by key, as JSON.
  using Values = std::map<std::string, std::string>;

  /// The array `robots` of a roster with the parameters of each robot.
  explicit SetValues(const std::string& robots_json);

  /// The values of robot `slot`. Parameters that the roster does not describe are left out.
  [[nodiscard]] Values of(std::size_t slot,
                          const std::vector<std::pair<std::string, std::string>>& changed) const;

 private:
  /// By key: `number`, `integer`, `flag`, `choice` or `text`.
  std::vector<std::map<std::string, std::string>> kinds_;
};

}  // namespace rave::gui_server
