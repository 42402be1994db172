// SPDX-License-Identifier: Apache-2.0
#include "command_message.hpp"

#include <algorithm>
#include <cmath>
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
constexpr std::size_t kLongestHolder = 64;
constexpr std::size_t kMostCorners = 64;

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

Status take_slots(Members& members, CommandMessage& command) {
  RAVE_TRY_ASSIGN(command.slots, members.list("slots", kMostCommanded, Members::index_of));
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
  RAVE_TRY_ASSIGN(command.points, members.list("points", kMostCommanded, point_of));
  // Several robots may drive to one goal, but cannot be placed at one point.
  const bool one = command.points.size() == 1 && command.kind == Command::kGoal;
  if (!one && command.points.size() != robots) {
    return fail(ErrorCode::kParse, "`points`: expected one for each robot, {}", robots);
  }
  if (members.has("yaw")) {
    constexpr double kTurn_rad = 2 * std::numbers::pi;
    RAVE_TRY_ASSIGN(command.yaw_rad, members.number_in("yaw", -kTurn_rad, kTurn_rad));
  }
  return {};
}

Status take_speed(Members& members, CommandMessage& command) {
  // 0 means "not given". A path is driven forwards, so a negative speed has no meaning.
  if (members.has("speed")) {
    RAVE_TRY_ASSIGN(command.speed_mps, members.number_in("speed", 0, kFastestOrder));
  }
  return {};
}

Status take_path(Members& members, CommandMessage& command) {
  // A path too long for any run gets the error message that a run would give.
  constexpr std::size_t kMostRead = 100'000;
  RAVE_TRY_ASSIGN(command.points, members.list("points", kMostRead, point_of));
  RAVE_TRY(runtime::check_path_size(command.points.size()));
  return take_speed(members, command);
}

Status take_order(Members& members, CommandMessage& command) {
  static constexpr WordTable<Command, 6> kOrders = {{{"drive", Command::kDrive},
                                                     {"goal", Command::kGoal},
                                                     {"path", Command::kPath},
                                                     {"cancel", Command::kCancel},
                                                     {"text", Command::kText},
                                                     {"place", Command::kPlace}}};
  RAVE_TRY_ASSIGN(command.kind, members.choice("kind", kOrders));
  RAVE_TRY(take_slots(members, command));
  if (command.kind == Command::kDrive) {
    RAVE_TRY_ASSIGN(command.v_mps, members.number_in("v", -kFastestOrder, kFastestOrder));
    RAVE_TRY_ASSIGN(command.w_radps, members.number_in("w", -kFastestOrder, kFastestOrder));
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

Status take_lease(Members& members, CommandMessage& command) {
  RAVE_TRY(take_slots(members, command));
  RAVE_TRY_ASSIGN(const std::string_view word, members.choice("do", {"take", "force", "give"}));
  // `force` is a word for the run, whose host decides who may force; for the server it is a take.
  command.kind = word == "give" ? Command::kGive : Command::kTake;
  if (word == "force") command.value = "force";
  if (word == "give" && members.has("to")) {
    RAVE_TRY_ASSIGN(command.value, members.text("to", kLongestHolder));
  }
  return {};
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

Status take_set(Members& members, CommandMessage& command) {
  command.kind = Command::kSet;
  RAVE_TRY(take_slots(members, command));
  RAVE_TRY_ASSIGN(command.key, members.text("key", kLongestKey));
  RAVE_TRY_ASSIGN(command.value, parameter_value_of(members));
  return {};
}

/// Files have degrees, so an edit has them, too.
template <class Entry>
Status take_pose(Members& members, Entry& entry) {
  RAVE_TRY_ASSIGN(const Pose2 pose, members.pose("pose", kFarthest_m));
  entry.x_m = pose.x;
  entry.y_m = pose.y;
  entry.yaw_deg = pose.yaw * 180 / std::numbers::pi;
  return {};
}

Status take_outline(Members& members, config::Outline& outline) {
  if (members.has("disc")) {
    RAVE_TRY_ASSIGN(outline.disc_radius_m, members.number_in("disc", -kFarthest_m, kFarthest_m));
    return {};
  }
  RAVE_TRY_ASSIGN(const std::vector<Vec2> corners, members.list("polygon", kMostCorners, point_of));
  if (corners.size() < 3) {
    return fail(ErrorCode::kParse, "`polygon`: expected 3 to {} corners", kMostCorners);
  }
  auto& polygon_m = outline.polygon_m.emplace();
  for (const Vec2& corner : corners) polygon_m.push_back({corner.x, corner.y});
  return {};
}

Status take_edit(Members& members, CommandMessage& command) {
  command.kind = Command::kEdit;
  config::ObstacleEdit& edit = command.edit.emplace();
  RAVE_TRY_ASSIGN(const std::string_view word, members.choice("do", {"add", "move", "remove"}));
  RAVE_TRY_ASSIGN(const std::string name, members.plain_name("name", "-_."));
  if (word == "remove") {
    edit.remove_obstacle = name;
    return {};
  }
  if (word == "move") {
    edit.move_obstacle.emplace().name = name;
    return take_pose(members, *edit.move_obstacle);
  }
  edit.add_obstacle.emplace().name = name;
  RAVE_TRY(take_pose(members, *edit.add_obstacle));
  return take_outline(members, edit.add_obstacle->outline);
}

Status take_twin(Members& members, CommandMessage& command) {
  static constexpr WordTable<Command, 2> kTwinWords = {
      {{"hand_over", Command::kHandOver}, {"reset_shadow", Command::kResetShadow}}};
  RAVE_TRY(take_slots(members, command));
  RAVE_TRY_ASSIGN(command.kind, members.choice("do", kTwinWords));
  if (command.kind == Command::kHandOver) {
    RAVE_TRY_ASSIGN(command.value, members.choice("to", {"real", "simulated", "first", "twin"}));
  }
  return {};
}

using Take = Status (*)(Members&, CommandMessage&);
constexpr WordTable<Take, 5> kTypes = {{{"order", take_order},
                                        {"lease", take_lease},
                                        {"set", take_set},
                                        {"edit", take_edit},
                                        {"twin", take_twin}}};

Result<CommandMessage> read_command(Members& members, Take take) {
  CommandMessage command;
  RAVE_TRY_ASSIGN(command.request, members.index("request"));
  RAVE_TRY(take(members, command));
  return command;
}

}  // namespace

std::optional<Result<CommandMessage>> command_of(std::string_view type, Members& members) {
  const auto take = kTypes.find(type);
  if (!take) return std::nullopt;
  return read_command(members, *take);
}

}  // namespace rave::gui_server
