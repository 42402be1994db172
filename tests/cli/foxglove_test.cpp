// SPDX-License-Identifier: Apache-2.0
// A Foxglove client at a run in progress: it sees robots and obstacles where they are.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <thread>

#include "process.hpp"
#include "rave/gui_testing/foxglove_client.hpp"

namespace rave::cli_test {
namespace {

using gui_server::testing::FoxgloveClient;
using Json = nlohmann::ordered_json;

class FoxgloveRun : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_.path() / "index.html") << "<!doctype html><title>page</title>\n";
  }
  void TearDown() override {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    static_cast<void>(wait_for(process_));
  }
  [[nodiscard]] std::string said() const { return content_of(folder_.path() / "said"); }
  [[nodiscard]] std::string results() const { return folder_.path() / "results"; }
  [[nodiscard]] std::string setting() const { return "XDG_RUNTIME_DIR=" + folder_.path().string(); }
  /// Starts a process with a page, and waits until it says where Foxglove connects.
  void start(std::vector<std::string> words) {
    const std::string folder = folder_.path();
    words.insert(words.end(), {"--page", folder, "--port", "0", "--no-open", "--foxglove"});
    std::vector<std::string> variables = {setting()};
    variables.insert(variables.end(), desktop_.begin(), desktop_.end());
    process_ = start_rave(words, variables, folder + "/said");
    ASSERT_GT(process_, 0);
    for (int i = 0; i < 3000 && said().find("Ctrl-C ends") == std::string::npos; ++i) {
      ASSERT_EQ(::waitpid(process_, nullptr, WNOHANG), 0) << said();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const std::string begin = "foxglove  ws://127.0.0.1:";
    const std::size_t at = said().find(begin);
    ASSERT_NE(at, std::string::npos) << said();
    const std::string place = said().substr(at + begin.size());
    port_ = static_cast<std::uint16_t>(std::stoi(place));
    target_ = place.substr(place.find('/'), place.find('\n') - place.find('/'));
  }
  /// The whole answer of the server to one request.
  [[nodiscard]] std::string ask(const std::string& method, const std::string& path,
                                const std::string& headers, const std::string& body) const {
    web::testing::RawClient client(port_, {});
    client.send(
        fmt::format("{} {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\nContent-Length: "
                    "{}\r\n{}\r\n{}",
                    method, path, port_, body.size(), headers, body));
    return client.read_all();
  }
  /// Where a robot is by the messages of a subscription to `/tf`; waits until it is there.
  static bool comes_to(FoxgloveClient& client, std::uint32_t id, const std::string& robot, double x,
                       double y) {
    for (int i = 0; i < 1000; ++i) {
      const Json message = client.data(id);
      if (!message.is_object()) return false;
      for (const Json& transform : message.at("transforms")) {
        if (transform.at("child_frame_id") != "robot/" + robot) continue;
        const Json& place = transform.at("translation");
        if (std::abs(place.at("x").get<double>() - x) < 1e-3 &&
            std::abs(place.at("y").get<double>() - y) < 1e-3) {
          return true;
        }
      }
    }
    return false;
  }

  TemporaryFolder folder_;
  pid_t process_ = -1;
  std::uint16_t port_ = 0;
  std::string target_;
  std::vector<std::string> desktop_;  ///< Variables that say whether there is one.
};

