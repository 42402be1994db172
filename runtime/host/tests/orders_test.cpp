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
using Kind = RunRequest::Kind;

RunRequest request(Kind kind, const std::string& by, const std::string& robot = "r1") {
  RunRequest asked;
  asked.kind = kind;
  asked.robot = robot;
  asked.by = by;
  return asked;
}

RunRequest drive(const std::string& by, double v_mps) {
  RunRequest asked = request(Kind::kDrive, by);
  asked.v_mps = v_mps;
  return asked;
}

RunRequest goal(const std::string& by) {
  RunRequest asked = request(Kind::kGoal, by);
  asked.points = {{1, 2}};
  return asked;
}

/// A desk before a run that takes everything, and what has become inputs.
struct Office {
  OrderDesk desk;
  std::vector<std::string> inputs;
  bool driven = false;
  bool refuses = false;
  ErrorCode error = ErrorCode::kState;
  OrderDesk::Time now{1h};

  OrderDesk::Give give() {
    return [this](const RunRequest& asked) -> Result<std::string> {
      if (refuses) return fail(error, "it is stopped");
      driven = asked.kind == Kind::kDrive;
      inputs.push_back(fmt::format(
          "{} {} {}{}", to_string(asked.kind), asked.robot, asked.by,
          asked.kind == Kind::kDrive ? fmt::format(" {}", asked.v_mps) : std::string()));
      return std::string("done");
    };
  }
  std::string serve(const RunRequest& asked) {
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
  RunRequest text = request(Kind::kText, "anna");
  text.value = "hello";
  EXPECT_EQ(office.serve(text), "done");
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
  EXPECT_EQ(office.serve(request(Kind::kCancel, "bert")), "`anna` drives r1");
  EXPECT_EQ(office.serve(request(Kind::kRelease, "bert")), "`anna` drives r1");
  RunRequest take = request(Kind::kTake, "bert");
  EXPECT_EQ(office.serve(take), "`anna` drives r1");
  office.serve(drive("anna", 0.3));
  office.take();
  take.value = "force";
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
  EXPECT_EQ(office.serve(request(Kind::kHandOver, "bert")), "done") << "nobody drives it";
  EXPECT_EQ(office.serve(goal("anna")), "done");
  EXPECT_EQ(office.serve(request(Kind::kHandOver, "bert")), "`anna` drives r1");
  EXPECT_EQ(office.serve(request(Kind::kHandOver, "anna")), "done");
  RunRequest root = request(Kind::kHandOver, "root");
  root.overrides = true;
  EXPECT_EQ(office.serve(root), "done");
  EXPECT_EQ(office.serve(request(Kind::kHandOver, "")), "done") << "the terminal";
}

TEST(OrderDesk, ASecondPageOfTheSamePersonTakesItAndTheRobotStands) {
  Office office;
  RunRequest first = drive("anna", 0.3);
  first.page = 1;
  RunRequest second = drive("anna", 0.1);
  second.page = 2;
  EXPECT_EQ(office.serve(first), "done");
  EXPECT_NE(office.serve(second).find("you drive r1 on another page"), std::string::npos);
  RunRequest release = request(Kind::kRelease, "anna");
  release.page = 2;
  EXPECT_NE(office.serve(release).find("you drive r1 on another page"), std::string::npos);
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0.3"});
  RunRequest take = request(Kind::kTake, "anna");
  take.page = 2;
  take.value = "force";
  EXPECT_EQ(office.serve(take), "r1 is yours; it was taken from another page of yours");
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0"});
  EXPECT_EQ(office.desk.page("r1"), 2U);
  EXPECT_NE(office.serve(first).find("you drive r1 on another page"), std::string::npos);
  EXPECT_EQ(office.serve(second), "done");
  EXPECT_EQ(office.take(), Lines{"drive r1 anna 0.1"});
}

RunRequest on_page(RunRequest request, std::uint64_t page) {
  request.page = page;
  return request;
}

TEST(OrderDesk, AStickThatIsHeldWhileTheRobotIsArmedMovesNothingUntilItIsNeutral) {
  Office office;
  office.refuses = true;
  const RunRequest held = on_page(drive("anna", 0.3), 7);
  EXPECT_EQ(office.serve(held), "it is stopped");
  office.refuses = false;  // it is released and armed
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(office.serve(held), "it is stopped; let the stick go before it drives r1");
    office.wait(33ms);
  }
  RunRequest asks = on_page(request(Kind::kTake, "anna"), 7);
  asks.value = "drive";
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
  const RunRequest held = on_page(drive("bert", 0.1), 2);
  EXPECT_EQ(office.serve(held), "`anna` drives r1");
  office.serve(on_page(request(Kind::kGive, "anna"), 1));
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
  const RunRequest held = on_page(drive("", 0.3), 9);
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
  const RunRequest first = on_page(drive("", 0.3), 1);
  const RunRequest second = on_page(drive("", -0.3), 2);
  const std::string refused = "another terminal drives r1; `--force` takes it from there";
  EXPECT_EQ(office.serve(first), "done");
  EXPECT_EQ(office.serve(second), refused);
  EXPECT_EQ(office.serve(request(Kind::kGoal, "")), refused) << "a script";
  EXPECT_EQ(office.take(), Lines{"drive r1  0.3"});
  RunRequest take = on_page(request(Kind::kTake, ""), 3);
  take.value = "force";
  EXPECT_EQ(office.serve(take), "r1 is yours; it was taken from another terminal of yours");
  EXPECT_EQ(office.serve(first), refused);
  EXPECT_EQ(office.serve(on_page(drive("", -0.3), 3)), "done");
}

