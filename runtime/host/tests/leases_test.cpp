// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rave/control/drive_watch.hpp"
#include "rave/control/host_leases.hpp"

namespace rave::runtime {
namespace {

using namespace std::chrono_literals;
using Use = HostLeases::Use;
using Change = HostLeases::Change;

const HostLeases::Person kAnna{"anna"};
const HostLeases::Person kBert{"bert"};
const HostLeases::Person kRoot{"root", true};
const HostLeases::Person kTerminal{};
const HostLeases::Time kStart{1h};

template <class Outcome>
std::string why(const Outcome& outcome) {
  return outcome ? "" : outcome.error().message;
}

TEST(HostLeases, TheFirstOrderTakesTheLease) {
  HostLeases leases;
  EXPECT_EQ(leases.holder("r1"), "");
  EXPECT_TRUE(leases.use("r1", kAnna, Use::kLook, kStart));
  EXPECT_FALSE(leases.any()) << "who looks takes nothing";
  EXPECT_TRUE(leases.use("r1", kAnna, Use::kOrder, kStart));
  EXPECT_EQ(leases.holder("r1"), "anna");
  EXPECT_EQ(why(leases.use("r1", kBert, Use::kOrder, kStart)), "`anna` drives r1");
  EXPECT_EQ(why(leases.use("r1", kBert, Use::kLook, kStart)), "`anna` drives r1");
  EXPECT_EQ(why(leases.use("r1", kTerminal, Use::kOrder, kStart)), "`anna` drives r1");
  EXPECT_TRUE(leases.use("r2", kBert, Use::kOrder, kStart)) << "another robot is free";
  EXPECT_TRUE(leases.use("r1", kAnna, Use::kDrive, kStart));
  EXPECT_EQ(leases.take_changes(), (std::vector<Change>{{"r1", "", "anna", false, false},
                                                        {"r2", "", "bert", false, false}}))
      << "who goes on is no news";
  EXPECT_TRUE(leases.take_changes().empty());
}

TEST(HostLeases, EndsAfterADriveSoonerThanAfterAGoal) {
  HostLeases leases;
  ASSERT_TRUE(leases.use("r1", kAnna, Use::kDrive, kStart));
  ASSERT_TRUE(leases.use("r2", kAnna, Use::kOrder, kStart));
  leases.expire(kStart + 2999ms);
  EXPECT_EQ(leases.holder("r1"), "anna");
  ASSERT_TRUE(leases.use("r1", kAnna, Use::kDrive, kStart + 2999ms));
  leases.expire(kStart + 5998ms);
  EXPECT_EQ(leases.holder("r1"), "anna") << "it was renewed";
  leases.expire(kStart + 5999ms);
  EXPECT_EQ(leases.holder("r1"), "");
  EXPECT_EQ(leases.holder("r2"), "anna");
  leases.expire(kStart + 10min);
  EXPECT_FALSE(leases.any());
  const auto changes = leases.take_changes();
  ASSERT_EQ(changes.size(), 4U);
  EXPECT_EQ(changes[2], (Change{"r1", "anna", "", true, true}));
  EXPECT_EQ(changes[3], (Change{"r2", "anna", "", false, true}));
}

TEST(HostLeases, WhoHasDrivenKeepsItLongWhenTheDriveEnds) {
  HostLeases leases;
  ASSERT_TRUE(leases.use("r1", kAnna, Use::kDrive, kStart));
  leases.drive_ended("r1", kStart + 1s);
  leases.expire(kStart + 9min);
  EXPECT_EQ(leases.holder("r1"), "anna");
  leases.expire(kStart + 10min + 1s);
  EXPECT_EQ(leases.holder("r1"), "");
}

TEST(HostLeases, IsTakenByForceOrRights) {
  HostLeases leases;
  ASSERT_TRUE(leases.take("r1", kAnna, false, kStart));
  const auto refused = leases.take("r1", kBert, false, kStart);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "`anna` drives r1");
  EXPECT_EQ(leases.take("r1", kBert, true, kStart).value(),
            "r1 is yours; it was taken from `anna`");
  EXPECT_EQ(leases.take("r1", kRoot, false, kStart).value(),
            "r1 is yours; it was taken from `bert`");
  EXPECT_EQ(leases.take("r1", kTerminal, false, kStart).value(),
            "r1 is yours; it was taken from `root`");
  EXPECT_EQ(leases.holder("r1"), "terminal");
  EXPECT_EQ(leases.take("r1", kTerminal, false, kStart).value(), "r1 is yours");
}

TEST(HostLeases, IsHandedOverByItsHolderAndGivenBack) {
  HostLeases leases;
  EXPECT_FALSE(leases.give("r1", kAnna, "", kStart)) << "nobody has it";
  ASSERT_TRUE(leases.take("r1", kAnna, false, kStart));
  EXPECT_FALSE(leases.give("r1", kBert, "bert", kStart));
  EXPECT_EQ(leases.give("r1", kAnna, "bert", kStart).value(), "r1 is given to `bert`");
  EXPECT_EQ(leases.holder("r1"), "bert");
  EXPECT_EQ(leases.give("r1", kRoot, "", kStart).value(), "no person drives r1 now");
  EXPECT_EQ(leases.holder("r1"), "");
}

TEST(HostLeases, ATerminalTakesNoLeaseForWhatItSaysOnce) {
  HostLeases leases;
  EXPECT_TRUE(leases.use("r1", kTerminal, Use::kOrder, kStart));
  EXPECT_EQ(leases.holder("r1"), "");
  EXPECT_TRUE(leases.use("r1", kTerminal, Use::kDrive, kStart));
  EXPECT_EQ(why(leases.use("r1", kAnna, Use::kDrive, kStart)), "`terminal` drives r1");
}

TEST(HostLeases, TwoPagesOfOnePersonDoNotShareALease) {
  const HostLeases::Person first{"anna", false, 1};
  const HostLeases::Person second{"anna", false, 2};
  const HostLeases::Person boss{"anna", true, 3};
  HostLeases leases;
  ASSERT_TRUE(leases.use("r1", first, Use::kDrive, kStart));
  EXPECT_EQ(leases.page("r1"), 1U);
  const std::string refusal = "you drive r1 on another page: give it back there, or take it here";
  for (const Use use : {Use::kLook, Use::kOrder, Use::kDrive}) {
    EXPECT_EQ(why(leases.use("r1", second, use, kStart)), refusal);
  }
  EXPECT_EQ(why(leases.use("r1", kAnna, Use::kDrive, kStart)), refusal) << "a script is none";
  EXPECT_EQ(why(leases.use("r1", boss, Use::kDrive, kStart)), refusal);
  EXPECT_EQ(leases.take("r1", second, false, kStart).error().message, refusal);
  EXPECT_EQ(leases.give("r1", second, "bert", kStart).error().message, refusal);
  EXPECT_EQ(why(leases.use("r1", kBert, Use::kDrive, kStart)), "`anna` drives r1");
  static_cast<void>(leases.take_changes());
  EXPECT_EQ(leases.take("r1", second, true, kStart).value(),
            "r1 is yours; it was taken from another page of yours");
  EXPECT_EQ(leases.page("r1"), 2U);
  const auto changes = leases.take_changes();
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0], (Change{"r1", "anna", "anna", true, false}));
  EXPECT_EQ(lease_text(changes[0]), "`anna` drives on another page");
  EXPECT_EQ(why(leases.use("r1", first, Use::kDrive, kStart)), refusal);
}

