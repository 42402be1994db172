// SPDX-License-Identifier: Apache-2.0
// What a scenario and its script ask of a run, as inputs of the run.
#include "scenario_requests.hpp"

#include <algorithm>
#include <utility>

#include "rave/assemble/input_action.hpp"
#include "rave/assemble/obstacles.hpp"
#include "rave/assemble/parameter_key.hpp"
#include "rave/codec/diagnostics.hpp"
#include "rave/config/yaml.hpp"
#include "rave/sim/obstacle_change.hpp"

namespace rave::runtime {
namespace {

using codec::RawNode;

RawNode node_of(const script::Value& value) {
  if (value.is_nil()) return {};
  if (const auto* const on = std::get_if<bool>(&value.is)) return RawNode::boolean(*on);
  if (const auto* const whole = std::get_if<std::int64_t>(&value.is)) {
    return RawNode::integer(*whole);
  }
  if (const auto* const number = std::get_if<double>(&value.is)) return RawNode::number(*number);
  if (const auto* const text = value.text()) return RawNode::text(*text);
  RawNode list = RawNode::sequence();
  RawNode mapping = RawNode::mapping();
  for (const auto& [key, member] : *value.table()) {
    if (const auto* const name = std::get_if<std::string>(&key)) {
      mapping.append(*name, node_of(member));
    } else {
      list.push_back(node_of(member));
    }
  }
  return mapping.size() > 0 ? mapping : list;
}

/// Bodies are changed by who has the world, all else by the host of the robot: two inputs.
void add_changes(std::vector<sim::ParameterChange> changes, RobotId robot,
                 std::vector<sim::WorldInput>& inputs) {
  const auto of_body = [](const sim::ParameterChange& change) {
    return change.part == sim::ParameterChange::Part::kBody;
  };
  const auto bodies = std::ranges::stable_partition(changes, std::not_fn(of_body));
  sim::Change body{{bodies.begin(), bodies.end()}};
  changes.erase(bodies.begin(), bodies.end());
  for (sim::Change one : {sim::Change{std::move(changes)}, std::move(body)}) {
    if (one.changes.empty()) continue;
    inputs.push_back({0, std::move(one), sim::Author::kRun, robot});
  }
}

Status add_set(const config::ExpandedScenario& scenario, const sim::EngineSpec& spec,
               std::string_view name, const RawNode& set, std::vector<sim::WorldInput>& inputs) {
  RAVE_TRY_ASSIGN(const auto robots, meant_robots(scenario, name));
  for (const RobotId robot : robots) {
    const sim::RobotType& type = spec.types[spec.robots[robot.value()].type];
    std::vector<sim::ParameterChange> changes;
    for (std::size_t i = 0; i < set.size(); ++i) {
      RAVE_TRY_ASSIGN(auto change, parse_change(type, set.key(i), set.child(i)));
      changes.push_back(std::move(change));
    }
    add_changes(std::move(changes), robot, inputs);
  }
  return {};
}

Result<sim::WorldInput> edit_input(const config::ObstacleEdit& edit) {
  RAVE_TRY_ASSIGN(sim::ObstacleChange change, change_of(edit));
  RAVE_TRY(sim::check_obstacle_change(change));
  return sim::WorldInput{0, std::move(change), sim::Author::kRun, RobotId()};
}

}  // namespace

std::optional<sim::WorldInput::Action> input_action(const request::Action& action) {
  if (auto order = request::order_of(action)) return *std::move(order);
  if (const auto* const stop = std::get_if<request::Stop>(&action)) return *stop;
  if (const auto* const release = std::get_if<request::Release>(&action)) return *release;
  if (const auto* const arm = std::get_if<request::Arm>(&action)) return *arm;
  return std::nullopt;
}

Result<std::vector<RobotId>> meant_robots(const config::ExpandedScenario& scenario,
                                          std::string_view name) {
  std::vector<RobotId> robots;
  for (const std::size_t r : config::robots_named(scenario, name)) {
    robots.emplace_back(static_cast<std::uint32_t>(r));
  }
  if (!robots.empty()) return robots;
  return fail(ErrorCode::kNotFound, "there is no robot `{}`{}", name,
              config::robot_suggestion(scenario, name));
}

Result<std::vector<sim::WorldInput>> inputs_of(const config::ExpandedScenario& scenario,
                                               const sim::EngineSpec& spec,
                                               const request::Request& request) {
  std::vector<sim::WorldInput> inputs;
  if (const auto* const edit = request.as<request::Edit>()) {
    RAVE_TRY_ASSIGN(inputs.emplace_back(), edit_input(edit->edit));
    return inputs;
  }
  if (const auto* const set = request.as<request::Set>()) {
    codec::Diagnostics diagnostics;
    auto value = config::parse_yaml(set->value, "value", diagnostics);
    if (!value || !diagnostics.ok()) {
      return fail(ErrorCode::kInvalidArgument, "`{}` is not a value of a parameter", set->value);
    }
    RawNode node = RawNode::mapping();
    node.append(set->key, *std::move(value));
    RAVE_TRY(add_set(scenario, spec, request.robot, node, inputs));
    return inputs;
  }
  auto action = input_action(request.action);
  if (!action) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is for people; a scenario cannot ask for it",
                request::name_of(request.action));
  }
  sim::WorldInput input{0, *std::move(action), sim::Author::kRun, RobotId()};
  if (request.robot.empty()) {
    if (request::needs_robot(request.action)) {
      return fail(ErrorCode::kInvalidArgument, "`{}` needs a robot",
                  request::name_of(request.action));
    }
    return std::vector{std::move(input)};
  }
  RAVE_TRY_ASSIGN(const auto robots, meant_robots(scenario, request.robot));
  for (const RobotId robot : robots) {
    input.robot = robot;
    inputs.push_back(input);
  }
  return inputs;
}

