// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "process.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

TEST(Run, LeavesEverythingInOneFolder) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  const Ended ended = run_rave({"run", "good_scenario.yaml", "--output", output});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(ended.out.ends_with("done\n")) << ended.out;
  for (const char* const file : {"summary.txt", "result.json", "picture.svg", "picture.png",
                                 "events.log", "scenario.yaml", "console.log"}) {
    EXPECT_TRUE(fs::exists(output + "/" + file)) << file;
    EXPECT_NE(ended.out.find(file), std::string::npos) << file;
  }
  EXPECT_NE(content_of(output + "/picture.svg").find("anna (simulated robot)"), std::string::npos)
      << "few simulated robots are told apart by name and colour";
}

TEST(Run, QuietWithoutPicture) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  const Ended ended =
      run_rave({"run", "good_scenario.yaml", "--output", output, "--quiet", "--no-picture"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.out + ended.err, "");
  EXPECT_FALSE(fs::exists(output + "/picture.svg"));
}

TEST(Run, OverridesComeBeforeTheFile) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  const Ended ended = run_rave({"run", "good_scenario.yaml", "--output", output, "--seed", "41",
                                "--duration", "0.5", "--threads", "2", "--pace", "500x"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const std::string used = content_of(output + "/scenario.yaml");
  EXPECT_NE(used.find("\nseed: 41"), std::string::npos);
  EXPECT_NE(used.find("\nduration_s: 0.5"), std::string::npos);
  EXPECT_NE(used.find("\nthreads: 2"), std::string::npos);
  EXPECT_NE(used.find("\npace: \"500x\""), std::string::npos);
}

TEST(Run, AnyKeyIsSetAndWhatRunsIsWritten) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  const Ended ended = run_rave({"run", "good_scenario.yaml", "--output", output, "--no-record",
                                "--no-picture", "--set", "duration_s=0.2", "--set",
                                "robots.herd.robot.sensors.front_laser.params.rays=17", "--set",
                                "robots.0.pose.x_m=0.5"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const std::string used = content_of(output + "/scenario.yaml");
  EXPECT_NE(used.find("\nduration_s: 0.2"), std::string::npos);
  EXPECT_NE(used.find("rays: 91"), std::string::npos);
  EXPECT_NE(used.find("rays: 17"), std::string::npos);
  EXPECT_NE(used.find("x_m: 0.5"), std::string::npos);
  const Ended wrong = run_rave({"run", "good_scenario.yaml", "--set", "robots.hert.pose=null"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("--set robots.hert.pose=null: there is no item `hert`; expected a name "
                           "or 0 to 1; did you mean `herd`?"),
            std::string::npos)
      << wrong.err;
  const Ended checked = run_rave({"check", "good_scenario.yaml", "--set", "duration_s=7"});
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_NE(checked.out.find(", 7 s\n"), std::string::npos) << checked.out;
}

TEST(Run, SomeRobotsOfAnEntryAreReal) {
  const Ended ended = run_rave({"run", RAVE_SOURCE_DIR "/scenarios/corridor/hand-over.yaml",
                                "--dry-run", "--set", "robots.create.pose=null", "--set",
                                "robots.create.poses=[[1, 0, 0], [2, 0, 0], [3, 0, 0]]", "--set",
                                "robots.create.real=1"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("  this process: 3 robots: `create-1` (real), `create-2` to "
                           "`create-3`\n"),
            std::string::npos)
      << ended.out;
}

TEST(Run, ARobotFileIsNoScenario) {
  for (const auto& [file, kind] :
       {std::pair{"good_robot.yaml", "robot"}, std::pair{"good_world.yaml", "world"}}) {
    const Ended ended = run_rave({"run", file});
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_EQ(ended.err, fmt::format("rave: `{0}` is a {1} file; expected a scenario, which names "
                                     "it (`rave check {0}` checks it alone)\n",
                                     file, kind));
  }
}

TEST(Run, UnknownScenarioNamesTheNearest) {
  const Ended ended = run_rave({"run", "smal"}, {"RAVE_SHARE=share"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err,
            "rave: there is no scenario `smal`: not a file, not a folder, and not a name in "
            "`scenarios` of this folder or of `share`; did you mean `small`?\n");
}

TEST(Run, ScenarioByName) {
  const TemporaryFolder folder;
  const Ended ended = run_rave({"run", "small", "--output", folder.path()}, {"RAVE_SHARE=share"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

TEST(Run, BadInputLeavesNoFolder) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  for (const char* const file : {"empty_scenario.yaml", "unusable_driver.yaml"}) {
    const Ended ended = run_rave({"run", file, "--output", output});
    EXPECT_EQ(ended.exit_code, 2) << file;
    EXPECT_EQ(ended.out, "") << file;
    EXPECT_FALSE(fs::exists(output)) << file;
  }
  EXPECT_EQ(run_rave({"run", "good_scenario.yaml", "--pace", "fast"}).exit_code, 2);
}

TEST(Run, AFolderOfAnotherRunIsRefusedAndLeftAsItIs) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  const std::vector<std::string> words = {"run", "good_scenario.yaml", "--output", output};
  ASSERT_EQ(run_rave(words).exit_code, 0);
  const std::string record = content_of(output + "/run.mcap");
  const std::string result = content_of(output + "/result.json");
  ASSERT_FALSE(record.empty());
  for (const auto& again :
       {words,
        {"run", "good_scenario.yaml", "--output", output, "--seed", "41", "--no-record", "--quiet",
         "--processes", "2"},
        {"env", "good_scenario.yaml", "--output", output, "--processes", "2"},
        {"robot", "good_scenario.yaml", "--output", output, "--processes", "2", "--host", "host-1"},
        {"play", output, "--output", output}}) {
    const Ended ended = run_rave(again);
    EXPECT_EQ(ended.exit_code, 2) << again.front();
    EXPECT_NE(ended.err.find("the folder `" + output +
                             "` has the results of another run "
                             "(`run.mcap`); choose another folder with --output, or remove those "
                             "results with --replace"),
              std::string::npos)
        << again.front() << ": " << ended.err;
  }
  EXPECT_EQ(content_of(output + "/run.mcap"), record);
  EXPECT_EQ(content_of(output + "/result.json"), result);
}

TEST(Run, EachFileOfARunTellsThatAFolderIsUsed) {
  for (const char* const file :
       {"run.mcap", "world.mcap", "result.json", "summary.txt", "events.log", "picture.svg",
        "picture.png", "console.log", "scenario.yaml", "hosts"}) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / file);
    const Ended ended = run_rave({"run", "good_scenario.yaml", "--output", folder.path()});
    EXPECT_EQ(ended.exit_code, 2) << file;
    EXPECT_NE(ended.err.find("results of another run (`" + std::string(file) + "`)"),
              std::string::npos)
        << ended.err;
  }
}

TEST(Run, TheScenarioThatRunsIsNeverReplaced) {
  const TemporaryFolder folder;
  const std::string own = folder.path() / "scenario.yaml";
  fs::copy_file(fs::path(RAVE_SOURCE_DIR "/tests/cli/data") / "good_scenario.yaml", own);
  fs::copy_file(fs::path(RAVE_SOURCE_DIR "/tests/cli/data") / "good_robot.yaml",
                folder.path() / "good_robot.yaml");
  fs::copy_file(fs::path(RAVE_SOURCE_DIR "/tests/cli/data") / "good_world.yaml",
                folder.path() / "good_world.yaml");
  const std::string before = content_of(own);
  for (const std::string& word : {own, folder.path().string()}) {
    const Ended ended = run_rave({"run", word, "--output", folder.path(), "--replace"});
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_NE(ended.err.find("is the scenario that you run, and results would replace it"),
              std::string::npos)
        << ended.err;
    EXPECT_EQ(content_of(own), before);
  }
}

TEST(Run, ASeedIsAWholeNumber) {
  for (const char* const word : {"-1", "99999999999999999999", "1.5", "x", ""}) {
    const Ended ended = run_rave({"run", "good_scenario.yaml", "--seed", word});
    EXPECT_NE(ended.exit_code, 0) << word;
    EXPECT_NE(ended.err.find("expected a whole number from 0 to 18446744073709551615"),
              std::string::npos)
        << word << ": " << ended.err;
  }
}

TEST(Run, ReplaceLeavesNothingOfTheEarlierRunAndAllThatIsNotItsOwn) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  ASSERT_EQ(run_rave({"run", "good_scenario.yaml", "--output", output}).exit_code, 0);
  fs::create_directories(output + "/hosts/one");
  for (const char* const file : {"world.mcap", "gap-create.json", "hosts/one/run.mcap",
                                 "hosts/one/console.log", "notes.txt"}) {
    std::ofstream(output + "/" + file) << "x";
  }
  const Ended ended = run_rave({"run", "good_scenario.yaml", "--output", output, "--replace",
                                "--seed", "41", "--no-record", "--no-picture"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* const gone :
       {"run.mcap", "world.mcap", "picture.svg", "picture.png", "gap-create.json", "hosts"}) {
    EXPECT_FALSE(fs::exists(output + "/" + gone)) << gone;
  }
  EXPECT_EQ(content_of(output + "/notes.txt"), "x");
  EXPECT_NE(content_of(output + "/scenario.yaml").find("\nseed: 41"), std::string::npos);
  EXPECT_EQ(run_rave({"verify", output}).exit_code, 2) << "there is no record to verify";
}

TEST(Run, ReplaceDoesNotRemoveTheRecordThatIsPlayed) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  ASSERT_EQ(run_rave({"run", "good_scenario.yaml", "--output", output}).exit_code, 0);
  const Ended ended = run_rave({"play", output, "--output", output + "/../results", "--replace"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("--replace would remove the recording to be played, `"),
            std::string::npos)
      << ended.err;
  EXPECT_TRUE(fs::exists(output + "/run.mcap"));
}

TEST(Run, ARunThatDoesNotStartLeavesAnEmptyFolderEmpty) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_rave({"run", "unusable_driver.yaml", "--output", folder.path()}).exit_code, 2);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Run, FirstSignalEndsItEarlyWithItsResults) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  const pid_t process = start_rave({"run", "good_scenario.yaml", "--output", output, "--duration",
                                    "100000", "--pace", "realtime"});
  ASSERT_GT(process, 0);
  // The run writes this file after it began to listen.
  while (!fs::exists(output + "/scenario.yaml") && ::waitpid(process, nullptr, WNOHANG) == 0) {
    std::this_thread::yield();
  }
  ASSERT_EQ(::kill(process, SIGINT), 0);
  EXPECT_EQ(wait_for(process), 0) << "an end by hand is an end";
  const std::string result = content_of(output + "/result.json");
  EXPECT_NE(result.find("\"whole\": true"), std::string::npos) << result;
  EXPECT_EQ(result.find("\"ended_by_hand_s\": null"), std::string::npos) << result;
}

/// Until it goes, no file of this process and of those it starts may be larger.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) {
    // Inherited by a program that is started, which then gets an error as from a full disk.
    before_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    EXPECT_EQ(::getrlimit(RLIMIT_FSIZE, &before_), 0);
    const rlimit small{bytes, before_.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;
  ~SmallFiles() {
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &before_), 0);
    std::signal(SIGXFSZ, before_handler_);
  }

 private:
  rlimit before_{};
  void (*before_handler_)(int) = SIG_DFL;
};

