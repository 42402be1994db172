// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rave::gui_server {

/// Values that parameters were given during the run, as its events `changed` say. These
/// come in the same way under each clock and over a bus, from any author.
class SetValues {
 public:
  /// Values by key, as JSON.
  using Values = std::map<std::string, std::string>;

  /// The array `robots` of a roster with the parameters of each robot.
  explicit SetValues(const std::string& robots_json);

  /// Takes the values of an event of robot `slot`, such as `program.speed_mps: 0.2 -> 0.4,
  /// body.scale: 1 -> 2 (by hand: anna)`, into `values`. Returns whether these changed. Parameters
  /// that the roster does not describe are left out.
  bool take(std::size_t slot, std::string_view text, Values& values) const;

 private:
  struct Known {
    std::string key;
    std::string kind;  ///< `number`, `integer`, `flag`, `choice` or `text`.
  };
  std::vector<std::vector<Known>> robots_;
};

}  // namespace rave::gui_server
