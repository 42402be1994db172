// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "rave/control/order_desk.hpp"
#include "rave/control/order_words.hpp"

namespace rave::runtime::testing {
namespace {

using namespace std::chrono_literals;

request::Request request(request::Action action, const std::string& by,
                         const std::string& robot = "r1") {
  return {std::move(action), robot, by};
}

request::Request drive(const std::string& by, double v_mps) {
  return request(request::Drive{v_mps, 0}, by);
}

request::Request goal(const std::string& by) { return request(request::Goal{{1, 2}, {}}, by); }

/// A desk before a run that takes everything, and what has become inputs.
struct Office {
  OrderDesk desk;
  std::vector<std::string> inputs;
  bool driven = false;
  bool refuses = false;
  ErrorCode error = ErrorCode::kState;
  OrderDesk::Time now{1h};

  OrderDesk::Give give() {
    return [this](const request::Request& asked) -> Result<std::string> {
      if (refuses) return fail(error, "it is stopped");
      const auto* const drive = asked.as<request::Drive>();
      driven = drive != nullptr;
      inputs.push_back(
          fmt::format("{} {} {}{}", request::name_of(asked.action), asked.robot, asked.by,
                      drive != nullptr ? fmt::format(" {}", drive->v_mps) : std::string()));
      return std::string("done");
    };
  }
  std::string serve(const request::Request& asked) {
    const auto answer = desk.serve(
        asked, give(), [this](const std::string&) { return driven; }, now);
    return answer ? *answer : answer.error().message;
  }
  void wait(std::chrono::milliseconds time) {
    now += time;
    desk.tick(give(), now);
  }
  std::vector<std::string> take() { return std::exchange(inputs, {}); }
};

using Lines = std::vector<std::string>;

TEST(OrderDesk, ADriveThatIsRenewedIsOneInput) {
  Office office;
  EXPECT_EQ(office.serve(drive("anna", 0.3)), "done");
  for (int i = 0; i < 100; ++i) {
    office.wait(16ms);
    EXPECT_EQ(office.serve(drive("anna", 0.3)), "r1 is driven");
  }
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0.3"});
  EXPECT_EQ(office.serve(drive("anna", 0.4)), "done");
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0.4"});
}

TEST(OrderDesk, ASilentDriverLetsTheRobotStandAndLosesItLater) {
  Office office;
  office.serve(drive("anna", 0.3));
  office.take();
  office.wait(199ms);
  EXPECT_TRUE(office.take().empty());
  office.wait(1ms);
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0"});
  EXPECT_EQ(office.desk.holder("r1"), "anna");
  EXPECT_EQ(office.serve(drive("bert", 0.1)), "`anna` drives r1");
  office.wait(2750ms);
  EXPECT_TRUE(office.take().empty());
  office.wait(50ms);
  EXPECT_EQ(office.take(), Lines{"cancel r1 anna"}) << "its program goes on";
  EXPECT_EQ(office.desk.holder("r1"), "");
  EXPECT_EQ(office.serve(drive("bert", 0.1)), "done");
}

TEST(OrderDesk, ATextDoesNotHideThatTheDriverIsSilent) {
  Office office;
  office.serve(drive("anna", 0.3));
  EXPECT_EQ(office.serve(request(request::Text{"hello"}, "anna")), "done");
  office.take();
  office.wait(200ms);
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0"});
}

TEST(OrderDesk, AGoalEndsTheDriveBeforeIt) {
  Office office;
  office.serve(drive("anna", 0.3));
  EXPECT_EQ(office.serve(goal("anna")), "done");
  office.take();
  office.wait(1s);
  EXPECT_TRUE(office.take().empty()) << "nobody is silent who does not drive";
}

TEST(OrderDesk, AFloodOfOthersTakesNothingFromTheDriver) {
  Office office;
  EXPECT_EQ(office.serve(drive("anna", 0.3)), "done");
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(office.serve(drive("bert", 0.1)), "`anna` drives r1");
  EXPECT_EQ(office.serve(drive("anna", 0.2)), "done");
}

TEST(OrderDesk, AStickAtRestKeepsTheRobot) {
  Office office;
  for (int i = 0; i < 300; ++i) {
    office.serve(drive("anna", 0));
    office.wait(100ms);
  }
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0"});
  EXPECT_EQ(office.desk.holder("r1"), "anna");
}

TEST(OrderDesk, WhoIsRefusedByTheRunHasNoLease) {
  Office office;
  office.refuses = true;
  EXPECT_EQ(office.serve(goal("anna")), "it is stopped");
  EXPECT_EQ(office.serve(drive("anna", 0.3)), "it is stopped");
  EXPECT_EQ(office.desk.holder("r1"), "");
  EXPECT_FALSE(office.desk.waits());
}

TEST(OrderDesk, AfterAStopTheSameDriveCountsAnewOnceTheStickWasNeutral) {
  Office office;
  office.serve(drive("anna", 0.3));
  office.driven = false;  // as a stop does
  const std::string held =
      "r1 was stopped while it was driven; let the stick go before it drives r1";
  EXPECT_EQ(office.serve(drive("anna", 0.3)), held);
  office.wait(999ms);
  EXPECT_EQ(office.serve(drive("anna", 0.2)), held) << "it is held on";
  office.take();
  EXPECT_EQ(office.serve(drive("anna", 0)), "the stick of r1 is neutral");
  EXPECT_TRUE(office.take().empty()) << "that drives nothing";
  EXPECT_EQ(office.serve(drive("anna", 0.3)), "done");
  EXPECT_EQ(office.take().size(), 1U);
}

TEST(OrderDesk, TwoCommandersDoNotFight) {
  Office office;
  EXPECT_EQ(office.serve(goal("anna")), "done");
  EXPECT_EQ(office.serve(goal("bert")), "`anna` drives r1");
  EXPECT_EQ(office.serve(request(request::Cancel(), "bert")), "`anna` drives r1");
  EXPECT_EQ(office.serve(request(request::Release(), "bert")), "`anna` drives r1");
  request::Request take = request(request::Take(), "bert");
  EXPECT_EQ(office.serve(take), "`anna` drives r1");
  office.serve(drive("anna", 0.3));
  office.take();
  take.action = request::Take{.force = true};
  EXPECT_EQ(office.serve(take), "r1 is yours; it was taken from `anna`");
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0"}) << "it stands until bert says something";
  EXPECT_EQ(office.serve(drive("anna", 0.3)), "`bert` drives r1");
  const auto changes = office.desk.take_changes();
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[1].before, "anna");
  EXPECT_EQ(changes[1].after, "bert");
}

TEST(OrderDesk, WhoDrivesARobotAloneHandsItOver) {
  Office office;
  EXPECT_EQ(office.serve(request(request::HandOver(), "bert")), "done") << "nobody drives it";
  EXPECT_EQ(office.serve(goal("anna")), "done");
  EXPECT_EQ(office.serve(request(request::HandOver(), "bert")), "`anna` drives r1");
  EXPECT_EQ(office.serve(request(request::HandOver(), "anna")), "done");
  request::Request root = request(request::HandOver(), "root");
  root.overrides = true;
  EXPECT_EQ(office.serve(root), "done");
  EXPECT_EQ(office.serve(request(request::HandOver(), "")), "done") << "the terminal";
}

TEST(OrderDesk, ASecondPageOfTheSamePersonTakesItAndTheRobotStands) {
  Office office;
  request::Request first = drive("anna", 0.3);
  first.page = 1;
  request::Request second = drive("anna", 0.1);
  second.page = 2;
  EXPECT_EQ(office.serve(first), "done");
  EXPECT_NE(office.serve(second).find("you drive r1 on another page"), std::string::npos);
  request::Request release = request(request::Release(), "anna");
  release.page = 2;
  EXPECT_NE(office.serve(release).find("you drive r1 on another page"), std::string::npos);
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0.3"});
  request::Request take = request(request::Take{.force = true}, "anna");
  take.page = 2;
  EXPECT_EQ(office.serve(take), "r1 is yours; it was taken from another page of yours");
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0"});
  EXPECT_EQ(office.desk.page("r1"), 2U);
  EXPECT_NE(office.serve(first).find("you drive r1 on another page"), std::string::npos);
  EXPECT_EQ(office.serve(second), "done");
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0.1"});
}

request::Request on_page(request::Request request, std::uint64_t page) {
  request.page = page;
  return request;
}

TEST(OrderDesk, AStickThatIsHeldWhileTheRobotIsArmedMovesNothingUntilItIsNeutral) {
  Office office;
  office.refuses = true;
  const request::Request held = on_page(drive("anna", 0.3), 7);
  EXPECT_EQ(office.serve(held), "it is stopped");
  office.refuses = false;  // it is released and armed
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(office.serve(held), "it is stopped; let the stick go before it drives r1");
    office.wait(33ms);
  }
  const auto asks = on_page(request(request::Take{.drives = true}, "anna"), 7);
  EXPECT_EQ(office.serve(asks), "it is stopped; let the stick go before it drives r1")
      << "over the bus a drive has no other answer";
  office.wait(10s);
  EXPECT_NE(office.serve(held), "done") << "a page that was away may hold it still";
  EXPECT_TRUE(office.take().empty());
  EXPECT_EQ(office.serve(on_page(drive("anna", 0), 7)), "the stick of r1 is neutral");
  EXPECT_EQ(office.serve(held), "done");
  EXPECT_EQ(office.serve(asks), "r1 is yours");
}

