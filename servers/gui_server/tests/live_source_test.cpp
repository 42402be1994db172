// SPDX-License-Identifier: Apache-2.0
// A run that is shown while it goes on, without its loop.
#include "live/live_source.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "fake_port.hpp"

namespace rave::gui_server {
namespace {

using Answer = Result<std::string>;

/// Keeps what it is asked.
class AskedPort final : public testing::FakePort {
 public:
  explicit AskedPort(std::vector<std::promise<Answer>>& asked) : asked_(asked) {}
  [[nodiscard]] Result<std::future<Answer>> post(request::Request /*request*/) override {
    return asked_.emplace_back().get_future();
  }

 private:
  std::vector<std::promise<Answer>>& asked_;
};

TEST(LiveSource, AnswersThatAreFollowedByNewRequestsAreAllGiven) {
  std::vector<std::promise<Answer>> asked;
  LiveSource::Start start;
  start.about.relay = true;
  start.robots = {"anna"};
  start.robots_json = "[]";
  LiveSource source(std::move(start), std::make_shared<LiveBox>(),
                    std::make_unique<AskedPort>(asked));
  CommandMessage drive;
  drive.action = request::Drive();
  drive.slots = {0};
  int answered = 0;
  int later = 0;
  constexpr int kWaiting = 5;
  // As a page does whose next drive waited for the answer.
  for (int i = 0; i < kWaiting; ++i) {
    source.command(drive, {}, [&](std::uint32_t, bool, const std::string&) {
      ++answered;
      source.command(drive, {}, [&](std::uint32_t, bool, const std::string&) { ++later; });
    });
  }
  const auto answer_from = [&asked](std::size_t first) {
    for (std::size_t i = first; i < asked.size(); ++i) asked[i].set_value("done");
  };
  answer_from(0);
  source.tick({}, {});
  EXPECT_EQ(answered, kWaiting);
  ASSERT_EQ(asked.size(), 2U * kWaiting);
  EXPECT_EQ(later, 0);
  answer_from(kWaiting);
  source.tick({}, {});
  EXPECT_EQ(answered, kWaiting);
  EXPECT_EQ(later, kWaiting);
}

}  // namespace
}  // namespace rave::gui_server
