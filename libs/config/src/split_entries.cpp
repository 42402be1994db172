// SPDX-License-Identifier: Apache-2.0
// An entry of several robots whose variables are lists, or of which some are real, becomes one
// entry per robot before structs are read, so that nothing behind knows of lists.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "scenario_fields.hpp"
#include "start_poses.hpp"

namespace rave::config {
namespace {

constexpr std::array<std::string_view, 5> kStarts = {"pose", "poses", "grid", "ring", "scatter"};

/// The entry with its name and start poses only; none if they cannot be read, which is reported
/// when the whole entry is.
std::optional<RobotEntry> starts_of(const RawNode& entry) {
  RawNode part = RawNode::mapping({{"file", RawNode::text("unknown")}});
  const RawNode* const name = entry.find("name");
  if (name == nullptr) return std::nullopt;
  part.append("name", *name);
  for (const std::string_view key : kStarts) {
    if (const RawNode* const start = entry.find(key)) part.append(std::string(key), *start);
  }
  for (const std::string_view key : {"twin", "real"}) {
    if (const RawNode* const value = entry.find(key)) part.append(std::string(key), *value);
  }
  // In the place of its content, which may have variables.
  if (entry.find("twin_robot") && !part.find("twin")) part.append("twin", RawNode::text("unknown"));
  Diagnostics diagnostics;
  auto read = codec::read_node<RobotEntry>(part, diagnostics);
  if (!diagnostics.ok()) return std::nullopt;
  return read;
}

/// Whether the number of real robots is possible.
bool real_fits(const RawNode& entry, const RobotEntry& starts, Diagnostics& diagnostics) {
  if (!starts.real) return true;
  const SourceLocation where = entry.find("real")->where();
  const std::size_t count = robots_of(starts);
  if (static_cast<std::size_t>(*starts.real) > count) {
    diagnostics.add(where, fmt::format("`real`: found {}, expected at most {}, the robots of `{}`",
                                       *starts.real, count, *starts.name));
    return false;
  }
  if (*starts.real > 0 && starts.scatter) {
    diagnostics.add(where,
                    "`real`: a real robot stands where it stands; expected another key than "
                    "`scatter`");
    return false;
  }
  return true;
}

bool says_real(const RawNode& entry) {
  const RawNode* const real = entry.find("real");
  return real != nullptr && !real->is_null();
}

bool has_lists(const RawNode& entry) {
  const RawNode* const variables = entry.find("variables");
  if (variables == nullptr || !variables->is_mapping()) return false;
  for (const RawNode& value : variables->children()) {
    if (value.is_sequence()) return true;
  }
  return false;
}

/// Whether each list has a value for each robot.
bool lists_fit(const RawNode* variables, const RobotEntry& starts, Diagnostics& diagnostics) {
  const std::size_t count = robots_of(starts);
  bool fit = true;
  for (std::size_t v = 0; variables != nullptr && v < variables->size(); ++v) {
    const RawNode& list = variables->child(v);
    if (!list.is_sequence() || list.size() == count) continue;
    fit = false;
    diagnostics.add(list.where(), fmt::format("the variable `{}`: found a list of {}, expected {}, "
                                              "a value for each robot of `{}`",
                                              variables->key(v), list.size(), count, *starts.name));
  }
  return fit;
}

/// `value` at the place of `from`.
RawNode placed(RawNode value, const RawNode& from) {
  const SourceLocation where = from.where();
  value.set_where(std::make_shared<const std::string>(where.file), where.line, where.column);
  return value;
}

/// Gives a real robot the drivers of the twin first, and leaves a simulated one without a twin.
void choose_drivers(bool real, RawNode& one) {
  for (const auto& [first, twin] : {std::pair("file", "twin"), std::pair("robot", "twin_robot")}) {
    const RawNode* const of_twin = one.find(twin);
    const std::optional<RawNode> other = of_twin ? std::optional(*of_twin) : std::nullopt;
    const RawNode* const of_first = one.find(first);
    const std::optional<RawNode> own = of_first ? std::optional(*of_first) : std::nullopt;
    one.erase(twin);
    if (!real) continue;
    one.erase(first);
    if (other) one.append(first, *other);
    if (own) one.append(twin, *own);
  }
  if (!real) one.erase("shadow");
}

RawNode entry_of_one(const RawNode& entry, const RobotEntry& starts, std::size_t i) {
  RawNode one = entry;
  if (RawNode* const variables = one.find("variables")) {
    for (std::size_t v = 0; v < variables->size(); ++v) {
      if (!variables->child(v).is_sequence()) continue;
      RawNode value = variables->child(v).child(i);
      variables->child(v) = std::move(value);
    }
  }
  if (starts.real) choose_drivers(i < static_cast<std::size_t>(*starts.real), one);
  one.erase("real");
  if (robots_of(starts) == 1) return one;
  const RawNode& name = *entry.find("name");
  one.set("name", placed(RawNode::text(fmt::format("{}-{}", *starts.name, i + 1)), name));
  // An entry that is itself part of another name stays so; each of its robots has that name.
  if (!one.find("part_of")) one.append("part_of", placed(RawNode::text(*starts.name), name));
  for (const std::string_view key : kStarts) one.erase(key);
  if (const auto pose = pose_of(starts, i)) {
    one.append("pose", placed(codec::write_node(*pose), name));
  } else if (starts.scatter) {
    ScatterFile alone = *starts.scatter;
    alone.count = 1;
    one.append("scatter", placed(codec::write_node(alone), name));
  }
  return one;
}

}  // namespace

void split_entries(RawNode& scenario, Diagnostics& diagnostics) {
  RawNode* const robots = scenario.find("robots");
  if (robots == nullptr || !robots->is_sequence()) return;
  std::vector<RawNode> entries;
  bool any = false;
  for (std::size_t e = 0; e < robots->size(); ++e) {
    const RawNode& entry = robots->child(e);
    const bool splits = has_lists(entry) || says_real(entry);
    const auto starts = splits ? starts_of(entry) : std::nullopt;
    if (!starts || !real_fits(entry, *starts, diagnostics) ||
        !lists_fit(entry.find("variables"), *starts, diagnostics)) {
      entries.push_back(entry);
      continue;
    }
    any = true;
    for (std::size_t i = 0; i < robots_of(*starts); ++i) {
      entries.push_back(entry_of_one(entry, *starts, i));
    }
  }
  if (any) *robots = placed(RawNode::sequence(std::move(entries)), *robots);
}

}  // namespace rave::config
