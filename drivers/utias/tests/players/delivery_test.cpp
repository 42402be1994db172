// SPDX-License-Identifier: Apache-2.0
// What the players deliver is what the reader read, in the same order, with the stamps of the run.
#include <numbers>

#include "played.hpp"

namespace rave::utias {
namespace {

using PoseSamples = std::vector<Published<PoseReading>>;
using SightingSamples = std::vector<Published<rave::Sighting>>;

/// The samples of a state that count for a window: those inside, and the last one before it.
template <class Sample>
std::vector<Sample> of_window(std::span<const Sample> samples, const Dataset& data) {
  std::vector<Sample> kept;
  for (const Sample& sample : samples) {
    if (sample.t_ns > data.end_ns) continue;
    if (sample.t_ns <= data.start_ns) kept.clear();
    kept.push_back(sample);
  }
  return kept;
}

TEST(Delivery, PosesAreThoseOfTheReader) {
  const Dataset data = recorded("100-220");
  for (const RobotLog& robot : data.robots) {
    const double number = robot.subject;
    const auto played =
        play_all<PoseReading>("utias_mocap", {{"folder", "100-220"}, {"robot", number}});
    const auto expected = of_window(robot.poses.samples(), data);
    ASSERT_EQ(played.size(), expected.size()) << robot.subject;
    ASSERT_GT(played.size(), 6000U);
    EXPECT_EQ(played[0].stamp_ns, 0);
    EXPECT_LE(expected[0].t_ns, data.start_ns);
    for (std::size_t i = 0; i < played.size(); ++i) {
      ASSERT_EQ(played[i].records.size(), 1U);
      const PoseReading& pose = played[i].records[0];
      EXPECT_EQ(pose.x_m, expected[i].pose.x);
      EXPECT_EQ(pose.y_m, expected[i].pose.y);
      EXPECT_EQ(pose.yaw_rad, expected[i].pose.yaw);
      if (i > 0) {
        EXPECT_EQ(played[i].stamp_ns, expected[i].t_ns - data.start_ns);
      }
    }
  }
}

TEST(Delivery, CommandsAreThoseOfTheReader) {
  const Dataset data = recorded("100-220");
  const auto played =
      play_all<VelocityReading>("utias_odometry", {{"folder", "100-220"}, {"robot", 4.0}});
  const auto expected = of_window(std::span(data.robot(4)->odometry), data);
  ASSERT_EQ(played.size(), expected.size());
  ASSERT_GT(played.size(), 6000U);
  EXPECT_EQ(played[0].stamp_ns, 0);
  for (std::size_t i = 0; i < played.size(); ++i) {
    ASSERT_EQ(played[i].records.size(), 1U);
    EXPECT_EQ(played[i].records[0].v_mps, expected[i].v_mps);
    EXPECT_EQ(played[i].records[0].w_radps, expected[i].w_radps);
    if (i > 0) {
      EXPECT_EQ(played[i].stamp_ns, expected[i].t_ns - data.start_ns);
    }
  }
}

TEST(Delivery, SightingsOfOneImageComeTogether) {
  const Dataset data = recorded("100-220");
  std::size_t total = 0;
  for (const RobotLog& robot : data.robots) {
    const double number = robot.subject;
    const auto played =
        play_all<rave::Sighting>("utias_camera", {{"folder", "100-220"}, {"robot", number}});
    const auto images = images_of(robot);
    ASSERT_EQ(played.size(), images.size());
    for (std::size_t i = 0; i < played.size(); ++i) {
      const auto& group = images[i];
      ASSERT_EQ(played[i].records.size(), group.size());
      EXPECT_EQ(played[i].stamp_ns, group.front().t_ns - data.start_ns);
      for (std::size_t k = 0; k < group.size(); ++k) {
        const rave::Sighting& seen = played[i].records[k];
        EXPECT_EQ(seen.stamp_ns, played[i].stamp_ns);
        EXPECT_EQ(seen.code, group[k].code);
        EXPECT_EQ(seen.range_m, static_cast<float>(group[k].range_m));
        EXPECT_EQ(seen.bearing_rad, static_cast<float>(group[k].bearing_rad));
      }
      total += group.size();
    }
  }
  EXPECT_EQ(total, 2547U + 3U) << "the known ones and three of barcode 50";
}

TEST(Delivery, ThePosesOfRobotOneEndWhereItWasLost) {
  const auto played = play_all<PoseReading>("utias_mocap", {{"folder", "760-900"}, {"robot", 1.0}});
  ASSERT_FALSE(played.empty());
  EXPECT_EQ(played.front().stamp_ns, 0);
  EXPECT_NEAR(static_cast<double>(played.back().stamp_ns) * 1e-9, 771.9 - 760, 0.05);
  EXPECT_TRUE(
      play_all<rave::Sighting>("utias_camera", {{"folder", "760-900"}, {"robot", 1.0}}).empty());
}

TEST(Delivery, AWindowBeginsWithWhatHoldsAtItsStart) {
  const Given window = {
      {"folder", "100-220"}, {"robot", 3.0}, {"start_s", 150.0}, {"end_s", 152.5}};
  const Dataset data = recorded("100-220");
  const auto poses = play_all<PoseReading>("utias_mocap", window);
  ASSERT_GT(poses.size(), 100U);
  EXPECT_EQ(poses[0].stamp_ns, 0);
  EXPECT_GT(poses[1].stamp_ns, 0);
  EXPECT_LE(poses.back().stamp_ns, 2'500'000'000);
  EXPECT_GT(poses.back().stamp_ns, 2'400'000'000);
  const auto commands = play_all<VelocityReading>("utias_odometry", window);
  ASSERT_FALSE(commands.empty());
  EXPECT_EQ(commands[0].stamp_ns, 0);
  const auto held =
      held_at(std::span<const OdometrySample>(data.robot(3)->odometry), 150 * kSecond_ns);
  ASSERT_TRUE(held);
  EXPECT_EQ(commands[0].records[0].v_mps, held->v_mps);
  EXPECT_EQ(commands[0].records[0].w_radps, held->w_radps);
  std::size_t groups = 0;
  for (const auto& image : images_of(*data.robot(3))) {
    const std::int64_t t_ns = image.front().t_ns;
    groups += t_ns >= 150 * kSecond_ns && t_ns <= 152'500 * kMillisecond_ns ? 1U : 0U;
  }
  EXPECT_GT(groups, 0U);
  EXPECT_EQ(play_all<rave::Sighting>("utias_camera", window).size(), groups);
}

TEST(Delivery, TheStatedVariancesStandInEachPose) {
  Given given = {{"folder", "760-900"}, {"robot", 1.0}};
  const PoseSamples plain = play_all<PoseReading>("utias_mocap", given);
  ASSERT_FALSE(plain.empty());
  const double half_degree = std::numbers::pi / 360;
  EXPECT_DOUBLE_EQ(plain.back().records[0].variance_xy_m2, 1e-6);
  EXPECT_DOUBLE_EQ(plain.back().records[0].variance_yaw_rad2, half_degree * half_degree);
  given["position_sigma_m"] = 0.02;
  given["heading_sigma_deg"] = 2.0;
  const PoseSamples wide = play_all<PoseReading>("utias_mocap", given);
  EXPECT_DOUBLE_EQ(wide.back().records[0].variance_xy_m2, 4e-4);
  EXPECT_DOUBLE_EQ(wide.back().records[0].variance_yaw_rad2, 16 * half_degree * half_degree);
}

TEST(Delivery, BarcodesReadAsSubjectsNameTheWrongOnes) {
  Given given = {{"folder", "100-220"}, {"robot", 3.0}};
  const SightingSamples right = play_all<rave::Sighting>("utias_camera", given);
  given["codes"] = "subject";
  const SightingSamples wrong = play_all<rave::Sighting>("utias_camera", given);
  ASSERT_EQ(right.size(), wrong.size());
  const Subjects subjects = recorded("100-220").subjects;
  int mistaken = 0;
  int nobody = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    ASSERT_EQ(right[i].records.size(), wrong[i].records.size());
    for (std::size_t k = 0; k < right[i].records.size(); ++k) {
      const int number = right[i].records[k].code;
      const int read = wrong[i].records[k].code;
      EXPECT_NE(read, number);
      EXPECT_EQ(right[i].records[k].range_m, wrong[i].records[k].range_m);
      const bool is_subject = number >= 1 && number <= 20;
      EXPECT_EQ(read, is_subject ? subjects.code_of_subject(number) : -1 - number);
      (is_subject ? mistaken : nobody) += 1;
    }
  }
  EXPECT_GT(mistaken, 100);
  EXPECT_GT(nobody, 100);
}

/// Checks that all samples of `later` are samples of `plain`, stamped `shift_ns` later.
template <class Record>
void expect_shifted(const std::vector<Published<Record>>& plain,
                    const std::vector<Published<Record>>& later, std::int64_t shift_ns) {
  std::map<std::int64_t, std::size_t> by_stamp;
  for (std::size_t i = 0; i < plain.size(); ++i) by_stamp[plain[i].stamp_ns] = i;
  std::size_t found = 0;
  for (const auto& sample : later) {
    const auto match = by_stamp.find(sample.stamp_ns - shift_ns);
    if (sample.stamp_ns <= shift_ns || match == by_stamp.end()) continue;
    EXPECT_EQ(sample.records.size(), plain[match->second].records.size());
    ++found;
  }
  EXPECT_GT(found * 100, plain.size() * 97);
}

TEST(Delivery, AClockThatIsOffShiftsTheStamps) {
  const Given plain = {{"folder", "100-220"}, {"robot", 5.0}};
  Given shifted = plain;
  shifted["clock_offset_s"] = 1.0;
  expect_shifted(play_all<rave::Sighting>("utias_camera", plain),
                 play_all<rave::Sighting>("utias_camera", shifted), kSecond_ns);
  expect_shifted(play_all<VelocityReading>("utias_odometry", plain),
                 play_all<VelocityReading>("utias_odometry", shifted), kSecond_ns);
  const auto on_time = play_all<PoseReading>("utias_mocap", plain);
  const auto late = play_all<PoseReading>("utias_mocap", shifted);
  expect_shifted(on_time, late, kSecond_ns);
  // The margin of the files fills the second that the shift opens.
  EXPECT_EQ(late[0].stamp_ns, 0);
  EXPECT_LT(late[1].stamp_ns, 100 * kMillisecond_ns);
  shifted["clock_offset_s"] = -1.0;
  const auto early = play_all<PoseReading>("utias_mocap", shifted);
  EXPECT_GT(early.back().stamp_ns, 119'900 * kMillisecond_ns);
  EXPECT_LE(early.back().stamp_ns, 120 * kSecond_ns);
}

TEST(Delivery, DriversSayWhatTheyAre) {
  const std::map<std::string, ReadingKind> kinds = {{"utias_mocap", ReadingKind::kPose},
                                                    {"utias_odometry", ReadingKind::kVelocity},
                                                    {"utias_camera", ReadingKind::kSightings}};
  for (const auto& [name, kind] : kinds) {
    Player player(name);
    EXPECT_EQ(player.info().name, name);
    EXPECT_EQ(player.info().kind, DriverKind::kSensor);
    EXPECT_EQ(player.info().clock, DriverClock::kEither);
    EXPECT_EQ(player.info().data_kind, static_cast<std::uint32_t>(kind));
    for (const std::string clock : {"stepped", "live"}) {
      ASSERT_EQ(player.configure({{"folder", "760-900"}, {"robot", 2.0}, {"clock", clock}},
                                 data_folder()),
                "");
      EXPECT_EQ(player.declaration().clock,
                clock == "live" ? DriverClock::kLive : DriverClock::kStepped);
    }
    const bool events = kind == ReadingKind::kSightings;
    EXPECT_EQ(player.declaration().capacity, events ? 64U : 1U);
    EXPECT_EQ(player.declaration().collect, events ? 1U : 0U);
  }
}

}  // namespace
}  // namespace rave::utias