TEST_F(FoxgloveRun, ShowsRobotsAndObstaclesWhereTheyAre) {
  start({"run", "foxglove.yaml", "--output", results(), "--gui", "--duration", "100000"});
  FoxgloveClient client(port_, {}, target_);
  ASSERT_EQ(client.status(), "101") << client.socket().answer();
  ASSERT_TRUE(client.subscribe("/scene", 1));
  ASSERT_TRUE(client.subscribe("/robots", 2));
  const Json scene = client.data(1);
  ASSERT_EQ(scene.at("entities").size(), 3U) << scene.dump();
  // The wall of good_world.yaml: 4 m by 0.1 m by 1 m, at (0, 2). Its first edge is a short one, so
  // it is a turned one of 0.1 m by 4 m.
  const Json& wall = scene["entities"][0].at("cubes")[0];
  EXPECT_EQ(wall.at("pose").at("position").dump(), R"({"x":0.0,"y":2.0,"z":0.5})");
  EXPECT_EQ(wall.at("size").dump(), R"({"x":0.1,"y":4.0,"z":1.0})");
  EXPECT_NEAR(std::abs(wall.at("pose").at("orientation").at("z").get<double>()), std::sqrt(0.5),
              1e-9);
  EXPECT_EQ(client.data(2).at("entities").size(), 2U);
  ASSERT_TRUE(client.subscribe("/tf", 3));
  EXPECT_TRUE(comes_to(client, 3, "bert", -3, -3));
  EXPECT_TRUE(comes_to(client, 3, "carl", 3, -3));
  const Ended placed = run_rave({"place", "bert", "2.5", "0.5", "90"}, {setting()});
  EXPECT_EQ(placed.exit_code, 0) << placed.err;
  EXPECT_TRUE(comes_to(client, 3, "bert", 2.5, 0.5));
  // The clock of the run is that of the client.
  const std::uint64_t before = client.time_ns;
  ASSERT_TRUE(client.subscribe("/poses", 4));
  Json poses = client.data(4);
  // The first may be of the moment that is known already.
  while (poses.is_object() && client.time_ns <= before) poses = client.data(4);
  ASSERT_TRUE(poses.is_object());
  EXPECT_EQ(poses.at("robots")[0].at("name"), "bert");
  EXPECT_NEAR(poses.at("robots")[0].at("y_m").get<double>(), 0.5, 1e-3);
  // An obstacle that is added comes, and goes again.
  const Ended added = run_rave(
      {"edit", "add", "box", "--name", "box", "--at", "4,4", "--size", "1x1"}, {setting()});
  EXPECT_EQ(added.exit_code, 0) << added.err;
  const Json more = client.data(1);
  ASSERT_TRUE(more.is_object());
  ASSERT_EQ(more.at("entities").size(), 1U) << more.dump();
  EXPECT_EQ(more["entities"][0].at("metadata")[0].at("value"), "box");
  EXPECT_EQ(run_rave({"edit", "remove", "box"}, {setting()}).exit_code, 0);
  const Json less = client.data(1);
  ASSERT_TRUE(less.is_object());
  EXPECT_EQ(less.at("deletions")[0].at("id"), more["entities"][0].at("id"));
  EXPECT_EQ(less.at("entities").size(), 0U);
}

TEST_F(FoxgloveRun, GivesAnObserverNoByteOfAnObstacle) {
  const std::string accounts = folder_.path() / "gui";
  const Ended invited = run_rave({"people", "invite", "--accounts", accounts});
  ASSERT_EQ(invited.exit_code, 0) << invited.err;
  const std::string secret = invited.out.substr(std::string("/join?invite=").size(), 48);
  start({"run", "foxglove.yaml", "--output", results(), "--gui", "--duration", "100000",
         "--accounts", accounts});
  const std::string joined = ask("POST", "/join", {}, "invite=" + secret + "&name=ada");
  const std::size_t cookie = joined.find("Set-Cookie: ");
  ASSERT_NE(cookie, std::string::npos) << joined;
  const std::string own = joined.substr(cookie + 12, joined.find(';', cookie) - cookie - 12);
  const std::string page = ask("GET", "/foxglove", "Cookie: " + own + "\r\n", {});
  const std::size_t at = page.find("/foxglove?token=");
  ASSERT_NE(at, std::string::npos) << page;
  FoxgloveClient client(port_, {}, page.substr(at, page.find('\n', at) - at));
  ASSERT_TRUE(client.subscribe("/scene", 1));
  ASSERT_TRUE(client.subscribe("/log", 2));
  ASSERT_TRUE(client.subscribe("/tf", 3));
  const Json scene = client.data(1);
  ASSERT_TRUE(scene.is_object());
  ASSERT_EQ(scene.at("entities").size(), 1U) << scene.dump();
  // Another one comes while they look, and its event.
  const Ended added =
      run_rave({"edit", "add", "box", "--name", "hidden-box", "--at", "4.125,4", "--size", "1x1"},
               {setting()});
  EXPECT_EQ(added.exit_code, 0) << added.err;
  EXPECT_EQ(run_rave({"place", "bert", "2.5", "0.5", "90"}, {setting()}).exit_code, 0);
  EXPECT_TRUE(comes_to(client, 3, "bert", 2.5, 0.5));
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(client.data(3).is_object());
  for (const char* const word : {"crate", "post", "hidden-box", "virtual", "4.125"}) {
    EXPECT_EQ(client.socket().heard().find(word), std::string::npos) << word;
  }
}

