// SPDX-License-Identifier: Apache-2.0
// What one page is sent of a run in progress, and when.
#include "page/session.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "fake_port.hpp"
#include "live/live_source.hpp"

namespace rave::gui_server {
namespace {

using namespace std::chrono_literals;
using SessionJson = nlohmann::json;

class KeptSocket final : public web::Socket {
 public:
  void send_text(web::Payload text) override { texts.push_back(SessionJson::parse(*text)); }
  void send_binary(web::Payload bytes) override { binaries.push_back(*bytes); }
  void close(std::uint16_t /*code*/, std::string_view /*reason*/) override {}
  [[nodiscard]] std::size_t waiting_bytes() const noexcept override { return 0; }

  std::vector<SessionJson> texts;
  std::vector<std::string> binaries;
};

/// A run of this process that is held, or goes on.
class HeldPort final : public testing::FakePort {
 public:
  explicit HeldPort(runtime::RunControl& run) : run_(run) {}
  [[nodiscard]] RunHold held() const override { return gui_server::held(run_); }
  void hold(const TransportMessage& transport) override { gui_server::hold(run_, transport); }
  [[nodiscard]] std::optional<runtime::RunStatus> own_status() const override {
    runtime::RunStatus status;
    status.scenario = "yard";
    status.robots.resize(2);
    status.robots[0].simulated = false;
    return status;
  }

 private:
  runtime::RunControl& run_;
};

class PageSessions : public ::testing::Test {
 protected:
  static constexpr std::uint8_t kPoses = 1;  ///< First byte of a frame of poses.

  void SetUp() override {
    LiveSource::Start start;
    start.about.live = true;
    start.about.name = "yard";
    start.robots = {"anna", "bert"};
    start.robots_json = R"([{"name":"anna","team":"","sensors":[]},)"
                        R"({"name":"bert","team":"","sensors":[]}])";
    source_ =
        std::make_shared<LiveSource>(std::move(start), box_, std::make_unique<HeldPort>(run_));
    robots_.assign(2, RobotState{1, 2, 0.5, 0, kKnown});
    Greeting greeting;
    greeting.user = {"ada", Role::kSuperUser, {}};
    session_.show(source_, greeting, false, texts_);
    look("[]");
  }

  /// `readings`: pairs of slot and sensor.
  void look(const std::string& readings) {
    session_.received(R"({"type":"look","poses":true,"true_poses":false,"parts":false,)"
                      R"("max_hz":30,"readings":)" +
                      readings + "}");
  }

  /// Some time passes: the run hands out a picture every 50 ms, as it does while it is held, and
  /// the page acknowledges what it gets.
  void pass(std::chrono::milliseconds time) {
    for (auto gone = 0ms; gone < time; gone += 10ms) {
      now_ += 10ms;
      if (gone % 50ms == 0ms) draw();
      source_->tick(now_, {});
      SharedFrames frames;
      session_.tick(now_, frames);
      session_.received(R"({"type":"ack","sequence":)" + std::to_string(serial_) + "}");
    }
  }

  void draw() {
    if (!run_.paused()) {
      ++step_;
      for (RobotState& robot : robots_) robot.x_m += 0.01;
    }
    LivePicture& picture = box_->pictures.draft();
    picture.poses = {++serial_, 0.05 * static_cast<double>(step_), step_, robots_, {}, 7 * serial_};
    picture.readings = readings_;
    picture.reading_count = readings_.size();
    box_->pictures.publish();
  }

  /// How many frames of poses came since the last call.
  std::size_t frames() {
    const auto count = std::ranges::count_if(socket_.binaries, [](const std::string& frame) {
      return static_cast<std::uint8_t>(frame[0]) == kPoses;
    });
    others_ = socket_.binaries.size() - static_cast<std::size_t>(count);
    socket_.binaries.clear();
    return static_cast<std::size_t>(count);
  }
  [[nodiscard]] std::size_t texts_of(std::string_view type) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        socket_.texts, [type](const SessionJson& text) { return text.at("type") == type; }));
  }

  runtime::RunControl run_;
  KeptSocket socket_;
  std::shared_ptr<LiveBox> box_ = std::make_shared<LiveBox>();
  std::shared_ptr<LiveSource> source_;
  SharedTexts texts_;
  std::vector<RobotState> robots_;
  std::vector<ReadingAt> readings_;
  std::uint32_t serial_ = 0;
  std::uint64_t step_ = 0;
  std::size_t others_ = 0;  ///< Frames that were no poses, when they were counted last.
  SessionCalls calls_;
  Session session_{socket_, calls_};
  Session::Clock::time_point now_ = Session::Clock::now();
};

TEST_F(PageSessions, GetAFrameForEachPictureOfARunThatGoesOn) {
  pass(1000ms);
  // The past comes beside it.
  EXPECT_GE(frames(), 18U);
}

TEST_F(PageSessions, OfAHeldRunGetNothingButItsTime) {
  pass(1000ms);
  run_.pause();
  pass(200ms);
  static_cast<void>(frames());
  socket_.texts.clear();
  pass(3000ms);
  EXPECT_EQ(frames(), 0U);
  EXPECT_EQ(others_, 0U);
  EXPECT_EQ(texts_of("time"), 3U);
}

TEST_F(PageSessions, OfAHeldRunGetWhatChangesAllTheSame) {
  pass(500ms);
  run_.pause();
  pass(500ms);
  static_cast<void>(frames());
  robots_[1].flags |= kStopped;
  pass(500ms);
  EXPECT_EQ(frames(), 1U);
  // The page looks at a sensor: there is a frame at once, and one with the reading when it comes.
  look("[[0,0]]");
  pass(100ms);
  readings_ = {{0, 0, 0, 0.5, 1, 1, {4.5F}}};
  pass(500ms);
  EXPECT_EQ(frames(), 2U);
  EXPECT_EQ(others_, 1U);
  run_.resume();
  pass(500ms);
  EXPECT_GE(frames(), 8U);
}

TEST_F(PageSessions, OfARunOfOneProcessHearOfThisProcessAsItsHost) {
  pass(2500ms);
  const auto told =
      std::ranges::find_if(socket_.texts.rbegin(), socket_.texts.rend(),
                           [](const SessionJson& text) { return text.at("type") == "hosts"; });
  ASSERT_NE(told, socket_.texts.rend());
  ASSERT_EQ(told->at("hosts").size(), 1U);
  const SessionJson& host = told->at("hosts").at(0);
  EXPECT_EQ(host.at("name"), "yard");
  EXPECT_EQ(host.at("state"), "here");
  EXPECT_EQ(host.at("pid"), ::getpid());
  EXPECT_EQ(host.at("real"), 1);
  EXPECT_EQ(host.at("simulated"), 1);
  EXPECT_NEAR(host.at("steps_per_s").get<double>(), 20, 1);
  EXPECT_GT(host.at("memory_mb").get<double>(), 0);
  EXPECT_GE(host.at("cpu").get<double>(), 0);
  EXPECT_FALSE(host.at("machine").get<std::string>().empty());
}

}  // namespace
}  // namespace rave::gui_server