TEST(OrderDesk, ATerminalThatHasDrivenLeavesTheRobotToOthers) {
  Office office;
  EXPECT_EQ(office.serve(on_page(drive("", 0.3), 1)), "done");
  EXPECT_EQ(office.serve(on_page(request(Kind::kCancel, ""), 1)), "done");
  EXPECT_EQ(office.desk.holder("r1"), "");
  EXPECT_EQ(office.take(), (Lines{"drive r1  0.3", "cancel r1 "}));
  EXPECT_EQ(office.serve(on_page(drive("", 0.3), 2)), "done");
}

TEST(OrderDesk, ALeaseThatIsGivenBackGivesTheRobotToItsProgram) {
  Office office;
  office.serve(goal("anna"));
  office.take();
  EXPECT_EQ(office.serve(request(Kind::kGive, "anna")), "no person drives r1 now");
  EXPECT_EQ(office.take(), Lines{"cancel r1 anna"});
}

TEST(OrderDesk, ReleaseNeedsTheLeaseOrRights) {
  Office office;
  office.serve(goal("anna"));
  EXPECT_EQ(office.serve(request(Kind::kRelease, "anna")), "done");
  RunRequest root = request(Kind::kRelease, "root");
  EXPECT_EQ(office.serve(root), "`anna` drives r1");
  root.overrides = true;
  EXPECT_EQ(office.serve(root), "done");
  EXPECT_EQ(office.serve(request(Kind::kRelease, "")), "done") << "a terminal";
  EXPECT_NE(office.serve(request(Kind::kRelease, "anna", "")).find("super-user"),
            std::string::npos);
  EXPECT_NE(office.serve(request(Kind::kCancel, "anna", "")).find("super-user"), std::string::npos);
  EXPECT_EQ(office.serve(request(Kind::kCancel, "", "")), "done");
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

TEST(OrderDesk, RefusesWordsThatAreNone) {
  Office office;
  RunRequest take = request(Kind::kTake, "anna");
  take.value = "please";
  EXPECT_EQ(office.serve(take), "`please`: expected `force` or nothing");
  EXPECT_EQ(office.serve(request(Kind::kGoal, "anna", "")), "`goal` needs a robot");
  EXPECT_EQ(office.serve(goal("terminal")), "`terminal` is not a valid name of a person");
}

TEST(OrderWords, ComeBackBitByBit) {
  RunRequest path = request(Kind::kPath, "anna");
  path.points = {{0.1, std::nextafter(1.0, 2.0)}, {-1e-300, 1e6}};
  path.speed_mps = 1.0 / 3;
  RunRequest place = goal("bert");
  place.kind = Kind::kPlace;
  place.yaw_rad = -0.1;
  RunRequest text = request(Kind::kText, "");
  text.value = "points 1 2, please";
  RunRequest turn = drive("anna", -0.1);
  turn.w_radps = 2.0 / 3;
  for (const RunRequest& asked : {path, place, text, turn, goal(""), request(Kind::kCancel, "")}) {
    RunRequest read;
    read.kind = asked.kind;
    ASSERT_TRUE(read_order_words(order_words(asked), read)) << order_words(asked);
    EXPECT_EQ(read.points, asked.points) << order_words(asked);
    EXPECT_EQ(read.yaw_rad, asked.yaw_rad);
    EXPECT_EQ(read.v_mps, asked.v_mps);
    EXPECT_EQ(read.w_radps, asked.w_radps);
    EXPECT_EQ(read.speed_mps, asked.speed_mps);
    EXPECT_EQ(read.value, asked.value);
  }
}

TEST(OrderWords, RefusesWhatIsNone) {
  for (const char* const words :
       {"points", "points 1", "points a b", "yaw", "v 1 w", "fast", "points 1 2 yaw x", "v 1m"}) {
    RunRequest read;
    read.kind = Kind::kGoal;
    EXPECT_FALSE(read_order_words(words, read)) << words;
  }
}

}  // namespace
}  // namespace rave::runtime::testing
