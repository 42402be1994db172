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
  const Ended ended = run_rave({"run", "small", "--sed=3"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err,
            "rave: there is no option `--sed`; did you mean `--seed`?\n"
            "for usage: `rave run --help`\n");
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
}

}  // namespace
}  // namespace rave::cli_test