TEST_F(FoxgloveRun, PlaysARecording) {
  const Ended ran =
      run_rave({"run", "foxglove.yaml", "--output", results(), "--pace", "max", "--duration", "3"},
               {setting()});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  start({"gui", results()});
  FoxgloveClient client(port_, {}, target_);
  ASSERT_TRUE(client.subscribe("/run", 1));
  ASSERT_TRUE(client.subscribe("/tf", 2));
  EXPECT_TRUE(comes_to(client, 2, "carl", 3, -3));
  Json state = client.data(1);
  while (state.is_object() && state.at("state") != "ended") state = client.data(1);
  ASSERT_TRUE(state.is_object());
  EXPECT_NEAR(state.at("time_s").get<double>(), 3, 0.1);
}

/// Without a desktop in front of the user the page is reached through SSH.
TEST_F(FoxgloveRun, IsToldHowToReachItFromAnotherMachine) {
  const auto told = [&](std::vector<std::string> desktop) {
    desktop_ = std::move(desktop);
    start({"run", "foxglove.yaml", "--output", results(), "--replace", "--gui", "--duration",
           "100000"});
    const bool there =
        said().find(fmt::format("ssh -L {0}:127.0.0.1:{0} ", port_)) != std::string::npos;
    TearDown();
    process_ = -1;
    return there;
  };
  EXPECT_FALSE(told({"SSH_CONNECTION=", "DISPLAY=:0", "WAYLAND_DISPLAY="}));
  EXPECT_TRUE(told({"SSH_CONNECTION=", "DISPLAY=", "WAYLAND_DISPLAY="}));
  EXPECT_TRUE(told({"SSH_CONNECTION=10.0.0.1 1 10.0.0.2 22", "DISPLAY=:0", "WAYLAND_DISPLAY="}));
}

TEST_F(FoxgloveRun, NeedsItsOption) {
  const Ended alone = run_rave({"gui", "x", "--foxglove-origin", "https://app.foxglove.dev"});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.err.find("--foxglove-origin requires --foxglove"), std::string::npos)
      << alone.err;
  const Ended unseen = run_rave({"run", "foxglove.yaml", "--foxglove", "--output", results()});
  EXPECT_EQ(unseen.exit_code, 2);
  EXPECT_NE(unseen.err.find("--foxglove requires --gui"), std::string::npos) << unseen.err;
  const Ended odd =
      run_rave({"run", "foxglove.yaml", "--gui", "--no-open", "--foxglove", "--page",
                folder_.path(), "--foxglove-origin", "app.foxglove.dev", "--output", results()});
  EXPECT_EQ(odd.exit_code, 2);
  EXPECT_NE(odd.err.find("`app.foxglove.dev` is not an origin: expected scheme and host"),
            std::string::npos)
      << odd.err;
}

}  // namespace
}  // namespace rave::cli_test
