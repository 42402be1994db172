// SPDX-License-Identifier: Apache-2.0
// A program that crashes, hangs or throws costs its own robot and nobody else's.
#include <fstream>
#include <thread>

#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

class Faults : public ScenarioTest {
 protected:
  void SetUp() override {
    ScenarioTest::SetUp();
    folder_ /= "run";
  }

  /// Three wanderers far apart, the first with a program that goes wrong.
  config::ExpandedScenario with_program(const std::string& program, bool isolate) {
    const std::string wanderer = std::string(RAVE_SOURCE_DIR) + "/robots/wanderer.yaml";
    const std::string text =
        "name: faults\nduration_s: 2\nrobots:\n"
        "  - {name: broken, file: " +
        wanderer +
        ", pose: {x_m: 0, y_m: 0}}\n"
        "  - {name: sound, file: " +
        wanderer + ", poses: [[10, 0, 0], [20, 0, 0]]}\n";
    auto scenario = config::expand_scenario_text(text, folder_ / "faults.yaml");
    EXPECT_TRUE(scenario) << (scenario ? "" : scenario.error().text());
    config::ProgramFile& file = *scenario->groups[0].robot.program;
    file.driver.value = program;
    file.isolate = isolate;
    file.params = codec::RawNode();
    return *scenario;
  }

  runtime::RunOutcome run_faulty(const config::ExpandedScenario& scenario) {
    plugin::Catalogue catalogue(runtime::host_stamp());
    const std::filesystem::path build(RAVE_BINARY_DIR);
    EXPECT_TRUE(catalogue.add_folder(build / "tests/plugins/isolation"));
    EXPECT_TRUE(catalogue.add_folder(build / "lib/rave/plugins"));
    runtime::RunOptions options;
    options.output = folder_;
    options.program_runner = build / "bin/rave-program-runner";
    options.picture = false;
    auto outcome = runtime::run(scenario, catalogue, options);
    EXPECT_TRUE(outcome) << (outcome ? "" : outcome.error().text());
    return outcome.value_or(runtime::RunOutcome{});
  }

  /// The line of the test plug-in's source that carries a mark.
  static std::string line_of(std::string_view mark) {
    const std::string path = "runtime/isolation/tests/plugins/faults.cpp";
    std::ifstream file(std::filesystem::path(RAVE_SOURCE_DIR) / path);
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      if (line.find(std::string("mark: ") + std::string(mark)) != std::string::npos) {
        return path + ":" + std::to_string(number);
      }
    }
    return "no such mark";
  }

  /// Who moved, from the summary of each robot in result.json.
  std::string result() const {
    std::ifstream file(folder_ / "result.json");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  void expect_only_the_broken_one_lost(const runtime::RunOutcome& outcome,
                                       const std::string& text) {
    EXPECT_FALSE(outcome.whole);
    ASSERT_EQ(outcome.problems.size(), 1U);
    EXPECT_NE(outcome.problems[0].find("robot `broken`"), std::string::npos);
    EXPECT_NE(outcome.problems[0].find(text), std::string::npos) << outcome.problems[0];
    const std::string json = result();
    EXPECT_NE(json.find("\"program_failed\": 1"), std::string::npos);
    EXPECT_NE(json.find("\"steps\": 200"), std::string::npos) << "the run went to its end";
  }
};

TEST_F(Faults, ACrashNamesItsLineAndCostsOneRobot) {
  const auto outcome = run_faulty(with_program("null_pointer", true));
  expect_only_the_broken_one_lost(outcome, line_of("null_pointer"));
}

TEST_F(Faults, AnEndlessLoopNamesItsLineAndCostsOneRobot) {
  const auto outcome = run_faulty(with_program("endless", true));
  expect_only_the_broken_one_lost(outcome, "has not decided for 1.0 s");
}

TEST_F(Faults, AnExceptionCostsOneRobotEvenInTheHost) {
  const auto outcome = run_faulty(with_program("throws", false));
  expect_only_the_broken_one_lost(outcome, "threw an exception");
}

TEST(RunControl, StepsOneByOneAndEnds) {
  runtime::RunControl control;
  EXPECT_TRUE(control.wait_for_turn()) << "nothing holds a run at first";
  control.pause();
  EXPECT_TRUE(control.paused());
  control.step(2);
  EXPECT_TRUE(control.wait_for_turn());
  EXPECT_TRUE(control.wait_for_turn());
  bool turn = true;
  std::thread run([&] { turn = control.wait_for_turn(); });
  control.stop();
  run.join();
  EXPECT_FALSE(turn) << "the third step was not asked for";
}

TEST(RunControl, ResumeLetsAHeldRunGoOn) {
  runtime::RunControl control;
  control.pause();
  bool turn = false;
  std::thread run([&] { turn = control.wait_for_turn(); });
  control.resume();
  run.join();
  EXPECT_TRUE(turn);
  EXPECT_FALSE(control.paused());
}

}  // namespace
}  // namespace rave::tests
