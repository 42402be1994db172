// SPDX-License-Identifier: Apache-2.0
#include "command_message.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>

#include "rave/control/order_words.hpp"

namespace rave::gui_server {
namespace {

using Command = CommandMessage::Kind;

// No world is as large, and no robot as fast.
constexpr double kFarthest_m = 1e6;
constexpr double kFastestOrder = 100;
constexpr std::size_t kLongestKey = 128;
constexpr std::size_t kLongestValue = 256;
constexpr std::size_t kLongestBodyName = 64;
constexpr std::size_t kMostCorners = 64;

Result<double> number_within(Members& members, const char* name, double most) {
  RAVE_TRY_ASSIGN(const double value, members.number(name));
  // Members::number() has refused what is not finite, so the comparison suffices.
  if (std::abs(value) > most) {
    return fail(ErrorCode::kParse, "`{}`: expected a number from {} to {}", name, -most, most);
  }
  return value;
}

Result<Vec2> point_of(const PageJson& pair, const char* name) {
  // JSON has no NaN, and a number that overflows is no JSON for the parser: the bound refuses the
  // rest.
  const bool good = pair.is_array() && pair.size() == 2 && pair[0].is_number() &&
                    pair[1].is_number() && std::abs(pair[0].get<double>()) <= kFarthest_m &&
                    std::abs(pair[1].get<double>()) <= kFarthest_m;
  if (!good) {
    return fail(ErrorCode::kParse, "`{}`: expected pairs of finite numbers, metres", name);
  }
  return Vec2{pair[0].get<double>(), pair[1].get<double>()};
}

Result<std::vector<Vec2>> points_of(Members& members, const char* name, std::size_t most) {
  RAVE_TRY_ASSIGN(const PageJson* const pairs, members.array(name, most));
  std::vector<Vec2> points;
  points.reserve(pairs->size());
  for (const PageJson& pair : *pairs) {
    RAVE_TRY_ASSIGN(const Vec2 point, point_of(pair, name));
    points.push_back(point);
  }
  return points;
}

Status take_slots(Members& members, CommandMessage& command) {
  RAVE_TRY_ASSIGN(const PageJson* const slots, members.array("slots", kMostCommanded));
  for (const PageJson& slot : *slots) {
    RAVE_TRY_ASSIGN(const std::uint32_t index, Members::index_of(slot, "slots"));
    command.slots.push_back(index);
  }
  // The order is kept: points and refusals belong to slots by place. A robot that is named twice
  // would answer twice, and the count of missing answers would never be right.
  auto sorted = command.slots;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty() || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    return fail(ErrorCode::kParse, "`slots`: expected 1 to {} robots, each once", kMostCommanded);
  }
  return {};
}

Status take_place(Members& members, CommandMessage& command) {
  const std::size_t robots = command.slots.size();
  RAVE_TRY_ASSIGN(command.points, points_of(members, "points", kMostCommanded));
  // Several robots may drive to one goal, but cannot be placed at one point.
  const bool one = command.points.size() == 1 && command.kind == Command::kGoal;
  if (!one && command.points.size() != robots) {
    return fail(ErrorCode::kParse, "`points`: expected one for each robot, {}", robots);
  }
  if (members.has("yaw")) {
    RAVE_TRY_ASSIGN(command.yaw_rad, number_within(members, "yaw", 2 * std::numbers::pi));
  }
  return {};
}

Status take_speed(Members& members, CommandMessage& command) {
  if (!members.has("speed")) return {};
  RAVE_TRY_ASSIGN(command.speed_mps, number_within(members, "speed", kFastestOrder));
  // 0 means "not given". A path is driven forwards, so a negative speed has no meaning.
  if (command.speed_mps < 0) return fail(ErrorCode::kParse, "`speed`: expected 0 or more");
  return {};
}

Status take_path(Members& members, CommandMessage& command) {
  // A path too long for any run gets the error message that a run would give.
  constexpr std::size_t kMostRead = 100'000;
  RAVE_TRY_ASSIGN(command.points, points_of(members, "points", kMostRead));
  RAVE_TRY(runtime::check_path_size(command.points.size()));
  return take_speed(members, command);
}

Status take_order(Members& members, CommandMessage& command) {
  if (command.kind == Command::kDrive) {
    RAVE_TRY_ASSIGN(command.v_mps, number_within(members, "v", kFastestOrder));
    RAVE_TRY_ASSIGN(command.w_radps, number_within(members, "w", kFastestOrder));
  } else if (command.kind == Command::kGoal) {
    RAVE_TRY(take_place(members, command));
    RAVE_TRY(take_speed(members, command));
  } else if (command.kind == Command::kPlace) {
    RAVE_TRY(take_place(members, command));
  } else if (command.kind == Command::kPath) {
    RAVE_TRY(take_path(members, command));
  } else if (command.kind == Command::kText) {
    RAVE_TRY_ASSIGN(command.value, members.text("text", kLongestText, true));
  }
  return {};
}

Result<CommandMessage> order_of(Members& members) {
  static constexpr std::array kKinds = {Command::kDrive,  Command::kGoal, Command::kPath,
                                        Command::kCancel, Command::kText, Command::kPlace};
  CommandMessage command;
  RAVE_TRY_ASSIGN(command.request, members.index("request"));
  RAVE_TRY_ASSIGN(const std::string word, members.word("kind"));
  const auto* const kind = std::find_if(kKinds.begin(), kKinds.end(),
                                        [&](Command known) { return to_string(known) == word; });
  if (kind == kKinds.end()) {
    return fail(ErrorCode::kParse, "`kind`: expected drive, goal, path, cancel, text or place");
  }
  command.kind = *kind;
  RAVE_TRY(take_slots(members, command));
  RAVE_TRY(take_order(members, command));
  return command;
}

Result<CommandMessage> lease_of(Members& members) {
  CommandMessage command;
  RAVE_TRY_ASSIGN(command.request, members.index("request"));
  RAVE_TRY(take_slots(members, command));
  RAVE_TRY_ASSIGN(const std::string word, members.word("do"));
  if (word != "take" && word != "force" && word != "give") {
    return fail(ErrorCode::kParse, "`do`: expected take, force or give");
  }
  // `force` is a word for the run, whose host decides who may force; for the server it is a take.
  command.kind = word == "give" ? Command::kGive : Command::kTake;
  if (word == "force") command.value = "force";
  if (word == "give" && members.has("to")) {
    RAVE_TRY_ASSIGN(command.value, members.text("to", kLongestBodyName));
  }
  return command;
}

/// A number, a truth value or a word, as a file has it.
Result<std::string> parameter_value_of(Members& members) {
  RAVE_TRY_ASSIGN(const PageJson* const value, members.any("value"));
  if (value->is_string()) {
    auto text = value->get<std::string>();
    if (text.size() <= kLongestValue) return text;
  } else if (value->is_boolean() || (value->is_number() && std::isfinite(value->get<double>()))) {
    // As text: only the run knows the type of the parameter.
    return value->dump();
  }
  return fail(ErrorCode::kParse, "`value`: expected a number, true, false or a short text");
}

Result<CommandMessage> set_of(Members& members) {
  CommandMessage command;
  command.kind = Command::kSet;
  RAVE_TRY_ASSIGN(command.request, members.index("request"));
  RAVE_TRY(take_slots(members, command));
  RAVE_TRY_ASSIGN(command.key, members.text("key", kLongestKey));
  RAVE_TRY_ASSIGN(command.value, parameter_value_of(members));
  return command;
}

Result<std::string> body_name_of(Members& members) {
  RAVE_TRY_ASSIGN(std::string name, members.text("name", kLongestBodyName));
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  });
  if (name.empty() || !plain) {
    return fail(ErrorCode::kParse, "`name`: expected letters, digits, - and _");
  }
  return name;
}

