// SPDX-License-Identifier: Apache-2.0
// What one client is sent, and when.
#include "foxglove/foxglove_session.hpp"

#include <gtest/gtest.h>

#include "fake_run.hpp"

namespace rave::gui_server {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

/// A line that takes nothing while it is told to be full.
class FakeSocket final : public web::Socket {
 public:
  void send_text(web::Payload text) override { texts.push_back(*text); }
  void send_binary(web::Payload bytes) override { binaries.push_back(*bytes); }
  void close(std::uint16_t code, std::string_view /*reason*/) override { closed = code; }
  [[nodiscard]] std::size_t waiting_bytes() const noexcept override { return waiting; }

  /// The messages of a subscription below 256 so far.
  [[nodiscard]] std::vector<Json> data(char subscription) const {
    std::vector<Json> messages;
    for (const std::string& bytes : binaries) {
      if (bytes.size() < 13 || bytes[0] != 1 || bytes[1] != subscription) continue;
      messages.push_back(Json::parse(bytes.substr(13)));
    }
    return messages;
  }

  std::vector<std::string> texts;
  std::vector<std::string> binaries;
  std::uint16_t closed = 0;
  std::size_t waiting = 0;
};

class FoxgloveSessions : public ::testing::Test {
 protected:
  void SetUp() override { session_.show(run_); }
  void subscribe(std::uint32_t id, const std::string& topic) {
    const FoxgloveTopics topics(*run_, 1);
    for (const FoxgloveChannel& channel : topics.channels()) {
      if (channel.topic != topic) continue;
      session_.received(
          Json({{"op", "subscribe"},
                {"subscriptions", Json::array({{{"id", id}, {"channelId", channel.id}}})}})
              .dump());
    }
  }
  /// Some time passes, in ticks of the server.
  void pass(std::chrono::milliseconds time) {
    for (auto gone = 0ms; gone < time; gone += 16ms) {
      now_ += 16ms;
      run_->tick(now_, {});
      FoxgloveFrames frames;
      session_.tick(now_, frames);
    }
  }

  FakeSocket socket_;
  std::shared_ptr<testing::FakeRun> run_ = std::make_shared<testing::FakeRun>();
  FoxgloveSession session_{socket_, "server"};
  FoxgloveSession::Clock::time_point now_ = FoxgloveSession::Clock::now();
};

TEST_F(FoxgloveSessions, AreGreetedAndSentNothingUnasked) {
  ASSERT_EQ(socket_.texts.size(), 3U);
  EXPECT_EQ(Json::parse(socket_.texts[0]).at("op"), "serverInfo");
  EXPECT_EQ(socket_.texts[1], R"({"op":"advertise","channels":[]})");
  EXPECT_EQ(Json::parse(socket_.texts[2]).at("channels").size(), 10U);
  EXPECT_FALSE(session_.wants_poses());
  pass(200ms);
  // The clock alone.
  for (const std::string& bytes : socket_.binaries) EXPECT_EQ(bytes[0], 2);
}

TEST_F(FoxgloveSessions, GetAtMostThirtyASecond) {
  subscribe(1, "/tf");
  EXPECT_TRUE(session_.wants_poses());
  pass(10s);
  EXPECT_LE(socket_.data(1).size(), 301U);
  EXPECT_GE(socket_.data(1).size(), 290U);
}

TEST_F(FoxgloveSessions, GetTheNewestOnceALineHasRoom) {
  subscribe(1, "/tf");
  subscribe(2, "/scene");
  subscribe(3, "/log");
  socket_.waiting = 1;
  pass(5s);
  EXPECT_TRUE(socket_.binaries.empty());
  socket_.waiting = 0;
  pass(16ms);
  ASSERT_EQ(socket_.data(1).size(), 1U);
  const Json stamp = socket_.data(1)[0].at("transforms")[0].at("timestamp");
  // 10 ms of the run a tick.
  EXPECT_EQ(stamp.at("sec"), 3);
  // What does not come again has waited.
  EXPECT_EQ(socket_.data(2).size(), 1U);
  EXPECT_EQ(socket_.data(3).size(), 4U);
}

TEST_F(FoxgloveSessions, LookAtTheSensorsOfTheirSubscriptions) {
  subscribe(1, "/scan/walker-3/scan");
  EXPECT_EQ(session_.looked_at(), (std::vector<LookedAt>{{2, 0}}));
  pass(100ms);
  EXPECT_EQ(socket_.data(1).front().at("frame_id"), "robot/walker-3");
  session_.received(R"({"op":"unsubscribe","subscriptionIds":[1]})");
  EXPECT_TRUE(session_.looked_at().empty());
  socket_.binaries.clear();
  pass(100ms);
  EXPECT_TRUE(socket_.data(1).empty());
}

TEST_F(FoxgloveSessions, HearOfTheEventsOfARecordingAsTheirTimeComes) {
  run_->facts.live = false;
  subscribe(3, "/log");
  pass(500ms);
  EXPECT_TRUE(socket_.data(3).empty());
  pass(4s);
  // 10 ms of the run a tick of 16 ms.
  EXPECT_EQ(socket_.data(3).size(), 2U);
  pass(4s);
  EXPECT_EQ(socket_.data(3).size(), 4U);
}

TEST_F(FoxgloveSessions, AreToldOfBodiesOnce) {
  subscribe(1, "/scene");
  subscribe(2, "/robots");
  pass(3s);
  EXPECT_EQ(socket_.data(1).size(), 1U);
  EXPECT_EQ(socket_.data(2).size(), 1U);
}

}  // namespace
}  // namespace rave::gui_server