TEST(OrderDesk, AStickThatWasRefusedForTheLeaseOfAnotherDoesNotDriveWhenThatEnds) {
  Office office;
  office.serve(on_page(drive("anna", 0.3), 1));
  const request::Request held = on_page(drive("bert", 0.1), 2);
  EXPECT_EQ(office.serve(held), "`anna` drives r1");
  office.serve(on_page(request(request::Give(), "anna"), 1));
  EXPECT_EQ(office.serve(held), "`anna` drives r1; let the stick go before it drives r1");
  EXPECT_EQ(office.serve(on_page(drive("bert", 0), 2)), "the stick of r1 is neutral");
  EXPECT_EQ(office.serve(held), "done");
}

TEST(OrderDesk, AMistakeInADriveHoldsNoStick) {
  Office office;
  office.error = ErrorCode::kInvalidArgument;
  office.refuses = true;
  EXPECT_EQ(office.serve(drive("anna", 1000)), "it is stopped");
  office.refuses = false;
  EXPECT_EQ(office.serve(drive("anna", 1)), "done");
}

TEST(OrderDesk, ADriverWhoWasSuspendedDoesNotDriveOn) {
  Office office;
  const request::Request held = on_page(drive("", 0.3), 9);
  EXPECT_EQ(office.serve(held), "done");
  office.wait(200ms);
  office.wait(800ms);
  EXPECT_EQ(office.serve(held), "done") << "a slow link";
  office.wait(200ms);
  office.wait(801ms);
  EXPECT_EQ(office.serve(held),
            "the driver of r1 was silent for 1.0 s; let the stick go, then drive on");
  office.wait(60s);
  office.take();
  EXPECT_EQ(office.serve(held),
            "the driver of r1 was silent for 61.0 s; let the stick go, then drive on");
  EXPECT_TRUE(office.take().empty());
  EXPECT_EQ(office.serve(on_page(drive("", 0.3), 10)), "done") << "another terminal";
}

