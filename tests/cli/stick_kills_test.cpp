// SPDX-License-Identifier: Apache-2.0
// `kill -9` of the GUI Server, of hosts and of sticks at their direct lines (some of which only
// fall silent), at random moments of a run in real time: no robot moves on without its driver, and
// the rest goes on. RAVE_TEST_SEED and RAVE_KILL_ROUNDS say which moments, and how many.
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>
#include <iostream>
#include <thread>

#include "free_port.hpp"
#include "kill_rounds.hpp"
#include "live_listener.hpp"
#include "rave/record/run_reader.hpp"

extern char** environ;

namespace rave::cli_test {
namespace {

using Words = std::vector<std::string>;
using std::chrono::milliseconds;

constexpr std::int64_t kStep_ns = 20'000'000;
/// Within this a robot stands whose driver has gone; after that comes the step that notices.
constexpr std::int64_t kStands_ns = 300'000'000;
/// The lease of who has driven ends after 3 s, and somebody else may drive.
constexpr std::int64_t kQuiet_ns = 2'000'000'000;

/// A robot, its host, and who drives it.
struct Side {
  std::string host;
  std::string robot;
  std::uint32_t id = 0;
  std::uint16_t port = 0;
  pid_t stick = -1;
};

class StickKill : public KillRound {
 protected:
  void SetUp() override {
    auto opened = LiveListener::open(run_, apart());
    ASSERT_TRUE(opened) << opened.error().text();
    listener_ = *std::move(opened);
    const Ended made = run_rave({"keys", "line", key()});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    for (Side& side : sides_) side.port = free_port();
    start("env", "env", "sticks.yaml", of_run({}));
    for (const Side& side : sides_) {
      start(side.host, "robot", "sticks.yaml",
            of_run({"--host", side.host, "--web", "127.0.0.1:" + std::to_string(side.port),
                    "--web-key", key() + ".pub"}));
    }
    start_gui();
    for (Side& side : sides_) take_stick(side);
  }
  void TearDown() override {
    for (Side& side : sides_) drop_stick(side);
    kill_gui();
  }
  void start_gui() {
    std::ofstream(folder_.path() / "index.html") << "<!doctype html><title>page</title>\n";
    Words words = {"gui",       "sticks.yaml", "--line-key", key(),   "--page",   folder_.path(),
                   "--no-open", "--port",      "0",          "--run", run_.text()};
    for (const std::string& word : apart()) words.push_back(word);
    gui_ = start_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()}, folder("gui.log"));
    ASSERT_GT(gui_, 0);
    wait_until(
        [&] { return content_of(folder("gui.log")).find("Ctrl-C ends") != std::string::npos; },
        "the server is there");
  }
  void kill_gui() {
    if (gui_ <= 0) return;
    ::kill(gui_, SIGKILL);
    EXPECT_EQ(wait_for(std::exchange(gui_, -1)), -1) << content_of(folder("gui.log"));
  }
  [[nodiscard]] std::string key() const { return folder_.path() / "line_key"; }

  /// Starts to drive, again and again until the line is there and the robot moves.
  void take_stick(Side& side) {
    const std::string port = std::to_string(side.port);
    const std::string run = run_.text();
    const std::string file = key();
    const std::string user = "driver-" + side.host;
    std::array<std::string, 7> words = {
        RAVE_BINARY_DIR "/tests/line_stick", port, side.host, side.robot, run, file, user};
    std::array<char*, 8> arguments{};
    std::ranges::transform(words, arguments.begin(), [](std::string& word) { return word.data(); });
    const auto start = [&] {
      return ::posix_spawn(&side.stick, arguments[0], nullptr, nullptr, arguments.data(),
                           environ) == 0;
    };
    ASSERT_TRUE(start());
    // A stick that finds no line ends.
    wait_until_it_moves(side, [&] {
      if (::waitpid(side.stick, nullptr, WNOHANG) == 0) return;
      EXPECT_TRUE(start());
    });
  }
  static void drop_stick(Side& side) {
    if (side.stick <= 0) return;
    ::kill(side.stick, SIGKILL);
    ::waitpid(side.stick, nullptr, 0);
    side.stick = -1;
  }
  /// Its driver is gone: the line ends, or it stays and nobody speaks, as when a cable is pulled.
  void lose_stick(Side& side) {
    if (!chance_.one_in(2)) return drop_stick(side);
    std::cout << "its line stays open\n";
    ASSERT_EQ(::kill(side.stick, SIGSTOP), 0);
  }
  /// The newest moment of a robot that its host has told of.
  [[nodiscard]] std::int64_t newest_ns(const Side& side) {
    listener_->listen();
    const auto told = listener_->stamps_ns.find(side.id);
    return told == listener_->stamps_ns.end() || told->second.empty() ? 0 : told->second.back();
  }
  /// Waits for the next moment, which is after the present one.
  std::int64_t next_ns(const Side& side) {
    const std::int64_t now_ns = newest_ns(side);
    std::int64_t next_ns = 0;
    wait_until([&] { return (next_ns = newest_ns(side)) > now_ns; }, side.robot + " is heard of");
    return next_ns;
  }
  void wait_until_it_moves(
      const Side& side, const std::function<void()>& meanwhile = [] {}) {
    wait_until(
        [&] {
          meanwhile();
          listener_->listen();
          return listener_->places.contains(side.id);
        },
        side.robot + " is in the world");
    const LiveListener::Place from = listener_->places[side.id];
    wait_until(
        [&] {
          meanwhile();
          listener_->listen();
          const LiveListener::Place& now = listener_->places[side.id];
          return std::hypot(now.x_m - from.x_m, now.y_m - from.y_m) > 0.05;
        },
        side.robot + " moves");
  }
  void wait_a_while(const std::string& what) {
    const auto after = chance_.up_to(milliseconds(1500));
    std::cout << "kill -9 " << what << " after " << after.count() << " us\n";
    const auto end = std::chrono::steady_clock::now() + after;
    while (std::chrono::steady_clock::now() < end) {
      listener_->listen();
      std::this_thread::sleep_for(milliseconds(5));
    }
  }
  /// By the record of its host the robot stands from `gone_ns` + 300 ms + a step on.
  void expect_stood(const Side& side, std::int64_t gone_ns) {
    const auto reader = record::McapReader::open(folder(side.host) + "/run.mcap");
    ASSERT_TRUE(reader) << reader.error().text();
    const std::int64_t from_ns = gone_ns + kStands_ns + kStep_ns;
    std::vector<Pose2> poses;
    bool moved = false;
    std::optional<Pose2> before;
    const auto take = [&](const record::MessageView& message) -> Status {
      RAVE_TRY_ASSIGN(const auto step, record::decode_poses(message.bytes));
      for (const record::RobotPose& pose : step.items) {
        if (pose.robot.value() != side.id || !pose.true_pose) continue;
        const std::int64_t at_ns = step.time.ns;
        if (at_ns <= gone_ns && before) moved = moved || before->x != pose.true_pose->x;
        before = pose.true_pose;
        if (at_ns >= from_ns && at_ns < gone_ns + kQuiet_ns) poses.push_back(*pose.true_pose);
      }
      return {};
    };
    ASSERT_TRUE(record::for_each_message(*reader, record::topic::kPoses, take));
    EXPECT_TRUE(moved) << side.robot << " was driven before";
    ASSERT_GE(poses.size(), 20U) << side.robot;
    for (const Pose2& pose : poses) {
      ASSERT_EQ(pose.x, poses.front().x) << side.robot << " moves without its driver";
      ASSERT_EQ(pose.y, poses.front().y) << side.robot;
      ASSERT_EQ(pose.yaw, poses.front().yaw) << side.robot;
    }
  }