TEST(Run, OnAFullDiskOnlyWhatDoesNotFitIsLostAndNamed) {
  const TemporaryFolder folder;
  const std::string whole = folder.path() / "whole";
  ASSERT_EQ(run_rave({"run", "good_scenario.yaml", "--output", whole, "--duration", "4"}).exit_code,
            0);
  const std::string output = folder.path() / "full";
  // The small texts fit, recording and pictures do not.
  constexpr std::uintmax_t kRoom = 60'000;
  for (const char* const file : {"result.json", "summary.txt", "events.log", "scenario.yaml"}) {
    ASSERT_LT(fs::file_size(fs::path(whole) / file), kRoom - 2000) << file;
  }
  for (const char* const file : {"run.mcap", "picture.svg", "picture.png"}) {
    ASSERT_GT(fs::file_size(fs::path(whole) / file), kRoom) << file;
  }
  Ended ended;
  {
    const SmallFiles full(kRoom);
    ended = run_rave({"run", "good_scenario.yaml", "--output", output, "--duration", "4"});
  }
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  for (const char* const file : {"result.json", "summary.txt", "events.log", "scenario.yaml"}) {
    EXPECT_TRUE(fs::exists(fs::path(output) / file)) << file;
  }
  const std::string result = content_of(output + "/result.json");
  EXPECT_NE(result.find("\"whole\": false"), std::string::npos) << result;
  for (const char* const lost : {"the recording is incomplete: ", "picture.svg` is not written: ",
                                 "picture.png` is not written: "}) {
    EXPECT_NE(result.find(lost), std::string::npos) << lost << ": " << result;
    EXPECT_NE(ended.err.find(lost), std::string::npos) << lost << ": " << ended.err;
  }
  EXPECT_FALSE(fs::exists(output + "/picture.svg") || fs::exists(output + "/picture.png"));
  EXPECT_NE(ended.out.find("run hash"), std::string::npos) << "the table: " << ended.out;
  EXPECT_EQ(run_rave({"info", output}).exit_code, 1) << "no recording is called whole";
  EXPECT_NE(run_rave({"verify", output}).exit_code, 0);
}

