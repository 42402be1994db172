// SPDX-License-Identifier: Apache-2.0
#include "live/set_values.hpp"

#include <gtest/gtest.h>

#include "fake_port.hpp"
#include "live/live_source.hpp"
#include "nlohmann/json.hpp"
#include "page/page_text.hpp"

namespace rave::gui_server {
namespace {

constexpr const char* kSetRobots =
    R"([{"name":"r1","team":"","kind":"simulated","sensors":[],"parameters":[)"
    R"({"key":"program.v_mps","kind":"number","value":0.2},{"key":"program.bold","kind":"flag"},)"
    R"({"key":"program.mode","kind":"choice","choices":["slow","fast"]},)"
    R"({"key":"program.words","kind":"text"}]},)"
    R"({"name":"r2","team":"","kind":"simulated","sensors":[]}])";

using Changed = std::vector<std::pair<std::string, std::string>>;

TEST(SetValues, HaveTheKindsOfTheRoster) {
  const SetValues set(kSetRobots);
  SetValues::Values values = set.of(0, Changed{{"program.v_mps", "0.5"},
                                               {"program.bold", "true"},
                                               {"program.mode", "fast"},
                                               {"program.words", "b, \"c\" -> d"}});
  EXPECT_EQ(values["program.v_mps"], "0.5");
  EXPECT_EQ(values["program.bold"], "true");
  EXPECT_EQ(values["program.mode"], "\"fast\"");
  EXPECT_EQ(values["program.words"], R"("b, \"c\" -> d")");
  EXPECT_EQ(values.size(), 4U);
}

TEST(SetValues, NothingElseIsTakenForAValue) {
  const SetValues set(kSetRobots);
  const Changed one = {{"program.v_mps", "0.3"}};
  EXPECT_TRUE(set.of(0, {{"program.v_mps", "fast"}, {"controller.x.y", "1"}}).empty());
  EXPECT_TRUE(set.of(1, one).empty()) << "it has none";
  EXPECT_TRUE(set.of(7, one).empty());
  EXPECT_TRUE(SetValues("no JSON").of(0, one).empty());
  EXPECT_EQ(set.of(0, one).size(), 1U);
}

/// A run whose first robot was given a speed before anybody looked.
class SetPort final : public testing::FakePort {
 public:
  explicit SetPort(const std::string& speed) : speed_(speed) {}
  [[nodiscard]] std::vector<runtime::RunStatus::Robot> robots() const override {
    runtime::RunStatus::Robot robot;
    robot.name = "r1";
    robot.lease = "anna";
    robot.changed = {{"program.v_mps", speed_}};
    return {robot};
  }

 private:
  const std::string& speed_;
};

TEST(SetValues, PagesThatAreThereAndThatComeLaterAreTold) {
  const auto box = std::make_shared<LiveBox>();
  LiveSource::Start start;
  start.robots_json = kSetRobots;
  start.robots = {"r1", "r2"};
  std::string speed = "0.7";
  LiveSource source(std::move(start), box, std::make_unique<SetPort>(speed));
  const auto now = Playhead::Clock::now();
  source.tick(now, {});
  const auto first = source.leases_changed_since(0);
  ASSERT_FALSE(first.empty());
  EXPECT_EQ(first[0].values.at("program.v_mps"), "0.7");
  const std::uint64_t before = source.leases_revision();
  source.tick(now + std::chrono::seconds(1), {});
  EXPECT_TRUE(source.leases_changed_since(before).empty()) << "the same again";
  speed = "0.9";
  source.tick(now + std::chrono::seconds(2), {});
  const auto changed = source.leases_changed_since(before);
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed[0].values.at("program.v_mps"), "0.9");
  const auto told = nlohmann::json::parse(leases_text(source.leases_changed_since(0), {}, true));
  EXPECT_EQ(told["robots"][0]["values"]["program.v_mps"], 0.9);
  EXPECT_FALSE(told["robots"][1].contains("values"));
}

}  // namespace
}  // namespace rave::gui_server
