// SPDX-License-Identifier: Apache-2.0
// Obstacles that come, move and go in a world of several processes, started as users would start
// them.
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <random>

#include "rave/bus/sequence.hpp"
#include "rave/bus/writer.hpp"
#include "rave/record/run_reader.hpp"
#include "shared_world.hpp"
#include "stranger.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class EditsOverHosts : public SharedWorld {
 protected:
  /// `rave` in another terminal.
  [[nodiscard]] Ended rave(const Words& words) const {
    return run_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()});
  }
  [[nodiscard]] Ended add_box(const std::string& name, const std::string& at) const {
    return rave({"edit", "add", "box", "--name", name, "--at", at, "--size", "0.5x0.3"});
  }
  void start_all(const std::string& scenario, const Words& more = {}) {
    start("env", "env", scenario, more);
    start_host("one", scenario, more);
    start_host("two", scenario, more);
  }
  /// Until the manager takes requests.
  void wait_until_it_runs() {
    wait_until([&] { return rave({"edit", "list"}).exit_code == 0; }, "it runs");
  }
  void wait_for_size(const std::string& host) {
    wait_until(
        [&] {
          std::error_code error;
          const auto size = fs::file_size(folder(host) + "/run.mcap", error);
          return !error && size > 100'000;
        },
        host + " goes on");
  }
  /// What the record of a host says was asked by hand: kind, step, and what.
  [[nodiscard]] std::vector<std::string> inputs_of(const std::string& host) const {
    std::vector<std::string> inputs;
    const auto reader = record::McapReader::open(folder(host) + "/run.mcap");
    EXPECT_TRUE(reader) << reader.error().text();
    if (!reader) return inputs;
    const auto take = [&](const record::MessageView& message) -> Status {
      RAVE_TRY_ASSIGN(const record::RunInput input, record::decode_input(message.bytes));
      inputs.push_back(fmt::format("{} {} {} {} {}", input.step, input.kind, input.robot, input.key,
                                   input.value));
      return {};
    };
    EXPECT_TRUE(record::for_each_message(*reader, record::topic::kInputs, take));
    return inputs;
  }
  void expect_verified(const std::string& host) const {
    const Ended ended = rave({"verify", folder(host)});
    EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
    EXPECT_NE(ended.out.find("equal: "), std::string::npos) << ended.out;
  }
  void end_by_hand(const std::string& manager) {
    signal(manager, SIGINT);
    EXPECT_EQ(end_of(manager), 1) << console(manager);
  }
};

TEST_F(EditsOverHosts, AScenarioThatChangesObstaclesHasTheHashOfOneProcess) {
  const std::string alone = hash_alone("edited.yaml", {});
  ASSERT_EQ(alone.size(), 16U);
  start("run", "run", "edited.yaml");
  // As in one process: a change that cannot be made makes the run one that is not whole.
  EXPECT_EQ(end_of("run"), 1) << console("run");
  EXPECT_EQ(result("run")["hash"], alone);
  ASSERT_EQ(result("run")["problems"].size(), 1U);
  EXPECT_NE(result("run")["problems"][0].get<std::string>().find("obstacle `lid` would overlap"),
            std::string::npos);
  std::mt19937 chance(static_cast<unsigned>(::getpid()));
  for (const int processes : {2, 3}) {
    Words order = {"env"};
    for (int i = 1; i <= processes; ++i) order.push_back(fmt::format("host-{}", i));
    std::shuffle(order.begin(), order.end(), chance);
    const Words split = {"--processes", std::to_string(processes)};
    for (const std::string& who : order) {
      if (who == "env") {
        start("env", "env", "edited.yaml", split);
      } else {
        start_host(who, "edited.yaml", split);
      }
    }
    for (const std::string& who : order) {
      EXPECT_EQ(end_of(who), who == "env" ? 1 : 0) << who << console(who);
    }
    EXPECT_EQ(result("env")["hash"], alone) << processes;
  }
}