/// The disk is full long before the end, but its last room is for the results.
TEST(Run, ARecordingThatFillsTheDiskLeavesRoomForTheResults) {
  const TemporaryFolder folder;
  const std::string disk = folder.path() / "disk";
  const std::string kept = folder.path() / "kept";
  fs::create_directory(disk);
  fs::create_directory(kept);
  // The disk goes with its mount, and that with the shell.
  const std::string inside = fmt::format(
      "mount -t tmpfs -o size=1800k tmpfs {0} && cd {2} && touch {1}/mounted; {3}/bin/rave run "
      "good_scenario.yaml --duration 100 --pace max --output {0}/run > {1}/out 2> {1}/err; "
      "echo $? > {1}/code; cp {0}/run/*.json {0}/run/*.txt {0}/run/events.log {1}",
      disk, kept, RAVE_SOURCE_DIR "/tests/cli/data", RAVE_BINARY_DIR);
  static_cast<void>(std::system(
      fmt::format("unshare --user --map-root-user --mount sh -c '{}' 2> /dev/null", inside)
          .c_str()));
  if (!fs::exists(kept + "/mounted")) GTEST_SKIP() << "no disk of its own may be mounted here";
  EXPECT_EQ(content_of(kept + "/code"), "1\n") << content_of(kept + "/err");
  EXPECT_NE(content_of(kept + "/err").find("the recording is incomplete: "), std::string::npos)
      << content_of(kept + "/err");
  const std::string result = content_of(kept + "/result.json");
  EXPECT_NE(result.find("the recording is incomplete: "), std::string::npos) << result;
  EXPECT_NE(content_of(kept + "/summary.txt").find("run hash"), std::string::npos);
  EXPECT_TRUE(fs::exists(kept + "/events.log"));
}

