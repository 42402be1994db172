// SPDX-License-Identifier: Apache-2.0
#include "../temporary_dataset.hpp"
#include "played.hpp"

namespace rave::utias {
namespace {

/// A small data set; its times count from 1000.
class PlayerErrors : public TemporaryDataset {
 protected:
  /// What configure() says of the temporary data set, or nothing.
  [[nodiscard]] std::string refusal(const std::string& driver, Given given = {}) const {
    given.try_emplace("folder", folder_.filename().string());
    given.try_emplace("robot", 1.0);
    return Player(driver).configure(given, folder_.parent_path().string());
  }
  /// Without a stated origin all logs are needed; with it only the one that is played.
  void state_the_stretch() const {
    put("stretch.txt", "origin_s: 1000.000\nstart_s: 0.0\nend_s: 0.2\n");
  }
};

TEST_F(PlayerErrors, AFolderThatIsNotThere) {
  EXPECT_EQ(
      refusal("utias_mocap", {{"folder", "nowhere"}}),
      "there is no folder `" + (folder_.parent_path() / "nowhere").string() + "` with UTIAS logs");
}

TEST_F(PlayerErrors, AFolderMayBeAbsolute) {
  EXPECT_EQ(refusal("utias_mocap", {{"folder", folder_.string()}}), "");
}

TEST_F(PlayerErrors, ARobotThatIsNotThere) {
  EXPECT_EQ(refusal("utias_odometry", {{"robot", 3.0}}),
            "`" + folder_.string() + "` has no logs of robot 3; it has robots: 1, 2");
}

TEST_F(PlayerErrors, AWindowThatIsNotHeld) {
  EXPECT_EQ(refusal("utias_camera", {{"start_s", 0.1}, {"end_s", 7.0}}),
            "the window from 0.1 to 7 s is empty or not within the 0 to 0.2 s that `" +
                folder_.string() + "` holds");
}

TEST_F(PlayerErrors, NoNumberInALogOnlyHurtsWhoPlaysIt) {
  state_the_stretch();
  put("Robot1_Groundtruth.dat", "# head\n1000.000 0.0 nan 3.1\n1000.100 0.1 0.0 -3.1\n");
  const std::string text = refusal("utias_mocap");
  EXPECT_TRUE(text.starts_with(in_folder("Robot1_Groundtruth.dat") + ":2:14: ")) << text;
  EXPECT_NE(text.find("nan"), std::string::npos) << text;
  EXPECT_EQ(refusal("utias_odometry"), "");
  EXPECT_EQ(refusal("utias_camera"), "");
}

TEST_F(PlayerErrors, OnlyTheLogThatIsPlayedMustBeThere) {
  state_the_stretch();
  remove("Robot1_Groundtruth.dat");
  remove("Robot1_Measurement.dat");
  EXPECT_EQ(refusal("utias_odometry"), "");
  EXPECT_EQ(refusal("utias_camera"),
            "`" + folder_.string() +
                "` has neither `Robot1_Measurement.dat.gz` nor `Robot1_Measurement.dat`");
}

TEST_F(PlayerErrors, ACutLogIsPlayedIfThatIsAccepted) {
  put("Robot1_Odometry.dat", "1000.050 0.1 0.0\n1000.150 0.2");
  const std::string text = refusal("utias_odometry");
  EXPECT_TRUE(text.starts_with(in_folder("Robot1_Odometry.dat") + ":2:")) << text;
  EXPECT_EQ(refusal("utias_odometry", {{"accept_cut", 1.0}}), "");
}

TEST_F(PlayerErrors, ManySightingsOfOneStampRaiseTheCapacity) {
  std::string log;
  for (int i = 0; i < 70; ++i) log += "1000.100 63 1.5 0.25\n";
  put("Robot1_Measurement.dat", log);
  Player player("utias_camera");
  ASSERT_EQ(player.configure({{"folder", folder_.string()}, {"robot", 1.0}}, ""), "");
  EXPECT_EQ(player.declaration().capacity, 70U);
  const auto played = play_once<rave::Sighting>(player);
  ASSERT_EQ(played.size(), 1U);
  EXPECT_EQ(played[0].records.size(), 70U);
}

}  // namespace
}  // namespace rave::utias