Result<std::vector<sim::WorldInput>> inputs_of(const config::ExpandedScenario& scenario,
                                               const sim::EngineSpec& spec,
                                               const config::ChangeFile& change) {
  std::vector<sim::WorldInput> inputs;
  if (change.request) {
    RAVE_TRY_ASSIGN(const request::Request request, request::from_node(*change.request));
    if (!request.by.empty() || request.overrides || request.page != 0) {
      return fail(ErrorCode::kInvalidArgument, "a request of a scenario is of no person");
    }
    return inputs_of(scenario, spec, request);
  }
  if (change.set) RAVE_TRY(add_set(scenario, spec, **change.robot, *change.set, inputs));
  if (change.changes_obstacle()) {
    RAVE_TRY_ASSIGN(inputs.emplace_back(), edit_input(change.obstacle));
  }
  return inputs;
}

Result<request::Request> request_of(std::string_view action, const script::Value& members) {
  RawNode node = RawNode::mapping();
  node.append("do", RawNode::text(std::string(action)));
  if (const auto* const table = members.table()) {
    for (const auto& [key, value] : *table) {
      const auto* const name = std::get_if<std::string>(&key);
      if (name == nullptr || *name == "do" || *name == "by" || *name == "overrides" ||
          *name == "page") {
        return fail(ErrorCode::kInvalidArgument,
                    "`{}`: expected members such as `robot`, found `{}`", action,
                    name != nullptr ? *name : "a value without a name");
      }
      node.append(*name, node_of(value));
    }
  } else if (!members.is_nil()) {
    return fail(ErrorCode::kInvalidArgument, "`{}`: expected a table, found {}", action,
                script::kind_text(members));
  }
  // A script says only once that something is edited.
  if (action == "edit") {
    RawNode edit = std::exchange(node, RawNode::mapping());
    edit.erase("do");
    node.append("do", RawNode::text("edit"));
    node.append("edit", std::move(edit));
  }
  // The value of a parameter is a text, as in a file.
  if (RawNode* const value = node.find("value"); action == "set" && value != nullptr) {
    *value = RawNode::text(value->scalar());
  }
  return request::from_node(node);
}

config::ExpandedScenario names_in(const config::ExpandedScenario& scenario) {
  config::ExpandedScenario names;
  names.scenario.step_s = scenario.scenario.step_s;
  names.scenario.seed = scenario.scenario.seed;
  names.scenario.users = scenario.scenario.users;
  names.scenario.teams = scenario.scenario.teams;
  names.groups = scenario.groups;
  names.robots = scenario.robots;
  return names;
}

std::vector<std::string> gifts_of(const config::ExpandedScenario& scenario, std::string_view team,
                                  std::string_view to) {
  std::vector<std::string> gifts;
  for (const std::string& one : config::teams_within(scenario, team)) {
    gifts.push_back(config::TeamGift::text(one, to));
  }
  return gifts;
}

Result<std::vector<std::string>> gifts_of(const config::ExpandedScenario& scenario,
                                          const script::Value& members) {
  const auto text = [&](std::string_view key) {
    const script::Value* const member = members.find(key);
    return member != nullptr && member->text() != nullptr ? *member->text() : std::string();
  };
  const bool known =
      std::ranges::any_of(scenario.scenario.users, [&](const config::UserFile& user) {
        return *user.name == text("to") && user.role != config::UserRole::kObserver;
      });
  std::vector<std::string> gifts = gifts_of(scenario, text("team"), text("to"));
  if (known && !gifts.empty()) return gifts;
  return fail(ErrorCode::kNotFound,
              "`give`: expected {{team = TEAM, to = COMMANDER}} of this scenario");
}

}  // namespace rave::runtime
