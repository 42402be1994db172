// SPDX-License-Identifier: Apache-2.0
#include "set_values.hpp"

#include <gtest/gtest.h>

#include "live_source.hpp"
#include "nlohmann/json.hpp"
#include "page_text.hpp"

namespace rave::gui_server {
namespace {

constexpr const char* kSetRobots =
    R"([{"name":"r1","team":"","kind":"simulated","sensors":[],"parameters":[)"
    R"({"key":"program.v_mps","kind":"number","value":0.2},{"key":"program.bold","kind":"flag"},)"
    R"({"key":"program.mode","kind":"choice","choices":["slow","fast"]},)"
    R"({"key":"program.words","kind":"text"}]},)"
    R"({"name":"r2","team":"","kind":"simulated","sensors":[]}])";

TEST(SetValues, AreThoseOfTheEventWithoutItsAuthor) {
  const SetValues set(kSetRobots);
  SetValues::Values values;
  EXPECT_TRUE(set.take(0, "program.v_mps: 0.2 -> 0.45 (by hand: anna)", values));
  EXPECT_EQ(values, (SetValues::Values{{"program.v_mps", "0.45"}}));
  EXPECT_FALSE(set.take(0, "program.v_mps: 0.2 -> 0.45", values)) << "the same again";
  EXPECT_TRUE(
      set.take(0,
               "program.v_mps: 0.45 -> 0.5, program.bold: false -> 1, program.mode: slow -> "
               "fast, program.words: a -> b, c -> d, controller.x.y: 1 -> 2 (by hand)",
               values));
  EXPECT_EQ(values["program.v_mps"], "0.5");
  EXPECT_EQ(values["program.bold"], "true");
  EXPECT_EQ(values["program.mode"], "\"fast\"");
  EXPECT_TRUE(values["program.words"].starts_with("\"b, c -> d")) << values["program.words"];
  EXPECT_EQ(values.size(), 4U);
}

TEST(SetValues, NothingElseIsTakenForAValue) {
  const SetValues set(kSetRobots);
  SetValues::Values values;
  EXPECT_FALSE(set.take(0, "program.v_mps: 0.2 -> fast", values));
  EXPECT_FALSE(set.take(0, "program.v_mps", values));
  EXPECT_FALSE(set.take(0, "", values));
  EXPECT_FALSE(set.take(1, "program.v_mps: 0.2 -> 0.3", values)) << "it has none";
  EXPECT_FALSE(set.take(7, "program.v_mps: 0.2 -> 0.3", values));
  EXPECT_FALSE(SetValues("no JSON").take(0, "program.v_mps: 0.2 -> 0.3", values));
  EXPECT_TRUE(values.empty());
}

/// A run that nobody asks anything.
class NoPort final : public RunPort {
 public:
  [[nodiscard]] std::string why_not_held() const override { return {}; }
  [[nodiscard]] bool paused() const override { return false; }
  [[nodiscard]] double pace() const override { return 1; }
  void pause() override {}
  void resume() override {}
  void step(std::uint64_t /*count*/) override {}
  void set_pace(double /*factor*/) override {}
  [[nodiscard]] std::vector<runtime::RunStatus::Robot> robots() const override {
    runtime::RunStatus::Robot robot;
    robot.name = "r1";
    robot.lease = "anna";
    return {robot};
  }
  [[nodiscard]] Result<std::future<Result<std::string>>> post(
      runtime::RunRequest /*request*/) override {
    return fail(ErrorCode::kState, "not here");
  }
};

TEST(SetValues, PagesThatAreThereAndThatComeLaterAreTold) {
  const auto box = std::make_shared<LiveBox>();
  LiveSource::Start start;
  start.robots_json = kSetRobots;
  start.robots = {"r1", "r2"};
  LiveSource source(std::move(start), box, std::make_unique<NoPort>());
  const auto now = Playhead::Clock::now();
  source.tick(now, {});
  const std::uint64_t before = source.leases_revision();
  auto news = std::make_unique<LiveNews>();
  news->events.push_back({1, 0, "changed", "program.v_mps: 0.2 -> 0.7 (by hand)"});
  news->events.push_back({1, 0, "said", "program.v_mps: 0.2 -> 9"});
  box->news.push(std::move(news));
  source.tick(now, {});
  const auto changed = source.leases_changed_since(before);
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed[0].values.at("program.v_mps"), "0.7");
  EXPECT_EQ(changed[0].lease, "anna");
  // A status that comes later leaves them.
  source.tick(now + std::chrono::seconds(1), {});
  const auto told = nlohmann::json::parse(leases_text(source.leases_changed_since(0), {}, true));
  EXPECT_EQ(told["robots"][0]["values"]["program.v_mps"], 0.7);
  EXPECT_FALSE(told["robots"][1].contains("values"));
}

}  // namespace
}  // namespace rave::gui_server
