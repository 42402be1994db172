// SPDX-License-Identifier: Apache-2.0
#include "rave/assemble/twins.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "guards.hpp"
#include "rave/base/names.hpp"
#include "rave/base/word_table.hpp"
#include "rave/math/scalar.hpp"
#include "sees_others.hpp"

namespace rave::runtime {
namespace {

using config::HandOverTo;

constexpr WordTable<HandOverTo, 4> kWords = {{{"real", HandOverTo::kReal},
                                              {"simulated", HandOverTo::kSimulated},
                                              {"first", HandOverTo::kFirst},
                                              {"twin", HandOverTo::kTwin}}};

template <class Devices>
std::string names_of(const Devices& devices) {
  std::vector<std::string_view> names;
  for (const auto& device : devices) names.push_back(device.name.value);
  return names.empty() ? std::string("none") : join_names(names);
}

tl::unexpected<Error> differs(const config::RobotGroup& group, std::string_view what) {
  return fail_at(group.twin->robot.body.where, ErrorCode::kInvalidArgument,
                 "the twin of robot `{}` has another {} than the robot itself; the two files may "
                 "differ in drivers, their parameters, devices and guard",
                 group.name.value, what);
}

/// What the program and the world must find unchanged.
/// A hand-over changes drivers while the program keeps running and the world keeps its body.
Status check_same_robot(const config::RobotGroup& group) {
  const config::RobotFile& first = group.robot;
  const config::RobotFile& twin = group.twin->robot;
  if (!(first.body == twin.body)) return differs(group, "body");
  if (!(first.program == twin.program)) return differs(group, "program");
  if (!(first.controllers == twin.controllers)) return differs(group, "list of controllers");
  // Radios are not exchanged in a hand-over, so their drivers must be equal, too.
  if (!(first.transmitters == twin.transmitters)) return differs(group, "list of transmitters");
  if (!(first.communicators == twin.communicators)) return differs(group, "list of communicators");
  if (first.ros2 != twin.ros2) return differs(group, "value of `ros2`");
  return {};
}

template <class Devices>
Status check_names(const config::RobotGroup& group, std::string_view what, const Devices& first,
                   const Devices& twin) {
  const bool same =
      first.size() == twin.size() &&
      // In the same order, because the engine addresses both sets with the same indices.
      std::equal(first.begin(), first.end(), twin.begin(),
                 [](const auto& a, const auto& b) { return a.name.value == b.name.value; });
  if (same) return {};
  return fail_at(group.twin->robot.body.where, ErrorCode::kInvalidArgument,
                 "the twin of robot `{}` has the {} {}; expected those of the robot in their "
                 "order: {}",
                 group.name.value, what, names_of(twin), names_of(first));
}

Status check_kinds(const config::RobotGroup& group, const sim::RobotType& first,
                   const sim::RobotType& twin) {
  for (std::size_t s = 0; s < first.sensors.size(); ++s) {
    const sim::SensorSpec& a = first.sensors[s];
    const sim::SensorSpec& b = twin.sensors[s];
    const auto& file = group.twin->robot.sensors[s];
    if (a.kind != b.kind) {
      return fail_at(file.driver.where, ErrorCode::kInvalidArgument,
                     "sensor `{}` of the twin of robot `{}` gives {}; expected {}, as the driver "
                     "`{}` does",
                     a.name, group.name.value, to_string(b.kind), to_string(a.kind), a.driver);
    }
    // The program was told the mounts at its start. It would interpret readings from another place
    // wrongly.
    if (file.mount == group.robot.sensors[s].mount) continue;
    return fail_at(file.name.where, ErrorCode::kInvalidArgument,
                   "sensor `{}` of the twin of robot `{}` is mounted elsewhere", a.name,
                   group.name.value);
  }
  return {};
}

Result<sim::RobotType> make_twin(const DeviceContext& context, const config::RobotGroup& group) {
  RAVE_TRY(check_same_robot(group));
  RAVE_TRY(check_names(group, "sensors", group.robot.sensors, group.twin->robot.sensors));
  RAVE_TRY(check_names(group, "actuators", group.robot.actuators, group.twin->robot.actuators));
  return make_type(context, twin_group(group));
}

bool is_local(const DeviceContext& context, std::size_t robot) {
  const auto& local = context.options.local;
  return !local || std::find(local->begin(), local->end(),
                             RobotId(static_cast<std::uint32_t>(robot))) != local->end();
}

/// In lock-step the authority would have to learn of a hand-over during the step in which it
/// happens.
Status check_in_real_time(const DeviceContext& context) {
  const config::ScenarioFile& file = context.scenario.scenario;
  // `local` is set in a host of a split run. The process that starts such a run has no `local`, so
  // `processes` and `hosts` of the scenario count as well.
  const bool shared = context.options.local || file.processes || !file.hosts.empty();
  if (!shared || !context.built.live_reason.empty()) return {};
  for (const config::RobotGroup& group : context.scenario.groups) {
    if (!group.twin) continue;
    return fail_at(group.name.where, ErrorCode::kInvalidArgument,
                   "robot `{}` has a `twin`, whose drivers hosts in lock-step cannot change; "
                   "expected one process (neither `processes` nor `hosts`), or a run in real time "
                   "(`clock: real_time`)",
                   group.name.value);
  }
  return {};
}

}  // namespace

config::RobotGroup twin_group(const config::RobotGroup& group) {
  config::RobotGroup other = group;
  other.robot = group.twin->robot;
  other.file = group.twin->file;
  // A twin has no twin: there are two sets of drivers, and hand-overs go back and forth between
  // them.
  other.twin.reset();
  return other;
}

Result<sim::RobotType> make_type(const DeviceContext& context, const config::RobotGroup& group) {
  sim::RobotType type;
  type.name = group.name.value;
  type.folder = std::filesystem::path(group.file).parent_path().string();
  type.staleness = from_seconds(group.robot.staleness_s);
  type.pose_max_speed_mps = group.robot.pose_max_speed_mps;
  if (const auto turn_dps = group.robot.pose_max_turn_dps) {
    type.pose_max_turn_radps = deg_to_rad(*turn_dps);
  }
  RAVE_TRY(add_devices(context, group, type));
  RAVE_TRY_ASSIGN(type.guard, guard_spec(group));
  return type;
}

Status add_twins(const DeviceContext& context) {
  sim::EngineSpec& spec = context.built.spec;
  for (std::size_t r = 0; r < spec.robots.size(); ++r) {
    const config::RobotGroup& group = context.scenario.group_of(context.scenario.robots[r]);
    if (!group.twin) continue;
    const bool others = context.options.others != nullptr && !is_local(context, r);
    plugin::Catalogue& drivers = others ? *context.options.others : context.catalogue;
    RAVE_TRY_ASSIGN(auto twin,
                    make_twin({context.scenario, drivers, context.options, context.built}, group));
    const sim::RobotType& first = spec.types[spec.robots[r].type];
    RAVE_TRY(check_kinds(group, first, twin));
    // A shadow is the simulated twin of a real robot; two of one kind leave nothing to compare.
    if (group.shadow && first.simulated == twin.simulated) {
      return fail_at(group.name.where, ErrorCode::kInvalidArgument,
                     "`shadow` of robot `{}` needs a real and a simulated set of drivers, but "
                     "`file` and `twin` are both {}",
                     group.name.value, first.simulated ? "simulated" : "real");
    }
    spec.robots[r].twin = static_cast<std::uint32_t>(spec.types.size());
    spec.robots[r].hand_over = {group.hand_over.within_m, deg_to_rad(group.hand_over.within_deg)};
    // With either set of drivers the twin may need the poses of other robots.
    const std::uint32_t type = spec.robots[r].type;
    if (sees_others(twin)) context.built.sees[type] = 1;
    context.built.sees.push_back(std::uint8_t{context.built.sees[type]});
    spec.types.push_back(std::move(twin));
  }
  return check_in_real_time(context);
}

Result<config::HandOverTo> hand_over_word(std::string_view word) {
  if (const auto to = kWords.find(word)) return *to;
  const auto words = kWords.words();
  return fail(ErrorCode::kInvalidArgument, "`{}`: expected one of {}{}", word, join_names(words),
              suggestion(word, words));
}

Result<sim::DriverSet> driver_set(const sim::EngineSpec& spec, RobotId robot, sim::DriverSet active,
                                  HandOverTo to) {
  const sim::RobotSpec& its = spec.robots[robot.value()];
  if (!its.twin) {
    return fail(ErrorCode::kInvalidArgument,
                "robot `{}` has one set of drivers; `twin:` in the scenario names another",
                its.name);
  }
  // `first` and `twin` name a set; `real` and `simulated` name what the robot should become, which
  // needs the set that is active now and two sets of different kinds.
  if (to == HandOverTo::kFirst) return sim::DriverSet::kFirst;
  if (to == HandOverTo::kTwin) return sim::DriverSet::kTwin;
  const bool simulated = spec.types[its.type].simulated;
  if (simulated == spec.types[*its.twin].simulated) {
    return fail(ErrorCode::kInvalidArgument,
                "both sets of drivers of robot `{}` are {}; say `first` or `twin`", its.name,
                simulated ? "simulated" : "real");
  }
  if (simulated == (to == HandOverTo::kSimulated)) return active;
  return active == sim::DriverSet::kFirst ? sim::DriverSet::kTwin : sim::DriverSet::kFirst;
}

Status add_hand_overs(const config::ExpandedScenario& scenario, sim::EngineSpec& spec) {
  const double step_s = scenario.scenario.step_s.value;
  for (const config::ChangeFile& file : scenario.scenario.changes) {
    if (!file.robot || !file.hand_over) continue;
    for (const std::size_t r : config::robots_named(scenario, file.robot->value)) {
      const RobotId robot(static_cast<std::uint32_t>(r));
      auto set = driver_set(spec, robot, sim::DriverSet::kFirst, *file.hand_over);
      if (!set) {
        return fail_at(file.robot->where, ErrorCode::kInvalidArgument, "`hand_over`: {}",
                       set.error().message);
      }
      const auto step = static_cast<std::uint64_t>(std::llround(**file.at_s / step_s));
      spec.hand_overs.push_back({step, robot, *set});
    }
  }
  std::stable_sort(spec.hand_overs.begin(), spec.hand_overs.end(),
                   [](const auto& a, const auto& b) { return a.step < b.step; });
  return {};
}

}  // namespace rave::runtime
