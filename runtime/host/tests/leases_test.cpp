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

std::string why(const Status& status) { return status ? "" : status.error().message; }

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
  EXPECT_EQ(leases.give("r1", kAnna, "bert", kStart).value(), "r1 is now `bert`'s");
  EXPECT_EQ(leases.holder("r1"), "bert");
  EXPECT_EQ(leases.give("r1", kRoot, "", kStart).value(), "nobody drives r1 now");
  EXPECT_EQ(leases.holder("r1"), "");
}

TEST(HostLeases, ATerminalTakesNoLeaseForWhatItSaysOnce) {
  HostLeases leases;
  EXPECT_TRUE(leases.use("r1", kTerminal, Use::kOrder, kStart));
  EXPECT_EQ(leases.holder("r1"), "");
  EXPECT_TRUE(leases.use("r1", kTerminal, Use::kDrive, kStart));
  EXPECT_EQ(why(leases.use("r1", kAnna, Use::kDrive, kStart)), "`terminal` drives r1");
}

TEST(DriveWatch, TellsWhoHasFallenSilentOnce) {
  DriveWatch watch;
  EXPECT_TRUE(watch.driven("r1", "anna", 0.3, 0, kStart));
  EXPECT_FALSE(watch.driven("r1", "anna", 0.3, 0, kStart + 200ms)) << "nothing new";
  EXPECT_TRUE(watch.take_silent(kStart + 449ms).empty());
  EXPECT_EQ(watch.take_silent(kStart + 450ms), (std::vector<DriveWatch::Silent>{{"r1", "anna"}}));
  EXPECT_TRUE(watch.take_silent(kStart + 900ms).empty());
  EXPECT_TRUE(watch.driven("r1", "anna", 0.3, 0, kStart + 1s)) << "it stands: that is another";
}

TEST(DriveWatch, AStickHeldAtZeroIsNotSilent) {
  DriveWatch watch;
  EXPECT_TRUE(watch.driven("r1", "anna", 0, 0, kStart));
  EXPECT_TRUE(watch.take_silent(kStart + 1s).empty());
  EXPECT_TRUE(watch.driven("r1", "anna", 0, 0.1, kStart + 1s));
  EXPECT_TRUE(watch.driven("r1", "bert", 0, 0.1, kStart + 1s)) << "another driver";
  watch.ended("r1");
  EXPECT_FALSE(watch.any());
  EXPECT_TRUE(watch.take_silent(kStart + 1min).empty());
}

}  // namespace
}  // namespace rave::runtime
