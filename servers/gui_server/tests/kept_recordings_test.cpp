// SPDX-License-Identifier: Apache-2.0
// Where the recordings of a run on the bus are when it is over. That they are played: page_hosts.
#include "replay/kept_recordings.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace rave::gui_server {
namespace {

namespace fs = std::filesystem;

class KeptRecordings : public ::testing::Test {
 public:
  KeptRecordings() { fs::create_directories(folder_); }
  ~KeptRecordings() override { fs::remove_all(folder_); }

 protected:
  fs::path folder_ =
      fs::temp_directory_path() / ("rave-kept-" + std::to_string(::getpid()) +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(KeptRecordings, OfOtherMachinesAreNamedOnceEach) {
  const std::vector<watch::KeptAt> kept = {{"environment manager", true, "lab-1", "/runs/m"},
                                           {"left", false, "lab-2", "/runs/a"},
                                           {"left", false, "lab-2", "/runs/a"},
                                           {"right", false, "lab-3", "/runs/b\n"}};
  EXPECT_EQ(places_of(kept),
            "The recordings of this run are on lab-1 in `/runs/m`, on lab-2 in `/runs/a`, and on "
            "lab-3 in `/runs/b `.");
  const auto opened = open_kept(kept, "lab-1");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(opened.error().message, places_of(kept));
}

TEST_F(KeptRecordings, APathOfAnotherMachineIsNotOpenedHere) {
  std::ofstream(folder_ / "run.mcap") << "of another run";
  const std::vector<watch::KeptAt> there = {{"left", false, "lab-2", folder_.string()}};
  const auto opened = open_kept(there, "lab-1");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().message, places_of(there));
  // Of this machine it is opened, and then found wanting.
  const auto here = open_kept(there, "lab-2");
  ASSERT_FALSE(here);
  EXPECT_NE(here.error().code, ErrorCode::kNotFound);
}

TEST_F(KeptRecordings, WhoRecordsNothingLeavesNothing) {
  const auto opened = open_kept({}, "lab-1");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().message, "The run left no recording.");
}

TEST_F(KeptRecordings, ManyPlacesAreCounted) {
  std::vector<watch::KeptAt> kept;
  for (int i = 0; i < 9; ++i) {
    kept.push_back({"host", false, "lab", "/runs/" + std::to_string(i)});
  }
  EXPECT_NE(places_of(kept).find("and in 3 more folders."), std::string::npos) << places_of(kept);
}

}  // namespace
}  // namespace rave::gui_server
