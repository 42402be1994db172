// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "played.hpp"

namespace rave::utias {
namespace {

using Json = nlohmann::json;

Json report_of(const std::string& driver, const Given& given) {
  Player player(driver);
  EXPECT_EQ(player.configure(given, data_folder()), "");
  return Json::parse(player.report());
}

TEST(PlayerReport, OfThePosesThatEndEarly) {
  const Json report = report_of("utias_mocap", {{"folder", "760-900"}, {"robot", 1.0}});
  EXPECT_EQ(report["stream"], "poses");
  EXPECT_EQ(report["folder"], "760-900");
  EXPECT_EQ(report["robot"], 1);
  EXPECT_EQ(report["start_s"], 760.0);
  EXPECT_EQ(report["end_s"], 900.0);
  EXPECT_NEAR(report["first_stamp_s"].get<double>(), 760, 0.05);
  EXPECT_NEAR(report["last_stamp_s"].get<double>(), 771.9, 0.05);
  EXPECT_NEAR(report["largest_age_s"].get<double>(), 128.1, 0.05);
  EXPECT_GT(report["rows"].get<int>(), 500);
  EXPECT_GT(report["rate_hz"].get<double>(), 55);
  ASSERT_FALSE(report["gaps"].empty());
  const Json& last = report["gaps"].back();
  EXPECT_EQ(last["kind"], "early_end");
  EXPECT_NEAR(last["start_s"].get<double>(), 771.9, 0.05);
  EXPECT_NEAR(last["length_s"].get<double>(), 128.1, 0.05);
  EXPECT_EQ(report["file"], "Robot1_Groundtruth.dat.gz");
  EXPECT_EQ(report["sha256"].get<std::string>().size(), 64U);
  EXPECT_EQ(report["unchanged"], true);
}

TEST(PlayerReport, SaysWhatTheReaderSays) {
  const Dataset data = recorded("100-220");
  const StreamReport& truth = data.robot(4)->odometry_report;
  const Json report = report_of("utias_odometry", {{"folder", "100-220"}, {"robot", 4.0}});
  EXPECT_EQ(report["stream"], "odometry");
  EXPECT_EQ(report["rows"], truth.rows);
  EXPECT_EQ(report["rate_hz"], truth.mean_rate_hz);
  EXPECT_EQ(report["sha256"], truth.sha256);
  EXPECT_EQ(report["gaps"].size(), truth.gaps.size());
  ASSERT_EQ(report["repairs"].size(), 1U);
  EXPECT_EQ(report["repairs"][0]["what"], "duplicate_stamp");
  EXPECT_EQ(report["repairs"][0]["count"], truth.repaired(RepairKind::kDuplicateStamp));
}

TEST(PlayerReport, CountsCodesOfNobody) {
  int unknown = 0;
  for (const double robot : {1.0, 2.0, 3.0, 4.0, 5.0}) {
    const Json report = report_of("utias_camera", {{"folder", "100-220"}, {"robot", robot}});
    for (const Json& code : report["unknown_codes"]) {
      EXPECT_EQ(code["code"], 50);
      unknown += code["count"].get<int>();
    }
  }
  EXPECT_EQ(unknown, 3);
}

TEST(PlayerReport, OfAStreamWithoutRows) {
  const Json report = report_of("utias_camera", {{"folder", "760-900"}, {"robot", 1.0}});
  EXPECT_EQ(report["rows"], 0);
  EXPECT_TRUE(report["first_stamp_s"].is_null());
  EXPECT_TRUE(report["last_stamp_s"].is_null());
}

TEST(PlayerReport, CountsTheOffsetOfTheClock) {
  const Given given = {{"folder", "760-900"}, {"robot", 1.0}, {"clock_offset_s", 0.5}};
  const Json report = report_of("utias_mocap", given);
  EXPECT_EQ(report["clock_offset_s"], 0.5);
  EXPECT_NEAR(report["last_stamp_s"].get<double>(), 772.4, 0.05);
}

TEST(PlayerReport, IsEmptyBeforeItIsConfigured) { EXPECT_EQ(Player("utias_mocap").report(), "{}"); }

}  // namespace
}  // namespace rave::utias
