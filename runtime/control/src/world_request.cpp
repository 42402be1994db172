// SPDX-License-Identifier: Apache-2.0
#include "rave/control/world_request.hpp"

#include <algorithm>

#include "rave/assemble/parameter_key.hpp"
#include "rave/codec/diagnostics.hpp"
#include "rave/config/yaml.hpp"
#include "rave/control/obstacle_edits.hpp"
#include "rave/control/order_words.hpp"

namespace rave::runtime {
namespace {

using ObstacleKind = sim::ObstacleChange::Kind;
constexpr std::string_view kBodyKey = "body.scale";

/// Whether the scenario changes the body of a robot in this step.
bool is_scheduled(const sim::EngineSpec& spec, std::uint64_t step, RobotId robot) {
  return std::any_of(spec.changes.begin(), spec.changes.end(), [&](const auto& scheduled) {
    return scheduled.step == step && scheduled.robot == robot &&
           std::any_of(scheduled.changes.begin(), scheduled.changes.end(), [](const auto& change) {
             return change.part == sim::ParameterChange::Part::kBody;
           });
  });
}

}  // namespace

Result<sim::ParameterChange> requested_parameter(const sim::EngineSpec& spec, RobotId robot,
                                                 const request::Set& set) {
  if (!robot.valid())
    return fail(ErrorCode::kInvalidArgument, "expected the robot whose parameter changes");
  codec::Diagnostics diagnostics;
  const auto value = config::parse_yaml(set.value, "value", diagnostics);
  if (!value || !diagnostics.ok() || (!value->is_scalar() && !value->is_sequence())) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not a value of a parameter", set.value);
  }
  auto change = parse_change(spec.types[spec.robots[robot.value()].type], set.key, *value);
  // The place of an error within a word of the command line does not help the user, so it is
  // omitted.
  if (!change) return fail(change.error().code, "{}", change.error().message);
  return change;
}

Result<sim::WorldInput> input_of(const sim::EngineSpec& spec, const request::Request& request) {
  if (request::is_order(request.action) || request::is_hold(request.action)) {
    return input_for(spec, request);
  }
  sim::WorldInput input;
  input.author.name = request.by;
  if (!request.robot.empty()) {
    RAVE_TRY_ASSIGN(input.robot, find_robot(spec, request.robot));
  }
  if (const auto* const set = request.as<request::Set>()) {
    if (input.robot.valid() && set->key != kBodyKey) {
      return fail(ErrorCode::kState,
                  "the parameters of `{}` are set at its host: send the request to that process, "
                  "which `rave ps` lists; here only `{}` can be set",
                  request.robot, kBodyKey);
    }
    RAVE_TRY_ASSIGN(auto change, requested_parameter(spec, input.robot, *set));
    input.action = sim::Change{{std::move(change)}};
    return input;
  }
  if (const auto* const edit = request.as<request::Edit>()) {
    RAVE_TRY_ASSIGN(input.action, requested_change(edit->edit, request.by));
    return input;
  }
  if (request.is<request::HandOver, request::ResetShadow>()) {
    return fail(ErrorCode::kInvalidArgument,
                "hosts in lock-step cannot hand a robot over; run it in one process or in real "
                "time");
  }
  if (request::is_of_lease(request.action)) {
    return fail(ErrorCode::kState, "the lease of a robot is kept by its host");
  }
  return fail(ErrorCode::kInvalidArgument, "a request that changes nothing");
}

std::vector<request::Request> requests_in(const sim::EngineSpec& spec,
                                          const sim::WorldStep& world) {
  const auto name_of = [&spec](RobotId robot) {
    return robot.valid() ? spec.robots[robot.value()].name : std::string();
  };
  std::vector<request::Request> requests;
  for (const sim::ObstacleChange& change : world.obstacles) {
    if (change.asked.empty()) continue;
    auto edit = config::read_edit(change.asked, "edit");
    // What cannot be read did not get through the bus: lock_step::read_obstacle() refuses it.
    if (!edit) continue;
    requests.push_back({request::Edit{*std::move(edit)}, {}, change.by});
  }
  for (const sim::ResizedRobot& resized : world.resized) {
    if (is_scheduled(spec, world.step, resized.robot)) continue;
    requests.push_back({request::Set{std::string(kBodyKey), fmt::format("{}", resized.scale)},
                        name_of(resized.robot), resized.by});
  }
  for (const sim::WorldInput& input : world.inputs) {
    if (!input.author.by_hand || input.is<sim::Change>()) continue;
    requests.push_back(input_request(spec, input));
  }
  return requests;
}

std::string_view word_of(sim::ObstacleChange::Kind kind) noexcept {
  if (kind == ObstacleKind::kAdd) return "added";
  return kind == ObstacleKind::kMove ? "moved" : "removed";
}

}  // namespace rave::runtime