TEST(HostLeases, WhatAPageLeavesTheNextPageOfThePersonHas) {
  const HostLeases::Person first{"anna", false, 1};
  const HostLeases::Person second{"anna", false, 2};
  HostLeases leases;
  ASSERT_TRUE(leases.use("r1", first, Use::kDrive, kStart));
  static_cast<void>(leases.take_changes());
  EXPECT_EQ(leases.give("r1", first, "anna", kStart + 1s).value(),
            "any of your pages can drive r1 now");
  EXPECT_TRUE(leases.take_changes().empty()) << "anna drives it as before";
  EXPECT_EQ(why(leases.use("r1", kBert, Use::kOrder, kStart + 1s)), "`anna` drives r1");
  EXPECT_TRUE(leases.use("r1", second, Use::kOrder, kStart + 2s));
  EXPECT_NE(why(leases.use("r1", first, Use::kOrder, kStart + 2s)), "");
  EXPECT_TRUE(leases.take_changes().empty());
  // What somebody else gave is that of the page that uses it first.
  EXPECT_EQ(leases.give("r1", second, "bert", kStart + 3s).value(), "r1 is given to `bert`");
  EXPECT_TRUE(leases.use("r1", {"bert", false, 8}, Use::kDrive, kStart + 3s));
  EXPECT_NE(why(leases.use("r1", {"bert", false, 9}, Use::kDrive, kStart + 3s)), "");
  // A page that goes takes nothing, not even that of a super-user.
  EXPECT_EQ(why(leases.give("r1", kRoot, "root", kStart + 4s)), "`bert` drives r1");
  EXPECT_EQ(why(leases.give("r2", first, "anna", kStart + 4s)), "no person drives r2");
  EXPECT_EQ(leases.holder("r2"), "");
  // A page that goes keeps nobody longer from the robot than it would have.
  HostLeases left;
  ASSERT_TRUE(left.use("r1", first, Use::kDrive, kStart));
  ASSERT_TRUE(left.give("r1", first, "anna", kStart + 2s));
  left.expire(kStart + 3s);
  EXPECT_FALSE(left.any());
}

TEST(DriveWatch, TellsWhoHasFallenSilentOnce) {
  DriveWatch watch;
  EXPECT_TRUE(watch.driven("r1", "anna", {0.3, 0}, kStart));
  EXPECT_FALSE(watch.driven("r1", "anna", {0.3, 0}, kStart + 200ms)) << "nothing new";
  EXPECT_TRUE(watch.take_silent(kStart + 399ms).empty());
  EXPECT_EQ(watch.take_silent(kStart + 400ms), (std::vector<DriveWatch::Silent>{{"r1", "anna"}}));
  EXPECT_TRUE(watch.take_silent(kStart + 900ms).empty());
  EXPECT_TRUE(watch.driven("r1", "anna", {0.3, 0}, kStart + 1s)) << "it stands: that is another";
}

TEST(DriveWatch, AStickHeldAtZeroIsNotSilent) {
  DriveWatch watch;
  EXPECT_TRUE(watch.driven("r1", "anna", {0, 0}, kStart));
  EXPECT_TRUE(watch.take_silent(kStart + 1s).empty());
  EXPECT_TRUE(watch.driven("r1", "anna", {0, 0.1}, kStart + 1s));
  EXPECT_TRUE(watch.driven("r1", "bert", {0, 0.1}, kStart + 1s)) << "another driver";
  watch.ended("r1");
  EXPECT_FALSE(watch.any());
  EXPECT_TRUE(watch.take_silent(kStart + 1min).empty());
}

}  // namespace
}  // namespace rave::runtime