TEST(Run, ReplaceWorksOnAFolderOfSeveralProcesses) {
  const TemporaryFolder folder;
  const std::string output = folder.path() / "results";
  std::vector<std::string> words = {"run",     "good_scenario.yaml", "--output",
                                    output,    "--processes",        "2",
                                    "--quiet", "--no-picture"};
  const Ended first = run_rave(words);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  ASSERT_EQ(run_rave({"info", output}).exit_code, 0) << "merged";
  words.emplace_back("--replace");
  const Ended second = run_rave(words);
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_TRUE(fs::exists(output + "/hosts/host-2/run.mcap"));
  // The same of a run of one process, which has none of it.
  const Ended alone = run_rave(
      {"run", "good_scenario.yaml", "--output", output, "--quiet", "--no-picture", "--replace"});
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_FALSE(fs::exists(output + "/hosts") || fs::exists(output + "/world.mcap"));
  // What is somebody's own stays, and is named.
  fs::create_directories(output + "/hosts/host-1");
  std::ofstream(output + "/hosts/host-1/notes.txt") << "mine";
  const Ended kept = run_rave(words);
  EXPECT_EQ(kept.exit_code, 2);
  EXPECT_NE(kept.err.find("results of another run (`hosts/host-1/notes.txt`)"), std::string::npos)
      << kept.err;
}

}  // namespace
}  // namespace rave::cli_test
