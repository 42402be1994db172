// SPDX-License-Identifier: Apache-2.0
// Virtual sensors that are tried by who may not.
#include <unistd.h>

#include <cstring>

#include "hostile_fixture.hpp"

namespace rave::gui_server::testing {
namespace {

class HostileProbes : public Hostile {
 protected:
  /// Whether something is tried on just these robots soon.
  [[nodiscard]] bool probed(int robots) const {
    for (int i = 0; i < 1000 && run_->probed != robots; ++i) ::usleep(10'000);
    return run_->probed == robots;
  }
};

/// Tries a laser on a robot.
std::string probe_on(int slot) {
  return fmt::format(
      R"({{"type":"look_probes","request":1,"probes":[{{"slot":{},"name":"p","driver":"virtual_laser","mount":[0,0,0],"z":0,"params":{{}}}}]}})",
      slot);
}

constexpr const char* kLookAtPoses =
    R"({"type":"look","poses":true,"true_poses":false,"readings":[],"parts":false,"max_hz":60})";

TEST_F(HostileProbes, ProbesAreForWhoMayHaveThemOnThatRobot) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  eve.send(kLookAtPoses);
  eve.send(probe_on(0));
  EXPECT_NE(eve.text_with("\"probes\"").find("Your rights do not include this."),
            std::string::npos);
  eve.send(R"({"type":"ask_catalogue","request":2})");
  EXPECT_NE(eve.text_with("\"catalogue\"").find(R"("drivers":[])"), std::string::npos);
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  ben.send(kLookAtPoses);
  for (const int slot : {1, 3, 4, -1}) {
    ben.send(probe_on(slot));
    const std::string answer = ben.text_with(slot < 0 ? "\"message\"" : "\"probes\"");
    EXPECT_EQ(answer.find("\"block\""), std::string::npos) << answer;
  }
  EXPECT_TRUE(run_->requests().empty());
  ben.send(probe_on(2));
  EXPECT_NE(ben.text_with("\"block\"").find("virtual_laser"), std::string::npos);
  ASSERT_EQ(run_->requests().size(), 1U);
  EXPECT_EQ(run_->requests()[0].slot, 2U);
  EXPECT_FALSE(run_->requests()[0].without_obstacles);
  EXPECT_TRUE(probed(4));
}

TEST_F(HostileProbes, AProbeEndsWithItsRightAndWithItsPage) {
  RawSocket boss = super_user();
  {
    RawSocket ben = socket(guest(Role::kCommander, "ben"));
    ben.send(kLookAtPoses);
    ben.send(probe_on(0));
    EXPECT_TRUE(probed(1));
    set_right(boss, "commander", "probe", "\"none\"");
    EXPECT_TRUE(probed(0));
    // Who gets no virtual obstacles does not learn of them by a laser.
    set_right(boss, "commander", "probe", "null");
    set_right(boss, "commander", "obstacles", "\"none\"");
    ben.send(kLookAtPoses);
    ben.send(probe_on(0));
    EXPECT_TRUE(probed(1));
    EXPECT_TRUE(run_->requests().back().without_obstacles);
  }
  EXPECT_TRUE(probed(0)) << "the page has gone";
}

TEST_F(HostileProbes, NobodyReadsTheProbeOfSomebodyElseByItsNumber) {
  RawSocket boss = super_user();
  boss.send(kLookAtPoses);
  boss.send(probe_on(0));
  EXPECT_TRUE(probed(1));
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  eve.send(fmt::format(
      R"({{"type":"look","poses":true,"true_poses":false,"readings":[[0,{}]],"parts":false,"max_hz":60}})",
      FakeRun::kProbeNumber));
  for (int pictures = 0; pictures < 5;) {
    const auto frame = eve.next();
    ASSERT_TRUE(frame.has_value());
    if (frame->opcode != 2) continue;
    ASSERT_NE(frame->payload.front(), 2) << "a reading";
    if (frame->payload.front() != 1) continue;
    ++pictures;
    std::uint32_t sequence = 0;
    std::memcpy(&sequence, frame->payload.data() + 4, sizeof sequence);
    eve.send(fmt::format(R"({{"type":"ack","sequence":{}}})", sequence));
  }
}

}  // namespace
}  // namespace rave::gui_server::testing
