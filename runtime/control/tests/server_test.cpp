// SPDX-License-Identifier: Apache-2.0
#include "rave/control/server.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <vector>

#include "rave/base_testing/no_threads.hpp"
#include "rave/control/client.hpp"
#include "rave/control/folder.hpp"
#include "rave/process/unix_socket.hpp"

namespace rave::control {
namespace {

namespace fs = std::filesystem;

class ServerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = "/tmp/rave-sockets-XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    ::setenv("XDG_RUNTIME_DIR", name.c_str(), 1);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Something that goes on and serves requests as a run does.
  void run(runtime::RunControl& control) {
    control.begin({"tests", "", 0, 10, 1, false, false, false, {}, {{"anna", true, true, false}}});
    begun_ = true;
    while (control.wait_for_turn([&] { serve(control); }) && !done_) {
      serve(control);
      std::this_thread::yield();
    }
    control.end();
  }
  void serve(runtime::RunControl& control) {
    control.serve(
        [this](const request::Request& request) -> Result<std::string> {
          ++served_;
          if (request.robot == "nobody") return fail(ErrorCode::kNotFound, "there is nobody");
          return "did it to " + request.robot;
        },
        [](runtime::RunStatus& status) { status.robots[0].stopped = true; });
  }

  static Request stop(const std::string& robot) { return request_of({request::Stop(), robot}); }

