// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "rave/base/file.hpp"
#include "rave/player_testing/pack.hpp"
#include "utias/dataset.hpp"

namespace rave::utias {

using recording::pack;

/// A folder with a small, whole data set of two robots and one landmark, to be broken by a test.
class TemporaryDataset : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("rave_utias_") + test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    put("Barcodes.dat", "# head\n 1 5\n 2 14\n 6 63\n");
    put("Landmark_Groundtruth.dat", "6 0.5 -4.25 0.0001 0.0002\n");
    for (const std::string robot : {"Robot1_", "Robot2_"}) {
      put(robot + "Groundtruth.dat",
          "# head\n1000.000 0.0 0.0 3.1\n1000.100 0.1 0.0 -3.1\n1000.200 0.2 0.0 -3.0\n");
      put(robot + "Odometry.dat", "1000.050 0.1 0.0\n1000.150 0.2 0.5\n");
      put(robot + "Measurement.dat", "1000.100 63 1.5 0.25\n1000.100 5 2.5 -0.25\n");
    }
    options_.robots = {1, 2};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void put(const std::string& name, const std::string& content) const {
    ASSERT_TRUE(write_file_atomically(folder_ / name, content));
  }
  void remove(const std::string& name) const { std::filesystem::remove(folder_ / name); }
  [[nodiscard]] std::string in_folder(const std::string& name) const {
    return (folder_ / name).string();
  }
  /// The text of the error that load() gives, or a remark that there is none.
  [[nodiscard]] std::string error() const {
    const auto data = load(folder_, options_);
    return data ? "no error" : data.error().text();
  }

  std::filesystem::path folder_;
  LoadOptions options_;
};

}  // namespace rave::utias