/// Files have degrees, so an edit has them, too.
template <class Entry>
Status take_pose(Members& members, Entry& entry) {
  RAVE_TRY_ASSIGN(const PageJson* const pose, members.array("pose", 3));
  if (pose->size() != 3 || !(*pose)[2].is_number() ||
      std::abs((*pose)[2].get<double>()) > 2 * std::numbers::pi) {
    return fail(ErrorCode::kParse, "`pose`: expected x, y in metres and yaw in radians");
  }
  // Obstacles become the YAML that `rave edit` sends, so that one reader checks both.
  const PageJson xy = PageJson::array({(*pose)[0], (*pose)[1]});
  RAVE_TRY_ASSIGN(const Vec2 p, point_of(xy, "pose"));
  entry.x_m = p.x;
  entry.y_m = p.y;
  entry.yaw_deg = (*pose)[2].get<double>() * 180 / std::numbers::pi;
  return {};
}

Status take_outline(Members& members, config::Outline& outline) {
  if (members.has("disc")) {
    RAVE_TRY_ASSIGN(outline.disc_radius_m, number_within(members, "disc", kFarthest_m));
    return {};
  }
  RAVE_TRY_ASSIGN(const std::vector<Vec2> corners, points_of(members, "polygon", kMostCorners));
  if (corners.size() < 3) {
    return fail(ErrorCode::kParse, "`polygon`: expected 3 to {} corners", kMostCorners);
  }
  auto& polygon_m = outline.polygon_m.emplace();
  for (const Vec2& corner : corners) polygon_m.push_back({corner.x, corner.y});
  return {};
}