TEST(OrderDesk, TwoTerminalsDoNotShareALease) {
  Office office;
  const request::Request first = on_page(drive("", 0.3), 1);
  const request::Request second = on_page(drive("", -0.3), 2);
  const std::string refused = "another terminal drives r1; `--force` takes it from there";
  EXPECT_EQ(office.serve(first), "done");
  EXPECT_EQ(office.serve(second), refused);
  EXPECT_EQ(office.serve(request(request::Goal(), "")), refused) << "a script";
  EXPECT_EQ(office.take(), Lines{"drive r1  0.3"});
  const auto take = on_page(request(request::Take{.force = true}, ""), 3);
  EXPECT_EQ(office.serve(take), "r1 is yours; it was taken from another terminal of yours");
  EXPECT_EQ(office.serve(first), refused);
  EXPECT_EQ(office.serve(on_page(drive("", -0.3), 3)), "done");
}

TEST(OrderDesk, ATerminalThatHasDrivenLeavesTheRobotToOthers) {
  Office office;
  EXPECT_EQ(office.serve(on_page(drive("", 0.3), 1)), "done");
  EXPECT_EQ(office.serve(on_page(request(request::Cancel(), ""), 1)), "done");
  EXPECT_EQ(office.desk.holder("r1"), "");
  EXPECT_EQ(office.take(), (Lines{"drive r1  0.3", "cancel r1 "}));
  EXPECT_EQ(office.serve(on_page(drive("", 0.3), 2)), "done");
}

