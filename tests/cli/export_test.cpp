// SPDX-License-Identifier: Apache-2.0
// `rave export`: what comes out as CSV is what is in the recording.
#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "process.hpp"
#include "rave/run_testing/recorded_run.hpp"

namespace rave::cli_test {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// Without quotes, which the columns that are looked at do not have.
Rows rows_of(const std::string& csv) {
  Rows rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

class Export : public ::testing::Test {
 protected:
  void SetUp() override {
    const Ended ended = run_rave({"run", "small", "--output", run_, "--quiet"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
  }
  Ended rave_export(std::vector<std::string> words) {
    words.insert(words.begin(), {"export", run_});
    return run_rave(words);
  }

  TemporaryFolder folder_;
  std::string run_ = folder_.path() / "run";
};

TEST_F(Export, PosesOfEveryStep) {
  const Ended ended = rave_export({"poses", "--robot", "anna"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const Rows rows = rows_of(ended.out);
  EXPECT_EQ(rows.front().front(), "time_s");
  const auto reader = record::McapReader::open(run_ + "/run.mcap");
  ASSERT_TRUE(reader);
  const auto run = record::read_run_info(*reader);
  ASSERT_TRUE(run);
  const auto poses = record::read_poses(*reader, record::find_robot(*run, "anna").value()->id);
  ASSERT_TRUE(poses);
  ASSERT_EQ(rows.size(), poses->size() + 1);
  for (std::size_t i = 0; i < poses->size(); ++i) {
    const std::vector<std::string>& row = rows[i + 1];
    EXPECT_EQ(row.at(1), "anna");
    ASSERT_TRUE((*poses)[i].reported_pose);
    // To the bit.
    EXPECT_EQ(std::stod(row.at(2)), (*poses)[i].reported_pose->x);
    EXPECT_EQ(std::stod(row.at(4)), (*poses)[i].reported_pose->yaw);
  }
}

TEST_F(Export, ReadingsOfASensor) {
  const std::string file = folder_.path() / "laser.csv";
  const Ended ended =
      rave_export({"readings", "--robot", "anna", "--sensor", "front_laser", "--output", file});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.out, "");
  const Rows rows = rows_of(content_of(file));
  const auto readings = readings_of(run_ + "/run.mcap").at("anna/front_laser");
  ASSERT_EQ(rows.size(), readings.size() + 1);
  EXPECT_EQ(rows[0].at(2), "range_m_0");
  const auto& [delivered_ns, stamp_ns, count, bytes] = readings.front();
  ASSERT_EQ(rows[1].size(), count + 2);
  EXPECT_NEAR(std::stod(rows[1].at(1)), static_cast<double>(stamp_ns) * 1e-9, 1e-9);
  float last = 0;
  std::memcpy(&last, bytes.data() + bytes.size() - sizeof last, sizeof last);
  EXPECT_EQ(std::stof(rows[1].back()), last);
}

/// The columns of a kind are part of the files of users.
TEST_F(Export, EachKindHasItsColumns) {
  const std::string played = folder_.path() / "played";
  ASSERT_EQ(run_rave({"run", "played.yaml", "--output", played, "--quiet"}).exit_code, 0);
  constexpr std::pair<const char*, const char*> kColumns[] = {
      {"sonar", "range_m_0"},
      {"camera", "code,range_m,bearing_rad"},
      {"odometry", "x_m,y_m,yaw_rad,v_mps,w_radps,variance_xy_m2,variance_yaw_rad2"},
      {"indoor", "x_m,y_m,yaw_rad,variance_xy_m2,variance_yaw_rad2"},
      {"bumper", "touching,bearing_rad"},
      {"others", "robot,range_m,bearing_rad,vx_mps,vy_mps"},
  };
  for (const auto& [sensor, columns] : kColumns) {
    const Ended ended =
        run_rave({"export", played, "readings", "--robot", "anna", "--sensor", sensor});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_TRUE(ended.out.starts_with(std::string("time_s,stamp_s,") + columns + "\n"))
        << ended.out.substr(0, 200);
    const Rows rows = rows_of(ended.out);
    EXPECT_GT(rows.size(), 1U) << sensor;
    for (const std::vector<std::string>& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  }
}

TEST_F(Export, EventsAreQuoted) {
  const Ended ended = rave_export({"events"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(ended.out.starts_with("time_s,robot,kind,text\n")) << ended.out;
}

TEST_F(Export, BadInput) {
  const auto error = [&](const std::vector<std::string>& words) {
    const Ended ended = rave_export(words);
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_EQ(ended.out, "");
    return ended.err;
  };
  EXPECT_NE(error({"pose"}).find("pose"), std::string::npos);
  EXPECT_NE(error({"poses", "--robot", "ana"}).find("did you mean `anna`?"), std::string::npos);
  EXPECT_NE(error({"readings"}).find("expected --robot NAME and --sensor NAME"), std::string::npos);
  EXPECT_NE(error({"poses", "--sensor", "laser"}).find("only with readings"), std::string::npos);
  EXPECT_NE(error({"poses", "--output", folder_.path() / "no/such/file"}).find("cannot write"),
            std::string::npos);
  EXPECT_EQ(run_rave({"export", "good_world.yaml", "poses"}).exit_code, 2);
}

}  // namespace
}  // namespace rave::cli_test