Result<CommandMessage> edit_of(Members& members) {
  CommandMessage command;
  command.kind = Command::kEdit;
  config::ObstacleEdit& edit = command.edit.emplace();
  RAVE_TRY_ASSIGN(command.request, members.index("request"));
  RAVE_TRY_ASSIGN(const std::string word, members.word("do"));
  RAVE_TRY_ASSIGN(const std::string name, body_name_of(members));
  if (word == "remove") {
    edit.remove_obstacle = name;
  } else if (word == "move") {
    edit.move_obstacle.emplace().name = name;
    RAVE_TRY(take_pose(members, *edit.move_obstacle));
  } else if (word == "add") {
    edit.add_obstacle.emplace().name = name;
    RAVE_TRY(take_pose(members, *edit.add_obstacle));
    RAVE_TRY(take_outline(members, edit.add_obstacle->outline));
  } else {
    return fail(ErrorCode::kParse, "`do`: expected add, move or remove");
  }
  return command;
}

Result<CommandMessage> twin_of(Members& members) {
  CommandMessage command;
  RAVE_TRY_ASSIGN(command.request, members.index("request"));
  RAVE_TRY(take_slots(members, command));
  RAVE_TRY_ASSIGN(const std::string word, members.word("do"));
  if (word == "reset_shadow") {
    command.kind = Command::kResetShadow;
    return command;
  }
  if (word != "hand_over") {
    return fail(ErrorCode::kParse, "`do`: expected hand_over or reset_shadow");
  }
  command.kind = Command::kHandOver;
  RAVE_TRY_ASSIGN(command.value, members.word("to"));
  static constexpr std::array kSets = {"real", "simulated", "first", "twin"};
  if (std::find(kSets.begin(), kSets.end(), command.value) == kSets.end()) {
    return fail(ErrorCode::kParse, "`to`: expected real, simulated, first or twin");
  }
  return command;
}

}  // namespace

std::optional<Result<CommandMessage>> command_of(std::string_view type, Members& members) {
  if (type == "order") return order_of(members);
  if (type == "lease") return lease_of(members);
  if (type == "set") return set_of(members);
  if (type == "edit") return edit_of(members);
  if (type == "twin") return twin_of(members);
  return std::nullopt;
}

}  // namespace rave::gui_server
