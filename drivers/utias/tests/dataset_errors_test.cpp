// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "temporary_dataset.hpp"
#include "utias/recording_names.hpp"

namespace rave::utias {
namespace {

using DatasetTest = TemporaryDataset;

TEST_F(DatasetTest, CountsAllTimesFromOneOrigin) {
  put("Robot2_Groundtruth.dat", "1000.015 0 0 0\n1000.200 0 0 0\n");
  const auto data = load(folder_, options_);
  ASSERT_TRUE(data) << data.error().text();
  EXPECT_EQ(data->origin_ns, 1'000'000'000'000);
  EXPECT_EQ(data->end_ns, 200'000'000);
  EXPECT_EQ(data->robot(2)->poses.samples().front().t_ns, 15'000'000);
  EXPECT_EQ(data->robot(1)->odometry.front().t_ns, 50'000'000);
  EXPECT_EQ(data->robot(1)->sightings.front().t_ns, 100'000'000);
  EXPECT_EQ(data->robot(3), nullptr);
  options_.robots = {2};
  EXPECT_EQ(load(folder_, options_)->origin_ns, 1'000'000'000'000) << "robot 1 still sets it";
}

TEST_F(DatasetTest, ReadsCodesAsBarcodesUnlessToldToBeWrong) {
  auto data = load(folder_, options_);
  const auto group = data->robot(2)->sightings;
  ASSERT_EQ(group.size(), 2U);
  EXPECT_EQ(group[0].subject, 6);
  EXPECT_EQ(group[1].subject, 1);
  options_.code_meaning = CodeMeaning::kSubject;
  data = load(folder_, options_);
  EXPECT_EQ(data->robot(2)->sightings[1].subject, kUnknownSubject);
  EXPECT_EQ(data->robot(2)->sighting_report.unknown_codes.size(), 2U);
}

TEST_F(DatasetTest, ShiftsOnlyTheClockOfSightings) {
  options_.clock_offset_s = -0.05;
  const auto data = load(folder_, options_);
  EXPECT_EQ(data->robot(1)->sightings.front().t_ns, 50'000'000);
  EXPECT_EQ(data->robot(1)->odometry.front().t_ns, 50'000'000);
  EXPECT_EQ(data->origin_ns, 1'000'000'000'000);
}

TEST_F(DatasetTest, RepairsAndReports) {
  put("Robot1_Groundtruth.dat",
      "1000.000 0 0 0\n1000.200 2 0 4\n1000.100 1 0 0\n1000.200 3 0 -7\n1000.300 4 0 0\n");
  const auto data = load(folder_, options_);
  ASSERT_TRUE(data) << data.error().text();
  const auto samples = data->robot(1)->poses.samples();
  ASSERT_EQ(samples.size(), 4U);
  EXPECT_EQ(samples[1].pose.x, 1);
  EXPECT_EQ(samples[2].pose.x, 3) << "the later row of a stamp is kept";
  EXPECT_NEAR(samples[2].pose.yaw, -7 + 2 * 3.14159265358979, 1e-12);
  const StreamReport& report = data->robot(1)->pose_report;
  EXPECT_EQ(report.repaired(RepairKind::kStepBack), 1);
  EXPECT_EQ(report.repaired(RepairKind::kDuplicateStamp), 1);
  EXPECT_EQ(report.repaired(RepairKind::kHeadingWrapped), 1);
  EXPECT_EQ(report.repaired(RepairKind::kCutLine), 0);
  EXPECT_EQ(report.repairs.front().first_line, 3);
}

TEST_F(DatasetTest, AcceptsACutLogOnlyIfAsked) {
  const std::string packed = pack("1000.000 0.0 0.0 1.0\n1000.100 0.1 0.0 1.0\n1000.2 0");
  remove("Robot1_Groundtruth.dat");
  put("Robot1_Groundtruth.dat.gz", packed);
  EXPECT_EQ(error(), in_folder("Robot1_Groundtruth.dat.gz") +
                         ":3:9: the log ends in the middle of this line; fetch the whole file, or "
                         "set accept_cut to use the 2 whole rows");
  options_.accept_cut = true;
  const auto data = load(folder_, options_);
  ASSERT_TRUE(data) << data.error().text();
  EXPECT_EQ(data->robot(1)->pose_report.rows, 2);
  EXPECT_EQ(data->robot(1)->pose_report.repaired(RepairKind::kCutLine), 1);
}

TEST_F(DatasetTest, NamesWhatIsMissing) {
  options_.robots = {1, 4};
  EXPECT_EQ(error(), "`" + folder_.string() + "` has no logs of robot 4; it has robots: 1, 2");
  options_.robots = {1, 2};
  remove("Robot2_Odometry.dat");
  EXPECT_EQ(error(), "`" + folder_.string() +
                         "` has neither `Robot2_Odometry.dat.gz` nor `Robot2_Odometry.dat`");
  remove("Barcodes.dat");
  EXPECT_EQ(error(), "`" + folder_.string() + "` has neither `Barcodes.dat.gz` nor `Barcodes.dat`");
  folder_ /= "nowhere";
  EXPECT_EQ(error(), "there is no folder `" + folder_.string() + "` with UTIAS logs");
}

TEST_F(DatasetTest, RefusesNanInALog) {
  put("Robot2_Groundtruth.dat", "1000.0 0 0 0\n1000.1 0 nan 0\n1000.2 0 0 0\n");
  EXPECT_EQ(error(), in_folder("Robot2_Groundtruth.dat") +
                         ":2:10: y [m] is `nan`: expected a finite number within +-1e6");
}

TEST_F(DatasetTest, RefusesARobotWithoutAnyPose) {
  put("Robot2_Groundtruth.dat", "# nothing\n");
  EXPECT_EQ(error(), in_folder("Robot2_Groundtruth.dat") +
                         ": robot 2 has no pose up to the end of the window at 0.2 s");
}

TEST_F(DatasetTest, RefusesWrongOptions) {
  options_.end_s = 0.5;
  EXPECT_EQ(error(), "the window from 0 to 0.5 s is empty or not within the 0 to 0.2 s that `" +
                         folder_.string() + "` holds");
  options_.end_s.reset();
  options_.start_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error(), "start_s is nan: expected seconds from 0 to 1000000000");
  options_.start_s.reset();
  options_.clock_offset_s = 5000;
  EXPECT_EQ(error(), "clock_offset_s is 5000: expected seconds from -1000 to 1000");
  options_.clock_offset_s = 0;
  options_.robots = {1, 1};
  EXPECT_EQ(error(), "robot 1 requested twice");
  options_.robots = {};
  EXPECT_EQ(error(), "no robot requested");
}

TEST_F(DatasetTest, HoldsTheStretchToItsWord) {
  const std::string times = "origin_s: 990.000000000\nstart_s: 10.1\nend_s: 10.2\n";
  put("stretch.txt", times);
  auto data = load(folder_, options_);
  ASSERT_TRUE(data) << data.error().text();
  EXPECT_EQ(data->robot(1)->poses.samples().back().t_ns, 10'200'000'000);
  EXPECT_FALSE(data->robot(1)->pose_report.unchanged);

  const std::string log = "1000.000 0 0 0\n";
  put("Robot1_Groundtruth.dat", log);
  put("stretch.txt", times + "sha256: " + sha256_hex(log) + " Robot1_Groundtruth.dat\n");
  data = load(folder_, options_);
  ASSERT_TRUE(data) << data.error().text();
  EXPECT_EQ(data->robot(1)->pose_report.unchanged, true);

  put("Robot1_Groundtruth.dat", "1000.000 1 0 0\n");
  EXPECT_NE(
      error().find("Robot1_Groundtruth.dat: the file differs from the one that stretch.txt lists"),
      std::string::npos)
      << error();
}

TEST_F(DatasetTest, RefusesABrokenStretchFile) {
  const std::string file = in_folder("stretch.txt");
  put("stretch.txt", "# a\norigin: 5\n");
  EXPECT_EQ(error(), file +
                         ":2: expected one of `origin_s: `, `start_s: `, `end_s: ` and "
                         "`sha256: `");
  put("stretch.txt", "origin_s: soon\n");
  EXPECT_EQ(error(), file +
                         ":1: `origin_s` is `soon`: expected seconds with at most nine "
                         "decimals");
  put("stretch.txt", "origin_s: 1\norigin_s: 1\n");
  EXPECT_EQ(error(), file + ":2: `origin_s` is given twice");
  put("stretch.txt", "origin_s: 1\nstart_s: 2\n");
  EXPECT_EQ(error(), file + ": expected all of `origin_s`, `start_s` and `end_s`");
  put("stretch.txt", "origin_s: 1\nstart_s: 2\nend_s: 2\n");
  EXPECT_EQ(error(), file + ": `start_s` must be less than `end_s`");
  put("stretch.txt", "sha256: 12 a.dat\n");
  EXPECT_EQ(error(), file +
                         ":1: expected `sha256: `, 64 lower-case hexadecimal digits and a file "
                         "name");
}

}  // namespace
}  // namespace rave::utias
