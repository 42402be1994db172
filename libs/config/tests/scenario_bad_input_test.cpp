// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rave/config/scenario_file.hpp"

namespace rave::config {
namespace {

struct FileCase {
  const char* name;
  const char* text;
  const char* error;
};

// The name that GoogleTest looks for. NOLINTNEXTLINE(readability-identifier-naming)
void PrintTo(const FileCase& c, std::ostream* out) { *out << c.name; }
std::string name_of(const testing::TestParamInfo<FileCase>& info) { return info.param.name; }

#define BODY "body: {shapes: [{disc_radius_m: 0.1, z_m: [0, 0.1]}]}\n"

class BadRobot : public testing::TestWithParam<FileCase> {};

TEST_P(BadRobot, IsRefused) {
  const auto robot = read_robot_text(GetParam().text, "r.yaml");
  ASSERT_FALSE(robot.has_value());
  EXPECT_EQ(robot.error().text(), GetParam().error);
}

const FileCase kRobots[] = {
    {"NoBody", "description: x\n", "r.yaml:1:1: missing key `body`: expected a mapping"},
    {"NoShapes", "body: {shapes: []}\n",
     "r.yaml:1:16: `shapes`: found a list of 0 items, expected a list of 1 to 64 items, each a "
     "mapping"},
    {"NoOutline", "body:\n  shapes:\n    - {z_m: [0, 1]}\n",
     "r.yaml:3:7: expected exactly one of `disc_radius_m`, `box_m` and `polygon_m`, found none"},
    {"TwoOutlines", "body:\n  shapes:\n    - {disc_radius_m: 1, box_m: [1, 1], z_m: [0, 1]}\n",
     "r.yaml:3:7: expected exactly one of `disc_radius_m`, `box_m` and `polygon_m`, found two"},
    {"NegativeRadius", "body:\n  shapes:\n    - {disc_radius_m: -1, z_m: [0, 1]}\n",
     "r.yaml:3:23: `disc_radius_m`: found the number -1, expected a number (from 0.0001 to "
     "1000000, in metres)"},
    {"NoHeight", "body:\n  shapes:\n    - {disc_radius_m: 1}\n",
     "r.yaml:3:7: missing key `z_m`: expected a list of 2 items, each a number (from -1000000 to "
     "1000000, in metres)"},
    {"HeightsUpsideDown", "body:\n  shapes:\n    - {disc_radius_m: 1, z_m: [0.2, 0.1]}\n",
     "r.yaml:3:31: `z_m`: found 0.2 to 0.1, expected the first to be less than the second"},
    {"PolygonWithTwoCorners",
     "body:\n  shapes:\n    - {polygon_m: [[0, 0], [1, 0]], z_m: [0, 1]}\n",
     "r.yaml:3:19: `polygon_m`: found a list of 2 items, expected a list of 3 to 1000 items, each "
     "a list of 2 items, each a number (from -1000000 to 1000000, in metres)"},
    {"Colour", "body:\n  shapes: [{disc_radius_m: 0.1, z_m: [0, 0.1]}]\n  colour: red\n",
     "r.yaml:3:11: `colour`: found the text \"red\", expected `#rrggbb` with hexadecimal digits"},
    {"BarcodeHeightAlone",
     "body:\n  shapes: [{disc_radius_m: 0.1, z_m: [0, 0.1]}]\n  barcode_z_m: [0, 1]\n",
     "r.yaml:3:16: `barcode_z_m` is given without `barcode`"},
    {"UnitMissing", BODY "staleness: 1\n",
     "r.yaml:2:1: unknown key `staleness`: unit missing: expected `staleness_s` (seconds)"},
    {"Roll", BODY "sensors:\n  - {name: a, driver: b, mount: {roll_deg: 10}}\n",
     "r.yaml:3:44: `roll_deg`: found 10, expected 0: anything else needs the 3-D world, which does "
     "not exist yet"},
    {"NoDriver", BODY "sensors:\n  - {name: a}\n",
     "r.yaml:3:5: missing key `driver`: expected text that is not empty"},
    {"NegativePeriod", BODY "sensors:\n  - {name: a, driver: b, period_s: -1}\n",
     "r.yaml:3:36: `period_s`: found the number -1, expected a number (greater than 0 and at most "
     "1000000, in seconds)"},
    {"PhaseBeyondPeriod", BODY "sensors:\n  - {name: a, driver: b, period_s: 0.1, phase_s: 0.1}\n",
     "r.yaml:3:50: `phase_s`: found 0.1, expected less than `period_s` (0.1)"},
    {"UnknownLayer", BODY "sensors:\n  - {name: a, driver: b, senses: [real_robot]}\n",
     "r.yaml:3:35: item 1 of `senses`: found the text \"real_robot\", expected one of "
     "virtual_obstacles, mapped_real, simulated_robots and real_robots; did you mean "
     "`real_robots`?"},
    {"LayerTwice", BODY "sensors:\n  - {name: a, driver: b, senses: [real_robots, real_robots]}\n",
     "r.yaml:3:34: `senses` names a layer twice"},
    {"TwoFilters",
     BODY "sensors:\n  - {name: a, driver: b, filters: [{median: {}, exponential: "
          "{time_constant_s: 1}}]}\n",
     "r.yaml:3:36: expected exactly one of `median` and `exponential`, found two"},
    {"EvenWindow", BODY "sensors:\n  - {name: a, driver: b, filters: [{median: {window: 4}}]}\n",
     "r.yaml:3:54: `window`: found 4, expected an odd number"},
    {"Params", BODY "sensors:\n  - {name: a, driver: b, params: 3}\n",
     "r.yaml:3:34: `params`: found the number 3, expected a mapping"},
    {"SensorName", BODY "sensors:\n  - {name: a b, driver: b}\n",
     "r.yaml:3:12: `name`: found the text \"a b\", expected letters, digits, `-` and `_`"},
    {"SensorTwice", BODY "sensors:\n  - {name: a, driver: b}\n  - {name: a, driver: c}\n",
     "r.yaml:4:12: two sensors are named `a`; the first is at r.yaml:3:12"},
    {"ActuatorTwice", BODY "actuators:\n  - {name: a, driver: b}\n  - {name: a, driver: c}\n",
     "r.yaml:4:12: two actuators are named `a`; the first is at r.yaml:3:12"},
    {"ControllerTwice",
     BODY "actuators: [{name: w, driver: b}]\ncontrollers:\n"
          "  - {name: a, driver: b, actuator: w}\n  - {name: a, driver: c, actuator: w}\n",
     "r.yaml:5:12: two controllers are named `a`; the first is at r.yaml:4:12"},
    {"UnknownActuator",
     BODY "actuators: [{name: wheels, driver: b}]\ncontrollers:\n"
          "  - {name: a, driver: b, actuator: wheel}\n",
     "r.yaml:4:36: `actuator`: there is no actuator `wheel`; did you mean `wheels`?"},
    {"UnknownPoseSource", BODY "pose_from: mocap\n",
     "r.yaml:2:12: `pose_from`: there is no sensor `mocap`; there are none"},
    {"UnknownVariable", "variables: {robot: 1, code: 5}\n" BODY "description: $(robt)\n",
     "r.yaml:3:14: unknown variable `robt`; the robot file declares robot and code"},
    {"NoVariables", BODY "description: $(robot)\n",
     "r.yaml:2:14: unknown variable `robot`; the robot file declares none"},
    {"OpenVariable", BODY "description: a $(robot\n",
     "r.yaml:2:14: `$(` is not closed by `)`; write `$$(` for these characters"},
    {"VariableOfVariable", "variables: {a: 1, b: $(a)}\n" BODY,
     "r.yaml:1:22: the variable `b` may not contain `$(`"},
    {"ListAsVariable", "variables: {a: [1]}\n" BODY,
     "r.yaml:1:16: the variable `a`: found a list, expected a number, true, false or text"},
    {"VariableName", "variables: {a b: 1}\n" BODY,
     "r.yaml:1:13: `a b` cannot name a variable: expected letters, digits and `_`, the first no "
     "digit"},
    {"ValueOfAVariable",
     "variables: {r: wide}\nbody:\n  shapes:\n"
     "    - {disc_radius_m: $(r), z_m: [0, 1]}\n",
     "r.yaml:4:23: `disc_radius_m`: found the text \"wide\", expected a number (from 0.0001 to "
     "1000000, in metres)"},
};

INSTANTIATE_TEST_SUITE_P(Config, BadRobot, testing::ValuesIn(kRobots), name_of);

TEST(BadRobotPolygon, ThatCrossesItselfIsRefusedAtItsCorners) {
  const auto robot = read_robot_text(
      "body:\n  shapes:\n    - {polygon_m: [[0, 0], [1, 1], [1, 0], [0, 1]], z_m: [0, 1]}\n",
      "r.yaml");
  ASSERT_FALSE(robot.has_value());
  const std::string text = robot.error().text();
  EXPECT_TRUE(text.starts_with("r.yaml:3:19: `polygon_m`: ")) << text;
  EXPECT_NE(text.find("cross"), std::string::npos) << text;
}

class BadWorld : public testing::TestWithParam<FileCase> {};

TEST_P(BadWorld, IsRefused) {
  const auto world = read_world_text(GetParam().text, "w.yaml");
  ASSERT_FALSE(world.has_value());
  EXPECT_EQ(world.error().text(), GetParam().error);
}

const FileCase kWorlds[] = {
    {"NamedTwice", "obstacles:\n  - {name: a, disc_radius_m: 1}\n  - {name: a, disc_radius_m: 1}\n",
     "w.yaml:3:12: two obstacles are named `a`; the first is at w.yaml:2:12"},
    {"NoOutline", "obstacles:\n  - {name: a}\n",
     "w.yaml:2:5: expected exactly one of `disc_radius_m`, `box_m` and `polygon_m`, found none"},
    {"Layer", "obstacles:\n  - {name: a, disc_radius_m: 1, layer: real}\n",
     "w.yaml:2:40: `layer`: found the text \"real\", expected one of virtual_obstacles and "
     "mapped_real"},
    {"MapHeights", "maps:\n  - {file: a.yaml, z_m: [1, 1]}\n",
     "w.yaml:2:25: `z_m`: found 1 to 1, expected the first to be less than the second"},
};

INSTANTIATE_TEST_SUITE_P(Config, BadWorld, testing::ValuesIn(kWorlds), name_of);

class BadScenario : public testing::TestWithParam<FileCase> {};

TEST_P(BadScenario, IsRefused) {
  const auto scenario = read_scenario_text(GetParam().text, "s.yaml");
  ASSERT_FALSE(scenario.has_value());
  EXPECT_EQ(scenario.error().text(), GetParam().error);
}

const FileCase kScenarios[] = {
    {"NoRobots", "name: a\n",
     "s.yaml:1:1: missing key `robots`: expected a list of 1 to 100000 items, each a mapping"},
    {"Empty", "name: a\nrobots: []\n",
     "s.yaml:2:9: `robots`: found a list of 0 items, expected a list of 1 to 100000 items, each a "
     "mapping"},
    {"Name", "name: a/b\nrobots: [{name: r, file: r.yaml}]\n",
     "s.yaml:1:7: `name`: found the text \"a/b\", expected letters, digits, `-` and `_`"},
    {"Pace", "name: a\npace: 0x\nrobots: [{name: r, file: r.yaml}]\n",
     "s.yaml:2:7: `pace`: found the text \"0x\", expected `max`, `realtime` or a positive number "
     "followed by `x`, such as `10x`"},
    {"Clock", "name: a\nclock: realtime\nrobots: [{name: r, file: r.yaml}]\n",
     "s.yaml:2:8: `clock`: found the text \"realtime\", expected one of lock_step and "
     "real_time; did you mean `real_time`?"},
    {"WorldPeriod", "name: a\nworld_period_s: 0\nrobots: [{name: r, file: r.yaml}]\n",
     "s.yaml:2:17: `world_period_s`: found the number 0, expected a number (from 0.001 to 10, in "
     "seconds)"},
    {"PaceAsNumber", "name: a\npace: 10\nrobots: [{name: r, file: r.yaml}]\n",
     "s.yaml:2:7: `pace`: found the number 10, expected `max`, `realtime` or a positive number "
     "followed by `x`, such as `10x`"},
    {"NoFile", "name: a\nrobots:\n  - {name: r}\n",
     "s.yaml:3:5: the robot `r` has neither `file` nor `robot`"},
    {"TwoStarts", "name: a\nrobots:\n  - {name: r, file: r.yaml, pose: {}, poses: [[0, 0, 0]]}\n",
     "s.yaml:3:5: the robot `r` has more than one of `pose`, `poses`, `grid`, `ring` and "
     "`scatter`"},
    {"Scatter",
     "name: a\nrobots:\n  - {name: r, file: r.yaml, scatter: {x_m: [1, 0], y_m: [0, 1]}}\n",
     "s.yaml:3:44: `x_m`: found 1 to 0, expected the first not to be greater"},
    {"InlineRobot", "name: a\nrobots:\n  - {name: r, robot: {}}\n",
     "s.yaml:3:22: missing key `body`: expected a mapping"},
    {"InlineVariable",
     "name: a\nrobots:\n  - name: r\n    variables: {x: 1}\n    robot: {"
     "}\n",
     "s.yaml:4:20: unknown variable `x`; the robot file declares none"},
    {"GeoOrigin",
     "name: a\ngeo_origin: {latitude_deg: 91, longitude_deg: 8}\nrobots: [{name: r, file: "
     "r.yaml}]\n",
     "s.yaml:2:28: `latitude_deg`: found the number 91, expected a number (from -90 to 90, in "
     "degrees)"},
    {"GeoOriginKey",
     "name: a\ngeo_origin: {lattitude_deg: 47, longitude_deg: 8}\nrobots: [{name: r, file: "
     "r.yaml}]\n",
     "s.yaml:2:13: missing key `latitude_deg`: expected a number (from -90 to 90, in degrees)\n"
     "s.yaml:2:14: unknown key `lattitude_deg`; did you mean `latitude_deg`?"},
    {"Ros2Nodes", "name: a\nros2: {nodes: humbel}\nrobots: [{name: r, file: r.yaml}]\n",
     "s.yaml:2:15: `nodes`: found the text \"humbel\", expected one of none, humble and iron; did "
     "you "
     "mean `humble`?"},
    {"GuiNobody",
     "name: a\ngui: {rights: [{classes: [pose], reach: all}]}\nrobots: [{name: r, file: r.yaml}]\n",
     "s.yaml:2:16: expected exactly one of `role` and `user`"},
    {"GuiUserName",
     "name: a\ngui: {rights: [{user: \"ada \", classes: [pose], reach: all}]}\nrobots: [{name: r, "
     "file: r.yaml}]\n",
     "s.yaml:2:23: `user`: found `ada `, expected 1 to 32 letters, digits, `-`, `_`, `.` and `@`, "
     "the first a letter or digit"},
    {"GuiTeams",
     "name: a\ngui: {rights: [{role: observer, classes: [pose], reach: teams}]}\nrobots: [{name: "
     "r, "
     "file: r.yaml}]\n",
     "s.yaml:2:16: `teams` is required with `reach: teams` and not allowed without it"},
    {"GuiSuperUser",
     "name: a\ngui: {rights: [{role: super_user, classes: [pose], reach: none}]}\nrobots: [{name: "
     "r, "
     "file: r.yaml}]\n",
     "s.yaml:2:23: `role`: found the text \"super_user\", expected one of observer and commander"},
    {"GuiClass",
     "name: a\ngui: {rights: [{role: observer, classes: [poses], reach: none}]}\nrobots: [{name: "
     "r, "
     "file: r.yaml}]\n",
     "s.yaml:2:43: item 1 of `classes`: found the text \"poses\", expected one of pose, true_pose, "
     "readings, "
     "hybrid_parts, obstacles, goals, maps, chat, log, video, recording, stop, release, "
     "run_control, command, edit, probe and conduct; did you mean `pose`?"},
    {"GuiFileAndMore",
     "name: a\ngui: {file: gui.yaml, relay: true}\nrobots: [{name: r, file: r.yaml}]\n",
     "s.yaml:2:30: `relay`: expected in `gui.yaml`, which `file` names"},
    {"GuiComponent",
     "name: a\ngui: {components: [{module: panel.ts}]}\nrobots: [{name: r, file: r.yaml}]\n",
     "s.yaml:2:29: `module`: found `panel.ts`, expected a file that ends in .js or .mjs"},
    {"Instant",
     "name: a\nduration_s: 10\nrobots: [{name: r, file: r.yaml}]\n"
     "picture: {instant_s: 11}\n",
     "s.yaml:4:10: `instant_s`: found 11, expected at most `duration_s` (10)"},
    {"CompanionWithoutCommand",
     "name: a\nrobots: [{name: r, file: r.yaml}]\ncompanions:\n  - {name: m, command: []}\n",
     "s.yaml:4:24: `command`: found a list of 0 items, expected a list of 1 to 1000 items, each "
     "text"},
    {"CompanionTwice",
     "name: a\nrobots: [{name: r, file: r.yaml}]\ncompanions:\n  - {name: m, command: [x]}\n  - "
     "{name: m, command: [y]}\n",
     "s.yaml:5:12: two companions are named `m`; the first is at s.yaml:4:12"},
    {"CompanionEnvironment",
     "name: a\nrobots: [{name: r, file: r.yaml}]\ncompanions:\n  - {name: m, command: [x], "
     "environment: {A: [1]}}\n",
     "s.yaml:4:46: the variable `A`: found a list, expected a text or number"},
    {"CompanionEnd",
     "name: a\nrobots: [{name: r, file: r.yaml}]\ncompanions:\n  - {name: m, command: [x], on_end: "
     "stop}\n",
     "s.yaml:4:37: `on_end`: found the text \"stop\", expected one of ignore and end_run"},
};

INSTANTIATE_TEST_SUITE_P(Config, BadScenario, testing::ValuesIn(kScenarios), name_of);

}  // namespace
}  // namespace rave::config
