// SPDX-License-Identifier: Apache-2.0
#include "../src/roster_book.hpp"

#include <gtest/gtest.h>

#include "rave/bus/sequence.hpp"

namespace rave::manager {
namespace {

constexpr std::uint64_t kLeft = 0xa1;
constexpr std::uint64_t kOther = 0xb2;

bus::RosterEntry entry_of(std::uint64_t writer, std::uint32_t robot, std::uint32_t host,
                          const std::string& name,
                          rave_wire_RobotKind kind = rave_wire_ROBOT_SIMULATED) {
  bus::RosterEntry entry{};
  entry.writer = writer;
  entry.robot = robot;
  entry.host = host;
  bus::put_text(entry.name, name);
  entry.kind = kind;
  return entry;
}

/// The hosts `left`, with anna and bob, and `right`, with a robot whose name is too long for the
/// bus.
class RosterBookTest : public ::testing::Test {
 protected:
  std::string reason(const bus::RosterEntry& entry, std::uint64_t serving) {
    return book_.hear(entry, serving).value_or("accepted");
  }

  const std::string long_name_ = std::string(80, 'x');
  RosterBook book_{{{"anna", true}, {"bob", true}, {long_name_, true}},
                   {{"left", {0, 1}, false}, {"right", {2}, false}}};
};

TEST_F(RosterBookTest, KindsAreThoseThatTheHostSays) {
  EXPECT_TRUE(book_.simulated(0, kLeft)) << "as in the scenario";
  EXPECT_EQ(reason(entry_of(kLeft, 0, 0, "anna", rave_wire_ROBOT_REAL), kLeft), "accepted");
  EXPECT_TRUE(book_.take_news());
  EXPECT_FALSE(book_.take_news());
  EXPECT_FALSE(book_.simulated(0, kLeft));
  EXPECT_TRUE(book_.simulated(1, kLeft));
  book_.lose(kLeft);
  EXPECT_TRUE(book_.take_news());
  EXPECT_TRUE(book_.simulated(0, kLeft));
}

TEST_F(RosterBookTest, WhoDrivesIsWhomTheHostNames) {
  using Driver = std::pair<std::string, std::uint64_t>;
  EXPECT_EQ(book_.driver(0, kLeft), Driver());
  bus::RosterEntry entry = entry_of(kLeft, 0, 0, "anna");
  bus::put_text(entry.driver, "lisa");
  entry.driver_page = 7;
  EXPECT_EQ(reason(entry, kLeft), "accepted");
  EXPECT_TRUE(book_.take_news());
  EXPECT_EQ(book_.driver(0, kLeft), Driver("lisa", 7));
  EXPECT_EQ(book_.driver(0, kOther), Driver()) << "another process serves the host now";
  EXPECT_EQ(book_.driver(1, kLeft), Driver());
}

TEST_F(RosterBookTest, WhatIsNotInTheScenarioIsRefusedOncePerProcess) {
  EXPECT_EQ(reason(entry_of(kLeft, 3, 0, "carl"), kLeft),
            "robot 3 is not one of the 3 of the scenario");
  EXPECT_EQ(reason(entry_of(kLeft, 4, 0, "dora"), kLeft), "accepted") << "said once already";
  EXPECT_FALSE(book_.take_news());
  EXPECT_EQ(reason(entry_of(kOther, 1, 0, "anna"), 0),
            "robot 1 was reported as `anna` on host `left`; in the scenario it is `bob` on `left`");
  book_.lose(kOther);
  EXPECT_EQ(reason(entry_of(kOther, 0, 7, "anna"), 0),
            "robot 0 was reported as `anna` on host 7, which does not exist; in the scenario it is "
            "`anna` on `left`");
}

TEST_F(RosterBookTest, ASecondRobotOfTheSameNameCountsWhenTheFirstIsGone) {
  EXPECT_EQ(reason(entry_of(kLeft, 0, 0, "anna"), kLeft), "accepted");
  EXPECT_EQ(reason(entry_of(kOther, 0, 0, "anna", rave_wire_ROBOT_REAL), kLeft),
            "a second robot `anna`: its host `left` is served by process 00000000000000a1");
  EXPECT_EQ(reason(entry_of(kOther, 1, 0, "bob", rave_wire_ROBOT_REAL), kLeft), "accepted")
      << "said once already";
  EXPECT_TRUE(book_.simulated(0, kLeft));
  book_.lose(kLeft);
  EXPECT_FALSE(book_.simulated(0, kOther)) << "it serves the host now";
  EXPECT_FALSE(book_.simulated(1, kOther));
}

TEST_F(RosterBookTest, BeforeAnybodyServesAHostAllAreKeptApart) {
  EXPECT_EQ(reason(entry_of(kOther, 0, 0, "anna", rave_wire_ROBOT_REAL), 0), "accepted");
  EXPECT_EQ(reason(entry_of(kLeft, 0, 0, "anna"), 0), "accepted");
  EXPECT_TRUE(book_.simulated(0, kLeft));
  EXPECT_FALSE(book_.simulated(0, kOther));
}

TEST_F(RosterBookTest, NamesThatAreCutOffOnTheWayFit) {
  EXPECT_EQ(reason(entry_of(kOther, 2, 1, long_name_), kOther), "accepted");
  EXPECT_NE(reason(entry_of(kOther, 2, 1, "x"), kOther), "accepted");
}

TEST_F(RosterBookTest, WhoMakesUpProcessesFillsNoMemoryAndStopsNobody) {
  for (std::uint64_t writer = 1000; writer < 3000; ++writer) {
    static_cast<void>(book_.hear(entry_of(writer, 0, 0, "anna", rave_wire_ROBOT_REAL), 0));
  }
  EXPECT_TRUE(book_.simulated(0, 2999)) << "it found no room";
  EXPECT_EQ(reason(entry_of(kLeft, 0, 0, "anna", rave_wire_ROBOT_REAL), kLeft), "accepted");
  EXPECT_FALSE(book_.simulated(0, kLeft)) << "who serves has a place always";
}

}  // namespace
}  // namespace rave::manager
