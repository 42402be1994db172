// SPDX-License-Identifier: Apache-2.0
#include "page/frame_pace.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rave::gui_server {
namespace {

using std::chrono::milliseconds;
using Clock = FramePace::Clock;

constexpr milliseconds kGlance{4};

/// A page that asks for 30 frames a second, of a run that shows a state every `state`, for `span`.
struct Watched {
  std::vector<double> ages_ms;   ///< Of the state in each frame.
  std::vector<double> times_ms;  ///< When it went.

  Watched(milliseconds state, milliseconds span, milliseconds last_state) {
    FramePace pace;
    pace.set_rate(30);
    std::uint64_t sent = 0;
    const Clock::time_point begin{std::chrono::seconds(1000)};
    for (milliseconds t{0}; t < span; t += kGlance) {
      const auto newest = std::min(t, last_state) / state;
      const auto picture = static_cast<std::uint64_t>(newest) + 1;
      if (!pace.due(begin + t, picture) || picture == sent) continue;
      pace.went(begin + t);
      sent = picture;
      ages_ms.push_back(static_cast<double>((t - newest * state).count()));
      times_ms.push_back(static_cast<double>(t.count()));
    }
  }
};

TEST(FramePace, AFrameGoesWithAFreshStateAtTheAskedRate) {
  for (const int state_ms : {16, 20, 25, 33}) {
    const Watched watched(milliseconds(state_ms), milliseconds(10'000), milliseconds(10'000));
    EXPECT_NEAR(static_cast<double>(watched.ages_ms.size()), 300, 8) << state_ms;
    for (std::size_t i = 5; i < watched.ages_ms.size(); ++i) {
      // What is left is the time until the server looks again.
      EXPECT_LE(watched.ages_ms[i], 4) << state_ms << " ms, frame " << i;
    }
  }
}

TEST(FramePace, RareStatesGoAtOnce) {
  const Watched watched(milliseconds(200), milliseconds(4000), milliseconds(4000));
  EXPECT_EQ(watched.ages_ms.size(), 20U);
  for (const double age_ms : watched.ages_ms) EXPECT_LE(age_ms, 0);
}

TEST(FramePace, TheLastStateOfARunThatStopsIsSent) {
  // The state at 1020 ms is the last, and the page was sent that of 1000 ms.
  const Watched watched(milliseconds(20), milliseconds(2000), milliseconds(1039));
  ASSERT_GT(watched.times_ms.size(), 25U);
  EXPECT_GE(watched.times_ms.back(), 1020);
  EXPECT_LE(watched.times_ms.back(), 1020 + 33 + 20);
}

}  // namespace
}  // namespace rave::gui_server
