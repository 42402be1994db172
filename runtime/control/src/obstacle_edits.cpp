// SPDX-License-Identifier: Apache-2.0
#include "rave/control/obstacle_edits.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "rave/assemble/obstacles.hpp"
#include "rave/codec/diagnostics.hpp"
#include "rave/config/yaml.hpp"

namespace rave::runtime {
namespace {

/// The words of older recordings, and the keys of today.
constexpr std::array kOldKinds = {std::pair{"add", "add_obstacle"},
                                  std::pair{"move", "move_obstacle"},
                                  std::pair{"remove", "remove_obstacle"}};

/// The edit of an older recording: its name is the key, or its value an entry in YAML.
Result<config::ObstacleEdit> old_edit(std::string_view member, std::string_view key,
                                      std::string_view value) {
  codec::RawNode entry = codec::RawNode::text(std::string(key));
  if (key.empty()) {
    codec::Diagnostics diagnostics;
    auto parsed = config::parse_yaml(value, "value", diagnostics);
    if (!parsed || !diagnostics.ok()) return tl::unexpected<Error>(diagnostics.joined());
    entry = *std::move(parsed);
  }
  codec::RawNode edit = codec::RawNode::mapping();
  edit.append(std::string(member), std::move(entry));
  return config::read_edit(codec::to_json_line(edit), "value");
}

}  // namespace

Result<sim::ObstacleChange> requested_change(const config::ObstacleEdit& edit,
                                             const std::string& by) {
  // The place of an error within a request does not help the user, so it is omitted.
  const auto without_place = [](const Error& error) {
    return fail(error.code, "{}", error.message);
  };
  // Requests also come from code that puts them together, such as the GUI Server.
  const Status checked = config::check_edit(edit);
  if (!checked) return without_place(checked.error());
  auto change = change_of(edit);
  if (!change) return without_place(change.error());
  change->by = by;
  change->asked = config::write_edit(edit);
  RAVE_TRY(sim::check_obstacle_change(*change));
  return change;
}

std::string_view word_of(const config::ObstacleEdit& edit) noexcept {
  if (edit.add_obstacle) return "add";
  return edit.move_obstacle ? "move" : "remove";
}

std::optional<Result<config::ObstacleEdit>> recorded_edit(std::string_view kind,
                                                          std::string_view key,
                                                          std::string_view value) {
  if (kind == request::Edit::kName) return config::read_edit(value, "value");
  for (const auto& [word, member] : kOldKinds) {
    if (kind == word) return old_edit(member, key, value);
  }
  return std::nullopt;
}

}  // namespace rave::runtime
