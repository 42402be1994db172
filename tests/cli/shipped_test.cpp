// SPDX-License-Identifier: Apache-2.0
// Scenarios that come with RAVE and are conducted: what their pages promise.
#include <nlohmann/json.hpp>

#include "paced_run.hpp"

namespace rave::cli_test {
namespace {

class Shipped : public PacedRun {
 protected:
  [[nodiscard]] static std::string scenario(const std::string& name) {
    return std::string(RAVE_SOURCE_DIR "/scenarios/") + name;
  }
  [[nodiscard]] nlohmann::json result_of(const std::string& name,
                                         const std::vector<std::string>& more) const {
    const std::string folder = folder_.path() / "whole";
    std::vector<std::string> words = {"run",  scenario(name), "--output",
                                      folder, "--replace",    "--pace",
                                      "max",  "--no-picture", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = rave(words);
    EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
    events_ = content_of(folder + "/events.log");
    return nlohmann::json::parse(content_of(folder + "/result.json"), nullptr, false);
  }
  /// Where a text stands in the events; npos: nowhere.
  [[nodiscard]] std::size_t at(const std::string& text) const { return events_.find(text); }

  mutable std::string events_;
};

TEST_F(Shipped, TheConvoyIsCutAndItsRearGivenToAnotherCommander) {
  const auto alone = result_of("convoy", {"--threads", "2"});
  EXPECT_EQ(alone["whole"], true) << alone["problems"];
  ASSERT_NE(at("barrier"), std::string::npos) << events_;
  ASSERT_NE(at("rear to bob"), std::string::npos) << events_;
  EXPECT_LT(at("barrier"), at("rear to bob"));
  EXPECT_LT(at("rear to bob"), at("the run ends: success")) << events_;
  for (const auto& check : alone["checks"]) EXPECT_EQ(check["holds"], true) << check;
  const auto split = result_of("convoy", {"--processes", "2"});
  EXPECT_EQ(split["hash"], alone["hash"]);
}

TEST_F(Shipped, AClassEndsWhenAllRobotsAreAtTheirFlags) {
  start(scenario("classroom"), {"--no-picture", "--no-record"}, "10x");
  for (int lane = 1; lane <= 10; ++lane) {
    const Ended sent =
        rave({"goal", "robot-" + std::to_string(lane), "7.5", std::to_string(lane - 1)});
    EXPECT_EQ(sent.exit_code, 0) << sent.err;
  }
  EXPECT_EQ(wait_for(process_), 0);
  process_ = -1;
  EXPECT_NE(events().find("as number 10"), std::string::npos) << events();
  EXPECT_NE(events().find("success: all robots are at their flags"), std::string::npos);
}

TEST_F(Shipped, APreyGetsFasterUntilItGetsAway) {
  const auto first = result_of("predator-prey/hunt.yaml", {"--seed", "1"});
  EXPECT_EQ(first["whole"], true) << first["problems"];
  EXPECT_NE(at("capture 4 after"), std::string::npos) << events_;
  EXPECT_NE(at("captures; a prey of 0.40 m/s gets away"), std::string::npos) << events_;
  EXPECT_EQ(first["events"]["contact"], 0);
  // Another seed is another start: the first capture is at another time.
  const std::string events = events_.substr(0, events_.find("capture 2"));
  const auto second = result_of("predator-prey/hunt.yaml", {"--seed", "2"});
  EXPECT_NE(second["hash"], first["hash"]);
  EXPECT_NE(events_.substr(0, events_.find("capture 2")), events);
  const auto threads = result_of("predator-prey/hunt.yaml", {"--seed", "2", "--threads", "2"});
  EXPECT_EQ(threads["hash"], second["hash"]);
}

TEST_F(Shipped, AWarehouseOf500RobotsFetchesGoodsWithoutContact) {
  const auto alone = result_of("warehouse", {"--duration", "62", "--no-record"});
  EXPECT_EQ(alone["robots"].size(), 500U);
  EXPECT_EQ(alone["events"]["contact"], 0);
  const std::size_t minute = events_.find(" goals, ");
  ASSERT_NE(minute, std::string::npos);
  const std::size_t begin = events_.rfind(' ', minute - 1) + 1;
  // Each robot has fetched at least once.
  EXPECT_GE(std::stoi(events_.substr(begin, minute - begin)), 700);
  EXPECT_EQ(events_.find("is not called again"), std::string::npos);
}

}  // namespace
}  // namespace rave::cli_test