  fs::path folder_;
  std::atomic<int> served_{0};
  std::atomic<bool> begun_{false};
  std::atomic<bool> done_{false};
};

TEST_F(ServerTest, AsksARunAndLists) {
  runtime::RunControl control;
  const auto server = Server::start("tests-1", control);
  ASSERT_TRUE(server) << server.error().text();
  // Nobody runs yet.
  const auto early = ask("tests-1", stop("anna"));
  ASSERT_TRUE(early) << early.error().text();
  EXPECT_FALSE(early->good);
  std::thread runner([&] { run(control); });
  while (!begun_) std::this_thread::yield();
  const auto answer = ask("tests-1", stop("anna"));
  ASSERT_TRUE(answer) << answer.error().text();
  EXPECT_TRUE(answer->good);
  EXPECT_EQ(answer->text, "did it to anna");
  const auto refused = ask("tests-1", stop("nobody"));
  ASSERT_TRUE(refused);
  EXPECT_FALSE(refused->good);
  EXPECT_EQ(refused->text, "there is nobody");
  const auto status = ask("tests-1", Request{});
  ASSERT_TRUE(status);
  EXPECT_EQ(status->status.scenario, "tests");
  EXPECT_TRUE(status->status.robots.at(0).stopped);
  EXPECT_EQ(running_runs().value(), std::vector<std::string>{"tests-1"});
  EXPECT_EQ(find_run("").value(), "tests-1");
  EXPECT_EQ(find_run("tests").value(), "tests-1");
  EXPECT_EQ(find_run("1").value(), "tests-1");
  EXPECT_NE(find_run("test-1").error().message.find("did you mean `tests-1`"), std::string::npos);
  done_ = true;
  runner.join();
}

TEST_F(ServerTest, WithoutAThreadThereIsAnErrorAndNoSocket) {
  runtime::RunControl control;
  {
    const base_testing::NoThreads none;
    const auto server = Server::start("tests-1", control);
    ASSERT_FALSE(server);
    EXPECT_NE(server.error().message.find("cannot start the thread of requests of other terminals"),
              std::string::npos)
        << server.error().text();
  }
  EXPECT_TRUE(fs::is_empty(folder_ / "rave"));
  EXPECT_EQ(running_runs().value(), std::vector<std::string>());
  EXPECT_TRUE(Server::start("tests-1", control));
}

TEST_F(ServerTest, AHostOfARunIsNotTakenForIt) {
  runtime::RunControl control;
  const auto run = Server::start(own_run_name("crowd"), control);
  const auto left = Server::start(own_run_name("crowd", "left"), control);
  ASSERT_TRUE(run && left);
  EXPECT_EQ(running_runs().value().size(), 2U);
  EXPECT_EQ(find_run("").value(), own_run_name("crowd"));
  EXPECT_EQ(find_run("crowd").value(), own_run_name("crowd"));
  EXPECT_EQ(find_run("crowd@left").value(), own_run_name("crowd", "left"));
  EXPECT_NE(find_run("crowd@lef").error().message.find("crowd@left"), std::string::npos);
}

TEST_F(ServerTest, WhoHasToChooseIsToldAmongWhatAndHow) {
  runtime::RunControl control;
  const auto one = Server::start("crowd-11", control);
  const auto two = Server::start("crowd-12", control);
  ASSERT_TRUE(one && two);
  const std::string how =
      "crowd-11 and crowd-12; name one, by its name or process id, such as `11`";
  EXPECT_EQ(find_run("").error().message, "2 runs are in progress: " + how);
  EXPECT_EQ(find_run("crowd").error().message, "several runs match `crowd`: " + how);
  EXPECT_EQ(find_run("12").value(), "crowd-12");
  const std::vector<std::string_view> runs = {"crowd-11", "crowd-12"};
  EXPECT_NE(choose_one(runs, "--run").find("such as `--run 11`"), std::string::npos);
}

TEST_F(ServerTest, AHostAloneIsWhatIsMeant) {
  runtime::RunControl control;
  const auto left = Server::start(own_run_name("crowd", "left"), control);
  ASSERT_TRUE(left);
  EXPECT_EQ(find_run("").value(), own_run_name("crowd", "left"));
}

TEST(RunControlLater, ARunMayAnswerWhenItHasComeToIt) {
  runtime::RunControl control;
  control.begin({"tests", "", 0, 10, 1, false, false, false, {}, {}});
  const std::stop_token woken = control.asked();
  EXPECT_FALSE(woken.stop_requested());
  std::string answer;
  std::thread asker([&] { answer = control.ask({}).value_or("refused"); });
  while (!woken.stop_requested()) std::this_thread::yield();
  auto asked = control.take();
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_TRUE(control.take().empty());
  EXPECT_FALSE(control.asked().stop_requested());
  asked[0].answer(std::string("later"));
  asked[0].answer(std::string("twice"));
  asker.join();
  EXPECT_EQ(answer, "later");
}

TEST(RunControlLater, BeforeAndAfterTheRunTheReasonIsSaid) {
  runtime::RunControl control;
  const auto refusal = [&control] { return control.ask({}).error().message; };
  EXPECT_EQ(refusal(), "the run has not begun yet");
  EXPECT_EQ(control.idle(), refusal());
  control.begin({});
  EXPECT_EQ(control.idle(), "");
  control.end();
  EXPECT_EQ(refusal(), "the run has ended");
  EXPECT_EQ(control.idle(), refusal());
}

TEST(RunControlLater, WhoIsNeverAnsweredIsTold) {
  runtime::RunControl control;
  control.begin({"tests", "", 0, 10, 1, false, false, false, {}, {}});
  const std::stop_token woken = control.asked();
  std::string answer;
  std::thread asker([&] { answer = control.ask({}).error().message; });
  while (!woken.stop_requested()) std::this_thread::yield();
  static_cast<void>(control.take());
  asker.join();
  EXPECT_EQ(answer, "the run has ended");
}

TEST(RunControlLater, AHeldRunIsCountedOutInSteps) {
  runtime::RunControl control;
  EXPECT_TRUE(control.may_step());
  control.pause();
  EXPECT_FALSE(control.may_step());
  control.step(2);
  EXPECT_TRUE(control.may_step());
  EXPECT_TRUE(control.may_step());
  EXPECT_FALSE(control.may_step());
  control.resume();
  EXPECT_TRUE(control.may_step());
}

TEST_F(ServerTest, AStopReachesAPausedRun) {
  runtime::RunControl control;
  const auto server = Server::start("tests-2", control);
  ASSERT_TRUE(server);
  std::thread runner([&] { run(control); });
  while (!begun_) std::this_thread::yield();
  Request pause;
  pause.own = Pause();
  EXPECT_TRUE(ask("tests-2", pause).value().good);
  EXPECT_TRUE(ask("tests-2", stop("anna")).value().good);
  Request resume;
  resume.own = Resume();
  EXPECT_TRUE(ask("tests-2", resume).value().good);
  done_ = true;
  runner.join();
}

TEST_F(ServerTest, SilentAndRudeClientsHoldNobodyUp) {
  runtime::RunControl control;
  const auto server = Server::start("tests-3", control);
  ASSERT_TRUE(server);
  std::thread runner([&] { run(control); });
  while (!begun_) std::this_thread::yield();
  std::vector<Descriptor> silent;
  for (int i = 0; i < 100; ++i) {
    auto file = process::connect_to(folder_ / "rave/tests-3.sock");
    ASSERT_TRUE(file);
    if (i % 2 == 0) {
      static_cast<void>(::send(file->get(), "{\"rave\"", 7, MSG_NOSIGNAL));
    }
    silent.push_back(*std::move(file));
  }
  const std::string long_line(3 * kMaxLineBytes, 'x');
  auto rude = process::connect_to(folder_ / "rave/tests-3.sock");
  ASSERT_TRUE(rude);
  static_cast<void>(::send(rude->get(), long_line.data(), long_line.size(), MSG_NOSIGNAL));
  EXPECT_TRUE(ask("tests-3", stop("anna")).value().good);
  done_ = true;
  runner.join();
}

TEST_F(ServerTest, SocketsOfTheDeadAreSweptAway) {
  const fs::path folder = socket_folder().value();
  {
    const Descriptor file(::socket(AF_UNIX, SOCK_STREAM, 0));
    const sockaddr_un address = process::address_of(folder / "dead-7.sock").value();
    ASSERT_EQ(::bind(file.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ASSERT_TRUE(fs::exists(folder / "dead-7.sock"));
  EXPECT_TRUE(running_runs().value().empty());
  EXPECT_FALSE(fs::exists(folder / "dead-7.sock"));
  EXPECT_EQ(find_run("").error().code, ErrorCode::kNotFound);
}

TEST_F(ServerTest, RefusesAFolderThatOthersCouldHaveMade) {
  fs::create_directory(folder_ / "elsewhere");
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "rave");
  EXPECT_EQ(socket_folder().error().code, ErrorCode::kState);
  fs::remove(folder_ / "rave");
  ASSERT_TRUE(socket_folder());
  struct stat info {};
  ASSERT_EQ(::stat((folder_ / "rave").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777U, 0700U);
  ASSERT_EQ(::chmod((folder_ / "rave").c_str(), 0770), 0);
  EXPECT_EQ(socket_folder().error().code, ErrorCode::kState);
  runtime::RunControl control;
  EXPECT_FALSE(Server::start("tests-4", control));
}

}  // namespace
}  // namespace rave::control
