// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/config/scenario_file.hpp"
#include "world_fields.hpp"

// The description of what happens in a run.
namespace rave::config {

/// A time of a run.
constexpr FieldOptions instant_s(std::string_view doc) {
  return {.doc = doc, .min = 0, .max = 1e9, .unit = "s"};
}

constexpr auto enum_names(EnumTag<HandOverTo> /*tag*/) {
  return std::array{EnumName{HandOverTo::kReal, "real"},
                    EnumName{HandOverTo::kSimulated, "simulated"},
                    EnumName{HandOverTo::kFirst, "first"}, EnumName{HandOverTo::kTwin, "twin"}};
}

constexpr auto enum_names(EnumTag<RunVerdict> /*tag*/) {
  return std::array{EnumName{RunVerdict::kSuccess, "success"},
                    EnumName{RunVerdict::kFailure, "failure"}};
}

template <class V>
void describe(V& v, ChangeFile& c) {
  v.field("name", c.name, {.doc = "Name, for `after` and for people."});
  v.field("at_s", c.at_s, instant_s("Time of the change, a multiple of the step."));
  v.field("when", c.when, {.doc = "Lua expression: happens when it begins to hold."});
  v.field("every_s", c.every_s, instant_s("Happens again and again, first after this time."));
  v.field("after", c.after, {.doc = "Happens after the entry with this name."});
  v.field("delay_s", c.delay_s, instant_s("With `when` and `after`: happens so much later."));
  v.field("repeat", c.repeat, {.doc = "With `when`: each time that it begins to hold."});
  v.field("robot", c.robot, {.doc = "Robot, or entry of robots, that changes."});
  v.field("set", c.set,
          {.doc = "New values by key: program.PARAM, controller.NAME.PARAM, "
                  "actuator.NAME.PARAM, body.scale."});
  v.field("hand_over", c.hand_over,
          {.doc = "Hands the robot over to other drivers: real, simulated, first (those of `file`) "
                  "or twin."});
  describe_edit(v, c.obstacle);
  v.field("request", c.request,
          {.doc = "What a person could ask, such as {do: goal, robot: r1, point: [1, 2]}."});
  v.field("give", c.give, {.doc = "Gives a team to another commander: {team: red, to: anna}."});
  v.field("mark", c.mark, {.doc = "Text for the events of the run."});
  v.field("end", c.end, {.doc = "Ends the run: success or failure."});
}

void validate(const ChangeFile& c, CheckContext& check);

}  // namespace rave::config