TEST_F(EditsOverHosts, WhatIsAskedInMidRunIsInTheRecordOfEveryHostAtTheSameStep) {
  start_all("crowd.yaml", {"--duration", "100000"});
  wait_until_it_runs();
  const Ended added = add_box("bale", "40,2,30");
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_NE(added.out.find("added `bale` at (40, 2), yaw "), std::string::npos) << added.out;
  EXPECT_NE(added.out.find("counts from step "), std::string::npos) << added.out;
  EXPECT_EQ(rave({"edit", "move", "bale", "--at", "-40,1"}).exit_code, 0);
  EXPECT_EQ(rave({"edit", "add", "polygon", "--name", "wedge", "--at", "34,-32", "--corners",
                  "0,0 1,0 0.5,1"})
                .exit_code,
            0);
  EXPECT_EQ(rave({"edit", "remove", "wedge"}).exit_code, 0);
  EXPECT_EQ(rave({"edit", "remove", "pillar"}).exit_code, 0);
  const Ended stopped = rave({"stop", "--robot", "left-1"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
  EXPECT_NE(stopped.out.find("stopped left-1; counts from step "), std::string::npos)
      << stopped.out;
  EXPECT_EQ(rave({"set", "right-2", "body.scale", "0.8"}).exit_code, 0);
  const Ended listed = rave({"edit", "list"});
  EXPECT_NE(listed.out.find("bale"), std::string::npos) << listed.out;
  EXPECT_NE(listed.out.find("(-40.000, 1.000) m"), std::string::npos) << listed.out;
  EXPECT_EQ(listed.out.find("wedge"), std::string::npos) << listed.out;
  end_by_hand("env");
  EXPECT_EQ(end_of("one"), 0);
  EXPECT_EQ(end_of("two"), 0);
  const std::vector<std::string> inputs = inputs_of("one");
  EXPECT_EQ(inputs.size(), 7U);
  EXPECT_EQ(inputs, inputs_of("two"));
  EXPECT_NE(content_of(folder("two") + "/events.log").find("obstacle added `bale` at (40, 2)"),
            std::string::npos);
  expect_verified("one");
  expect_verified("two");
}

TEST_F(EditsOverHosts, WhatCannotBeDoneIsRefusedWithASentence) {
  start_all("crowd.yaml", {"--duration", "100000"});
  wait_until_it_runs();
  const auto refused = [&](const Words& words, const std::string& why) {
    const Ended ended = rave(words);
    EXPECT_EQ(ended.exit_code, 1) << why;
    EXPECT_NE(ended.err.find(why), std::string::npos) << ended.err;
  };
  refused({"edit", "remove", "piller"}, "there is no obstacle `piller`; did you mean `pillar`?");
  refused({"edit", "add", "box", "--name", "lid", "--at", "0,0", "--size", "90000x90000"},
          "would overlap the robot `");
  refused({"set", "left-1", "program.cruise_mps", "0.1"}, "are set at its host");
  refused({"stop", "--robot", "left-99"}, "there is no robot `left-99`");
  // Where they are known, they can be set.
  const Ended there = rave({"set", "crowd@one", "left-1", "program.cruise_mps", "0.1"});
  EXPECT_EQ(there.exit_code, 0) << there.err;
  EXPECT_NE(console("env").find("refused: obstacle `lid` would overlap"), std::string::npos);
  end_by_hand("env");
}

TEST_F(EditsOverHosts, ARunIsHeldAndGoesOnStepByStep) {
  start("run", "run", "crowd.yaml", {"--duration", "100000", "--no-record"});
  wait_until_it_runs();
  EXPECT_EQ(rave({"pause"}).exit_code, 0);
  wait_until([&] { return rave({"ps"}).out.find("paused") != std::string::npos; }, "it is paused");
  const Ended added = add_box("bale", "40,2,30");
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_NE(added.out.find("requested; the run is paused"), std::string::npos) << added.out;
  EXPECT_EQ(rave({"edit", "list"}).out.find("bale"), std::string::npos);
  EXPECT_EQ(rave({"step"}).exit_code, 0);
  wait_for_line("run", "added `bale` at (40, 2)");
  EXPECT_NE(rave({"edit", "list"}).out.find("bale"), std::string::npos);
  EXPECT_NE(rave({"ps"}).out.find("paused"), std::string::npos);
  EXPECT_EQ(rave({"resume"}).exit_code, 0);
  EXPECT_EQ(rave({"edit", "remove", "bale"}).exit_code, 0);
  end_by_hand("run");
}

TEST_F(EditsOverHosts, AManagerThatIsKilledIsReplacedByOneThatKnowsTheObstacles) {
  const Words span = {"--duration", "40"};
  const Ended one_process =
      run_rave({"run", "edited.yaml", "--output", folder("alone"), "--processes", "1", "--pace",
                "max", "--no-record", "--no-picture", "--duration", "40"});
  EXPECT_EQ(one_process.exit_code, 1) << "a change is refused: " << one_process.err;
  start_all("edited.yaml", span);
  // In the step in which a change is refused.
  for (const char* const host : {"one", "two"}) wait_for_line(host, "obstacle moved: `east`");
  signal("env", SIGKILL);
  EXPECT_EQ(end_of("env"), -1);
  wait_for_line("one", "the environment manager is lost");
  Words goes_on = span;
  goes_on.emplace_back("--resume");
  start("second", "env", "edited.yaml", goes_on);
  EXPECT_EQ(end_of("second"), 1) << "of the change that was refused before";
  EXPECT_NE(result("second")["problems"].dump().find("obstacle `lid` would overlap"),
            std::string::npos)
      << result("second")["problems"];
  EXPECT_EQ(end_of("one"), 0) << console("one");
  EXPECT_EQ(end_of("two"), 0) << console("two");
  // What changed, who touched whom, and what was refused, also of before.
  for (const char* const part : {"hash", "events", "changes", "problems", "inputs_by_hand"}) {
    EXPECT_EQ(result("second")[part].dump(1), result("alone")[part].dump(1)) << part;
  }
  EXPECT_EQ(content_of(folder("second") + "/events.log"),
            content_of(folder("alone") + "/events.log"));
}

TEST_F(EditsOverHosts, ASuccessorGoesOnWithWhatWasEditedByHand) {
  start_all("crowd.yaml", {"--duration", "100000"});
  wait_until_it_runs();
  ASSERT_EQ(add_box("bale", "33,0,90").exit_code, 0);
  ASSERT_EQ(rave({"edit", "remove", "pillar"}).exit_code, 0);
  signal("env", SIGKILL);
  EXPECT_EQ(end_of("env"), -1);
  wait_for_line("one", "the environment manager is lost");
  start("second", "env", "crowd.yaml", {"--duration", "100000", "--resume"});
  wait_for_line("second", "takes over from a lost manager");
  wait_until_it_runs();
  const Ended listed = rave({"edit", "list"});
  EXPECT_NE(listed.out.find("bale"), std::string::npos) << listed.out;
  EXPECT_EQ(listed.out.find("pillar"), std::string::npos) << listed.out;
  EXPECT_EQ(rave({"edit", "move", "bale", "--at", "35,0,90"}).exit_code, 0);
  end_by_hand("second");
  EXPECT_EQ(result("second")["inputs_by_hand"], 3) << "two of them before it was there";
  EXPECT_EQ(end_of("one"), 0);
  EXPECT_EQ(end_of("two"), 0);
  EXPECT_EQ(inputs_of("one").size(), 3U);
  expect_verified("one");
}

TEST_F(EditsOverHosts, AHostThatIsKilledAndComesBackHasWhatWasEdited) {
  start_all("crowd.yaml", {"--duration", "100000"});
  wait_until_it_runs();
  ASSERT_EQ(add_box("bale", "33,0,90").exit_code, 0);
  ASSERT_EQ(rave({"edit", "move", "bale", "--at", "36,0.5"}).exit_code, 0);
  signal("one", SIGKILL);
  EXPECT_EQ(end_of("one"), -1);
  wait_for_line("env", "host `one` is gone");
  // Nothing is made while all wait, and who asks is told.
  const Ended later = add_box("crate", "40,3");
  EXPECT_EQ(later.exit_code, 0) << later.err;
  EXPECT_NE(later.out.find("requested; the run waits for one"), std::string::npos) << later.out;
  start("again", "robot", "crowd.yaml", {"--host", "one", "--duration", "100000"});
  wait_for_line("env", "host `one` is back");
  wait_for_size("again");
  wait_for_line("env", "added `crate`");
  const Ended listed = rave({"edit", "crowd@one", "list"});
  EXPECT_NE(listed.out.find("(36.000, 0.500) m"), std::string::npos) << listed.out;
  wait_until(
      [&] {
        return rave({"edit", "crowd@one", "list"}).out.find("crate") != std::string::npos;
      },
      "the edit that waited is there, too");
  end_by_hand("env");
}

/// A run of a known name, and a bus in this process from which anything can be sent to it.
class Garbage : public EditsOverHosts {
 protected:
  /// Sends it until the log of `who` has the text.
  template <class Message>
  void send_until(Message& message, const std::string& who, const std::string& text) {
    const auto bus = open_stranger(apart(), run_);
    ASSERT_TRUE(bus) << bus.error().text();
    auto writer = bus::Writer<Message>::create(**bus);
    ASSERT_TRUE(writer) << writer.error().text();
    wait_until(
        [&] {
          EXPECT_TRUE(writer->write(message));
          return console(who).find(text) != std::string::npos;
        },
        who + ": " + text);
  }

  bus::RunId run_ = bus::RunId::random();
};

/// An obstacle that nobody can build.
struct Nonsense {
  std::vector<double> x{0, 1, std::nan("")};
  std::vector<double> y{0, 0, 1};
  std::vector<rave_wire_BodyShape> shapes = std::vector<rave_wire_BodyShape>(1);
  std::vector<rave_wire_ObstacleChange> changes = std::vector<rave_wire_ObstacleChange>(1);

  Nonsense() {
    shapes[0].kind = rave_wire_SHAPE_POLYGON;
    shapes[0].z_max_m = 1;
    bus::borrow(shapes[0].x_m, x);
    bus::borrow(shapes[0].y_m, y);
    changes[0].id = 31;
    bus::put_text(changes[0].name, "nonsense");
    bus::borrow(changes[0].shapes, shapes);
  }
};

TEST_F(Garbage, NonsenseOfAStrangerIsRefusedAndTheRunGoesOn) {
  const Words words = {"--duration", "100000", "--run", run_.text()};
  start("env", "env", "crowd.yaml", words);
  Nonsense nonsense;
  bus::LastWorld last{};
  last.epoch = 7;
  bus::borrow(last.authority.obstacles, nonsense.changes);
  send_until(last, "env", "authority.obstacles[0].shapes[0].x_m is nan");
  start_host("one", "crowd.yaml", words);
  start_host("two", "crowd.yaml", words);
  wait_until_it_runs();
  bus::WorldStep world{};
  world.epoch = 7;
  bus::borrow(world.obstacles, nonsense.changes);
  send_until(world, "one", "obstacles[0].shapes[0].x_m is nan");
  EXPECT_EQ(add_box("bale", "40,2").exit_code, 0);
  EXPECT_EQ(rave({"edit", "list"}).out.find("nonsense"), std::string::npos);
  end_by_hand("env");
  EXPECT_EQ(end_of("one"), 0) << console("one");
}

class LiveEdits : public Garbage {
 protected:
  void begin(const std::string& who, const std::string& name) {
    Words words = {"--run", run_.text()};
    if (who != "env") words.insert(words.end(), {"--host", who});
    if (who == "env" && name != who) words.emplace_back("--resume");
    start(name, who == "env" ? "env" : "robot", "live.yaml", words);
  }
  void begin_all() {
    for (const char* const who : {"env", "one", "two"}) begin(who, who);
    wait_for_line("env", "all hosts have joined");
    wait_until_it_runs();
  }
  [[nodiscard]] bool host_has(const std::string& host, const std::string& text) const {
    return rave({"edit", "live@" + host, "list"}).out.find(text) != std::string::npos;
  }
};

TEST_F(LiveEdits, AnEditIsAroundAllRobotsWithinAMeasuredTime) {
  begin_all();
  const Ended added = add_box("bale", "0,5");
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_NE(added.out.find("added `bale` at (0, 5)"), std::string::npos) << added.out;
  EXPECT_NE(added.out.find("in effect at all 2 hosts "), std::string::npos) << added.out;
  EXPECT_EQ(rave({"edit", "move", "bale", "--at", "0.2,5"}).exit_code, 0);
  for (const char* const host : {"one", "two"}) {
    EXPECT_TRUE(host_has(host, "(0.200, 5.000) m")) << host;
  }
  EXPECT_EQ(rave({"edit", "remove", "bale"}).exit_code, 0);
  EXPECT_FALSE(host_has("one", "bale"));
  const Ended unknown = rave({"edit", "remove", "bal"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find("there is no obstacle `bal`"), std::string::npos) << unknown.err;
  // What is no edit is done by the hosts.
  const Ended stop = rave({"stop", "live"});
  EXPECT_EQ(stop.exit_code, 0) << stop.err;
  for (const char* const host : {"@one", "@two"}) {
    EXPECT_NE(stop.out.find(host), std::string::npos) << stop.out;
  }
  end_by_hand("env");
  const auto result = this->result("env");
  EXPECT_EQ(result["edits"], 3) << result.dump();
  EXPECT_EQ(result["edits_confirmed_by_all"], 3) << result.dump();
  EXPECT_TRUE(result["edit_slowest_s"].is_number()) << result.dump();
}

TEST_F(LiveEdits, WhoComesLateHasAllObstaclesBeforeItsFirstStep) {
  begin_all();
  ASSERT_EQ(add_box("bale", "0,5").exit_code, 0);
  ASSERT_EQ(add_box("gone", "0,-5").exit_code, 0);
  ASSERT_EQ(rave({"edit", "remove", "gone"}).exit_code, 0);
  ASSERT_EQ(rave({"edit", "move", "south", "--at", "0,-2.2"}).exit_code, 0);
  signal("two", SIGKILL);
  EXPECT_EQ(end_of("two"), -1);
  wait_for_line("env", "host `two` is gone");
  begin("two", "late");
  wait_for_line("late", "obstacle added: `bale`");
  wait_for_line("late", "obstacle removed: `gone`");
  wait_for_line("late", "obstacle moved: `south`");
  // All in the first step that this process made.
  signal("late", SIGINT);
  EXPECT_EQ(end_of("late"), 1);
  const std::string events = content_of(folder("late") + "/events.log");
  const auto time_of = [&](const std::string& text) {
    const std::size_t at = events.find(text);
    if (at == std::string::npos) return std::string("never: " + text);
    const std::size_t line = events.rfind('\n', at);
    return events.substr(line == std::string::npos ? 0 : line + 1, 12);
  };
  const auto late = result("late");
  EXPECT_EQ(time_of("obstacle added `bale`"), time_of("obstacle moved `south`")) << events;
  EXPECT_NEAR(std::stod(time_of("obstacle added `bale`")), late["first_step"].get<double>() * 0.01,
              0.0051)
      << events;
  end_by_hand("env");
}

TEST_F(LiveEdits, AManagerThatTakesOverKnowsTheObstacles) {
  begin_all();
  ASSERT_EQ(add_box("bale", "0,5").exit_code, 0);
  ASSERT_EQ(rave({"edit", "remove", "north"}).exit_code, 0);
  signal("env", SIGKILL);
  EXPECT_EQ(end_of("env"), -1);
  wait_for_line("one", "the environment manager is lost");
  begin("env", "second");
  wait_for_line("second", "takes over at");
  wait_until(
      [&] {
        return rave({"edit", "live", "move", "bale", "--at", "0.1,5"}).exit_code == 0;
      },
      "it knows the bale");
  const Ended listed = rave({"edit", "list"});
  EXPECT_EQ(listed.out.find("north"), std::string::npos) << listed.out;
  for (const char* const host : {"one", "two"}) {
    EXPECT_TRUE(host_has(host, "(0.100, 5.000) m")) << host;
  }
  end_by_hand("second");
}

TEST_F(LiveEdits, WhatTheScenarioCannotChangeIsAProblemOfTheRun) {
  start("run", "run", "live_edited.yaml");
  EXPECT_EQ(end_of("run"), 1) << console("run");
  const auto result = this->result("run");
  EXPECT_EQ(result["whole"], false);
  ASSERT_EQ(result["problems"].size(), 1U) << result.dump();
  const auto problem = result["problems"][0].get<std::string>();
  EXPECT_NE(problem.find("the change at "), std::string::npos) << problem;
  EXPECT_NE(problem.find("was refused: obstacle `lid` would overlap"), std::string::npos)
      << problem;
  // What all hosts had came once, whenever each of them had it.
  const std::string events = content_of(folder("run") + "/events.log");
  const std::size_t added = events.find("obstacle added `bale`");
  ASSERT_NE(added, std::string::npos) << events;
  EXPECT_EQ(events.find("obstacle added `bale`", added + 1), std::string::npos) << events;
}

TEST_F(LiveEdits, ARobotIsHandedOverByTheHostThatRunsIt) {
  const Words words = {"--run", run_.text()};
  start("env", "env", "live_twins.yaml", words);
  start_host("one", "live_twins.yaml", words);
  start_host("two", "live_twins.yaml", words);
  wait_for_line("env", "all hosts have joined");
  wait_until_it_runs();
  wait_for_line("two", "handed over: simulated -> simulated");
  // The run has three processes here; nobody needs to know which of them it is.
  const Ended made = rave({"hand-over", "left", "twin"});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("live_twins@one"), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("simulated -> simulated"), std::string::npos) << made.out;
  EXPECT_NE(console("one").find("handed over"), std::string::npos);
  const Ended again = rave({"hand-over", "left", "twin"});
  EXPECT_EQ(again.exit_code, 1) << again.out;
  EXPECT_NE(again.err.find("already has its"), std::string::npos) << again.err;
  end_by_hand("env");
}

TEST_F(LiveEdits, NonsenseIsRefusedWithALogLine) {
  begin_all();
  Nonsense nonsense;
  bus::Obstacle obstacle{};
  obstacle.id = 31;
  obstacle.revision = 9;
  obstacle.stands = nonsense.changes[0];
  send_until(obstacle, "one", "stands.shapes[0].x_m is nan");
  EXPECT_EQ(add_box("bale", "0,5").exit_code, 0);
  EXPECT_TRUE(host_has("one", "bale"));
  EXPECT_FALSE(host_has("one", "nonsense"));
  end_by_hand("env");
}

}  // namespace
}  // namespace rave::cli_test