  std::unique_ptr<LiveListener> listener_;
  pid_t gui_ = -1;
  std::array<Side, 2> sides_ = {Side{"one", "left", 0}, Side{"two", "right", 1}};
};

class WhoDrivesIsKilled : public StickKill {};

TEST_P(WhoDrivesIsKilled, TheRobotStandsAndTheOtherDrivesOn) {
  Side& left = sides_[chance_.below(2)];
  Side& other = &left == sides_.data() ? sides_[1] : sides_[0];
  // The server may be gone by then, or not.
  const bool server_first = chance_.one_in(2);
  if (server_first) {
    wait_a_while("gui");
    kill_gui();
    for (const Side& side : sides_) wait_until_it_moves(side);
  }
  wait_a_while("the stick of " + left.robot);
  lose_stick(left);
  const std::int64_t gone_ns = next_ns(left);
  wait_until_it_moves(other);
  if (!server_first) {
    wait_a_while("gui");
    kill_gui();
    wait_until_it_moves(other);
  }
  wait_until([&] { return newest_ns(left) > gone_ns + kQuiet_ns; }, "time passes");
  // Who comes back drives on, without any server.
  drop_stick(left);
  take_stick(left);
  wait_until_it_moves(other);
  for (Side& side : sides_) {
    signal(side.host, SIGINT);
    EXPECT_EQ(end_of(side.host), 0) << console(side.host);
  }
  expect_stood(left, gone_ns);
}
INSTANTIATE_TEST_SUITE_P(Round, WhoDrivesIsKilled, ::testing::Range(0, kill_rounds()));

class AHostOfASticksRobotIsKilled : public StickKill {};

TEST_P(AHostOfASticksRobotIsKilled, TheOtherRobotIsDrivenOnAndItComesBack) {
  Side& gone = sides_[chance_.below(2)];
  Side& other = &gone == sides_.data() ? sides_[1] : sides_[0];
  wait_a_while("host " + gone.host);
  kill_process(gone.host);
  wait_until_it_moves(other);
  // Its stick notices: the line has ended.
  wait_until([&] { return ::waitpid(gone.stick, nullptr, WNOHANG) != 0; }, "the line ends");
  gone.stick = -1;
  start(gone.host, "robot", "sticks.yaml",
        of_run({"--host", gone.host, "--web", "127.0.0.1:" + std::to_string(gone.port), "--web-key",
                key() + ".pub"}));
  wait_until_it_moves(other);
  take_stick(gone);
  wait_a_while("the stick of " + other.robot);
  lose_stick(other);
  const std::int64_t gone_ns = next_ns(other);
  wait_until_it_moves(gone);
  wait_until([&] { return newest_ns(other) > gone_ns + kQuiet_ns; }, "time passes");
  for (Side& side : sides_) {
    signal(side.host, SIGINT);
    const int code = end_of(side.host);
    // The one that came back may have noticed that the other one ended, which is a loss.
    EXPECT_TRUE(code == 0 || (code == 1 && &side == &gone)) << code << console(side.host);
  }
  expect_stood(other, gone_ns);
}
INSTANTIATE_TEST_SUITE_P(Round, AHostOfASticksRobotIsKilled, ::testing::Range(0, kill_rounds()));

}  // namespace
}  // namespace rave::cli_test
