// SPDX-License-Identifier: Apache-2.0
#include "../src/drain.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace rave::manager {
namespace {

constexpr std::chrono::hours kEver{1};
constexpr std::chrono::seconds kNever{0};

struct Place {
  std::string name;
  std::uint64_t writer;
};

class DrainLog : public LogSink {
 public:
  void write(LogLevel /*level*/, std::string_view /*source*/, std::string_view message) override {
    lines.emplace_back(message);
  }
  std::vector<std::string> lines;
};

/// Places `one` and `two`, whose processes are 1 and 2.
class DrainTest : public ::testing::Test {
 protected:
  void go(const DrainLimits& limits, const std::function<bool()>& turn) {
    drain(
        places_, &log_, [this](std::uint64_t writer) { return owing_ == writer; },
        [&] {
          ++turns_;
          return turn();
        },
        limits);
  }

  std::vector<Place> places_{{"one", 1}, {"two", 2}};
  std::uint64_t owing_ = 0;
  int turns_ = 0;
  DrainLog log_;
};

TEST_F(DrainTest, NobodyIsThere) {
  for (Place& place : places_) place.writer = 0;
  go({kEver, kEver}, [] { return true; });
  EXPECT_EQ(turns_, 0);
}

TEST_F(DrainTest, EndsWhenTheLastHasGone) {
  go({kEver, kEver}, [this] {
    places_[turns_ == 1 ? 1 : 0].writer = 0;
    return true;
  });
  EXPECT_EQ(turns_, 2);
  EXPECT_TRUE(log_.lines.empty());
}

TEST_F(DrainTest, EndsWithTheUsualTimeIfNobodyOwesAnything) {
  go({kNever, kEver}, [] { return true; });
  EXPECT_EQ(turns_, 0);
}

TEST_F(DrainTest, WaitsLongerForHostResultsAndSaysSoOnce) {
  owing_ = 2;
  go({kNever, kEver}, [this] {
    if (turns_ == 3) owing_ = 0;
    return true;
  });
  EXPECT_EQ(turns_, 3);
  ASSERT_EQ(log_.lines.size(), 1U);
  EXPECT_EQ(log_.lines[0], "waits up to 3600 s for the results of two");
}

TEST_F(DrainTest, EndsWhenTheBusIsOfNoUse) {
  owing_ = 1;
  go({kEver, kEver}, [] { return false; });
  EXPECT_EQ(turns_, 1);
}

}  // namespace
}  // namespace rave::manager
