// SPDX-License-Identifier: Apache-2.0
// Orders to robots of a run: from the request to the recording, and again by verify().
#include <future>
#include <map>

#include "rave/assemble_testing/host_fixture.hpp"
#include "rave/base/file.hpp"
#include "rave/host/run.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/replay/verify.hpp"

namespace rave::runtime::testing {
namespace {

/// Asks for something behind certain steps, and keeps the answers.
class Commander final : public RunObserver {
 public:
  explicit Commander(RunControl& control) : control_(control) {}
  void at(std::uint64_t step, request::Request request) { asks_.emplace(step, std::move(request)); }
  void after_step(const StepView& step) override {
    const auto [begin, end] = asks_.equal_range(step.engine.steps_done());
    for (auto ask = begin; ask != end; ++ask) {
      auto answer = control_.post(ask->second);
      ASSERT_TRUE(answer);
      answers_.push_back(*std::move(answer));
    }
    if (step.engine.steps_done() == kLook) status = control_.status();
  }
  [[nodiscard]] std::vector<std::string> answers() {
    std::vector<std::string> texts;
    for (auto& answer : answers_) {
      const auto text = answer.get();
      texts.push_back(text ? *text : "refused: " + text.error().message);
    }
    return texts;
  }
  static constexpr std::uint64_t kLook = 150;
  RunStatus status;

 private:
  RunControl& control_;
  std::multimap<std::uint64_t, request::Request> asks_;
  std::vector<std::future<Result<std::string>>> answers_;
};

request::Request order(request::Action action, const std::string& robot, const std::string& by) {
  return {std::move(action), robot, by};
}

std::string scenario() {
  const std::string goals =
      "controllers: [{name: drive, driver: velocity, actuator: wheels}, "
      "{name: navigate, driver: goal_point, actuator: wheels}]";
  const std::string wheels = "actuators: [{name: wheels, driver: differential_drive}], ";
  return "name: orders\nduration_s: 8\npace: max\nrobots:\n"
         "  - {name: anna, file: ../robots/wanderer.yaml, pose: {x_m: 0, y_m: 0}}\n"
         "  - {name: bert, pose: {x_m: 0, y_m: 3}, robot: {" +
         kBody + ", " + wheels + goals + "}}\n  - {name: carl, pose: {x_m: 0, y_m: -3}, robot: {" +
         kBody + ", " + wheels + goals +
         ", program: {driver: obey, params: {velocity_sensor: \"\", goal_sensor: \"\"}}}}\n";
}

void ask_for_all_kinds(Commander& commander) {
  using request::Goal;
  using request::Path;
  commander.at(50, order(request::Place{{2, 1}, 0.5}, "anna", ""));
  commander.at(60, order(request::Drive{0.2, 1.0 / 3}, "anna", "lisa"));
  commander.at(60, order(Goal{{0.5, 3}, {}}, "bert", "lisa"));
  commander.at(60, order(Path{{{0.2, -3}, {0.4, -2.9}}, 0}, "carl", "mona"));
  commander.at(60, order(request::Text{"hello"}, "carl", "mona"));
  commander.at(70, order(Goal{{1, 1}, {}}, "anna", "mona"));           // lisa has it
  commander.at(70, order(Path{{{1, 1}, {2, 2}}, 0}, "bert", "lisa"));  // no program
  commander.at(160, order(request::Cancel(), "anna", "lisa"));
  commander.at(170, order(Goal{{2.5, 1.5}, {}}, "anna", "lisa"));
  commander.at(700, order(request::Stop(), "bert", "mona"));
}

TEST(OrderedRun, IsRecordedAndVerified) {
  Host host;
  const auto expanded = host.expand(scenario());
  ASSERT_TRUE(expanded) << expanded.error().text();
  RunControl control;
  Commander commander(control);
  ask_for_all_kinds(commander);
  RunOptions options;
  options.output = std::filesystem::path(::testing::TempDir()) / "rave_ordered_run";
  std::filesystem::remove_all(options.output);
  options.picture = false;
  options.control = &control;
  options.observers = {&commander};
  const auto outcome = run(*expanded, host.catalogue(), options);
  ASSERT_TRUE(outcome) << outcome.error().text();

  const std::vector<std::string> expected = {
      "anna is placed at 2.00, 1.00",
      "anna is driven",
      "bert is sent to 0.50, 3.00",
      "carl is sent along 2 points to 0.40, -2.90",
      "the text was sent to carl",
      "refused: `lisa` drives anna",
      "refused: robot `bert`, path: its program takes no paths",
      "anna: the orders of people are cancelled",
      "anna is sent to 2.50, 1.50",
      "stopped bert"};
  EXPECT_EQ(commander.answers(), expected);
  ASSERT_EQ(commander.status.robots.size(), 3U);
  const RunStatus::Robot& anna = commander.status.robots[0];
  EXPECT_EQ(anna.lease, "lisa");
  EXPECT_EQ(anna.order, "drive");
  EXPECT_EQ(anna.takes, (std::vector<std::string>{"drive", "goal", "path", "place"}));

  const std::string events = read_file(options.output / "events.log").value_or("");
  for (const char* const text :
       {"drive 0.20 m/s, 0.33 rad/s (by hand: lisa)", "goal 0.50, 3.00: reached",
        "I am at the end of the path.", "I obey goals and paths, not texts.", "`lisa` drives",
        "place 2.00, 1.00, yaw 29 deg (by hand)", "by hand: mona"}) {
    EXPECT_NE(events.find(text), std::string::npos) << text << "\n" << events;
  }
  const auto again = verify(options.output / "run.mcap", host.catalogue(), {});
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_TRUE(again->same()) << (again->difference ? again->difference->text : "");
  for (const std::string& note : again->notes) {
    EXPECT_EQ(note.find("refused here"), std::string::npos) << note;
  }
  EXPECT_EQ(again->hash, again->recorded_hash);
  std::filesystem::remove_all(options.output);
}

}  // namespace
}  // namespace rave::runtime::testing