TEST(OrderDesk, ALeaseThatIsGivenBackGivesTheRobotToItsProgram) {
  Office office;
  office.serve(goal("anna"));
  office.take();
  EXPECT_EQ(office.serve(request(request::Give(), "anna")), "no person drives r1 now");
  EXPECT_EQ(office.take(), Lines{"cancel r1 anna"});
}

TEST(OrderDesk, ReleaseNeedsTheLeaseOrRights) {
  Office office;
  office.serve(goal("anna"));
  EXPECT_EQ(office.serve(request(request::Release(), "anna")), "done");
  request::Request root = request(request::Release(), "root");
  EXPECT_EQ(office.serve(root), "`anna` drives r1");
  root.overrides = true;
  EXPECT_EQ(office.serve(root), "done");
  EXPECT_EQ(office.serve(request(request::Release(), "")), "done") << "a terminal";
  EXPECT_NE(office.serve(request(request::Release(), "anna", "")).find("super-user"),
            std::string::npos);
  EXPECT_NE(office.serve(request(request::Cancel(), "anna", "")).find("super-user"),
            std::string::npos);
  EXPECT_EQ(office.serve(request(request::Cancel(), "", "")), "done");
}

TEST(OrderDesk, AFloodIsRefused) {
  Office office;
  int done = 0;
  for (int i = 0; i < 500; ++i) {
    if (office.serve(drive("anna", 0.001 * i)) == "done") ++done;
  }
  EXPECT_EQ(done, 100);
  EXPECT_NE(office.serve(goal("anna")).find("more than 100 orders in a second"), std::string::npos);
  office.wait(100ms);
  EXPECT_EQ(office.serve(goal("anna")), "done");
}

TEST(OrderDesk, RefusesWhatIsForNobody) {
  Office office;
  EXPECT_EQ(office.serve(request(request::Goal(), "anna", "")), "`goal` needs a robot");
  EXPECT_EQ(office.serve(goal("terminal")), "`terminal` is not a valid name of a person");
}

TEST(RecordedWords, ComeBackBitByBit) {
  const request::Action all[] = {
      request::Path{{{0.1, std::nextafter(1.0, 2.0)}, {-1e-300, 1e6}}, 1.0 / 3},
      request::Place{{1, 2}, -0.1},
      request::Text{"points 1 2, please"},
      request::Drive{-0.1, 2.0 / 3},
      request::Drive{0, 0, -1.0 / 3},
      request::Drive{0.1, 0, 0, request::Pedals{-1.0 / 3, 1, 0.1, -1}},
      request::Goal{{1, 2}, {}, 0.5},
      request::Cancel(),
      request::Stop(),
      request::Release(),
      request::Arm(),
      request::Set{"program.speed", "[1, 2]"},
      request::HandOver{"twin"},
      request::ResetShadow(),
      request::Edit{config::read_edit("{remove_obstacle: a}", "test").value()}};
  for (const request::Action& action : all) {
    const RecordedWords words = recorded_words(action);
    const auto read = recorded_action(words);
    ASSERT_TRUE(read) << words.kind << " " << words.value << ": " << read.error().text();
    EXPECT_EQ(*read, action) << words.kind << " " << words.value;
  }
}

TEST(RecordedWords, AreThoseOfOlderRecordings) {
  const RecordedWords goal = recorded_words(request::Goal{{1.5, 2}, 0.5, 0.2});
  EXPECT_EQ(goal.kind, "goal");
  EXPECT_EQ(goal.value, "points 1.5 2 yaw 0.5 speed 0.2");
  EXPECT_EQ(recorded_words(request::Drive{0.3, -0.1}).value, "v 0.3 w -0.1");
  EXPECT_EQ(recorded_words(request::Set{"body.scale", "2"}).key, "body.scale");
  EXPECT_EQ(recorded_words(request::HandOver{"real"}).value, "real");
}

TEST(RecordedWords, RefusesWhatIsNone) {
  for (const char* const words : {"", "points", "points 1", "points a b", "yaw", "v 1 w", "fast",
                                  "points 1 2 yaw x", "v 1m", "points 1 2 3 4"}) {
    EXPECT_FALSE(recorded_action({"goal", "", words})) << words;
  }
  for (const char* const words : {"pedals 0 1 0", "pedals 2 0 0 1", "pedals 0 1 0 0.5"}) {
    EXPECT_FALSE(recorded_action({"drive", "", words})) << words;
  }
  EXPECT_FALSE(recorded_action({"fly", "", ""}));
}

}  // namespace
}  // namespace rave::runtime::testing
