// SPDX-License-Identifier: Apache-2.0
#include "page/command_message.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rave/direct_line/order_members.hpp"

namespace rave::gui_server {
namespace {

using direct_line::kFarthest_m;
using direct_line::point_of;

constexpr std::size_t kLongestKey = 128;
constexpr std::size_t kLongestValue = 256;
constexpr std::size_t kLongestHolder = 64;
constexpr std::size_t kMostCorners = 64;

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

Status take_order(Members& members, CommandMessage& command) {
  using namespace request;
  RAVE_TRY_ASSIGN(const std::string_view word,
                  members.choice("kind", {Drive::kName, Goal::kName, Path::kName, Cancel::kName,
                                          Text::kName, Place::kName}));
  RAVE_TRY(take_slots(members, command));
  RAVE_TRY_ASSIGN(auto read,
                  direct_line::read_order(members, *order_named(word), command.slots.size()));
  command.action = action_of(std::move(read.order));
  command.points = std::move(read.points);
  return {};
}

Status take_lease(Members& members, CommandMessage& command) {
  RAVE_TRY(take_slots(members, command));
  RAVE_TRY_ASSIGN(const std::string_view word, members.choice("do", {"take", "force", "give"}));
  if (word != "give") {
    // The host of the robot decides who may force; for the server it is a take.
    command.action = request::Take{word == "force"};
    return {};
  }
  auto& give = command.action.emplace<request::Give>();
  if (members.has("to")) {
    RAVE_TRY_ASSIGN(give.to, members.text("to", kLongestHolder));
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
  RAVE_TRY(take_slots(members, command));
  auto& set = command.action.emplace<request::Set>();
  RAVE_TRY_ASSIGN(set.key, members.text("key", kLongestKey));
  RAVE_TRY_ASSIGN(set.value, parameter_value_of(members));
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
  config::ObstacleEdit& edit = command.action.emplace<request::Edit>().edit;
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
  using request::HandOver;
  using request::ResetShadow;
  RAVE_TRY(take_slots(members, command));
  RAVE_TRY_ASSIGN(const std::string_view word,
                  members.choice("do", {HandOver::kName, ResetShadow::kName}));
  if (word == ResetShadow::kName) {
    command.action = ResetShadow();
    return {};
  }
  RAVE_TRY_ASSIGN(const std::string_view to,
                  members.choice("to", {"real", "simulated", "first", "twin"}));
  command.action = HandOver{std::string(to)};
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
