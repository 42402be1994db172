// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "process.hpp"

namespace rave::cli_test {
namespace {

TEST(Usage, HelpOfEverySubcommandHasAnExample) {
  EXPECT_NE(run_rave({"--help"}).out.find("Examples:"), std::string::npos);
  for (const char* const name : {"run", "check", "drivers", "describe", "new", "schema", "info",
                                 "verify", "play", "report", "bench", "keys", "top", "doctor"}) {
    const Ended ended = run_rave({name, "--help"});
    EXPECT_EQ(ended.exit_code, 0) << name;
    EXPECT_NE(ended.out.find("Example"), std::string::npos) << name;
    EXPECT_EQ(ended.err, "") << name;
  }
}

TEST(Usage, HelpGoesDownToTheLastName) {
  const Ended ended = run_rave({"report", "gap", "--help"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_NE(ended.out.find("--twin"), std::string::npos);
  EXPECT_EQ(run_rave({"report", "gap", "run.mcap", "--robt=x"}).err,
            "rave: there is no option `--robt`; did you mean `--robot`?\n"
            "for usage: `rave report gap --help`\n");
}

TEST(Usage, UnknownSubcommandNamesTheNearest) {
  const Ended ended = run_rave({"chekc"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err, "rave: there is no subcommand `chekc`; did you mean `check`?\n");
}

TEST(Usage, UnknownOptionNamesTheNearest) {
  const Ended ended = run_rave({"run", "small", "--sead=3"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err,
            "rave: there is no option `--sead`; did you mean `--seed`?\n"
            "for usage: `rave run --help`\n");
}

TEST(Usage, ValuesAreComplainedOfLikeThoseOfFiles) {
  const auto first_line = [](const std::vector<std::string>& words) {
    const Ended ended = run_rave(words);
    EXPECT_EQ(ended.exit_code, 2);
    return ended.err.substr(0, ended.err.find('\n'));
  };
  EXPECT_EQ(first_line({"run", "small", "--duration", "0"}),
            "rave: --duration: found `0`, expected a number from 0.0001 to 1000000000");
  EXPECT_EQ(first_line({"run", "small", "--threads", "x"}),
            "rave: --threads: found `x`, expected a whole number from 1 to 1024");
  EXPECT_EQ(first_line({"run", "small", "--seed"}), "rave: --seed: found nothing, expected N");
  EXPECT_EQ(first_line({"place", "a", "x", "1"}), "rave: pose: found `x,1`, expected a number");
  EXPECT_EQ(first_line({"export", "run.mcap", "poess"}),
            "rave: what: found `poess`, expected one of poses, readings, events; did you mean "
            "`poses`?");
  EXPECT_EQ(first_line({"info"}), "rave: missing FILE: Recording (run.mcap), or folder of a run");
  EXPECT_EQ(first_line({"robot", "small"}),
            "rave: missing option --host NAME: Name of the host in the scenario");
  EXPECT_EQ(first_line({"report"}),
            "rave: report: expected the folder of a sweep, or `gap` with a recording");
}

TEST(Usage, HiddenOptionsAreNotOffered) {
  const Ended ended = run_rave({"run", "small", "--dds-onyl"});
  EXPECT_EQ(ended.err.find("--dds-only"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.err.find("--bus-tag"), std::string::npos) << ended.err;
}

TEST(Usage, HelpIsFoundWhereItIsLookedFor) {
  EXPECT_EQ(run_rave({"help"}).out, run_rave({"--help"}).out);
  EXPECT_EQ(run_rave({"help"}).exit_code, 0);
  EXPECT_EQ(run_rave({"help", "run"}).out, run_rave({"run", "--help"}).out);
  EXPECT_EQ(run_rave({"help", "rnu"}).err,
            "rave: there is no subcommand `rnu`; did you mean `run`?\n");
  EXPECT_NE(run_rave({"run", "--help"}).out.find("corridor, figure-3, flock, hybrid-laser"),
            std::string::npos);
  EXPECT_NE(run_rave({"scenarios"}).err.find("`rave run --help` lists the scenarios"),
            std::string::npos);
}

TEST(Usage, NothingAtAllShowsTheHelp) {
  const Ended ended = run_rave({});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("Runs in progress:"), std::string::npos);
}

TEST(Usage, VersionBothWays) {
  const Ended ended = run_rave({"version"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.out.substr(0, 5), "rave ");
  EXPECT_NE(ended.out.find("robot interface"), std::string::npos);
  EXPECT_EQ(run_rave({"--version"}).out, ended.out);
}

TEST(Usage, SchemaOfAnUnknownKind) {
  EXPECT_EQ(run_rave({"schema", "scenrio"}).err,
            "rave: there is no kind of file `scenrio`; did you mean `scenario`?\n");
  for (const char* const kind : {"robot", "world", "scenario"}) {
    EXPECT_EQ(run_rave({"schema", kind}).out,
              content_of(std::string(RAVE_SOURCE_DIR "/schemas/config/") + kind + ".schema.json"))
        << kind;
  }
}

TEST(Usage, NewMakesAProjectAndSaysWhatComesNext) {
  const TemporaryFolder folder;
  const std::string target = folder.path() / "follow_wall";
  const Ended ended = run_rave({"new", "program", "follow_wall", "--directory", target},
                               {"RAVE_SHARE=" RAVE_SOURCE_DIR "/share"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(std::filesystem::exists(target + "/follow_wall.cpp"));
  EXPECT_NE(ended.out.find("cmake --build " + target + "/build\n"), std::string::npos) << ended.out;
  EXPECT_EQ(run_rave({"new", "progam", "x"}).exit_code, 2);
  const std::string other = folder.path() / "other";
  EXPECT_EQ(run_rave({"new", "program", "wander", "--directory", other},
                     {"RAVE_SHARE=" RAVE_SOURCE_DIR "/share"})
                .err,
            "rave: `wander` is the name of a program that comes with RAVE, which yours would hide; "
            "choose another\n");
  EXPECT_FALSE(std::filesystem::exists(other));
}

}  // namespace
}  // namespace rave::cli_test
