// SPDX-License-Identifier: Apache-2.0
#include "udp_pose/pose_stream.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rave::udp_pose {
namespace {

using Verdict = PoseStream::Verdict;

std::string text(double t_s, int seq, const char* body = "cart") {
  return fmt::format(R"({{"body":"{}","t":{},"x":0,"y":0,"yaw":0,"seq":{}}})", body, t_s, seq);
}

TEST(PoseStream, OrdersCountsAndDrops) {
  PoseStream stream("cart", 0.2, 2);
  PoseDatagram pose;
  const auto take = [&](const std::string& bytes, double host_s) {
    return stream.take(bytes, "a", host_s, pose).verdict;
  };
  EXPECT_EQ(take(text(10.00, 1), 3.00), Verdict::kAccepted);
  EXPECT_EQ(take(text(10.01, 2), 3.01), Verdict::kAccepted);
  EXPECT_EQ(take(text(10.01, 2), 3.01), Verdict::kDuplicate);
  EXPECT_EQ(take(text(10.04, 5), 3.04), Verdict::kAccepted);
  EXPECT_EQ(take(text(10.03, 4), 3.05), Verdict::kOutOfOrder);
  EXPECT_EQ(take(text(10.05, 6, "dog"), 3.05), Verdict::kOtherBody);
  EXPECT_EQ(take("{", 3.05), Verdict::kRefused);
  EXPECT_EQ(take(text(10.06, 7), 3.36), Verdict::kLate);
  EXPECT_EQ(take(text(10.40, 8), 3.40), Verdict::kAccepted);
  const StreamState& state = stream.state();
  EXPECT_EQ(state.samples, 4U);
  EXPECT_EQ(state.duplicates, 1U);
  EXPECT_EQ(state.out_of_order, 1U);
  EXPECT_EQ(state.late, 1U);
  EXPECT_EQ(state.other_bodies, 1U);
  EXPECT_EQ(state.refused, 1U);
  EXPECT_EQ(state.trouble, "not JSON");
  EXPECT_EQ(state.lost, 3U);  // 3 and 4 before 5, and 6, which was another's
  EXPECT_NEAR(state.clock_offset_s, -7, 1e-9);
  EXPECT_NEAR(state.rate_hz, 7.5, 1e-6);
  EXPECT_NEAR(state.max_delay_s, 0.3, 1e-9);
}

TEST(PoseStream, ASenderThatBeginsAnewIsFollowed) {
  PoseStream stream("cart", 0.2, 2);
  PoseDatagram pose;
  for (int i = 0; i < 100; ++i) (void)stream.take(text(50 + 0.01 * i, i), "a", 0.01 * i, pose);
  int accepted = 0;
  for (int i = 0; i < 100; ++i) {
    const auto taken = stream.take(text(0.01 * i, i), "a", 2 + 0.01 * i, pose);
    accepted += taken.verdict == Verdict::kAccepted ? 1 : 0;
    EXPECT_EQ(taken.anew, i == 9);
    if (taken.verdict == Verdict::kAccepted) {
      EXPECT_NEAR(taken.host_s, 2 + 0.01 * i, 1e-6);
    }
  }
  EXPECT_EQ(accepted, 91);
  EXPECT_EQ(stream.state().restarts, 1U);
}

TEST(PoseStream, OfTwoSendersTheFirstCountsUntilItIsSilent) {
  PoseStream stream("cart", 0.2, 2);
  PoseDatagram pose;
  std::string news;
  const auto take = [&](const char* sender, double host_s) {
    auto taken = stream.take(text(host_s, static_cast<int>(host_s * 100)), sender, host_s, pose);
    if (!taken.news.empty()) news += taken.news + "\n";
    return taken.verdict;
  };
  EXPECT_EQ(take("a:1", 1), Verdict::kAccepted);
  EXPECT_EQ(take("a:1", 1.01), Verdict::kAccepted);
  for (int i = 2; i < 50; ++i) {
    EXPECT_EQ(take("b:2", 1.005 + 0.01 * i), Verdict::kOtherSender);
    EXPECT_EQ(take("a:1", 1.01 + 0.01 * i), Verdict::kAccepted);
  }
  EXPECT_EQ(news, "two senders of poses of `cart`, a:1 and b:2: only the first counts\n");
  EXPECT_EQ(stream.state().other_senders, 48U);
  EXPECT_EQ(stream.state().sender, "a:1");
  news.clear();
  EXPECT_EQ(take("b:2", 3.51), Verdict::kAccepted);
  EXPECT_EQ(news, "the poses of `cart` come from b:2 now; a:1 has been silent for 2 s\n");
}

TEST(PoseStream, ASenderMayOpenASocketForEachDatagram) {
  PoseStream stream("cart", 0.2, 2);
  PoseDatagram pose;
  for (int i = 0; i < 50; ++i) {
    const auto taken = stream.take(text(0.01 * i, i), fmt::format("a:{}", i), 0.01 * i, pose);
    EXPECT_EQ(taken.verdict, Verdict::kAccepted) << i;
    EXPECT_EQ(taken.news, "");
  }
  EXPECT_EQ(stream.state().restarts, 0U);
}

TEST(PoseStream, PosesThatFallBehindAreLateWhateverTheirNumber) {
  PoseStream stream("cart", 0.2, 2);
  PoseDatagram pose;
  double lag_s = 0;
  for (int i = 0; i < 4000; ++i) {
    if (i >= 400) lag_s = std::min(lag_s + 0.005, 3.0);
    const auto taken = stream.take(text(0.02 * i, i), "a", 100 + 0.02 * i + lag_s, pose);
    ASSERT_EQ(taken.verdict, lag_s < 0.195   ? Verdict::kAccepted
                             : lag_s < 0.205 ? taken.verdict
                                             : Verdict::kLate)
        << lag_s;
    EXPECT_NEAR(taken.host_s, 100 + 0.02 * i, 5e-3);
  }
  EXPECT_EQ(stream.state().restarts, 0U);
  EXPECT_GT(stream.state().late, 3000U);
}

TEST(PoseStream, AClockThatIsSetForwardIsLearntAnewAndTold) {
  PoseStream stream("cart", 0.2, 2);
  PoseDatagram pose;
  for (int i = 0; i < 200; ++i) (void)stream.take(text(0.02 * i, i), "a", 0.02 * i, pose);
  // One wrong stamp.
  EXPECT_EQ(stream.take(text(50, 200), "a", 4, pose).verdict, Verdict::kEarly);
  EXPECT_EQ(stream.take(text(4.02, 201), "a", 4.02, pose).verdict, Verdict::kAccepted);
  for (int i = 202; i < 300; ++i) {
    const auto taken = stream.take(text(3 + 0.02 * i, i), "a", 0.02 * i, pose);
    EXPECT_EQ(taken.verdict, i < 211 ? Verdict::kEarly : Verdict::kAccepted) << i;
    EXPECT_EQ(taken.anew, i == 211);
  }
  EXPECT_EQ(stream.state().early, 10U);
  EXPECT_EQ(stream.state().restarts, 1U);
  EXPECT_NEAR(stream.state().clock_offset_s, -3, 1e-9);
  EXPECT_EQ(stream.state().lost, 1U);  // the one with the wrong stamp
}

}  // namespace
}  // namespace rave::udp_pose
